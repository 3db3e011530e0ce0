"""`ribvault generate --support external|both` as a user runs it: what is written is supported, as `ribvault verify` reads it back."""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.environ["RIBVAULT"]
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "experiments"))
from make_solids import box, lathe, write_stl  # noqa: E402

CUBE = ROOT / "experiments/models/cube20.stl"


class External(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.table = self.folder / "table.stl"
        write_stl(self.table, box((0, 0, 0), (3, 3, 6)) + box((-5, -5, 6), (8, 8, 7)) + box((6, 6, 3), (7, 7, 6)))

    def run_program(self, command, *arguments):
        return subprocess.run([PROGRAM, command, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)

    def test_what_is_written_is_supported_outside_too(self):
        for support in ("external", "both"):
            done = self.run_program("generate", self.table, "-o", "a.gcode", "--report", "a.json", "--support", support)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("external supports", done.stdout)
            judged = self.run_program("verify", "a.gcode")
            self.assertEqual(judged.returncode, 0, judged.stdout)
            self.assertIn("Support material", judged.stdout)
            self.assertEqual(json.loads((self.folder / "a.json").read_text())["verdict"]["external_overhangs"], [])
        self.run_program("generate", self.table, "-o", "a.gcode", "--quiet")
        self.assertEqual(self.run_program("verify", "a.gcode").returncode, 1)

    def test_a_solid_object_is_solid_whatever_gaps_are_filled(self):
        plate = self.folder / "plate.stl"
        write_stl(plate, box((0, 0, 0), (20, 1.15, 5)))
        volumes = []
        for which in ("all", "needed"):
            done = self.run_program("generate", plate, "--report", "a.json", "--support", "external", "--fill-gaps", which)
            self.assertEqual(done.returncode, 0, done.stderr)
            volumes.append(json.loads((self.folder / "a.json").read_text())["totals"]["extruded_mm3"])
        self.assertEqual(volumes[0], volumes[1])
        self.assertGreater(volumes[0], 0.95 * 20 * 1.15 * 5)

    def test_the_supports_in_the_gcode_keep_the_gap(self):
        done = self.run_program("generate", self.table, "-o", "a.gcode", "--support", "external", "--support-gap", "0.3")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("removal gap", done.stdout)
        here, kind, z, supports = None, "", 0.0, 0
        for line in (self.folder / "a.gcode").read_text().splitlines():
            if line.startswith(";TYPE:"):
                kind = line[6:]
            elif line.startswith(";Z:"):
                z = float(line[3:])
            elif move := re.match(r"G[01] X(\S+) Y(\S+)( E)?", line):
                x, y = float(move[1]), float(move[2])
                if move[3] and kind == "Support material" and z <= 6:
                    supports += 1
                    for px, py in (here, (x, y)) if z <= 3 else ():  # there the leg alone is object: 3 x 3 mm about the middle of the bed
                        apart = math.hypot(max(abs(px - 125) - 1.5, 0), max(abs(py - 125) - 1.5, 0))
                        self.assertGreaterEqual(apart, 0.5, line)  # the gap and half a track
                here = x, y
        self.assertGreater(supports, 50)

    def test_what_is_asked_of_supports_outside_changes_nothing_inside(self):
        def inside(*arguments):
            done = self.run_program("generate", CUBE, "--report", "a.json", "--strategy", "thrifty", *arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
            totals = json.loads((self.folder / "a.json").read_text())["totals"]
            return [totals[k] for k in ("support_volume_mm3", "patches", "travels")]
        alone = inside()
        for rules in ([], ["--bed-only"], ["--support-gap", "0.3"], ["--support-gap-layers", "1"]):
            self.assertEqual(inside("--support", "both", *rules), alone, rules)
        narrow = ["--support-width", "0.3"]  # a gap within what the object holds up
        self.assertEqual(inside("--support", "both", "--support-gap", "0.04", *narrow), inside(*narrow))

    def test_corners_of_the_object_are_printed_however_narrow_supports_are(self):
        funnel = self.folder / "funnel.off"  # a plate that grows wider upwards
        corners = [(x * w, y * w, z) for z, w in ((0, 4), (1, 4), (5, 10)) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        sides = [(a, b, b + 4, a + 4) for k in (0, 4) for a, b in ((k, k + 1), (k + 1, k + 2), (k + 2, k + 3), (k + 3, k))]
        faces = [(3, 2, 1, 0), *sides, (8, 9, 10, 11)]
        funnel.write_text("\n".join(["OFF", f"{len(corners)} {len(faces)} 0", *(" ".join(map(str, c)) for c in corners), *(" ".join(map(str, (4, *s))) for s in faces), ""]))
        patches = []
        for width in ("0.4", "0.28"):
            done = self.run_program("generate", funnel, "--report", "a.json", "--support", "external", "--support-gap", "0.1", "--support-gap-layers", "1",
                                    "--support-width", width)
            self.assertEqual(done.returncode, 0, done.stderr)
            patches.append(json.loads((self.folder / "a.json").read_text())["totals"]["patches"])
        self.assertLess(patches[1], 2 * patches[0] + 10)

    def test_supports_that_come_off_are_judged_by_the_same_rules(self):
        for rules in (["--support-gap-layers", "1"], ["--support-gap", "0.3", "--support-gap-layers", "2"], ["--support-gap", "0.2", "--bed-only"]):
            done = self.run_program("generate", self.table, "-o", "a.gcode", "--support", "external", *rules)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            judged = self.run_program("verify", "a.gcode", *rules, "--report", "a.json")
            self.assertEqual(judged.returncode, 0, judged.stdout)
            settings = json.loads((self.folder / "a.json").read_text())["settings"]
            self.assertEqual((settings["support_gap_layers"] > 0, settings["bed_only"]), ("--support-gap-layers" in rules, "--bed-only" in rules))
            if "--support-gap-layers" in rules:
                judged = self.run_program("verify", "a.gcode", "--html", "a.html")
                self.assertEqual(judged.returncode, 1, judged.stdout)
                fewer = self.run_program("verify", "a.gcode", *rules[:-1], str(int(rules[-1]) - 1), "--svg", "pictures")
                self.assertEqual(fewer.returncode, 1, fewer.stdout)

    def test_layers_of_the_gap_on_which_nothing_is_printed_count(self):
        # A box over another one and air: under it supports stand on that, up to the gap, and the gap's layers are empty.
        write_stl(self.table, box((-4, -4, 0), (4, 4, 2)) + box((-4, -4, 4), (4, 4, 6)))
        done = self.run_program("generate", self.table, "-o", "a.gcode", "--support", "external", "--support-gap-layers", "3")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for layers, expected in (("2", 1), ("3", 0), ("4", 0)):
            self.assertEqual(self.run_program("verify", "a.gcode", "--support-gap-layers", layers).returncode, expected)

    def test_no_patch_is_printed_twice(self):
        # A lamp on its foot: supports from the bed do not reach under its shade, whose edge the slices below hold up.
        write_stl(self.table, lathe([(8, 0), (8, 1), (2, 1.5), (2, 6), (8, 9), (8, 10)], 24))
        self.run_program("generate", self.table, "-o", "a.gcode", "--layers", "a.layers", "--support", "external", "--bed-only")
        patches = [[json.dumps(p) for p in json.loads(line)["patch_tracks"]] for line in (self.folder / "a.layers").read_text().splitlines()[1:]]
        every, once = sum(map(len, patches)), sum(len(set(here)) for here in patches)
        self.assertGreater(every, 100)
        self.assertLess(every - once, every / 50)  # a few lie within a micrometre, to which the file rounds, of another

    def test_supports_on_the_bed_alone_stand_on_no_part_of_the_object(self):
        # A roof over a foot that reaches a little farther.
        write_stl(self.table, box((-4.5, -4.5, 0), (4.5, 4.5, 1)) + box((-1, -1, 1), (1, 1, 7)) + box((-4, -4, 7), (4, 4, 8)))
        for bed_only, expected in (([], 1), (["--bed-only"], 0)):
            done = self.run_program("generate", self.table, "-o", "a.gcode", "--support", "external", *bed_only)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(self.run_program("verify", "a.gcode", "--support-gap", "0").returncode, 0)
            self.assertEqual(self.run_program("verify", "a.gcode", "--support-gap", "0", "--bed-only").returncode, expected)

    def test_what_is_not_proved_is_said_quietly_too(self):
        # The foot reaches so far that no way from the bed leads under the roof.
        write_stl(self.table, box((-3, -3, 0), (3, 3, 0.4)) + box((-0.6, -0.6, 0.4), (0.6, 0.6, 1)) + box((-1.2, -1.2, 1), (1.2, 1.2, 1.4)))
        for quiet in ([], ["--quiet"]):
            done = self.run_program("generate", self.table, "-o", "a.gcode", "--support", "external", "--bed-only", *quiet)
            self.assertEqual(done.returncode, 1)
            self.assertIn("NOT PROVED", done.stderr if quiet else done.stdout)
            self.assertIn("no --bed-only", done.stderr if quiet else done.stdout)
        self.assertEqual(done.stdout, "")

    def test_a_second_tool_prints_the_supports(self):
        done = self.run_program("generate", self.table, "-o", "a.gcode", "--support", "external", "--support-extruder", "1", "--support-temperature", "190")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        tool, kind, printed, heated, layer, changes = 0, "", {}, False, -1, {}
        for line in (self.folder / "a.gcode").read_text().splitlines():
            heated = heated or line.startswith("M109 T1 S190")
            if line.startswith(";LAYER:"):
                layer = int(line[7:])
            elif re.fullmatch(r"T\d+", line):
                tool = int(line[1:])
                if layer >= 0:
                    changes[layer] = changes.get(layer, 0) + 1
            elif line.startswith(";TYPE:"):
                kind = line[6:]
            elif re.match(r"G1 X.* E", line):
                printed.setdefault(kind, set()).add(tool)
        self.assertTrue(heated)
        self.assertEqual(set(changes.values()), {1}, changes)  # last on even layers, first on odd ones
        self.assertEqual(printed.pop("Support material"), {1})
        self.assertEqual(set().union(*printed.values()), {0})
        self.assertEqual(self.run_program("verify", "a.gcode").returncode, 0)

    def test_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 2):
            self.run_program("generate", self.table, "-o", f"{threads}.gcode", "--support", "both", "--threads", threads, "--quiet")
        self.assertEqual((self.folder / "1.gcode").read_bytes(), (self.folder / "2.gcode").read_bytes())

    def test_what_cannot_be_is_refused(self):
        for arguments, fragment in ((["--support", "some"], "--support"), (["--support-gap", "0.2"], "--support external"), (["--bed-only"], "--support external"), (["--support-gap-layers", "1"], "--support external"), (["--pillars", "--brace", "5"], "--brace"),
                                    (["--pillars", "--length-bound"], "--length-bound"), (["--pillars", "--strategy", "thrifty", "--leaning-length", "0.39"], "--leaning-length"),
                                    (["--pillars", "--strategy", "thrifty", "--leaning-ratio", "0"], "--leaning-ratio"), (["--leaning-length", "1", "--strategy", "thrifty"], "--pillars"), (["--leaning-ratio", "5", "--strategy", "thrifty"], "--pillars"),
                                    (["--pillars", "--leaning-length", "1"], "thrifty"),
                                    (["--pillars", "--leaning-length", "1", "--strategy", "thrifty", "--support", "external"], "--support external"), (["--pillars", "--leaning-ratio", "5", "--strategy", "thrifty", "--no-shrink"], "--no-shrink"),
                                    (["--support", "both", "--support-gap", "9"], "--support-gap")):
            done = self.run_program("generate", CUBE, "-o", "a.gcode", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(fragment, done.stderr)
            self.assertFalse((self.folder / "a.gcode").exists())


if __name__ == "__main__":
    unittest.main()
