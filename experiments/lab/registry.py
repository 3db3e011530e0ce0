"""Which model is meant by a name, which file it is on this machine, and whether that is the paper's."""
import csv
import dataclasses
import json
import pathlib
import subprocess
import sys
import tarfile

from lab.store import Store, file_digest

HERE = pathlib.Path(__file__).resolve().parent.parent
ROOT = HERE.parent
CGAL_DATA = pathlib.Path("/usr/share/doc/libcgal-dev/data.tar.gz")
FORMATS = {".stl", ".obj", ".off", ".ply", ".3mf"}
SAME_VOLUME = 0.001  # the paper's model: volume within 0.1 %
LARGE_BED = ("--bed", "2000,2000,2000")  # Figure 24 and Section 5.2 have objects larger than a common printer
SAME_HEIGHT = 0.03   # heights in the paper are rounded to millimetres


@dataclasses.dataclass(frozen=True)
class Model:
    name: str
    title: str
    file: pathlib.Path | None = None
    placement: tuple = ()   # options of the programs: --scale, --height, --up
    origin: str = "missing"  # what the file is: the paper's model, a stand-in, built in
    stand_in: str | None = None

    def _options(self):
        return dict(zip(self.placement[::2], self.placement[1::2]))

    def _placed(self, options, *more):
        return dataclasses.replace(self, placement=(*(x for pair in options.items() for x in pair), *more))

    def at_height(self, mm):
        """Scaled to this height."""
        return self._placed({**self._options(), "--height": mm})

    def scaled(self, factor):
        """Larger or smaller than placed."""
        options = self._options()
        if "--height" in options:
            options["--height"] = f"{float(options['--height']) * factor:.9g}"
        else:
            scale = options.get("--scale", "1")
            # a fraction stays one
            options["--scale"] = (f"{factor:.9g}" if scale == "1" else
                                  f"{factor:.9g}/{scale[2:]}" if scale.startswith("1/") else f"{float(scale) * factor:.9g}")
        return self._placed(options, *LARGE_BED)


def paper_rows(table):
    """A CSV file in experiments/paper as a list of dicts; its first line names the source."""
    with open(HERE / "paper" / f"{table}.csv", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


class Registry:
    def __init__(self, folder, models, measure_program):
        """`folder`: for unpacked and built models and what was measured of them. `models`: the user's, or None."""
        self.folder, self.measure_program = pathlib.Path(folder), measure_program
        self.entries = json.loads((HERE / "models.json").read_text())
        self.measured = Store(self.folder / "measured")
        self.models = {}
        self._solids()
        self._cgal()
        self._paper(models)

    def __getitem__(self, name):
        return self.models[name]

    def by_row(self, table, paper_name):
        """The paper's model of a row of a table."""
        for entry in self.entries["paper"]:
            if entry["rows"].get(table) == paper_name:
                return self.models[entry["name"]]
        raise KeyError(f"{table}: no model for {paper_name} in models.json")

    def measure(self, file, up):
        """(volume, height) in the file's units as ribvault reads them, or None when it refuses the file."""
        spec = {"file": file_digest(file), "up": up}
        facts = self.measured.load(spec)
        if facts is None:
            if not pathlib.Path(self.measure_program).exists():
                raise SystemExit(f"{self.measure_program} is not there, which measures the files of --models; scripts/experiments builds it (RIBVAULT_BIN names another folder)")
            done = subprocess.run([self.measure_program, "measure", file, "--height", "10", "--up", up, "--bed", "10000,10000,10000"],
                                  capture_output=True, text=True)
            facts = json.loads(done.stdout) if done.returncode == 0 else {"refused": done.stderr.strip()}
            self.measured.save(spec, facts)
        return None if "refused" in facts else (facts["mesh"]["volume_mm3"] / facts["scale"] ** 3, 10 / facts["scale"])

    def _solids(self):
        folder = self.folder / "solids"
        names = [e["name"] for e in self.entries["solids"]]
        script = HERE / "make_solids.py"
        stamp = folder / file_digest(script)
        if not stamp.exists():
            subprocess.run([sys.executable, script, folder], check=True)
            stamp.touch()
        for name in names:
            self._add(self.entry("solids", name), folder / f"{name}.stl", (), "built in")

    def _cgal(self):
        wanted = {f"data/meshes/{e['name']}.off": e for e in self.entries["cgal"]}
        folder = self.folder / "cgal"
        missing = [m for m in wanted if not (folder / pathlib.Path(m).name).exists()]
        if missing and CGAL_DATA.exists():
            folder.mkdir(parents=True, exist_ok=True)
            with tarfile.open(CGAL_DATA) as archive:
                for member in archive:
                    if member.name in missing:
                        (folder / pathlib.Path(member.name).name).write_bytes(archive.extractfile(member).read())
        for member, entry in wanted.items():
            file = folder / pathlib.Path(member).name
            options = ("--height", str(entry["height_mm"]), *(("--up", entry["up"]) if "up" in entry else ()))
            self._add(entry, file if file.exists() else None, options, "CGAL's data package")

    def _paper(self, models):
        if models and not pathlib.Path(models).is_dir():
            raise SystemExit(f"--models {models}: there is no such folder")
        files = sorted(f for f in pathlib.Path(models).rglob("*") if f.suffix.lower() in FORMATS) if models else []
        for entry in self.entries["paper"]:
            if "solid" in entry:
                self._add(entry, self.models[entry["solid"]].file, (), "the paper's model")
                continue
            best = (None, (), "missing")
            for file in files:
                found = self.recognise(entry, file)
                if found and (best[0] is None or found[2] == "the paper's model"):
                    best = found
                if best[2] == "the paper's model":
                    break
            self._add(entry, *best)

    def recognise(self, entry, file):
        """(file, placement, origin) when the file is this entry's model, or is named like it; else None."""
        def plain(text):
            return "".join(c for c in text.lower() if c.isalnum())
        stem = plain(file.stem)
        names = [plain(n) for n in (*entry.get("files", ()), entry["name"], entry["title"])]
        named = stem in names or str(entry.get("thing", "-")) in file.stem
        volume, height, up = entry.get("volume_mm3"), entry.get("height_mm"), entry.get("up", "z")
        native = self.measure(file, up)
        if native is None or native[0] <= 0:
            return None
        turn = ("--up", up) if up != "z" else ()
        if volume:
            # the scale at which the volume is the paper's, and whether the height then is too
            scale = (volume / native[0]) ** (1 / 3)
            tall = native[1] * scale
            fits = height is not None and abs(tall / height - 1) <= SAME_HEIGHT
            given = entry.get("scale")
            if given:
                a, _, b = given.partition("/")
                at_given = native[0] * (float(a) / float(b or 1)) ** 3
                if abs(at_given / volume - 1) <= SAME_VOLUME:
                    return file, ("--scale", given, *turn), "the paper's model"
            elif abs(native[0] / volume - 1) <= SAME_VOLUME and (fits or (named and height is None)):
                return file, ("--scale", "1", *turn), "the paper's model"
            if named:
                origin = "the paper's model (scaled to its volume; its height agrees)" if fits else "stand-in (named like it)"
                return file, ("--scale", f"{scale:.9g}", *turn), origin
        elif named:
            return file, (("--height", str(height)) if height else ("--scale", "1", *LARGE_BED)) + turn, "stand-in (the paper gives no volume)"
        return None

    def entry(self, group, name):
        return next(e for e in self.entries[group] if e["name"] == name)

    def _add(self, entry, file, placement, origin):
        self.models[entry["name"]] = Model(entry["name"], entry["title"], file, tuple(placement),
                                           origin if file else "missing", entry.get("stand_in"))

    def or_stand_in(self, model):
        """The model, or what stands in for it at the same height; None when there is neither."""
        if model.file:
            return model
        if not model.stand_in or not self.models[model.stand_in].file:
            return None
        other, entry = self.models[model.stand_in], self.entry("paper", model.name)
        options = dict(zip(other.placement[::2], other.placement[1::2]))
        if entry.get("height_mm"):
            options["--height"] = str(entry["height_mm"])
        flat = tuple(x for pair in options.items() for x in pair)
        return dataclasses.replace(other, placement=flat, title=f"{other.title} (stand-in for {model.title})", origin="stand-in")
