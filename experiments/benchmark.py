#!/usr/bin/python3
"""ribvault (geometry and print proved), PrusaSlicer and CuraEngine (lightning infill) on the same files, in turn.

Usage: experiments/benchmark.py [--rounds 5] [--models FOLDER] [--json FILE]; scripts/benchmark installs and builds first.
0.2 mm layers, 0.4 mm lines, one perimeter, one cover. Wall time, CPU time and peak memory are whole processes'. Exit code 1 when
a print of ours is not proved.
"""
import argparse
import json
import pathlib
import shutil
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from lab import race  # noqa: E402
from lab.registry import Registry  # noqa: E402
from lab.runs import program  # noqa: E402
from lab.store import write_atomically  # noqa: E402
from lab.tables import Table  # noqa: E402

MODELS = ("bunny", "moai", "kitten", "bunny00", "elephant")
HEIGHTS = {"elephant": "55"}  # mm; the others keep the registry's size
PROGRAMS = {"own": "ribvault", "prusa": "prusa-slicer", "cura": "CuraEngine"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=5, help="each program once a round and model (default 5)")
    parser.add_argument("--models", type=pathlib.Path, help="folder with the paper's models")
    parser.add_argument("--only", action="append", choices=MODELS, metavar="MODEL", help=f"one of {', '.join(MODELS)}; may be repeated")
    parser.add_argument("--threads", type=int, default=0, help="of ribvault (default: all processors)")
    parser.add_argument("--json", type=pathlib.Path, default=HERE.parent / "results/benchmark.json")
    chosen = parser.parse_args()
    if chosen.rounds < 1:
        parser.error("--rounds: at least one")
    return chosen


def files(chosen, folder):
    """(model, placed STL) of those that are here; says which are not."""
    registry = Registry(HERE.parent / "results/models", chosen.models, program("ribvault_baselines"))
    for name in chosen.only or MODELS:
        model = registry[name]
        if not model.file:
            print(f"{model.title}: its file is missing (--models)", file=sys.stderr)
            continue
        if name in HEIGHTS:
            model = model.at_height(HEIGHTS[name])
        yield model, race.placed(model, folder)


def table(models, results):
    titles = [race.TITLES[k] for k in PROGRAMS]
    shown = Table("benchmark", "", [("model", ""), *((f"{t} s (CPU s, MB)", "") for t in titles), ("wall: ours / PrusaSlicer", ".2f"),
                                    ("ours / CuraEngine", ".2f"), ("proved", "")])
    for model in models:
        row = results[model.name]
        cells = ["{:.2f} ({:.2f}, {:.0f})".format(*(row[k][m]["median"] for m in race.MEASURES)) if k in row else None for k in PROGRAMS]
        shown.add(model.title, *cells, *(row["ratios"].get(k, {}).get("seconds") for k in ("prusa", "cura")), row["own"]["proved"])
    return shown.markdown()


def show(entry):
    if sys.stderr.isatty():
        print(f"\r\033[K{entry.name} {race.TITLES[entry.kind]}" if entry else "\r\033[K", end="", file=sys.stderr, flush=True)


def main():
    chosen = arguments()
    kinds = [k for k, name in PROGRAMS.items() if k == "own" or shutil.which(name)]
    for missing in PROGRAMS.keys() - set(kinds):
        print(f"{race.TITLES[missing]} is not on this machine: its columns stay empty", file=sys.stderr)
    machine = race.machine()
    with tempfile.TemporaryDirectory(prefix="ribvault-benchmark-") as scratch:
        found = list(files(chosen, pathlib.Path(scratch)))
        if not found:
            sys.exit("no model to measure")
        threads = ("--threads", chosen.threads) if chosen.threads else ()
        entries = [race.Entry(model.name, kind, file, threads if kind == "own" else ()) for model, file in found for kind in kinds]
        costs = race.race(entries, chosen.rounds, show)
    show(None)
    results = {model.name: {} for model, _ in found}
    for entry in entries:
        results[entry.name][entry.kind] = race.summary(costs[entry])
    for row in results.values():
        row["ratios"] = {k: race.ratios(row["own"], row[k]) for k in kinds if k != "own"}
    chosen.json.parent.mkdir(parents=True, exist_ok=True)
    write_atomically(chosen.json, json.dumps({"machine": machine, "versions": race.versions(kinds), "rounds": chosen.rounds, "models": results}, indent=1) + "\n")
    print(table([model for model, _ in found], results), end="")
    return 0 if all(row["own"]["proved"] for row in results.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
