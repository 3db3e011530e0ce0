#!/usr/bin/env python3
"""The README's table: the paper's models and CGAL's bunny, material beside Table 2, time and memory.

Usage: experiments/measured.py [--models FOLDER] [--program build/bin/ribvault] [--rounds 3]

h = 0.2 mm, d = 0.4 mm, one perimeter; "no cover" is --top-layers 0 --bottom-layers 0, the settings that the paper's
Section 5 names; "one cover" the default; "proved" is the geometry and the print of all three. Time and memory are the whole process's, proof and G-code included, medians over
the rounds with one cover. Without --models the rows of the paper's models say that their files are missing. Exit code 1 when a
run is not proved.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tarfile
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
CGAL_DATA = pathlib.Path("/usr/share/doc/libcgal-dev/data.tar.gz")
# name, file, options, Table 2's volume ("Our method", mm3), Table 5's time (s)
MODELS = [
    ("cube 20 mm", None, [], 1248, 4),
    ("low poly bunny", "low_poly_bunny.stl", ["--scale", "0.5"], 3901, 34),
    ("moai", "low_poly_moai.stl", ["--scale", "1/2.4"], 3663, 39),
    ("kitten", "kitten.off", ["--scale", "0.54271", "--up", "y"], 2109, 40),
    ("CGAL's bunny00, 55 mm", "bunny00.off", ["--height", "55", "--up", "y"], None, None),
]


def run(program, model, options, folder):
    report = folder / "report.json"
    start = time.monotonic()
    child = subprocess.Popen([program, "generate", model, *options, "-o", folder / "out.gcode", "--report", report, "--quiet"])
    _, status, usage = os.wait4(child.pid, 0)
    seconds = time.monotonic() - start
    code = os.waitstatus_to_exitcode(status)
    if code not in (0, 1):
        sys.exit(f"measured: {program} ended with exit code {code} on {model}")
    return json.loads(report.read_text()), seconds, usage.ru_maxrss * 1024 / 1e6


def find(name, models, folder):
    if name is None:
        return ROOT / "experiments/models/cube20.stl"
    if name == "bunny00.off":
        if not CGAL_DATA.exists():
            return None
        with tarfile.open(CGAL_DATA) as archive:
            (folder / name).write_bytes(archive.extractfile(f"data/meshes/{name}").read())
        return folder / name
    return models / name if models and (models / name).exists() else None


def arguments(usage):
    """The options of every command that runs over MODELS."""
    parser = argparse.ArgumentParser(description=usage, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=pathlib.Path, help="folder with low_poly_bunny.stl, low_poly_moai.stl, kitten.off")
    parser.add_argument("--program", default=str(ROOT / "build/bin/ribvault"))
    return parser


def main():
    parser = arguments(__doc__)
    parser.add_argument("--rounds", type=int, default=3)
    chosen = parser.parse_args()
    all_proved = True
    print("| model | layers | proved | no cover: total mm3 (supports) | one cover | one cover, thrifty | Table 2 | seconds (paper) | peak MB |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |", flush=True)
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for name, file, options, paper_mm3, paper_s in MODELS:
            model = find(file, chosen.models, folder)
            if model is None:
                print(f"| {name} | {file} is missing: give its folder with --models | | | | | {paper_mm3 or ''} | | |")
                continue
            print(f"running {name}", file=sys.stderr)
            bare, _, _ = run(chosen.program, model, [*options, "--top-layers", "0", "--bottom-layers", "0"], folder)
            rounds = [run(chosen.program, model, options, folder) for _ in range(chosen.rounds)]
            covered = rounds[0][0]
            thrifty, _, _ = run(chosen.program, model, [*options, "--strategy", "thrifty"], folder)
            proved = all(r["verdict"]["proved"] and r["verdict"]["print"]["proved"] for r in (bare, covered, thrifty))
            all_proved &= proved
            material = ["{material_mm3:.0f} ({support_volume_mm3:.0f})".format(**r["totals"]) for r in (bare, covered, thrifty)]
            seconds = statistics.median(r[1] for r in rounds)
            print(f"| {name} | {covered['totals']['layers']} | {'yes' if proved else 'NO'} | {' | '.join(material)} | "
                  f"{paper_mm3 or ''} | {seconds:.2f}{f' ({paper_s})' if paper_s else ''} | "
                  f"{max(r[2] for r in rounds):.0f} |", flush=True)
    return 0 if all_proved else 1


if __name__ == "__main__":
    sys.exit(main())
