#!/usr/bin/python3
"""Runs experiments and writes their tables. Usage: experiments/run.py [NAME ...] [options]; scripts/experiments builds first.

Names: table2 table3 table4 table5 figure24 infill ablations exactness peers gaps thrifty pillars solids table6; none: all. Results are kept under
results/runs and are not made twice; tables (Markdown, CSV, LaTeX) and plots are written to results/tables.
"""
import argparse
import importlib
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from drivers import NAMES  # noqa: E402
from lab.laboratory import Laboratory, Plot  # noqa: E402
from lab.runs import program, spec, version  # noqa: E402
from lab.store import digest, write_atomically  # noqa: E402
from lab.tables import emptied  # noqa: E402


def positive(text):
    if int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text}: at least 1")
    return int(text)


def swept(text):
    """OPTION=A,B,... as it stands, when that is its form; that the program has the option is seen later."""
    option, _, values = text.partition("=")
    if not option or not all(values.split(",")):
        raise argparse.ArgumentTypeError(f"'{text}' is not of the form OPTION=A,B,...")
    if option == "seed" and not all(v.isdigit() for v in values.split(",")):
        raise argparse.ArgumentTypeError(f"'{text}': seeds are whole numbers")
    return text


def check_program(sweeps):
    """Ends when there is no program to run, or one without an option that is to be swept: tables would lose their numbers."""
    ribvault = program("ribvault")
    if not os.access(ribvault, os.X_OK) or ribvault.is_dir():
        sys.exit(f"{ribvault} is not there; scripts/experiments builds it (RIBVAULT_BIN names another folder). Nothing was written.")
    if not sweeps:
        return
    asked = subprocess.run([ribvault, "generate", "--help"], capture_output=True, text=True)
    if asked.returncode != 0:
        sys.exit(f"{ribvault} generate --help: exit code {asked.returncode}: {asked.stderr.strip()[-300:]}")
    known = re.findall(r"--[a-z0-9-]+", asked.stdout)
    for option in (s.partition("=")[0] for s in sweeps):
        if f"--{option}" not in known:
            sys.exit(f"--sweep {option}: ribvault generate has no option --{option}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME")
    parser.add_argument("--models", type=pathlib.Path, help="folder with the paper's models, recognised by name or by volume and size")
    parser.add_argument("--results", type=pathlib.Path, default=HERE.parent / "results")
    parser.add_argument("--seeds", type=positive, default=5, help="how many, where chance matters (default 5)")
    parser.add_argument("--sweep", action="append", type=swept, default=[], metavar="OPTION=A,B,...", help="ablations: sweep this instead; may be repeated")
    parser.add_argument("--plan", action="store_true", help="write results/plan.json, one entry a run, and run nothing")
    parser.add_argument("--one", metavar="KEY", help="make one run of the plan")
    parser.add_argument("--tables-only", action="store_true", help="from stored results only; what is not there is left empty")
    parser.add_argument("--check", action="store_true", help="look for damaged results; exit code 1 when there are any")
    parser.add_argument("--write-docs", action="store_true", help="put the tables into experiments/README.md")
    chosen = parser.parse_args()
    unknown = [n for n in chosen.names if n not in NAMES]
    if unknown:
        parser.error(f"no such experiment: {', '.join(unknown)}; there are {', '.join(NAMES)}")
    chosen.names = chosen.names or NAMES
    return chosen


class Progress:
    def __init__(self, total):
        self.total, self.done, self.start, self.live = total, 0, time.monotonic(), sys.stderr.isatty()

    def show(self, name, fresh):
        self.done += 1
        spent = time.monotonic() - self.start
        filled = 24 * self.done // max(self.total, 1)
        line = f"[{'#' * filled}{'.' * (24 - filled)}] {self.done}/{self.total} {spent:4.0f} s  {name}"
        if self.live:
            print(f"\r\033[K{line[:140]}", end="\n" if self.done == self.total else "", file=sys.stderr, flush=True)
        elif fresh or self.done == self.total:
            print(line, file=sys.stderr, flush=True)


def draw(plot, folder):
    try:
        import matplotlib
    except ImportError:
        print(f"no {plot.name}.svg: matplotlib is missing (python3-matplotlib)", file=sys.stderr)
        return
    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "ribvault"
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6, 3.6))
    for (label, points), marker in zip(plot.series.items(), "osD^vx"):
        axes.plot(*zip(*points), marker=marker, label=label)
    axes.set(title=plot.title, xlabel=plot.x, ylabel=plot.y)
    if plot.series:
        axes.legend()
    axes.grid(alpha=0.3)
    figure.savefig(folder / f"{plot.name}.svg", bbox_inches="tight", metadata={"Date": None})
    pyplot.close(figure)


def keeps(part, before, where):
    """Whether no number of the table as it stands would give way to nothing; said when one would."""
    lost = emptied(before, part.markdown())
    if lost:
        print(f"{where}: left as it is, {lost} of its cells would be empty; give the models and programs that it was made with, or remove it first", file=sys.stderr)
    return lost == 0


def write(parts, folder):
    """Whether all were written."""
    folder.mkdir(parents=True, exist_ok=True)
    kept = set()
    for part in parts:
        if isinstance(part, Plot):
            if part.name not in kept:
                draw(part, folder)
            continue
        before = folder / f"{part.name}.md"
        if before.exists() and not keeps(part, before.read_text(), before):
            kept.add(part.name)
            continue
        for suffix, text in (("md", part.markdown()), ("csv", part.csv()), ("tex", part.latex())):
            write_atomically(folder / f"{part.name}.{suffix}", text)
    return not kept


def write_docs(parts, page):
    """Between <!-- NAME --> and <!-- /NAME --> in the page there is the table of that name. Whether all were written."""
    text, all_written = page.read_text(), True
    for part in parts:
        start, end = f"<!-- {part.name} -->\n", f"<!-- /{part.name} -->"
        if not isinstance(part, Plot) and start in text:
            before, rest = text.split(start, 1)
            table, after = rest.split(end, 1)
            if keeps(part, table, f"{page}, {part.name}"):
                text = before + start + "\n" + part.markdown() + "\n" + end + after
            else:
                all_written = False
    write_atomically(page, text)
    return all_written


def main():
    chosen = arguments()
    if not chosen.check:
        check_program(chosen.sweep)
    lab = Laboratory(chosen.results, chosen.models, chosen.seeds, chosen.sweep, make=not chosen.tables_only)
    if chosen.check:
        bad = lab.store.check()
        print("\n".join(bad) or "every stored result is as it was written")
        return 1 if bad else 0
    builds = {name: importlib.import_module(f"drivers.{name}").build for name in chosen.names}
    runs = list(dict.fromkeys(run for build in builds.values() for run in lab.plan(build)))
    runnable = [run for run in runs if version(run.kind) is not None]
    keys = {digest(spec(run)): run for run in runnable}
    if chosen.plan:
        plan = chosen.results / "plan.json"
        write_atomically(plan, json.dumps({key: run.name for key, run in keys.items()}, indent=1) + "\n")
        print(f"{len(keys)} runs in {plan}")
        return 0
    if chosen.one:
        if chosen.one not in keys:
            sys.exit(f"no run {chosen.one} in this plan: other programs, models or options than when it was made?")
        lab.result(keys[chosen.one])
        return 1 if lab.failed else 0
    if not chosen.tables_only:
        progress = Progress(len(runnable))
        for run in runnable:
            fresh = not lab.store.path(spec(run)).exists()
            lab.result(run)
            progress.show(run.name, fresh)
    written = True
    for name, build in builds.items():
        parts = build(lab)
        written = write(parts, chosen.results / "tables") and written
        if chosen.write_docs:
            written = write_docs(parts, HERE / "README.md") and written
    print(f"tables: {chosen.results / 'tables'}")
    if lab.failed:
        print(f"{len(lab.failed)} of {len(runs)} runs came to no result; start again to make them", file=sys.stderr)
    return 0 if written and not lab.failed else 1


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # as Ctrl-C: what runs is ended, its folder removed
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("\ninterrupted; what was made is kept, start again to go on")
