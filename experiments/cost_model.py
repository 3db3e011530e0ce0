#!/usr/bin/env python3
"""What a run has to do, counted: docs/performance.md's table of vertices, walls and decisions per layer.

Usage: experiments/cost_model.py [--models FOLDER] [--program build/bin/ribvault]

The models of the README's table (experiments/measured.py) with default settings. Counts are the report's and the layers file's, so they do
not depend on the machine. "Exactly" are decisions that machine numbers with error bounds left open: by rationals, by algebraic numbers.
"""
import json
import pathlib
import tempfile

from measured import MODELS, arguments, find
from measured import run as generate

SIGNS = ("interval", "rational", "algebraic")


def decisions(layers, proof):
    return [sum(layer[proof]["stages"][s] for layer in layers) for s in SIGNS]


def main():
    chosen = arguments(__doc__).parse_args()
    print("| model | bytes read | layers | slice vertices a layer | walls a layer | geometry: decisions a layer | of them exactly | print: decisions a layer | of them exactly | bytes of G-code |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        for name, file, options, _, _ in MODELS:
            model = find(file, chosen.models, folder)
            if model is None:
                print(f"| {name} | {file} is missing: give its folder with --models | | | | | | | | |")
                continue
            shapes = folder / "layers.ndjson"
            report, _, _ = generate(chosen.program, model, [*options, "--layers", shapes], folder)
            layers, vertices, walls = report["layers"], 0, 0
            with shapes.open() as lines:
                for line in map(json.loads, lines):
                    vertices += sum(map(len, line.get("slice", ())))
                    walls += len(line.get("edges", ()))
            n, row = len(layers), [name, model.stat().st_size, len(layers)]
            row += [f"{vertices / n:.0f}", f"{walls / n:.0f}"]
            for proof in ("verdict", "print"):
                counts = decisions(layers, proof)
                row += [f"{sum(counts) / n:.0f}", f"{sum(counts[1:]) / n:.2f}"]
            print("| " + " | ".join(map(str, [*row, (folder / "out.gcode").stat().st_size])) + " |")


if __name__ == "__main__":
    main()
