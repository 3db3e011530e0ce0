#!/usr/bin/python3
"""How time and memory grow: with size, layers, triangles, flat roofs, islands, hills and threads. G-code and both proofs included, whole processes.

Usage: experiments/scaling.py [--rounds 3] [--only SERIES] [--models FOLDER] [--json FILE]; scripts/benchmark scaling builds first.
Exponents e of size^e are least squares over all rows of a series. Exit code 1 when a print is not proved.
"""
import argparse
import dataclasses
import json
import pathlib
import statistics
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from lab import meshes, race, runs  # noqa: E402
from lab.registry import LARGE_BED, Registry  # noqa: E402
from lab.store import write_atomically  # noqa: E402
from lab.tables import Table, growth_exponent  # noqa: E402

MEASURES = race.MEASURES


@dataclasses.dataclass(frozen=True)
class Case:
    """One row: a file and the options that it is run with."""
    size: float          # what the series varies
    file: pathlib.Path
    options: tuple


@dataclasses.dataclass(frozen=True)
class Series:
    title: str
    varied: str          # heading of Case.size
    cases: list
    growth: bool = True  # whether exponents make sense


class Builder:
    """The series by name. Meshes are made when they are asked for."""

    def __init__(self, registry, folder):
        self.registry, self.folder = registry, folder

    def _made(self, name, mesh):
        path = self.folder / f"{name}.stl"
        if not path.exists():
            meshes.write_stl(path, mesh())
        return path

    def _cgal(self, name):
        file = self.registry[name].file
        if not file:
            raise runs.NotHere(f"{name}: no CGAL data (libcgal-demo)")
        return file

    def size(self):
        file = self._cgal("bunny00")
        heights = (20, 30, 55, 100, 150, 200, 300)
        return Series("Size: CGAL's bunny00, layers of 0.2 mm", "height mm", [Case(h, file, ("--height", h, "--up", "y", *LARGE_BED)) for h in heights])

    def layers(self):
        file = self._cgal("elephant")
        thick = ("0.3", "0.2", "0.15", "0.1", "0.05")
        return Series("Layer height: CGAL's elephant, 55 mm", "layers",
                      [Case(round(55 / float(h)), file, ("--height", 55, "--up", "y", "--layer-height", h)) for h in thick])

    def triangles(self):
        counts = (1_000, 10_000, 100_000, 500_000, 2_000_000)
        return Series("Triangles: a ball 40 mm across", "triangles",
                      [Case(n, self._made(f"ball{n}", lambda n=n: meshes.ball(n)), ("--height", 40)) for n in counts])

    def section(self):
        layers = (250, 500, 1000, 2000)
        return Series("Layers of one section: a column, 20 x 20 mm", "layers",
                      [Case(n, self._made(f"column{n}", lambda n=n: meshes.column(n * 0.2)), ("--scale", 1, *LARGE_BED)) for n in layers])

    def plates(self):
        return Series("Flat boxes, 12 mm high, thrifty", "side mm",
                      [Case(a, self._made(f"plate{a}", lambda a=a: meshes.column(12.0, a)), ("--scale", 1, "--strategy", "thrifty")) for a in (25, 50, 100, 200)])

    def pins(self):
        return Series("Islands: pyramids of 4 mm side by side", "pins",
                      [Case(n, self._made(f"pins{n}", lambda n=n: meshes.pins(n)), ("--scale", 1)) for n in (25, 100, 400, 1600)])

    def reliefs(self):
        return Series("Reliefs: square plates with hills every 8 mm", "side mm",
                      [Case(a, self._made(f"relief{a}", lambda a=a: meshes.relief(a)), ("--scale", 1)) for a in (25, 50, 100, 200)])

    def threads(self):
        file = self._cgal("bunny00")
        return Series("Threads: CGAL's bunny00, 55 mm", "threads", [Case(n, file, ("--height", 55, "--up", "y", "--threads", n)) for n in (1, 2)], False)

    def large(self):
        fine = self._made("fine", lambda: meshes.refined(*meshes.read_off(self._cgal("bunny00")), 1_500_000))
        cases = [Case(88, fine, ("--height", 88, "--up", "y"))]
        giant = self.registry["bunny"]
        if giant.file:
            cases.append(Case(270, giant.file, ("--height", 270, *LARGE_BED)))
        else:
            print("Low Poly Bunny at 270 mm: its file is missing (--models)", file=sys.stderr)
        return Series("Large: bunny00 cut into 1.5 million triangles, 88 mm; the low poly bunny, 270 mm", "height mm", cases, False)


SERIES = ("size", "layers", "triangles", "section", "plates", "pins", "reliefs", "threads", "large")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=3, help="runs of every case, in turn (default 3)")
    parser.add_argument("--models", type=pathlib.Path, help="folder with the paper's models")
    parser.add_argument("--only", action="append", choices=SERIES, metavar="SERIES", help=f"one of {', '.join(SERIES)}; may be repeated")
    parser.add_argument("--json", type=pathlib.Path, default=HERE.parent / "results/scaling.json")
    chosen = parser.parse_args()
    if chosen.rounds < 1:
        parser.error("--rounds: at least one")
    return chosen


def measure(case):
    """Costs and facts of one run."""
    with tempfile.TemporaryDirectory(prefix="ribvault-scaling-") as scratch:
        folder = pathlib.Path(scratch)
        command = [runs.program("ribvault"), "generate", case.file, *case.options, "-o", folder / "out.gcode", "--report", folder / "report.json", "--quiet"]
        code, text, cost = runs.measured(command, folder)
        if code not in (0, 1):
            raise SystemExit(f"{' '.join(map(str, command))}: exit code {code}: {text.strip()[-300:]}")
        report = json.loads((folder / "report.json").read_text())
    cost["peak_memory_mb"] = report["machine"]["peak_memory_mb"]  # wait4 counts this process's where that is more
    return {**cost, "proved": code == 0, "layers": report["totals"]["layers"], "stage_seconds": report["machine"]["stage_seconds"]}


def run(series, rounds):
    """Per case: its size, medians and every round."""
    costs = [[] for _ in series.cases]
    for _ in range(rounds):
        for case, done in zip(series.cases, costs):
            if sys.stderr.isatty():
                print(f"\r\033[K{series.title}: {case.size}", end="", file=sys.stderr, flush=True)
            done.append(measure(case))
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    return [{"size": case.size, **{m: statistics.median(d[m] for d in done) for m in MEASURES}, "layers": done[0]["layers"],
             "proved": all(d["proved"] for d in done), "rounds": done} for case, done in zip(series.cases, costs)]


def table(series, rows):
    shown = Table("scaling", series.title, [(series.varied, ".0f"), ("wall s", ".2f"), ("CPU s", ".2f"), ("peak MB", ".0f"), ("CPU ms a layer", ".2f"), ("proved", "")])
    for row in rows:
        shown.add(row["size"], *(row[m] for m in MEASURES), 1000 * row["cpu_seconds"] / row["layers"], row["proved"])
    text = f"{series.title}\n\n{shown.markdown()}"
    if series.growth:
        text += f"\nGrows with {series.varied.split()[0]} to the power of: " + ", ".join(f"{name} {e:.2f}" for name, e in exponents(rows).items()) + "\n"
    return text


def exponents(rows):
    names = {"wall time": "seconds", "CPU time": "cpu_seconds", "memory": "peak_memory_mb"}
    return {name: growth_exponent([r["size"] for r in rows], [r[m] for r in rows]) for name, m in names.items()}


def main():
    chosen = arguments()
    machine, results = race.machine(), {}
    with tempfile.TemporaryDirectory(prefix="ribvault-scaling-") as scratch:
        registry = Registry(HERE.parent / "results/models", chosen.models, runs.program("ribvault_baselines"))
        builder = Builder(registry, pathlib.Path(scratch))
        for name in chosen.only or SERIES:
            try:
                series = getattr(builder, name)()
            except runs.NotHere as missing:
                print(f"{name}: left out; {missing}", file=sys.stderr)
                continue
            rows = run(series, chosen.rounds)
            results[name] = {"title": series.title, "varied": series.varied, "rows": rows, **({"exponents": exponents(rows)} if series.growth else {})}
            print(table(series, rows), flush=True)
    chosen.json.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(chosen.json, json.dumps({"machine": machine, "rounds": chosen.rounds, "series": results}, indent=1) + "\n")
    return 0 if all(row["proved"] for series in results.values() for row in series["rows"]) else 1


if __name__ == "__main__":
    sys.exit(main())
