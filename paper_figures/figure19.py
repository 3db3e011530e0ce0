#!/usr/bin/python3
"""Figure 19: a support tree, the order of its paths, and the way of the nozzle."""
import sys

import look
import script

INPUTS = {"tree": "tree"}


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
    for k, path in enumerate(paths):
        look.lines(axes[1], [path], look.CYCLE[k % len(look.CYCLE)], points=2.0)
        middle = path[len(path) // 2] if len(path) > 2 else ((path[0][0] + path[-1][0]) / 2, (path[0][1] + path[-1][1]) / 2)
        axes[1].annotate(str(k + 1), middle, ha="center", va="center", fontsize=7, zorder=9, bbox={"boxstyle": "circle,pad=0.15", "fc": "white", "ec": "#888888", "lw": 0.5})
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
