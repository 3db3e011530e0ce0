"""Layers files and run pages as files: the same bytes on every way, and what is not whole refused by name."""
import pathlib
import tarfile
import tempfile
import unittest

from runs import CUBE, generate, make_page

MESHES = pathlib.Path("/usr/share/doc/libcgal-dev/data.tar.gz")  # package libcgal-demo


class Files(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def test_the_same_bytes_from_the_run_and_from_its_layers_file_for_any_number_of_threads(self):
        pages, files = set(), set()
        for threads in (1, 2, 5):
            generate(self.folder, CUBE, "--layers", "a.layers", "--html", "a.html", "--threads", threads)
            self.assertEqual(make_page(self.folder, "a.layers", "-o", "b.html").returncode, 0)
            pages |= {(self.folder / "a.html").read_bytes(), (self.folder / "b.html").read_bytes()}
            files.add((self.folder / "a.layers").read_bytes())
        self.assertEqual((len(pages), len(files)), (1, 1))

    @unittest.skipUnless(MESHES.exists(), f"there is no {MESHES}")
    def test_the_page_of_a_bunny_of_55_mm_is_below_10_mb(self):
        with tarfile.open(MESHES) as meshes, open(self.folder / "bunny00.off", "wb") as out:
            out.write(meshes.extractfile("data/meshes/bunny00.off").read())
        generate(self.folder, "bunny00.off", "--height", "55", "--up", "y", "--html", "a.html")
        size = (self.folder / "a.html").stat().st_size
        self.assertGreater(size, 1e6)
        self.assertLess(size, 10e6)

    def refuse(self, code, fragment, *arguments):
        done = make_page(self.folder, *arguments, "-o", "page.html")
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertIn(fragment, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        self.assertFalse((self.folder / "page.html").exists())

    def test_files_that_are_not_whole_are_refused_by_name(self):
        generate(self.folder, CUBE, "--layers", "a.layers", "--report", "a.json")
        lines = (self.folder / "a.layers").read_text().splitlines()

        def write(name, *changed):
            (self.folder / name).write_text("\n".join(changed) + "\n")

        write("old.layers", lines[0].replace("ribvault-layers/1", "ribvault-layers/0"), *lines[1:])
        self.refuse(3, "old.layers: line 1 is of schema ribvault-layers/0; expected a layers file, schema ribvault-layers/1", "old.layers")
        write("less.layers", *lines[:7], lines[7].replace('"trees":', '"threes":'), *lines[8:])
        self.refuse(3, 'less.layers: line 8 has no "trees"', "less.layers")
        write("cut.layers", *lines[:50])
        self.refuse(3, "cut.layers is cut off: it ends after 49 of 100 layers", "cut.layers")
        (self.folder / "half.layers").write_text("\n".join(lines)[:200000])
        self.refuse(3, "half.layers: line", "half.layers")
        self.refuse(3, "a.json: line 1 holds no whole JSON object; expected a layers file", "a.json")
        write("blank.layers", lines[0], "", *lines[1:])
        self.refuse(3, "blank.layers: line 2 is blank", "blank.layers")
        self.refuse(2, "--overlap has no effect", "a.layers", "--overlap", "0.6")
        (self.folder / "rubbish").write_bytes(bytes(range(256)) * 10)
        self.refuse(3, "rubbish", "rubbish")
        (self.folder / "empty").write_text("")
        self.refuse(3, "empty", "empty")
        self.refuse(3, "none", "none")
        self.refuse(3, "cut.layers", "a.layers", "cut.layers")
        self.assertEqual(make_page(self.folder, "a.layers", "a.layers", "a.layers", "-o", "page.html").returncode, 2)
        self.assertEqual(make_page(self.folder, "a.layers").returncode, 2)
        self.assertEqual(make_page(self.folder, "a.layers", "-o", "no/such/page.html").returncode, 6)


if __name__ == "__main__":
    unittest.main(verbosity=2)
