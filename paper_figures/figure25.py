#!/usr/bin/python3
"""Figure 25: where walls waste. Left: a flat roof of low slope misleads their direction. Right: a tip far from every wall and near the floor."""
import sys
import math

import look
import script

INPUTS = {"roof": "layers", "tip": "layers"}


TILT = 0.4


def seen(p, z):
    return p[0], z + TILT * p[1]


def draw(roof, tip):
    figure, axes = look.panels(2, ratio=0.75)
    for axis, layers, name in zip(axes, (roof, tip), ("a roof of 8 degrees", "a tip near the floor")):
        points = [seen(p, l["z_mm"]) for l in layers["layers"] for c in layers.region(l["slice"]) for p in c]
        look.frame(axis, look.box_of(points), 0.5)
        nozzle, h = layers.setting("nozzle"), layers.mm(layers["settings"]["layer_height"])
        shades, count, volume = look.pyplot.get_cmap("viridis"), len(layers["layers"]), 0.0
        for k, layer in enumerate(layers["layers"]):
            if k % 5 == 0 or k == count - 1:
                look.lines(axis, [[seen(p, layer["z_mm"]) for p in c + c[:1]] for c in layers.region(layer["slice"])], look.EDGE, points=0.3, alpha=0.5, order=2, many=True)
            segments = layers.forest(layer["supports"]).segments()
            volume += sum(math.dist(*s) for s in segments) * nozzle * h
            look.lines(axis, [[seen(a, layer["z_mm"]), seen(b, layer["z_mm"])] for a, b in segments], [shades(0.9 * k / count)], points=0.7, alpha=0.8, order=3, many=True)
        look.title(axis, f"{name}: {volume:.0f} mm³ of walls")
        look.scale_bar(axis)
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
