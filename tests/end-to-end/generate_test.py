"""`ribvault generate` as a user runs it: exit codes, messages, files. Run by CTest with the program's path in RIBVAULT."""
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["RIBVAULT"]
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CUBE = ROOT / "experiments/models/cube20.stl"
CORPUS = ROOT / "tests/corpus/meshes"


def files_up_to(size):
    """For a child process: files cannot grow beyond so many bytes, as on a full disk."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return limit


class Generate(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def run_program(self, *arguments, **options):
        return subprocess.run([PROGRAM, "generate", *map(str, arguments)], cwd=self.folder, capture_output=True, text=True,
                              **options)

    def files(self):
        return {p.name for p in self.folder.iterdir()}

    def refuse(self, code, fragment, *arguments):
        done = self.run_program(*arguments, "-o", "out.gcode")
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(fragment, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertEqual(self.files(), set())

    def test_everything_is_written_and_said(self):
        done = self.run_program(CUBE, "-o", "a.gcode", "--report", "a.json", "--svg", "pictures", "--mesh", "walls.stl")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("equation (2) holds on all 100 layers", done.stdout)
        self.assertEqual(self.files(), {"a.gcode", "a.json", "pictures", "walls.stl"})
        self.assertEqual(len(list((self.folder / "pictures").iterdir())), 100)
        report = json.loads((self.folder / "a.json").read_text())
        self.assertTrue(report["verdict"]["proved"])
        self.assertEqual(len(report["layers"]), 100)
        gcode = (self.folder / "a.gcode").read_text()
        self.assertEqual(re.findall(r"^;LAYER:(\d+)$", gcode, re.M), [str(k) for k in range(100)])
        pushed = sum(float(e) for e in re.findall(r"^G1 X\S+ Y\S+ E(\S+)", gcode, re.M))
        self.assertAlmostEqual(pushed, report["totals"]["filament_mm"], delta=0.01 * pushed)

    def test_what_is_written_is_proved_when_read_back(self):
        for options in ([], ["--strategy", "thrifty"], ["--gaps", "none", "--covers", "concentric"], ["--overlap", "0.7"]):
            done = self.run_program(CUBE, "-o", "a.gcode", "--quiet", *options)
            self.assertEqual(done.returncode, 0, done.stderr)
            radius = ["--overlap", "0.7"] if "--overlap" in options else []
            judged = subprocess.run([PROGRAM, "verify", "a.gcode", "--inside", *radius], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(judged.returncode, 0, str(options) + judged.stdout)

    def test_the_papers_gaps_let_something_hang(self):
        done = self.run_program(CUBE, "-o", "a.gcode", "--gaps", "paper")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("hang in air", done.stdout)
        judged = subprocess.run([PROGRAM, "verify", "a.gcode", "--inside"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(judged.returncode, 1, judged.stdout)

    def test_layers_higher_than_tracks_are_wide_are_warned_about(self):
        for height, said in (("0.4", False), ("0.5", True)):
            done = self.run_program(CUBE, "-o", "a.gcode", "--layer-height", height)
            self.assertEqual((done.returncode, done.stderr.count("more than its tracks are wide")), (0, 2 * said), done.stderr)
        done = self.run_program(CUBE, "-o", "a.gcode", "--first-layer-height", "0.5", "--first-layer-width", "0.6")
        self.assertNotIn("more than its tracks are wide", done.stderr)

    def test_quiet_says_nothing(self):
        done = self.run_program(CUBE, "-o", "a.gcode", "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_the_same_bytes_for_any_number_of_threads(self):
        texts = set()
        for threads in (1, 2, 5):
            self.run_program(CUBE, "-o", "a.gcode", "--report", "a.json", "--threads", threads)
            report = json.loads((self.folder / "a.json").read_text())
            del report["machine"]
            texts.add((self.folder / "a.gcode").read_bytes() + json.dumps(report).encode())
        self.assertEqual(len(texts), 1)

    def test_wrong_options(self):
        self.refuse(2, "--layer-height", CUBE, "--layer-height", "-1")
        self.refuse(2, "--nozzle", CUBE, "--nozzle", "wide")
        self.refuse(2, "--overlap", CUBE, "--overlap", "1.5")
        for arguments in ([], [CUBE, "--no-such-option"], [CUBE, "--scale", "2", "--height", "3"]):
            self.assertEqual(self.run_program(*arguments).returncode, 2)

    def test_unreadable_input(self):
        self.refuse(3, "missing.stl", "missing.stl")
        (self.folder / "folder").mkdir()
        done = self.run_program("folder", "-o", "out.gcode")
        self.assertEqual(done.returncode, 3, done.stderr)
        (self.folder / "folder").rmdir()
        self.refuse(3, "truncated.stl", CORPUS / "truncated.stl")
        self.refuse(3, "rubbish.dat", CORPUS / "rubbish.dat")

    def test_no_solid(self):
        self.refuse(4, "nan.stl", CORPUS / "nan.stl")
        self.refuse(4, "volume", CORPUS / "flat.off")

    def test_no_place(self):
        self.refuse(5, "--bed", CUBE, "--scale", "20")
        self.refuse(5, "--scale", CUBE, "--scale", "0.001")
        self.refuse(5, "no layer", CUBE, "--scale", "0.1", "--layer-height", "8")

    def test_nothing_to_print(self):
        plate = self.folder / "plate.off"  # thinner than any track
        corners = [(x, y, z) for x in (0, 0.01) for y in (0, 10) for z in (0, 10)]
        faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        plate.write_text("OFF\n8 6 0\n" + "".join("%g %g %g\n" % c for c in corners) + "".join("4 %d %d %d %d\n" % f for f in faces))
        done = self.run_program(plate, "-o", "a.gcode")
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn("nothing would be printed", done.stderr)
        self.assertEqual(self.files(), {"plate.off"})

    def test_no_output_takes_the_place_of_the_model_or_of_another_output(self):
        model = self.folder / "model.stl"
        model.write_bytes(CUBE.read_bytes())
        (self.folder / "link.stl").symlink_to(model)
        for name in ("model.stl", "./model.stl", "link.stl"):
            for option in ("-o", "--report", "--mesh", "--layers", "--html"):
                done = self.run_program(model, option, name)
                self.assertEqual(done.returncode, 2, option + " " + name)
                self.assertIn("is an input", done.stderr)
        self.assertEqual(model.read_bytes(), CUBE.read_bytes())
        for option, name, why in (("--html", "./a.gcode", "is the file of --output too"), ("--html", "", "name of the output is empty")):
            done = self.run_program(CUBE, "-o", "a.gcode", option, name)
            self.assertEqual(done.returncode, 2)
            self.assertIn(why, done.stderr)
        self.assertEqual(self.files(), {"model.stl", "link.stl"})
        self.assertEqual(self.run_program(CUBE, "-o", "/dev/null", "--report", "/dev/null").returncode, 0)

    def test_no_output_takes_the_place_of_what_settings_are_read_from(self):
        text = "nozzle_diameter = 0.4\n"
        (self.folder / "mine.ini").write_text(text)
        for given in ("--import", "--profile"):
            done = self.run_program(CUBE, given, "mine.ini", "--report", "./mine.ini")
            self.assertEqual(done.returncode, 2 if given == "--import" else done.returncode, done.stderr)
            self.assertNotEqual(done.returncode, 0)
            self.assertEqual((self.folder / "mine.ini").read_text(), text)
        (self.folder / "loop").symlink_to("not_yet.gcode")
        self.assertEqual(self.run_program(CUBE, "-o", "not_yet.gcode", "--report", "loop").returncode, 2)

    def test_outputs_that_are_streams_of_the_program(self):
        done = self.run_program(CUBE, "-o", "/dev/stdout", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.run_program(CUBE, "-o", "a.gcode", "--quiet").returncode, 0)
        self.assertEqual(done.stdout, (self.folder / "a.gcode").read_text())
        (self.folder / "log").write_text("before\n")
        with open(self.folder / "log", "a") as log:
            subprocess.run([PROGRAM, "generate", CUBE, "-o", "/dev/fd/1", "--quiet"], stdout=log, check=True)
        self.assertEqual((self.folder / "log").read_text(), "before\n" + done.stdout)

    def test_without_standard_streams_nothing_is_mixed_into_the_outputs(self):
        self.assertEqual(self.run_program(CUBE, "-o", "a.gcode").returncode, 0)
        def close():
            for stream in (0, 1, 2):
                os.close(stream)
        done = subprocess.run([PROGRAM, "generate", CUBE, "-o", "b.gcode"], cwd=self.folder, preexec_fn=close)
        self.assertEqual(done.returncode, 0)
        self.assertEqual((self.folder / "b.gcode").read_text(), (self.folder / "a.gcode").read_text())

    def test_a_summary_that_cannot_be_written_is_an_error(self):
        with open("/dev/full", "w") as full:
            done = subprocess.run([PROGRAM, "generate", CUBE, "-o", "a.gcode"], cwd=self.folder, stdout=full,
                                  stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 6)
        self.assertIn("standard output cannot be written", done.stderr)

    def test_parts_that_touch_but_for_rounding_are_one_solid(self):
        """A box on the side of another, turned: their common face lies a rounding apart."""
        corners, faces = [], []
        for low, high in (((0, 0, 0), (20, 20, 20)), ((20, 6, 6), (28, 14, 14))):
            first = len(corners)
            corners += [[(low, high)[k >> axis & 1][axis] for axis in (0, 1, 2)] for k in range(8)]
            faces += [[first + k for k in face] for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))]
        (self.folder / "boxes.off").write_text("OFF\n16 12 0\n" + "".join("%g %g %g\n" % tuple(c) for c in corners) +
                                               "".join("4 %d %d %d %d\n" % tuple(f) for f in faces))
        removed = 0
        for angle in ("45", "15", "33", "70"):
            done = self.run_program("boxes.off", "--rotate", "0,0," + angle, "-o", "a.gcode", "--report", "a.json")
            self.assertEqual(done.returncode, 0, done.stdout)
            layers = json.loads((self.folder / "a.json").read_text())["layers"]
            removed += sum(layer["slivers_removed"] for layer in layers)
            for layer in layers:
                self.assertLess(layer["perimeter_length_mm"], 100, layer["layer"])  # both parts' own would be 109
        self.assertGreater(removed, 0)

    def test_a_reader_that_goes_is_no_error(self):
        """More than a block of text, and a reader that has read none of it."""
        (self.folder / "a.gcode").write_text("M83\n" + "".join(
            ";TYPE:feature of a long name, number %d\n;WIDTH:0.4\n;HEIGHT:0.2\nG1 Z.2\nG1 X0 Y%d\nG1 X10 E1\n" % (k, k) for k in range(150)))
        command = [PROGRAM, "verify", "a.gcode"]
        whole = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(whole.returncode, 0, whole.stderr)
        self.assertGreater(len(whole.stdout), 8192)
        ours, theirs = os.pipe()
        os.close(ours)
        done = subprocess.run(command, cwd=self.folder, stdout=theirs, stderr=subprocess.PIPE, text=True)
        os.close(theirs)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open("/dev/full", "w") as full:
            done = subprocess.run(command, cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(done.returncode, 6)
        self.assertNotIn("Success", done.stderr)

    def test_a_limit_on_file_sizes_is_an_error(self):
        """As after `ulimit -f`, whose signal ends programs that do not ignore it."""
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000))
        done = self.run_program(CUBE, "-o", "a.gcode", "--quiet", preexec_fn=limit)
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertEqual(self.files(), set())

    def test_pictures_are_of_one_run_and_a_folder_without_any_goes_again(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine/layer_of_paint.svg").write_text("the user's")
        for height, layers in (("20", 100), ("10", 50)):
            done = self.run_program(CUBE, "--height", height, "--svg", "mine")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual({p.name for p in (self.folder / "mine").iterdir()},
                             {"layer_of_paint.svg"} | {f"layer_{k:05d}.svg" for k in range(layers)})
        plate = self.folder / "far.off"
        plate.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 1\n3 0 1 2\n")
        self.assertNotEqual(self.run_program(plate, "--svg", "new/pictures").returncode, 0)
        self.assertFalse((self.folder / "new").exists())

    def test_numbers_that_no_printer_has(self):
        for option, value in (("--filament-diameter", "1e-7"), ("--print-speed", "1e12"), ("--retraction", "1e6"),
                              ("--temperature", "99999"), ("--prime-surplus", "nan"), ("--seed", "-1")):
            self.refuse(2, value if option == "--seed" else "must lie between", CUBE, option, value)

    def test_unwritable_output(self):
        done = self.run_program(CUBE, "-o", "no/such/folder/a.gcode")
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertIn("no/such/folder/a.gcode", done.stderr)

    def test_a_full_disk_leaves_what_was_there(self):
        (self.folder / "a.gcode").write_text("what the user had")
        done = self.run_program(CUBE, "-o", "a.gcode", "--report", "a.json", preexec_fn=files_up_to(100000))
        self.assertEqual(done.returncode, 6, done.stderr)
        self.assertEqual((self.folder / "a.gcode").read_text(), "what the user had")
        self.assertEqual(self.files(), {"a.gcode"})

    def test_size_of_parts_wound_both_ways(self):
        # Two tetrahedra of 8^3 / 6 mm3, the second maybe inside out.
        def tetrahedra(winding):
            vertices = [f"v {x + x0} {y} {z}" for x0 in (0, 20) for x, y, z in ((0, 0, 0), (8, 0, 0), (0, 8, 0), (0, 0, 8))]
            faces = [(1, 3, 2), (1, 2, 4), (2, 3, 4), (1, 4, 3)]
            return "\n".join(vertices + [f"f {a} {b} {c}" for a, b, c in faces] + [f"f {a + 4} {b + 4} {c + 4}" for a, b, c in (f[::winding] for f in faces)]) + "\n"
        for winding, expected in ((1, ", 170.7 mm3, 2 components, "), (-1, "8.00 mm, 2 components (1 inverted), ")):
            (self.folder / "two.obj").write_text(tetrahedra(winding))
            done = self.run_program("two.obj")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(expected, done.stdout.splitlines()[0])

    def test_a_full_temporary_folder_costs_time_but_no_result(self):
        # What the sweeps before the run made is kept there, if it has room, so that the best one need not be made again.
        for room in (0, 5000):
            done = self.run_program(CUBE, "--strategy", "thrifty", preexec_fn=files_up_to(room))
            self.assertEqual(done.returncode, 0, done.stderr)
            results = [line for line in done.stdout.splitlines() if line.startswith(("proved", "material"))]
            if room == 0:
                expected = [line for line in self.run_program(CUBE, "--strategy", "thrifty").stdout.splitlines() if line.startswith(("proved", "material"))]
                self.assertEqual(len(expected), 2)
            self.assertEqual(results, expected)

    def test_interrupted(self):
        (self.folder / "a.gcode").write_text("what the user had")
        # Thin layers take some seconds; the signal comes after the first line of progress.
        child = subprocess.Popen([PROGRAM, "generate", CUBE, "--scale", "4", "--layer-height", "0.05", "-o", "a.gcode",
                                  "--svg", "pictures"],
                                 cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        child.stderr.readline()
        child.send_signal(signal.SIGINT)
        start = time.monotonic()
        _, errors = child.communicate(timeout=30)
        self.assertEqual(child.returncode, 130, errors)
        self.assertLess(time.monotonic() - start, 10)
        self.assertIn("interrupted", errors)
        self.assertEqual((self.folder / "a.gcode").read_text(), "what the user had")
        self.assertEqual([p for p in self.folder.rglob("*") if p.is_file()], [self.folder / "a.gcode"])

    def test_interrupted_twice(self):
        child = subprocess.Popen([PROGRAM, "generate", CUBE, "--scale", "4", "--layer-height", "0.05", "-o", "a.gcode", "--svg", "pictures"],
                                 cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        child.stderr.readline()
        child.send_signal(signal.SIGINT)
        child.send_signal(signal.SIGTERM)
        child.communicate(timeout=30)
        self.assertNotEqual(child.returncode, 0)
        self.assertEqual([p for p in self.folder.rglob("*") if p.is_file()], [])

    def test_names_no_file_can_have(self):
        for option in ("--profile", "--import"):
            done = self.run_program(CUBE, option, "a" * 300)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("cannot be opened", done.stderr)
        self.assertEqual(self.run_program("a" * 300).returncode, 3)

    def test_what_is_meant_by_an_option(self):
        for words, said in ((["--perimeter", "2"], "there is no option --perimeter; do you mean --perimeters?"), (["--what"], "there is no option --what"),
                            (["--top-layers", "1.5"], "--top-layers: '1.5' is no whole number"), (["--rotate", "90", "0", "0"], "'0' is not expected")):
            done = self.run_program(CUBE, *words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)

    def test_quiet_says_nothing_of_the_papers_gaps_and_no_output_is_said(self):
        done = self.run_program(CUBE, "--gaps", "paper", "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        self.assertIn("nothing was written; -o", self.run_program(CUBE).stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
