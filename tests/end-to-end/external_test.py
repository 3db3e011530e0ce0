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
from make_solids import box, write_stl  # noqa: E402

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

    def test_same_bytes_for_any_number_of_threads(self):
        for threads in (1, 2):
            self.run_program("generate", self.table, "-o", f"{threads}.gcode", "--support", "both", "--threads", threads, "--quiet")
        self.assertEqual((self.folder / "1.gcode").read_bytes(), (self.folder / "2.gcode").read_bytes())

    def test_what_cannot_be_is_refused(self):
        for arguments, fragment in ((["--support", "some"], "--support"), (["--support-gap", "0.2"], "--support external"), (["--pillars"], "--support external"),
                                    (["--support", "both", "--support-gap", "9"], "--support-gap")):
            done = self.run_program("generate", CUBE, "-o", "a.gcode", *arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(fragment, done.stderr)
            self.assertFalse((self.folder / "a.gcode").exists())


if __name__ == "__main__":
    unittest.main()
