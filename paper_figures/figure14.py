#!/usr/bin/python3
"""Figure 14: a tree is straightened section by section; its branching points stay where they are."""
import sys

import look
import script

INPUTS = {"tree": "tree"}


def draw(tree):
    figure, axes = look.panels(3, ratio=0.6)
    first, last = tree.forest(tree["straightening"][0]), tree.forest(tree["straightening"][-1])
    box = look.fitted(first.at, 0.6, 0.3)
    for axis, name in zip(axes, ("(a) tree", "(b) its sections", f"(c) after {len(tree['straightening']) - 1} layers")):
        look.frame(axis, box)
        look.area(axis, [c[::-1] for c in tree.region(tree["cavity"])], "none", edge=look.EDGE, width=0.8)
        look.title(axis, name)
    for axis, forest in ((axes[0], first), (axes[2], last)):
        look.lines(axis, forest.segments(), look.WALL, points=1.8)
        look.dots(axis, [p for v, p in enumerate(forest.at) if forest.valence(v) > 2], "white", 3.6, edge="black")
    for k, section in enumerate(first.sections()):
        look.lines(axes[1], [[first.at[v] for v in section]], look.CYCLE[k % len(look.CYCLE)], points=2.0)
    look.dots(axes[1], [p for v, p in enumerate(first.at) if first.valence(v) > 2], "white", 3.6, edge="black")
    look.scale_bar(axes[0])
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
