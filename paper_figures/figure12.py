#!/usr/bin/python3
"""Figure 12: what straightening does to the supports in a cube."""
import sys

import look
import script

INPUTS = {"straightened": "layers", "bent": "layers"}


def draw(straightened, bent):
    figure, axes = look.panels(3)
    shown = [(straightened, 2, "2nd layer with supports"), (bent, 12, "12th, without straightening"), (straightened, 12, "12th, with straightening")]
    for axis, (layers, below, name) in zip(axes, shown):
        layer = layers.below_top(below)
        slice_ = layers.region(layer["slice"])
        look.frame(axis, look.box_of_region(slice_), 0.2)
        look.shell(axis, slice_, layers.region(layer["cavity"]))
        look.lines(axis, layers.forest(layer["supports"]).segments(), look.WALL, mm=layers.setting("nozzle"))
        look.title(axis, name)
    look.scale_bar(axes[0])
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
