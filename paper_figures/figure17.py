#!/usr/bin/python3
"""Figure 17: supports of a flat square roof without and with the branch heuristic of equation (4). Orange dots: junctions."""
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
        look.dots(axis, [p for v, p in enumerate(forest.at) if forest.valence(v) > 2], look.HANG, 1.9)
        trees = sum(forest.root)
        look.title(axis, f"{name}: {trees} trees")
    look.scale_bar(axes[0])
    wall, junction = (axes[1].plot([], [], marker, color=colour, markersize=3, linewidth=1.1, label=label)[0]
                      for marker, colour, label in (("-", look.WALL, "wall"), ("o", look.HANG, "junction")))
    axes[1].legend(handles=[wall, junction], loc="upper left", bbox_to_anchor=(0, 0), ncol=2, frameon=False, borderaxespad=0.1, handletextpad=0.4)
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
