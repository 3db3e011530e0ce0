#!/usr/bin/python3
"""Figure 16: the distance fields that order the points to support and choose their partners (exact distances)."""
import sys
import math

import look
import script

INPUTS = {"stages": "stages"}


def field(stages, name):
    f = stages["growth"]["fields"]
    rows = [f[name][k * f["columns"]:(k + 1) * f["columns"]] for k in range(f["rows"])]
    return [[math.nan if v is None else stages.mm(v) for v in row] for row in rows]


def draw(stages):
    f = stages["growth"]["fields"]
    pitch, (x, y) = stages.mm(f["pitch"]), (stages.mm(f["origin"][0]), stages.mm(f["origin"][1]))
    extent = (x - pitch / 2, x + (f["columns"] - 0.5) * pitch, y - pitch / 2, y + (f["rows"] - 0.5) * pitch)
    slice_, cavity, forest = stages.region(stages["slice"]), stages.region(stages["cavity"]), stages.forest(f["supports"])
    x0, y0, x1, y1 = look.box_of_region(slice_)
    figure, axes = look.panels(2, ratio=(y1 - y0) / (x1 - x0), gap=0.7)
    for axis, name, words in zip(axes, ("shell", "both"), ("$D_B$: to the shell", "$D_{BS}$: to shell and supports, equation (4)")):
        look.frame(axis, (x0, y0, x1, y1), 0.2)
        look.shell(axis, slice_, cavity)
        values = field(stages, name)
        shown = axis.imshow(values, origin="lower", extent=extent, cmap="viridis" if name == "shell" else "cividis", zorder=2, interpolation="nearest")
        if name == "both":
            look.lines(axis, forest.segments(), "white", points=0.8)
        bar = figure.colorbar(shown, ax=axis, fraction=0.04, pad=0.02)
        bar.set_label("mm")
        look.title(axis, words)
    look.scale_bar(axes[0])
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
