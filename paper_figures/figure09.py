#!/usr/bin/python3
"""Figure 9: three slices of a hollowed cube, from higher to lower; the trees soon merge into the outer walls."""
import sys

import look
import script

INPUTS = {"layers": "layers"}


BELOW_TOP = (2, 12, 30)  # layers


def draw(layers):
    figure, axes = look.panels(len(BELOW_TOP))
    nozzle = layers.setting("nozzle")
    for axis, below in zip(axes, BELOW_TOP):
        layer = layers.below_top(below)
        slice_ = layers.region(layer["slice"])
        look.frame(axis, look.box_of_region(slice_), 0.2)
        look.shell(axis, slice_, layers.region(layer["cavity"]))
        look.lines(axis, layers.forest(layer["supports"]).segments(), look.WALL, mm=nozzle)
        look.title(axis, f"layer {layer['layer']}, z = {layer['z_mm']:.1f} mm")
    look.scale_bar(axes[0])
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
