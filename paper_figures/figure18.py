#!/usr/bin/python3
"""Figure 18: supports grow under a roof, from the unsupported area to the last wall."""
import sys

import look
import script

INPUTS = {"stages": "stages"}


def draw(stages):
    walls, mm = stages["growth"]["walls"], lambda p: (stages.mm(p[0]), stages.mm(p[1]))
    n = len(walls)
    counts = [0, 1, 1, 2, 3, 6, n // 8, n // 5, n // 3, n // 2, 3 * n // 4, n]
    figure, axes = look.panels(12, rows=2)
    nozzle, rho = stages.setting("nozzle"), stages.setting("support_radius")
    slice_, cavity = stages.region(stages["slice"]), stages.region(stages["cavity"])
    x0, y0, x1, y1 = look.box_of_region(slice_)
    half = max(x1 - x0, y1 - y0) / 2
    for k, (axis, count) in enumerate(zip(axes, counts)):
        look.frame(axis, ((x0 + x1) / 2 - half, (y0 + y1) / 2 - half, (x0 + x1) / 2 + half, (y0 + y1) / 2 + half), 0.2)
        look.area(axis, stages.region(stages["overhang"]), "#e07a5f", alpha=0.85)
        grown = stages.forest(stages["straightened"]).segments() + [(mm(w["point"]), mm(w["joint"])) for w in walls[:count]]
        if k != 1:
            look.lines(axis, grown, "#cfe6f5", mm=nozzle + 2 * rho, order=2)  # what they support
            look.lines(axis, grown, look.WALL, mm=nozzle, order=3)
        else:
            look.lines(axis, grown, look.WALL, points=1.0, order=3)
            look.dots(axis, [grown[-1][0]], "black", 3)
        look.shell(axis, slice_, cavity, order=4)
        look.title(axis, f"({'abcdefghijkl'[k]}) {count if k else 'no'} wall{'' if count == 1 else 's'}")
    look.scale_bar(axes[6])
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
