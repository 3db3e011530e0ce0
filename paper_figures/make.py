#!/usr/bin/python3
"""Makes the paper's figures from our own runs, and a page that shows them all.

Usage: paper_figures/make.py [NUMBER ...] [--models FOLDER] [--output FOLDER]; scripts/paper-figures installs and builds first.
Every figure is written as PDF, SVG and PNG; what did not change is not made again. Exit code 1 when a figure could not be made.
"""
import argparse
import html
import importlib
import pathlib
import shlex
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "experiments")]
import look  # noqa: E402
import camera  # noqa: E402
import docs_pictures  # noqa: E402
import results  # noqa: E402
from lab.registry import Registry  # noqa: E402

NO_COVER = ("--top-layers", "0", "--bottom-layers", "0")
# figure -> its inputs in the order of its INPUTS: (kind, model, options), or (picture, model, options, cut), or (table, name)
RECIPES = {
    1: [("picture", "bunny", NO_COVER, "whole"), ("picture", "bunny", NO_COVER, "front")],
    2: [("layers", "bunny00", NO_COVER)],
    6: [("picture", "elephant", NO_COVER, "left")],
    7: [("picture", "armadillo", NO_COVER, "left")],
    9: [("layers", "cube", ())],
    10: [("picture", "kitten", NO_COVER, "left"), ("picture", "kitten", NO_COVER, "right")],
    11: [("stages", "bunny00", ())],
    12: [("layers", "cube", ()), ("layers", "cube", ("--no-straighten",))],
    13: [("tree", "cube", ("--layer", "95"))],
    14: [("tree", "cube", ("--layer", "95"))],
    15: [("stages", "cube", ("--layer", "98"))],
    16: [("stages", "cube", ("--layer", "98"))],
    17: [("layers", "cube", ("--from", "97", "--no-branch-bonus")), ("layers", "cube", ("--from", "97"))],
    18: [("stages", "cube", ("--scale", "0.35", "--layer", "33"))],
    19: [("tree", "cube", ("--layer", "84", "--branches", "6", "--gaps", "paper"))],
    20: [("layers", "cube", ("--gaps", "paper"))],
    24: [("table", "figure24")],
    25: [(kind, *run, *cut) for run, at in ((("low_roof", NO_COVER), "front"), (("far_tip", NO_COVER), "front"), (("hanging_tip", (*NO_COVER, "--support", "external")), "whole"))
         for kind, cut in (("picture", (at,)), ("run", ()))],
}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("numbers", nargs="*", type=int, metavar="NUMBER", help=f"of figures: {', '.join(map(str, RECIPES))} (default: all)")
    parser.add_argument("--models", type=pathlib.Path, help="folder with the paper's models; without, others stand in")
    parser.add_argument("--results", type=pathlib.Path, default=results.ROOT / "results", help="where experiments/run.py put its tables")
    parser.add_argument("--output", type=pathlib.Path, help="default: RESULTS/paper_figures")
    parser.add_argument("--write-docs", action="store_true", help="put the pictures into docs/pictures/figures")
    chosen = parser.parse_args()
    for number in chosen.numbers:
        if number not in RECIPES:
            parser.error(f"figure {number}: there is no script for it; there are {', '.join(map(str, RECIPES))}")
    chosen.results = chosen.results.resolve()
    chosen.output = (chosen.output or chosen.results / "paper_figures").resolve()
    return chosen


def as_typed(*words):
    """The words as one would type them in the repository."""
    return shlex.join(str(w.relative_to(results.ROOT)) if isinstance(w, pathlib.Path) and w.is_relative_to(results.ROOT) else str(w) for w in words)


class Inputs:
    """The figures' input files, made when they are asked for; `notes` and `commands` say of what and how."""

    def __init__(self, chosen):
        self.tables, self.folder = chosen.results / "tables", chosen.output / "inputs"
        self.registry = Registry(chosen.results / "models", chosen.models, results.program("ribvault_baselines"))
        self.notes, self.commands = [], []

    def model(self, name, options):
        model = self.registry.or_stand_in(self.registry[name])
        if model is None:
            raise results.Unusable(f"{name}: neither the paper's file (--models) nor what stands in for it is here (libcgal-demo)")
        if "stand-in" in model.origin:
            self.notes.append(f"{model.title}")
        placement = () if "--scale" in options else model.placement
        return pathlib.Path(model.file), (*placement, *options)

    def file(self, recipe):
        """The input's path."""
        if recipe[0] == "table":
            table = self.tables / f"{recipe[1]}.csv"
            return table if table.exists() else results.ROOT / "experiments/README.md"  # as it was measured last
        kind, name, options = recipe[:3]
        model, placed = self.model(name, options)
        if kind not in ("picture", "run"):
            made = results.made(kind, model, placed, self.folder)
            self.commands.append(as_typed("build/bin/ribvault_steps", kind, model, *placed, "-o", made))
            return made
        page = camera.page_of(model, placed, self.folder)
        report = page.with_suffix(".json")
        self.commands.append(as_typed("build/bin/ribvault", "generate", model, *placed, "--html", page, "--report", report))
        if kind == "run":
            return report
        photograph = camera.photographed(page, recipe[3], self.folder)
        self.commands.append(as_typed("paper_figures/camera.py", page, recipe[3], photograph))
        return photograph


def make(number, inputs, output):
    """The figure's facts for the page: caption, command, stand-ins."""
    script = HERE / f"figure{number:02d}.py"
    module = importlib.import_module(script.stem)
    stem = output / script.stem
    inputs.notes, inputs.commands = [], []
    files = [inputs.file(recipe) for recipe in RECIPES[number]]
    given = {name: results.load(file, kind) for (name, kind), file in zip(module.INPUTS.items(), files)}
    stamp = results.digest(*(s.read_bytes() for s in (script, HERE / "look.py", HERE / "results.py")), *(f.read_bytes() for f in files))
    kept = output / f"{script.stem}.stamp"
    fresh = kept.exists() and kept.read_text() == stamp and all(stem.with_suffix(s).exists() for s in (".pdf", ".svg", ".png"))
    if not fresh:
        look.save(module.draw(**given), stem)
        kept.write_text(stamp)
    commands = dict.fromkeys([*inputs.commands, as_typed(script, *files, "-o", stem)])
    return {"number": number, "caption": " ".join(module.__doc__.split()), "commands": list(commands), "notes": list(inputs.notes), "made": not fresh}


STYLE = """body { font: 16px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; color: #222; background: #fff }
main { display: grid; grid-template-columns: repeat(auto-fill, minmax(20rem, 1fr)); gap: 1.5rem } figure { margin: 0; border: 1px solid #ddd; border-radius: 6px; padding: 1rem }
img { width: 100%; height: 15rem; object-fit: contain; background: #fff } pre { font-size: .72rem; white-space: pre-wrap; overflow-wrap: anywhere; color: #444 } .missing { color: #a33 }
a { color: #005a9c }
@media (prefers-color-scheme: dark) { body { background: #16181c; color: #e6e6e6 } figure { border-color: #3a3d44 } pre { color: #b8bcc4 } a { color: #7cc4ff } .missing { color: #ff9c8a } }"""


def index(entries, output):
    parts = []
    for e in entries:
        name = f"figure{e['number']:02d}"
        if "missing" in e:
            parts.append(f"<figure id=\"{name}\"><figcaption><b>Figure {e['number']}</b> <span class=\"missing\">not made: {html.escape(e['missing'])}</span></figcaption></figure>")
            continue
        caption = html.escape(e["caption"])
        notes = f" <i>Drawn on {html.escape(', '.join(sorted(set(e['notes']))))}.</i>" if e["notes"] else ""
        parts.append(f"<figure id=\"{name}\"><a href=\"{name}.svg\"><img src=\"{name}.png\" alt=\"{caption}\" loading=\"lazy\"></a><figcaption>{caption}{notes} "
                     f"<a href=\"{name}.pdf\">PDF</a> <a href=\"{name}.svg\">SVG</a><details><summary>commands</summary><pre>{html.escape(chr(10).join(e['commands']))}</pre></details></figcaption></figure>")
    page = ("<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>Figures of Ribbed Support Vaults, from our runs</title>"
            f"<style>{STYLE}</style><h1>Figures of <i>Ribbed Support Vaults</i>, from our runs</h1><p>Tricard, Claux, Lefebvre, CGF 2019. Captions in our words; each figure with the command that "
            "draws it. <code>scripts/paper-figures</code> makes all.</p><main>" + "\n".join(parts) + "</main></html>\n")
    temporary = output / "index.html.part"
    temporary.write_text(page)
    temporary.rename(output / "index.html")


def main():
    chosen = arguments()
    chosen.output.mkdir(parents=True, exist_ok=True)
    inputs, entries = Inputs(chosen), []
    for number in chosen.numbers or RECIPES:
        start = time.monotonic()
        print(f"figure {number:2d}  ", end="", flush=True)
        try:
            entries.append(make(number, inputs, chosen.output))
            words = f"made in {time.monotonic() - start:.1f} s" if entries[-1]["made"] else "as it was"
        except results.Unusable as error:
            entries.append({"number": number, "missing": str(error)})
            words = f"NOT MADE: {error}"
        print(words, flush=True)
    if not chosen.numbers:
        index(entries, chosen.output)
        print(chosen.output / "index.html")
    if chosen.write_docs:
        total = docs_pictures.write([chosen.output / f"figure{e['number']:02d}.png" for e in entries if "missing" not in e])
        print(f"{docs_pictures.FOLDER}: {total / 1e6:.2f} MB")
    return 1 if any("missing" in e for e in entries) else 0


if __name__ == "__main__":
    sys.exit(main())
