#!/usr/bin/python3
"""The figures' scripts: what they draw from real result files, and what they say of files that they cannot draw."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FIGURES, CUBE = ROOT / "paper_figures", ROOT / "experiments/models/cube20.stl"
STEPS = pathlib.Path(os.environ["RIBVAULT_BIN"]) / "ribvault_steps"

try:
    import matplotlib  # noqa: F401
except ModuleNotFoundError:
    print("skipped: python3-matplotlib is not installed")
    sys.exit(77)
sys.path.insert(0, str(FIGURES))
import results  # noqa: E402


def steps(kind, output, *options):
    return subprocess.run([STEPS, kind, CUBE, "--scale", "0.4", "-o", output, *options], capture_output=True, text=True)


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.scratch.cleanup)
        cls.folder = pathlib.Path(cls.scratch.name)
        for kind, options in (("layers", ()), ("stages", ("--layer", "38")), ("tree", ("--layer", "36"))):
            done = steps(kind, cls.folder / f"{kind}.json", *options)
            if done.returncode:
                raise RuntimeError(done.stderr)

    def draw(self, number, *inputs):
        return subprocess.run([FIGURES / f"figure{number:02d}.py", *inputs, "-o", self.folder / f"figure{number}"], capture_output=True, text=True)

    def assert_refused(self, done, *words):
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def changed(self, kind, change):
        data = json.loads((self.folder / f"{kind}.json").read_text())
        change(data)
        path = self.folder / f"changed-{kind}.json"
        path.write_text(json.dumps(data))
        return path

    def test_three_formats_of_each_kind_of_file(self):
        for number, kind in ((9, "layers"), (18, "stages"), (16, "stages"), (14, "tree"), (19, "tree")):
            done = self.draw(number, self.folder / f"{kind}.json")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((self.folder / f"figure{number}.pdf").read_bytes().startswith(b"%PDF"))
            self.assertIn("<svg", (self.folder / f"figure{number}.svg").read_text())
            self.assertTrue((self.folder / f"figure{number}.png").read_bytes().startswith(b"\x89PNG"))

    def test_the_same_file_gives_the_same_drawing(self):
        first = self.draw(9, self.folder / "layers.json") and (self.folder / "figure9.svg").read_bytes()
        second = self.draw(9, self.folder / "layers.json") and (self.folder / "figure9.svg").read_bytes()
        self.assertEqual(first, second)

    def test_another_version_is_named(self):
        def older(data):
            data["schema"] = "ribvault-layers/0"
        path = self.changed("layers", older)
        self.assert_refused(self.draw(9, path), str(path), "ribvault-layers/0", "ribvault-layers/1")

    def test_a_missing_member_is_named(self):
        path = self.changed("stages", lambda data: data.pop("growth"))
        self.assert_refused(self.draw(18, path), str(path), '"growth"')

    def test_a_missing_member_deep_inside_is_named(self):
        path = self.changed("stages", lambda data: data["growth"]["walls"][3].pop("joint"))
        self.assert_refused(self.draw(18, path), str(path), '"joint"')

    def test_another_kind_of_file_is_refused(self):
        self.assert_refused(self.draw(9, self.folder / "tree.json"), "ribvault-tree/1", "ribvault-layers/1")

    def test_files_that_are_not_there_or_no_json(self):
        self.assert_refused(self.draw(9, self.folder / "none.json"), "none.json")
        (self.folder / "torn.json").write_text('{"schema": "ribvault-lay')
        self.assert_refused(self.draw(9, self.folder / "torn.json"), "torn.json", "no JSON")

    def test_a_table_without_the_column(self):
        (self.folder / "figure24.csv").write_text("model,height mm\nowl,10\n")
        self.assert_refused(self.draw(24, self.folder / "figure24.csv"), '"reduction %"')

    def test_a_table_in_a_page(self):
        (self.folder / "page.md").write_text("Text.\n\n| a | b |\n| --- | --- |\n| 1 | 2 |\n\n| model | height mm | reduction % |\n| --- | --- | --- |\n| owl | 10 | 60.5 |\n| owl | 20 | 70 |\n")
        rows = results.read_table(self.folder / "page.md", ["model", "height mm", "reduction %"])
        self.assertEqual(rows, [{"model": "owl", "height mm": "10", "reduction %": "60.5"}, {"model": "owl", "height mm": "20", "reduction %": "70"}])
        self.assertEqual(self.draw(24, self.folder / "page.md").returncode, 0)
        self.assert_refused(self.draw(24, ROOT / "README.md"), "README.md", '"model"')

    def test_the_steps_are_the_runs(self):
        # The stages called one by one end where the run did (ribvault_steps checks it), so the last wall is drawn from the run itself.
        stages = results.read(self.folder / "stages.json", "stages")
        walls, forest = stages["growth"]["walls"], stages.forest(stages["grown"])
        self.assertGreater(len(walls), 20)
        tips = {p for v, p in enumerate(forest.at) if not forest.root[v]}
        for wall in walls:
            self.assertIn((stages.mm(wall["point"][0]), stages.mm(wall["point"][1])), tips)

    def test_sections_of_a_tree_are_all_its_edges(self):
        tree = results.read(self.folder / "tree.json", "tree")
        forest = tree.forest(tree["tree"])
        drawn = sorted(tuple(sorted(pair)) for s in forest.sections() for pair in zip(s, s[1:]))
        self.assertEqual(drawn, sorted(tuple(sorted(e)) for e in forest.edges))

    def test_steps_refuse_what_is_not_there(self):
        done = steps("stages", self.folder / "x.json", "--layer", "1000")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--layer 1000", done.stderr)
        self.assertFalse((self.folder / "x.json").exists())

    def make(self, *arguments):
        return subprocess.run([FIGURES / "make.py", *arguments, "--results", self.folder / "results"], capture_output=True, text=True)

    def test_what_did_not_change_is_not_made_again(self):
        first, second = self.make("9", "24"), self.make("9", "24")
        self.assertEqual((first.returncode, second.returncode), (0, 0), first.stderr + second.stderr)
        self.assertEqual((first.stdout.count("made in"), second.stdout.count("as it was")), (2, 2), first.stdout + second.stdout)
        drawn = self.folder / "results/paper_figures"
        (drawn / "figure24.svg").unlink()
        self.assertIn("figure 24  made in", self.make("24").stdout)
        self.assertEqual(list(drawn.glob("*.part")), [])

    def test_a_figure_that_cannot_be_made_is_named(self):
        tables = self.folder / "results/tables"
        tables.mkdir(parents=True, exist_ok=True)
        (tables / "figure24.csv").write_text("model,height mm\nowl,10\n")
        done = self.make("24")
        (tables / "figure24.csv").unlink()
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, 'figure 24  NOT MADE: .*figure24.csv: the column "reduction %" is missing')

    def test_the_index(self):
        import make
        make.index([{"number": 9, "caption": "Trees <merge>", "commands": ["a & b"], "notes": ["CGAL's elk"], "made": True},
                    {"number": 24, "missing": "no table"}], self.folder)
        page = (self.folder / "index.html").read_text()
        for part in ('src="figure09.png"', "Trees &lt;merge&gt;", "a &amp; b", "CGAL&#x27;s elk", "figure09.pdf", "not made: no table"):
            self.assertIn(part, page)

    def test_a_layer_without_new_walls_is_named(self):
        self.assert_refused(self.draw(15, self.changed("stages", lambda data: data["growth"].update(walls=[]))), "no wall of this layer")

    def test_a_folder_of_models_that_is_not_there_is_refused(self):
        done = self.make("9", "--models", self.folder / "none")
        self.assertEqual(done.returncode, 1)
        self.assertIn("there is no such folder", done.stderr)

    def test_unknown_figures(self):
        done = subprocess.run([FIGURES / "make.py", "3", "--output", self.folder / "all"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("figure 3", done.stderr)


if __name__ == "__main__":
    unittest.main()
