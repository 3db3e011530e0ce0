"""docs/options.md: every option stands in it, ranges end where it says, names are those it gives, and what it says to be refused is."""
import decimal
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["RIBVAULT"]
ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
CUBE = ROOT / "experiments/models/cube20.stl"
PAGE = (ROOT / "docs/options.md").read_text()
NOZZLE, RADIUS = decimal.Decimal("0.4"), decimal.Decimal("0.2")  # mm, what d and rho are when nothing is given
# What an option needs to have an effect.
WITH = {"--wall-lines-longer": ("--wall-lines", "2"), "--wall-lines-taller": ("--wall-lines", "2"),
        "--leaning-length": ("--strategy", "thrifty", "--pillars"), "--leaning-ratio": ("--strategy", "thrifty", "--pillars"),
        "--support-gap": ("--support", "external"), "--support-gap-layers": ("--support", "external"),
        "--support-extruder": ("--support", "external"), "--support-temperature": ("--support", "external"), "--skirt-distance": ("--skirt", "1")}

# Where the report does not call an option's value by its name.
KEYS = {"--fill-gaps": "gap_fill", "--temperature": "nozzle_temperature_c", "--skirt": "skirt_loops", "--brim": "brim_width_mm",
        "--pitch": "sampling_pitch_mm", "--branch-bonus": "branch_bonus_length_mm"}


def options_of(command):
    text = subprocess.run([PROGRAM, command, "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^ +(?:-\w,)?(--[a-z-]+)", text, re.M)) - {"--help"}


def rows():
    """Option and value of every line of the page's tables."""
    for line in PAGE.splitlines():
        if row := re.match(r"\| `(?:-\w,)?(--[a-z-]+)[^`]*` \| (.*?) \|", line):
            yield row.groups()


def limit(text):
    """A number, or a multiple or part of d: 2 d, d / 20."""
    if not text.rstrip().endswith(("d", "ρ")) and "/" not in text:
        return decimal.Decimal(text)
    factor = decimal.Decimal(re.match(r"[\d.]*", text).group() or 1)
    part = decimal.Decimal(text.split("/")[1]) if "/" in text else 1
    return factor * (RADIUS if "ρ" in text else NOZZLE) / part


class Options(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def refused(self, *arguments):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, str(arguments) + done.stderr)
        self.assertRegex(done.stderr, r"\Aribvault: .*\n\Z", arguments)
        self.assertEqual(list(self.folder.iterdir()), [])
        return done.stderr

    def accepted(self, *arguments):
        """No model is read when an option is wrong, so a model that is missing tells them apart."""
        done = subprocess.run([PROGRAM, "generate", "missing.stl", *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 3, str(arguments) + done.stderr)

    def test_every_option_stands_on_the_page(self):
        self.assertEqual({name for name, _ in rows()}, options_of("generate"))
        text = (ROOT / "docs/verify-command.md").read_text()
        self.assertEqual({o for o in options_of("verify") if not re.search(o + r"(?![a-z-])", text)}, set())

    def test_ranges_end_where_the_page_says(self):
        checked = 0
        for name, value in rows():
            ends = re.match(r"([\d.d]+) to (\d+ d|d / \d+|[\d.]+|d|ρ)(?![\w ]*less)", value)
            if not ends:
                continue
            low, high = map(limit, ends.groups())
            whole = "N`" in next(line for line in PAGE.splitlines() if name + " " in line) or name.endswith("temperature")
            step = decimal.Decimal("1" if whole else "0.00001" if high <= 10 else "0.01")
            for given in (low, high):
                self.accepted(*WITH.get(name, ()), name, given)
            for given in (low - step, high + step):
                self.refused("generate", CUBE, *WITH.get(name, ()), name, given)
            checked += 1
        self.assertGreater(checked, 40)

    def test_names_are_those_of_the_page(self):
        for name, value in rows():
            if name in ("--strategy", "--gaps", "--support", "--covers", "--seam", "--up", "--flavour", "--quarter-bonus", "--printer"):
                choices = re.findall(r"`([a-z][a-z0-9-]*)`", value)
                self.assertGreater(len(choices), 1, name)
                for choice in choices:
                    self.accepted(name, choice)
                self.refused("generate", CUBE, name, "no-such-name")

    def test_what_is_not_given_has_the_default_of_the_page(self):
        subprocess.run([PROGRAM, "generate", CUBE, "--report", "a.json", "--quiet"], cwd=self.folder, check=True)
        report = json.loads((self.folder / "a.json").read_text())
        used = report["settings"] | report["tracks"] | report["printer"]
        compared = 0
        for line in PAGE.splitlines():
            row = re.match(r"\| `(?:-\w,)?(--[a-z-]+)[^`]*` \| .*? \| `?([\w.ρ/ ]+)", line)
            if not row:
                continue
            name, default = row[1], row[2].strip()
            bare = name[2:].replace("-", "_")
            keys = [KEYS[name]] if name in KEYS else [k for k in (bare, *(f"{bare}_{unit}" for unit in ("mm", "c", "mm_s", "percent"))) if k in used]
            if not keys or isinstance(used[keys[0]], (bool, list)):
                continue
            value = used[keys[0]]
            if isinstance(value, str):
                self.assertEqual(default, value, name)
            elif re.fullmatch(r"[\d.]+|([\d.]+ )?d( / \d+)?|ρ", default):
                self.assertEqual(limit(default), decimal.Decimal(str(value)), name)
            else:
                continue
            compared += 1
        self.assertGreater(compared, 40)

    def test_numbers_are_decimal(self):
        report = self.folder / "a.json"
        subprocess.run([PROGRAM, "generate", CUBE, "--report", report, "--quiet", "--temperature", "0205", "--perimeters", "010", "--fan", "050",
                        "--threads", "01"], check=True)
        read = json.loads(report.read_text())
        self.assertEqual((read["printer"]["nozzle_temperature_c"], read["settings"]["perimeters"], read["printer"]["fan_percent"]), (205, 10, 50))
        report.unlink()
        for name, value in (("--perimeters", "0x2"), ("--temperature", "0xC8"), ("--fan", "0x10"), ("--bed", "0x10,0x10,200"), ("--threads", "0x1"),
                            ("--threads", "1025"), ("--skirt", "1e1"), ("--bed", "250,250"), ("--bed", "250,250,250,"),
                            ("--bed-corner", "1,2,3"), ("--bed-corner", "9751,0"), ("--first-layer-width", "0")):
            self.assertIn(name, self.refused("generate", CUBE, name, value))

    def test_what_has_no_effect_is_refused(self):
        for arguments in (["--no-shrink"], ["--no-trim"], ["--no-doubling"], ["--strategy", "thrifty", "--no-straighten"],
                          ["--strategy", "thrifty", "--straighten-step", "0.1"], ["--skirt-distance", "2"], ["--support-extruder", "1"], ["--support-temperature", "210"], ["--wall-lines-longer", "3"], ["--wall-lines-taller", "3"],
                          ["--branch-bonus", "1", "--no-branch-bonus"], ["--quarter-bonus", "narrow", "--no-branch-bonus"], ["--support-gap", "0.2"], ["--bed-only"], ["--overlap", "0.99"]):
            self.assertIn(next(a for a in arguments if a.startswith("--") and a != "--strategy"), self.refused("generate", CUBE, *arguments))
        self.accepted("--strategy", "thrifty", "--no-shrink", "--no-straighten")

    def test_supports_must_hold_up_the_shell_and_themselves(self):
        for arguments in (["--support-width", "0.26", "--overlap", "0.8"], ["--support-width", "0.3", "--support-radius", "0.31"]):
            self.assertIn("0.28 mm" if "--overlap" in arguments else "--support-radius", self.refused("generate", CUBE, *arguments))
        self.assertIn("at least 0.4 mm", self.refused("generate", CUBE, "--support-width", "0.3", "--support-radius", "0.015"))
        self.assertIn("--support-radius", self.refused("generate", CUBE, "--support-width", "0.3", "--support-radius", "0.005"))
        self.accepted("--support-width", "0.28", "--overlap", "0.8")
        self.accepted("--support-width", "0.3", "--support-radius", "0.3")

    def test_a_command_that_does_not_exist(self):
        self.assertIn("'bunny.stl'", self.refused("bunny.stl"))
        self.assertIn("generate, verify and page", self.refused())
        self.assertIn("generate --help", self.refused("generate"))


if __name__ == "__main__":
    unittest.main()
