"""The experiments' library: stored results, resuming, missing models, and the small numbers of experiments/README.md rerun."""
import csv
import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "experiments"))
PROGRAMS = tempfile.TemporaryDirectory()  # ribvault alone: the slow comparisons are not run here
os.symlink(os.path.realpath(os.environ["RIBVAULT"]), pathlib.Path(PROGRAMS.name) / "ribvault")
os.environ["RIBVAULT_BIN"] = PROGRAMS.name

import run  # noqa: E402
import scaling  # noqa: E402
from drivers import ablations  # noqa: E402
from lab import meshes, race  # noqa: E402
from lab.laboratory import Laboratory  # noqa: E402
from lab.store import Damaged, Store  # noqa: E402
from lab.tables import Table, emptied, growth_exponent, percent_off, spread  # noqa: E402


class Scratch(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def command(self, *arguments):
        return [sys.executable, str(ROOT / "experiments/run.py"), *arguments, "--results", str(self.folder), "--seeds", "1"]

    def run_experiments(self, *arguments, **environment):
        return subprocess.run(self.command(*arguments), capture_output=True, text=True, env={**os.environ, **environment})

    def results(self):
        return {f.name: f.stat().st_mtime_ns for f in (self.folder / "runs").glob("*.json")}

    def table(self, name):
        return list(csv.DictReader(io.StringIO((self.folder / "tables" / f"{name}.csv").read_text())))


class StoredResults(Scratch):
    def setUp(self):
        super().setUp()
        self.store, self.spec = Store(self.folder), {"model": "cube", "seed": 1}
        self.store.save(self.spec, {"material": 1233.25})

    def test_what_was_saved_is_loaded(self):
        self.assertEqual(self.store.load(self.spec), {"material": 1233.25})
        self.assertIsNone(self.store.load({"model": "cube", "seed": 2}))
        self.assertEqual(self.store.check(), [])

    def damage(self, change):
        path = self.store.path(self.spec)
        path.write_text(change(path.read_text()))
        self.assertEqual(len(self.store.check()), 1)
        self.assertIsNone(self.store.load(self.spec))
        self.assertEqual([f.suffix for f in self.folder.iterdir()], [".damaged"])

    def test_a_number_changed_by_hand_is_found(self):
        self.damage(lambda text: text.replace("1233.25", "1033.25"))

    def test_a_changed_spec_is_found(self):
        self.damage(lambda text: text.replace('"seed": 1', '"seed": 7'))

    def test_a_cut_file_is_found(self):
        self.damage(lambda text: text[: len(text) // 2])

    def test_a_result_under_another_name_is_found(self):
        path = self.store.path(self.spec)
        with self.assertRaises(Damaged):
            self.store.read(path.rename(path.with_name("0" * 64 + ".json")))


class Tables(unittest.TestCase):
    def test_three_formats(self):
        table = Table("t", "", [("model", ""), ("mm³", ".1f"), ("proved", "")])
        table.add("a|b_c", 1.25, True)
        table.add("missing")
        self.assertEqual(table.markdown().splitlines()[2:], ["| a\\|b_c | 1.2 | yes |", "| missing |  |  |"])
        self.assertEqual(table.csv().splitlines()[1:], ["a|b_c,1.25,True", "missing,,"])
        self.assertIn("a|b\\_c & 1.2 & yes \\\\", table.latex())

    def test_cells_that_would_be_emptied(self):
        tables = [Table("t", "", [("model", ""), ("mm³", ".1f"), ("what", "")]) for _ in range(3)]
        for table, rows in zip(tables, ((("a", 1.0), ("a", 2.0), ("b", None, "why")), (("a", 1.5), ("a", None), ("b", 3.0)), (("a", 1.0),))):
            for row in rows:
                table.add(*row)
        before, after, shorter = (table.markdown() for table in tables)
        self.assertEqual(emptied(before, after), 2)
        self.assertEqual(emptied("words\n\n" + before, before), 0)
        self.assertEqual(emptied(before, shorter), 0)
        self.assertEqual(emptied("", before), 0)

    def test_statistics(self):
        self.assertEqual(spread([1.0, 3.0]), "2 ± 1")
        self.assertIsNone(spread([]))
        self.assertAlmostEqual(percent_off(110, 100), 10)
        self.assertAlmostEqual(growth_exponent([1, 2, 4], [3, 12, 48]), 2)


class Races(unittest.TestCase):
    def test_medians_and_ratios_are_of_the_rounds(self):
        costs = [{m: k * x for m in race.MEASURES} for k, x in ((1, 4.0), (1, 1.0), (1, 2.5))]
        ours, theirs = race.summary([{**c, "proved": True} for c in costs]), race.summary([{m: 2 * v for m, v in c.items()} for c in costs])
        self.assertEqual(ours["seconds"], {"median": 2.5, "least": 1.0, "greatest": 4.0})
        self.assertTrue(ours["proved"])
        self.assertFalse(race.summary([{**c, "proved": i != 1} for i, c in enumerate(costs)])["proved"])
        self.assertEqual(set(race.ratios(ours, theirs).values()), {0.5})

    def test_programs_take_turns_and_are_measured(self):
        cube, turns = ROOT / "experiments/models/cube20.stl", []
        entries = [race.Entry("cube", "own", cube, ("--threads", t)) for t in (1, 2)]
        results = race.race(entries, 2, turns.append)
        self.assertEqual(turns, entries * 2)
        for entry in entries:
            costs = race.summary(results[entry])
            self.assertTrue(costs["proved"])
            self.assertEqual(len(costs["rounds"]), 2)
            self.assertLess(0, costs["cpu_seconds"]["least"])
            self.assertLess(costs["seconds"]["least"], costs["seconds"]["greatest"])
            self.assertTrue(5 < costs["peak_memory_mb"]["median"] < 200, costs)

    def test_a_program_that_fails_ends_the_race_with_its_words(self):
        with self.assertRaisesRegex(SystemExit, "no-such-file"):
            race.race([race.Entry("none", "own", ROOT / "no-such-file.stl")], 1)


class Scaling(Scratch):
    def assert_closed(self, mesh):
        sides = [(t[k], t[(k + 1) % 3]) for t in mesh[1] for k in range(3)]
        self.assertEqual(len(set(sides)), len(sides))
        self.assertEqual({(b, a) for a, b in sides}, set(sides))

    def test_meshes_are_closed_and_as_fine_as_asked_for(self):
        for count in (12, 13, 50, 191, 193, 1000):
            mesh = meshes.refined(*meshes.column(5.0), count)
            self.assertIn(len(mesh[1]), (count, count + 1))
            self.assert_closed(mesh)
        ball = meshes.ball(1000)
        self.assert_closed(ball)
        self.assertAlmostEqual(len(ball[1]), 1000, delta=50)

    def test_a_refined_mesh_prints_as_the_coarse_one(self):
        totals = []
        for name, mesh in (("coarse", meshes.column(5.0)), ("fine", meshes.refined(*meshes.column(5.0), 500))):
            meshes.write_stl(self.folder / f"{name}.stl", mesh)
            cost = scaling.measure(scaling.Case(1, self.folder / f"{name}.stl", ("--scale", 1)))
            self.assertTrue(cost["proved"])
            totals.append(cost["layers"])
        self.assertEqual(totals, [25, 25])

    def test_memory_is_the_programs_own(self):
        ballast = bytearray(400_000_000)
        meshes.write_stl(self.folder / "column.stl", meshes.column(2.0))
        self.assertLess(scaling.measure(scaling.Case(1, self.folder / "column.stl", ("--scale", 1)))["peak_memory_mb"], 200)
        del ballast

    def test_exponents_are_of_the_rows(self):
        rows = [{"size": n, "seconds": 3 * n ** 2, "cpu_seconds": 5 * n, "peak_memory_mb": 7.0} for n in (1, 2, 5)]
        self.assertEqual({k: round(e, 9) for k, e in scaling.exponents(rows).items()}, {"wall time": 2, "CPU time": 1, "memory": 0})


class WholeRuns(Scratch):
    def test_killed_and_started_again_nothing_is_lost_or_repeated(self):
        child = subprocess.Popen(self.command("solids"), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, start_new_session=True)
        while child.poll() is None and len(self.results() if (self.folder / "runs").exists() else ()) < 3:
            time.sleep(0.01)
        if child.poll() is None:
            os.killpg(child.pid, signal.SIGKILL)
        child.wait()
        before = self.results()
        done = self.run_experiments("solids")
        self.assertEqual(done.returncode, 0, done.stderr)
        after = self.results()
        self.assertEqual({k: after[k] for k in before}, before)
        self.assertEqual(len(after), 9)
        self.run_experiments("solids")
        self.assertEqual(self.results(), after)
        self.compare_with_docs(self.table("solids"))
        victim = self.folder / "runs" / min(after)
        victim.write_text(victim.read_text().replace("1", "2", 1))
        self.assertEqual(self.run_experiments("--check").returncode, 1)
        self.assertIn("set aside", self.run_experiments("solids").stderr)
        self.assertEqual(self.run_experiments("--check").returncode, 0)

    def fake_program(self, lines):
        """A folder with a ribvault that does `lines` first."""
        folder = self.folder / "bin"
        folder.mkdir(exist_ok=True)
        (folder / "ribvault").write_text("#!/bin/sh\n" + lines + f'\nexec {os.path.realpath(os.environ["RIBVAULT"])} "$@"\n')
        (folder / "ribvault").chmod(0o755)
        return str(folder)

    def test_runs_that_were_ended_are_made_again(self):
        """Killed, no memory, no room on the disk, interrupted: no result; a refusal is one."""
        sweep = ("ablations", "--sweep", "overlap=0.5")
        for end, words in (("kill -KILL $$", "SIGKILL"), ("exit 6", "exit code 6"), ("exit 7", "exit code 7"), ("exit 130", "exit code 130")):
            program = self.fake_program(f'[ "$2" = --help ] || [ -e {self.folder}/well ] || {{ {end}; }}')
            self.run_experiments(*sweep, "--plan", RIBVAULT_BIN=program)
            key = next(iter(json.loads((self.folder / "plan.json").read_text())))
            done = self.run_experiments(*sweep, "--one", key, RIBVAULT_BIN=program)
            self.assertEqual(done.returncode, 1, end)
            self.assertIn(words, done.stderr)
            self.assertEqual(self.results(), {}, end)
        done = self.run_experiments(*sweep, RIBVAULT_BIN=program)
        self.assertEqual(done.returncode, 1)
        self.assertIn("start again", done.stderr)
        self.assertEqual(self.results(), {})
        (self.folder / "well").touch()
        done = self.run_experiments(*sweep, RIBVAULT_BIN=program)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.table("ablation_overlap")[0]["proved"], "True")
        for file in [*(self.folder / "runs").iterdir(), *(self.folder / "tables").iterdir()]:
            file.unlink()
        done = self.run_experiments(*sweep, RIBVAULT_BIN=self.fake_program('[ "$2" = --help ] || { echo too large >&2; exit 5; }'))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(len(self.results()), 0)
        self.assertEqual(self.table("ablation_overlap")[0]["what"], "too large")

    def test_numbers_do_not_give_way_to_nothing(self):
        sweep = ("ablations", "--sweep", "overlap=0.5")
        self.assertEqual(self.run_experiments(*sweep).returncode, 0)
        tables = {file: file.read_bytes() for file in (self.folder / "tables").iterdir()}
        for arguments, environment, words in (((), {"RIBVAULT_BIN": "/nowhere"}, "/nowhere/ribvault is not there"),
                                              (("--tables-only",), {"RIBVAULT_BIN": self.fake_program("")}, "left as it is"),
                                              (("--models", self.folder / "none"), {}, "there is no such folder"),
                                              (("--models", ROOT / "experiments/models"), {"RIBVAULT_BIN": "/nowhere"}, "/nowhere/ribvault is not there"),
                                              (("--models", ROOT / "experiments/models"), {}, "ribvault_baselines is not there")):
            done = self.run_experiments(*sweep, *map(str, arguments), **environment)
            self.assertNotEqual(done.returncode, 0, arguments)
            self.assertIn(words, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
            self.assertEqual({file: file.read_bytes() for file in (self.folder / "tables").iterdir()}, tables, arguments)

    def test_options_that_cannot_be_are_refused_at_once(self):
        for arguments, words in ((("--seeds", "0"), "at least 1"), (("--seeds", "-3"), "at least 1"), (("--sweep", "foo"), "OPTION=A,B"), (("--sweep", "overlap=0.3,,0.4"), "OPTION=A,B"),
                                 (("--sweep", "seed=one"), "whole numbers"), (("--sweep", "nosuch=1,2"), "no option --nosuch")):
            done = subprocess.run([sys.executable, ROOT / "experiments/run.py", "ablations", "--results", self.folder, *arguments], capture_output=True, text=True)
            self.assertNotEqual(done.returncode, 0, arguments)
            self.assertIn(words, done.stderr)
            self.assertNotIn("Traceback", done.stderr)
        self.assertFalse((self.folder / "runs").exists())

    def test_words_are_swept_too(self):
        lab = Laboratory(self.folder)
        lab.result = lambda run: {"totals": {"support_volume_mm3": 5.0}, "verdict": {"proved": True}}
        for option, values, x in (("strategy", ["paper", "thrifty"], ["paper", "thrifty"]), ("overlap", ["0.3", "0.5"], [0.3, 0.5])):
            table, plot = ablations.sweep(lab, option, values)
            self.assertEqual([row[1] for row in table.rows if row[3]][:2], values)
            self.assertEqual([point[0] for point in next(iter(plot.series.values()))], x)
            run.draw(plot, self.folder)

    def test_sigterm_leaves_nothing_behind(self):
        scratch = self.folder / "scratch"
        scratch.mkdir()
        child = subprocess.Popen(self.command("solids"), stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env={**os.environ, "TMPDIR": str(scratch), "RIBVAULT_BIN": self.fake_program("sleep 0.2")})
        while child.poll() is None and not list(scratch.glob("ribvault-run-*")):
            time.sleep(0.01)
        child.terminate()
        self.assertIn("interrupted", child.communicate()[1])
        self.assertNotEqual(child.returncode, 0)
        self.assertEqual(list(scratch.iterdir()), [])

    def compare_with_docs(self, rows):
        """README's table "solids": layers and verdicts as they are, material within 1 %."""
        page = (ROOT / "experiments/README.md").read_text().split("<!-- solids -->")[1].split("<!-- /solids -->")[0]
        lines = [[c.strip() for c in line.strip("|\n ").split(" | ")] for line in page.strip().splitlines()]
        documented = {line[0]: dict(zip(lines[0], line)) for line in lines[2:]}
        self.assertEqual(len(documented), len(rows))
        for row in rows:
            said = documented[row["solid"]]
            self.assertEqual(said["layers"], row["layers"], row["solid"])
            self.assertEqual(said["proved"], "yes" if row["proved"] == "True" else "NO", row["solid"])
            for column in ("material mm³", "supports mm³"):
                self.assertAlmostEqual(float(said[column]), float(row[column]), delta=0.01 * float(row["material mm³"]), msg=row["solid"])

    def test_what_is_missing_is_a_row_that_says_so(self):
        done = self.run_experiments("table5", "--plan")
        self.assertEqual(done.returncode, 0, done.stderr)
        plan = json.loads((self.folder / "plan.json").read_text())
        self.assertTrue(all(" " in name for name in plan.values()))
        for file in (ROOT / "experiments/paper").iterdir():
            self.assertTrue(file.read_text().startswith("# source: Tricard"), file)
        lab = Laboratory(self.folder)
        rows = list(lab.paper_models("table2_reduction"))
        self.assertEqual(sum(1 for _, model, _ in rows if model is None), 7)
        self.assertEqual([m.name for _, m, real in rows if real], ["cube"])


if __name__ == "__main__":
    unittest.main()
