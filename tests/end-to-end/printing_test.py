"""Printer profiles, tracks and the G-code's own arithmetic, as a user meets them. PROGRAM from RIBVAULT."""
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["RIBVAULT"]
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CUBE = ROOT / "experiments/models/cube20.stl"
TEMPERATURES = "nozzle_temperature = 200\nbed_temperature = 50\n"


class Printing(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, "generate", CUBE, "-o", "a.gcode", "--report", "a.json", *map(str, arguments)], cwd=self.folder,
                              capture_output=True, text=True)

    def gcode(self, *arguments):
        done = self.run_program(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "a.gcode").read_text(), json.loads((self.folder / "a.json").read_text())

    def test_the_report_is_what_the_file_does(self):
        for options in ([], ["--covers", "concentric", "--perimeters", "2", "--brim", "3", "--skirt", "2", "--first-layer-width", "0.5"],
                        ["--shell-first", "--seam", "nearest", "--retract-over", "0", "--covers", "monotonic"]):
            text, report = self.gcode(*options)
            along, pushed, retractions, x, y, travel = 0, 0, 0, 0, 0, 0
            layers = text.split(";LAYER_CHANGE", 1)[1].split("; end of print")[0]
            first = True
            for line in layers.splitlines():
                words = {w[0]: float(w[1:]) for w in line.split(";")[0].split()[1:]} if line.startswith("G") else {}
                moves = "X" in words
                if moves and "E" not in words:
                    travel += 0 if first else math.hypot(words["X"] - x, words["Y"] - y)
                    first = False
                if moves:
                    x, y = words["X"], words["Y"]
                if "E" in words and not moves and words["E"] < 0:
                    retractions += 1
                    pushed += words["E"]
                elif "E" in words and not moves and abs(words["E"]) >= 3:
                    pushed += words["E"]
                elif "E" in words:
                    along += words["E"]
            totals = report["totals"]
            area = math.pi / 4 * 1.75 ** 2
            self.assertAlmostEqual(along * area / totals["extruded_mm3"], 1, delta=0.001)
            # The file's last retraction stays; the header's first one is primed in the first layer.
            self.assertAlmostEqual(pushed * area, totals["prime_surplus_mm3"], delta=0.001)
            self.assertEqual(retractions, totals["retractions"])
            self.assertAlmostEqual(travel, totals["travel_mm"], delta=0.01)
            self.assertEqual(totals["travels"], sum(layer["travels"] for layer in report["layers"]))
            self.assertEqual(totals["bends"], sum(layer["bends"] for layer in report["layers"]))
            self.assertGreater(totals["bends"], 0)
            self.assertIn("; estimated printing time (normal mode) = ", text)

    def test_profiles(self):
        (self.folder / "mine.ini").write_text(TEMPERATURES + "flavour = klipper\nstart_gcode = START_PRINT BED={bed_temperature}\nend_gcode = END_PRINT\n")
        text, report = self.gcode("--profile", "mine.ini", "--temperature", "190")
        self.assertIn("\nSTART_PRINT BED=50\n", text)
        self.assertIn("\nEND_PRINT\n", text)
        self.assertIn("M109 S190", text)  # what is written out wins over the profile
        self.assertEqual(report["printer"]["flavour"], "klipper")
        for name in ("ultimaker2", "ultimaker3", "prima-p120", "cr-10", "microdelta"):
            text, report = self.gcode("--printer", name)
            xs = [float(x) for x in re.findall(r"^G1 X(-?[0-9.]+)", text, re.M)]
            middle = report["printer"]["bed_corner_mm"][0] + report["printer"]["bed_mm"][0] / 2
            self.assertAlmostEqual((min(xs) + max(xs)) / 2, middle, delta=0.01)

    def test_bad_profiles_are_refused_with_key_and_line(self):
        for text, fragment in ((TEMPERATURES + "colour = red\n", "mine.ini:3: colour"), ("bed_temperature = 60\n", "nozzle_temperature: missing"),
                               ("nozzle_temperature = hot\n", "mine.ini:1: nozzle_temperature: 'hot'")):
            (self.folder / "mine.ini").write_text(text)
            done = self.run_program("--profile", "mine.ini")
            self.assertEqual(done.returncode, 2)
            self.assertIn(fragment, done.stderr)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertEqual(self.run_program("--profile", "none.ini").returncode, 3)
        (self.folder / "mine.ini").write_text("\n")
        self.assertEqual(self.run_program("--profile", "mine.ini").returncode, 3)
        self.assertEqual(self.run_program("--printer", "none").returncode, 2)

    def test_perimeters_inner_first_on_islands_of_unequal_width(self):
        """One island has no room for an inner perimeter."""
        boxes = ((0, 10), (11, 11.6))
        corners = [(x, y, z) for lo, hi in boxes for z in (0, 4) for x, y in ((lo, 0), (hi, 0), (hi, 10), (lo, 10))]
        faces = [[8 * k + v for v in f] for k in (0, 1) for f in ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))]
        towers = self.folder / "towers.off"
        towers.write_text("OFF\n16 12 0\n" + "".join("%g %g %g\n" % c for c in corners) + "".join("4 %d %d %d %d\n" % tuple(f) for f in faces))
        for options in ([], ["--shell-first"], ["--strategy", "thrifty"]):
            done = subprocess.run([PROGRAM, "generate", towers, "-o", "a.gcode", "--perimeters", "2", "--inner-first", "--quiet", *options],
                                  cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            types = re.findall(r"^;TYPE:(.*)$", (self.folder / "a.gcode").read_text(), re.M)
            self.assertIn("Perimeter", types)
            self.assertEqual(subprocess.run([PROGRAM, "verify", "a.gcode", "--inside", "--quiet"], cwd=self.folder).returncode, 0)

    def test_a_print_that_begins_in_the_air_says_so(self):
        """A pyramid on its tip: the lowest slices have no room for any track."""
        (self.folder / "tip.off").write_text("OFF\n5 6 0\n0 0 0\n2 2 9\n-2 2 9\n-2 -2 9\n2 -2 9\n3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 1\n3 1 3 2\n3 1 4 3\n")
        done = subprocess.run([PROGRAM, "generate", "tip.off", "-o", "a.gcode"], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("begins in the air", done.stdout)
        first = re.search(r"^;LAYER:(\d+)\n;Z:(\S+)\n(?:(?!;LAYER:).*\n)*?;TYPE:", (self.folder / "a.gcode").read_text(), re.M)
        self.assertRegex(done.stdout, r"nothing is printed on %s of \d+ layers, without room for a track \(the lowest is layer 0\): what is above" % first.group(1))
        done = subprocess.run([PROGRAM, "verify", "a.gcode"], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("mm over z = 0", done.stderr)
        done = subprocess.run([PROGRAM, "generate", "tip.off", "-o", "a.gcode", "--skirt", "2"], cwd=self.folder, capture_output=True, text=True)
        self.assertIn("begins in the air", done.stdout)
        self.gcode()
        done = subprocess.run([PROGRAM, "verify", "a.gcode"], cwd=self.folder, capture_output=True, text=True)
        self.assertNotIn("over z = 0", done.stderr)

    def test_an_hourglass_that_goes_on_in_the_air_says_so(self):
        """Two pyramids tip to tip: no slice near the tips has room for a track."""
        (self.folder / "glass.off").write_text(
            "OFF\n9 12 0\n0 0 9\n2 2 0\n-2 2 0\n-2 -2 0\n2 -2 0\n2 2 18\n-2 2 18\n-2 -2 18\n2 -2 18\n"
            "3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 1\n3 1 3 2\n3 1 4 3\n3 0 6 5\n3 0 7 6\n3 0 8 7\n3 0 5 8\n3 5 6 7\n3 5 7 8\n")
        done = subprocess.run([PROGRAM, "generate", "glass.off", "-o", "a.gcode"], cwd=self.folder, capture_output=True, text=True)
        printed = [int(n) for n in re.findall(r"^;LAYER:(\d+)\n;Z:\S+\n(?:(?!;LAYER:).*\n)*?;TYPE:", (self.folder / "a.gcode").read_text(), re.M)]
        empty = sorted(set(range(max(printed))) - set(printed))
        self.assertGreater(len(empty), 1)
        self.assertRegex(done.stdout, r"nothing is printed on %d of \d+ layers, without room for a track \(the lowest is layer %d\)" % (len(empty), empty[0]))

    def test_a_print_of_which_only_the_floor_is_left_says_so(self):
        """Walls of 0.1 mm on a plate: nothing is printed above the plate."""
        corners = [(x, y, z) for z in (0, 1, 9) for x, y in ((0, 0), (20, 0), (20, 20), (0, 20), (0, 0.1), (20, 0.1))]
        box = lambda a, b, c, d, e, f, g, h: [(a, d, c), (a, c, b), (e, f, g), (e, g, h), (a, b, f), (a, f, e), (b, c, g), (b, g, f), (c, d, h), (c, h, g), (d, a, e), (d, e, h)]
        faces = box(0, 1, 2, 3, 6, 7, 8, 9) + box(6, 7, 11, 10, 12, 13, 17, 16)
        (self.folder / "vase.off").write_text("OFF\n%d %d 0\n" % (len(corners), len(faces)) + "".join("%g %g %g\n" % c for c in corners) +
                                              "".join("3 %d %d %d\n" % f for f in faces))
        done = subprocess.run([PROGRAM, "generate", "vase.off", "--html", "a.html"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("nothing is printed on 40 of 45 layers, without room for a track (the lowest is layer 5)\n", done.stdout)

    def test_no_output_takes_a_picture_s_name(self):
        for output in ("-o", "--report"):
            done = subprocess.run([PROGRAM, "generate", CUBE, output, "svg/layer_00003.svg", "--svg", "svg"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("svg/layer_00003.svg has the name of a picture in the folder of --svg", done.stderr)
            self.assertFalse((self.folder / "svg").exists())
        (self.folder / "link.html").symlink_to("svg/layer_00001.svg")
        done = subprocess.run([PROGRAM, "generate", CUBE, "--html", "link.html", "--svg", "svg"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)

    def test_a_print_of_dots_is_not_empty(self):
        (self.folder / "post.off").write_text("OFF\n8 12 0\n" + "".join("%g %g %g\n" % (x, y, z) for z in (0, 4) for x, y in ((0, 0), (0.4, 0), (0.4, 0.4), (0, 0.4))) +
                                              "3 0 3 2\n3 0 2 1\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n")
        done = subprocess.run([PROGRAM, "generate", "post.off", "-o", "a.gcode", "--report", "a.json"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("nothing is printed", done.stdout)
        self.assertEqual({layer["empty"] for layer in json.loads((self.folder / "a.json").read_text())["layers"]}, {False})

    def test_import_says_what_it_ignored(self):
        (self.folder / "prusa.ini").write_text("layer_height = 0.3\nperimeters = 2\nfill_density = 20%\nbed_shape = 0x0,200x0,200x180,0x180\n")
        done = self.run_program("--import", "prusa.ini", "--perimeters", "1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("3 settings taken, 1 ignored: fill_density", done.stderr)
        settings = json.loads((self.folder / "a.json").read_text())["settings"]
        self.assertEqual(settings["layer_height_mm"], 0.3)
        self.assertEqual(settings["perimeters"], 1)
        for corner, far in ((3, 33), (-40, -10)):
            (self.folder / "prusa.ini").write_text("bed_shape = {0}x{0},{1}x{0},{1}x{1},{0}x{1}\n".format(corner, far))
            self.assertEqual(self.run_program("--import", "prusa.ini").returncode, 0)
            moves = re.findall(r"^G1 X(-?[0-9.]+) Y(-?[0-9.]+)", (self.folder / "a.gcode").read_text(), re.M)
            for places in zip(*moves):
                self.assertAlmostEqual((min(map(float, places)) + max(map(float, places))) / 2, (corner + far) / 2, delta=0.01)
            self.assertEqual(self.run_program("--import", "prusa.ini", "--brim", "6").returncode, 5)
        (self.folder / "prusa.ini").write_text("perimeters = 0\nthumbnails = big\n")
        done = self.run_program("--import", "prusa.ini", "--thumbnails", "none")
        self.assertEqual(done.returncode, 2)
        self.assertIn("prusa.ini:1: perimeters: ", done.stderr)
        self.assertIn("imported from prusa.ini", done.stderr)
        self.assertEqual(self.run_program("--import", "prusa.ini", "--thumbnails", "none", "--perimeters", "1").returncode, 0)
        done = self.run_program("--import", "prusa.ini", "--thumbnails", "none", "--perimeters", "1", "--quiet")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_the_bed_is_checked_with_skirt_and_brim(self):
        self.assertEqual(self.run_program("--bed", "24,24,30").returncode, 0)
        done = self.run_program("--bed", "24,24,30", "--brim", "3")
        self.assertEqual(done.returncode, 5)
        self.assertIn("skirt and brim", done.stderr)
        done = self.run_program("--printer", "microdelta", "--scale", "10")
        self.assertEqual(done.returncode, 5)
        advised = re.search(r"use --scale (\S+) or less", done.stderr).group(1)
        self.assertEqual(self.run_program("--printer", "microdelta", "--scale", advised).returncode, 0)

    def test_nothing_goes_higher_than_the_printer(self):
        self.assertEqual(self.run_program("--height", "20.09", "--bed", "100,100,20.1", "--layer-height", "0.1").returncode, 0)
        heights = [float(z) for z in re.findall(r"^G\d [^;]*Z([0-9.]+)", (self.folder / "a.gcode").read_text(), re.M)]
        self.assertEqual(max(heights), 20.1)
        self.assertEqual(self.run_program("--height", "20.09", "--bed", "100,100,20.09", "--layer-height", "0.49").returncode, 0)
        done = self.run_program("--height", "20", "--bed", "100,100,20", "--layer-height", "0.3")
        self.assertEqual(done.returncode, 5)
        self.assertIn("20.1 mm", done.stderr)

    def test_the_temperature_that_is_written_holds_from_the_first_layer_on(self):
        (self.folder / "mine.ini").write_text(TEMPERATURES + "first_layer_temperature = 210\n")
        self.assertIn("M104 S200 ;", self.gcode("--profile", "mine.ini")[0].split(";LAYER:1")[1])
        text, _ = self.gcode("--profile", "mine.ini", "--temperature", "190")
        self.assertIn("M109 S190", text)
        self.assertNotIn("M104", text.split(";LAYER:1")[1].split("; end of print")[0])
        text, _ = self.gcode("--profile", "mine.ini", "--temperature", "190", "--first-layer-temperature", "195")
        self.assertIn("M109 S195", text)
        self.assertIn("M104 S190 ;", text.split(";LAYER:1")[1])

    def test_a_tool_that_prints_nothing_stays_cold(self):
        self.assertNotIn("T2", self.gcode("--support", "both", "--support-extruder", "2", "--thumbnails", "none")[0])

    def test_every_move_of_a_fine_print_extrudes(self):
        text, _ = self.gcode("--nozzle", "0.1", "--layer-height", "0.02", "--filament-diameter", "2.85", "--height", "1.5")
        self.assertIsNone(re.search(r" E0(?![.\d])", text))
        self.assertEqual(subprocess.run([PROGRAM, "verify", "a.gcode", "--inside", "--quiet"], cwd=self.folder).returncode, 0)

    def test_thumbnails(self):
        text, _ = self.gcode("--thumbnails", "16x16,220x124")
        self.assertEqual(re.findall(r"^; thumbnail begin (\d+x\d+) ", text, re.M), ["16x16", "220x124"])
        self.assertNotIn("thumbnail", self.gcode("--thumbnails", "none")[0])
        self.assertEqual(self.run_program("--thumbnails", "big").returncode, 2)

    def test_narrower_supports_take_less_and_are_held_up(self):
        for options in (["--strategy", "paper"], ["--strategy", "thrifty", "--length-bound"], ["--wall-lines", "2", "--wall-lines-longer", "3"]):
            _, full = self.gcode(*options)
            text, narrow = self.gcode(*options, "--support-width", "0.28")
            if "--length-bound" in options:
                self.assertGreater(narrow["totals"]["support_length_bound_mm"], 1.1 * full["totals"]["support_length_bound_mm"])
            self.assertEqual((full["settings"]["support_width_mm"], narrow["settings"]["support_width_mm"]), (0.4, 0.28))
            self.assertLess(narrow["totals"]["support_volume_mm3"], 0.85 * full["totals"]["support_volume_mm3"])
            self.assertAlmostEqual(narrow["totals"]["shell_volume_mm3"], full["totals"]["shell_volume_mm3"], delta=0.01)
            widths = {(kind, width) for kind, width in re.findall(r"^;TYPE:(.*)\n;WIDTH:(.*)$", text, re.M)}
            self.assertEqual({width for kind, width in widths if kind == "Internal infill"}, {"0.28"})
            self.assertEqual({width for kind, width in widths if "perimeter" in kind.lower()}, {"0.4"})
            self.assertTrue(narrow["verdict"]["proved"] and narrow["verdict"]["print"]["proved"])
            judged = subprocess.run([PROGRAM, "verify", "a.gcode", "--inside"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(judged.returncode, 0, judged.stdout)

    def test_long_walls_get_several_lines_and_are_held_up(self):
        self.gcode()
        one = json.loads((self.folder / "a.json").read_text())["totals"]
        self.assertEqual(one["wide_trees"], 0)
        self.assertGreater(one["slenderness"], 1)
        for lines in (2, 3):
            self.gcode("--wall-lines", lines, "--wall-lines-longer", 3)
            totals = json.loads((self.folder / "a.json").read_text())["totals"]
            self.assertGreater(totals["wide_trees"], 0)
            self.assertGreater(totals["support_printed_length_mm"], 1.3 * one["support_printed_length_mm"])
            self.assertLess(totals["slenderness"], one["slenderness"])
            judged = subprocess.run([PROGRAM, "verify", "a.gcode", "--inside"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(judged.returncode, 0, judged.stdout)

    def test_the_same_bytes_for_any_number_of_threads(self):
        options = ["--covers", "monotonic", "--seam", "nearest", "--brim", "2", "--printer", "cr-10"]
        texts = {self.gcode(*options, "--threads", n)[0] for n in (1, 2, 7)}
        self.assertEqual(len(texts), 1)


if __name__ == "__main__":
    unittest.main()
