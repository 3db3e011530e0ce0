#!/usr/bin/python3
"""Figure 17: supports of a flat square roof without and with the branch heuristic of equation (4)."""
import sys

import look
import script

INPUTS = {"plain": "layers", "branching": "layers"}


def draw(plain, branching):
    figure, axes = look.panels(2)
    for axis, layers, name in zip(axes, (plain, branching), ("without the branch heuristic", "with it")):
        layer = layers.below_top(1)
        slice_ = layers.region(layer["slice"])
        forest = layers.forest(layer["supports"])
        look.frame(axis, look.box_of_region(slice_), 0.2)
        look.shell(axis, slice_, layers.region(layer["cavity"]))
        look.lines(axis, forest.segments(), look.WALL, points=1.1)
        look.dots(axis, [p for v, p in enumerate(forest.at) if forest.valence(v) > 2], look.HANG, 1.6)
        trees = sum(forest.root)
        look.title(axis, f"{name}: {trees} trees")
    look.scale_bar(axes[0])
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
