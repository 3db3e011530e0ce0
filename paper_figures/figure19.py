#!/usr/bin/python3
"""Figure 19: a support tree, the order of its paths, and the way of the nozzle."""
import math
import sys

import look
import script

INPUTS = {"tree": "tree"}


def halfway(path):
    """The point in the middle of a path, by length."""
    left = sum(math.dist(a, b) for a, b in zip(path, path[1:])) / 2
    for a, b in zip(path, path[1:]):
        step = math.dist(a, b)
        if step >= left > 0:
            return a[0] + left / step * (b[0] - a[0]), a[1] + left / step * (b[1] - a[1])
        left -= step
    return path[0]


def spread(path):
    """Points along a path."""
    return [(a[0] + k / 20 * (b[0] - a[0]), a[1] + k / 20 * (b[1] - a[1])) for a, b in zip(path, path[1:]) for k in range(21)]


def freest(at, far, taken):
    """Of eight places around a point the one farthest from all that is taken, as an offset."""
    around = [(far * math.cos(k * math.pi / 4), far * math.sin(k * math.pi / 4)) for k in range(8)]
    return max(around, key=lambda d: min(math.dist((at[0] + d[0], at[1] + d[1]), p) for p in taken))


def draw(tree):
    figure, axes = look.panels(3, ratio=0.75)
    forest, nozzle = tree.forest(tree["tree"]), tree.setting("nozzle")
    paths = [tree.points(p["points"]) for p in tree["paths"]]
    box = look.fitted(forest.at, 0.75, 0.5)
    for axis, name in zip(axes, ("(a) tree", "(b) order", "(c) path")):
        look.frame(axis, box)
        look.area(axis, tree.region(tree["cavity"]), "none", edge=look.EDGE, width=0.8)
        look.title(axis, name)
    look.lines(axes[0], forest.segments(), look.WALL, points=1.8)
    look.dots(axes[0], [p for p, r in zip(forest.at, forest.root) if r], "black", 4, shape="s")
    taken = [p for path in paths for p in spread(path)]
    for k, path in enumerate(paths):
        look.lines(axes[1], [path], look.CYCLE[k % len(look.CYCLE)], points=2.0)
        at = halfway(path)
        away = freest(at, 11 / look.points_per_mm(axes[1]), taken)
        taken.append((at[0] + away[0], at[1] + away[1]))
        axes[1].annotate(str(k + 1), at, xytext=taken[-1], textcoords="data", ha="center", va="center", fontsize=7, zorder=9,
                         arrowprops={"arrowstyle": "-", "lw": 0.5, "color": "#888888", "shrinkA": 0, "shrinkB": 0},
                         bbox={"boxstyle": "circle,pad=0.15", "fc": "white", "ec": "#888888", "lw": 0.5})
    look.lines(axes[2], paths, "#a6cee3", mm=nozzle, order=2)
    look.lines(axes[2], paths, look.WALL, points=0.9)
    travels = [[a[-1], b[0]] for a, b in zip(paths, paths[1:])]
    for a, b in travels:
        axes[2].annotate("", b, a, arrowprops={"arrowstyle": "->", "color": look.GREEN, "lw": 1.3, "shrinkA": 0, "shrinkB": 0}, zorder=8)
    look.dots(axes[2], [paths[0][0]], "black", 3.5)
    handles = [look.pyplot.Line2D([], [], color=look.WALL, linewidth=1.5, label="extrusion"), look.pyplot.Line2D([], [], color=look.GREEN, linewidth=1.5, label="travel")]
    axes[2].legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.01), ncol=2, frameon=False)
    look.scale_bar(axes[0])
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
