#!/usr/bin/python3
"""Figure 2: what of a hollowed model hangs in the cavity: overhangs (orange) and local minima (red)."""
import sys
import math

import look
import script

INPUTS = {"layers": "layers"}


# Seen from the front, a little from above.
TILT = 0.35


def seen(points, z):
    return [(x, z + TILT * y) for x, y in points]


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
    rho, drawn = layers.setting("support_radius"), []
    for axis in (whole, hangs):
        points = [p for l in layers["layers"] for c in layers.region(l["slice"]) for p in seen(c, l["z_mm"])]
        look.frame(axis, look.box_of(points), 0.5)
    minima = 0
    for k, layer in enumerate(layers["layers"]):
        slice_, cavity = layers.region(layer["slice"]), layers.region(layer["cavity"])
        outlines = [seen(c + c[:1], layer["z_mm"]) for c in slice_]
        if k % 6 == 0:
            look.lines(whole, outlines, look.EDGE, points=0.25, alpha=0.5)
            look.lines(whole, [seen(c + c[:1], layer["z_mm"]) for c in cavity], look.WALL, points=0.35, alpha=0.7)
        if k % 12 == 0:
            look.lines(hangs, outlines, look.EDGE, points=0.2, alpha=0.35)
        for contour in layers.region(layer["overhang"]):
            minimum = is_minimum(contour, cavity, rho)
            minima += minimum
            drawn.append((minimum, seen(contour, layer["z_mm"])))
    for minimum, contour in sorted(drawn, key=lambda d: d[0]):
        look.area(hangs, [contour], "#c1121f" if minimum else "#f4a259", alpha=1 if minimum else 0.6, edge="#c1121f" if minimum else "none", width=0.8, order=4 + minimum)
    look.title(whole, "shell (grey) and cavity (blue)")
    look.title(hangs, f"overhangs in the cavity, {minima} local minima")
    look.scale_bar(whole)
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
