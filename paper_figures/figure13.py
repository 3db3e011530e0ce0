#!/usr/bin/python3
"""Figure 13: a chain of walls is straightened: each vertex has a place on the chord and moves towards it by at most r a layer."""
import sys

import look
import script

INPUTS = {"tree": "tree"}


def draw(tree):
    figure, (left, right) = look.panels(2, ratio=0.5)
    mm = lambda points: [(tree.mm(x), tree.mm(y)) for x, y in points]
    chain, targets = mm(tree["chain"]["points"]), mm(tree["chain"]["targets"])
    states = [tree.forest(s) for s in tree["chain"]["states"]]
    box = look.fitted(chain + targets, 0.5, 0.2)
    for axis in (left, right):
        look.frame(axis, box)
    look.lines(left, [[chain[0], chain[-1]]], look.HANG, points=1.2, style="dashed", order=2)
    look.lines(left, list(zip(chain, targets)), "#999999", points=0.6, order=2)
    look.lines(left, [chain], look.WALL, points=1.8)
    look.dots(left, chain, look.WALL, 3.4)
    look.dots(left, targets, look.HANG, 3.0)
    look.title(left, "vertices and their places on the chord")
    shades = look.pyplot.get_cmap("viridis_r")
    for k, state in enumerate(states):
        colour = shades(0.15 + 0.85 * k / max(1, len(states) - 1))
        look.lines(right, state.segments(), [colour], points=1.4)
        look.dots(right, state.at, colour, 1.8)
    look.title(right, f"{len(states) - 1} layers, from light to dark")
    look.scale_bar(left)
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
