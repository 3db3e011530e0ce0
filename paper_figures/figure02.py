#!/usr/bin/python3
"""Figure 2: what of a hollowed model hangs in the cavity: overhangs (orange) and local minima (red)."""
import sys
import math

import look
import script

INPUTS = {"layers": "layers"}


TILT = 0.35  # seen a little from above


def seen(points, z):
    return [(y, z - TILT * x) for x, y in points]


def distance(p, contours):
    """To the nearest border."""
    least = math.inf
    for contour in contours:
        for a, b in zip(contour, contour[1:] + contour[:1]):
            dx, dy = b[0] - a[0], b[1] - a[1]
            n = dx * dx + dy * dy
            t = max(0.0, min(1.0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / n)) if n else 0.0
            least = min(least, math.hypot(p[0] - a[0] - t * dx, p[1] - a[1] - t * dy))
    return least


def is_minimum(contour, cavity, rho):
    """What hangs beside the shell begins within a step of rho from it; what begins by itself is farther away all along."""
    return min(distance(p, cavity) for p in contour) > 2 * rho


def draw(layers):
    figure, (whole, hangs) = look.panels(2, ratio=1.05)
    rho, minima = layers.setting("support_radius"), 0
    for axis in (whole, hangs):
        look.frame(axis, look.box_of([p for l in layers["layers"] for c in layers.region(l["slice"]) for p in seen(c, l["z_mm"])]), 0.5)
    for k, layer in enumerate(layers["layers"]):  # from the bed up: what is drawn later stands before what is below it
        slice_, cavity = ([seen(c, layer["z_mm"]) for c in layers.region(layer[name])] for name in ("slice", "cavity"))
        if k % 2 == 0:
            look.area(whole, slice_, look.SHELL, edge="#8c8c8c", width=0.25, order=2 + k / 1000)
            look.area(hangs, cavity, "#eef3f7", edge="#c3ccd4", width=0.2, order=2 + k / 1000)
        parts = look.parts(layers.region(layer["overhang"]))
        for part in parts:
            minimum = is_minimum(part[0], layers.region(layer["cavity"]), rho)
            minima += minimum
            look.area(hangs, [seen(c, layer["z_mm"]) for c in part], look.RED if minimum else look.ORANGE, edge=look.RED if minimum else look.ORANGE,
                      width=1.0 if minimum else 0.15, order=3 + minimum + k / 1000)
    look.title(whole, "the model")
    look.title(hangs, "its cavity, and what hangs in it")
    handles = [look.pyplot.Rectangle((0, 0), 1, 1, color=c, label=t) for c, t in ((look.ORANGE, "overhang"), (look.RED, f"local minimum ({minima})"))]
    hangs.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=2, frameon=False, handlelength=1.2)
    look.scale_bar(whole)
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
