#!/usr/bin/python3
"""Figure 20: a branch and its trunk from the side: eroded from layer to layer, one width away from the trunk but on its first layer (vermilion)."""
import sys
import math

import look
import results
import script

INPUTS = {"layers": "layers"}


def dist(a, b):
    return math.dist(a, b)


def branch_of(forest, tip):
    """From the junction to the tip, or None when the tip's chain ends on the shell."""
    chain = [tip]
    while True:
        onward = [w for w in forest.around[chain[-1]] if len(chain) < 2 or w != chain[-2]]
        if not onward:
            return None
        chain.append(onward[0])
        if forest.root[chain[-1]]:
            return None
        if forest.valence(chain[-1]) > 2:
            return chain[::-1]


def tips(forest):
    return [v for v in range(len(forest.at)) if forest.valence(v) == 1 and not forest.root[v]]


def along(chain, point):
    """How far along the chain the point lies when it is on it, else None."""
    done = 0.0
    for a, b in zip(chain, chain[1:]):
        n = dist(a, b)
        if n > 0:
            t = ((point[0] - a[0]) * (b[0] - a[0]) + (point[1] - a[1]) * (b[1] - a[1])) / n
            if -1e-3 <= t <= n + 1e-3 and abs((point[0] - a[0]) * (b[1] - a[1]) - (point[1] - a[1]) * (b[0] - a[0])) / n < 2e-3:
                return done + min(max(t, 0.0), n)
        done += n
    return None


def printed_from(chain, paths):
    """Where along the branch its own path begins."""
    length = sum(dist(a, b) for a, b in zip(chain, chain[1:]))
    best = None
    for path in paths:
        ends = [along(chain, p) for p in (path[0], path[-1])]
        if any(e is not None and e > length - 5e-2 for e in ends):  # this path prints the tip
            others = [e for e in ends if e is not None and e < length - 5e-2]
            best = min(others) if others else 0.0
    return best


def follow(layers, top, tip):
    """(z, length of the branch, where its path begins, first layer) from `top` downwards until it is gone."""
    rows, at, rho = [], None, layers.setting("support_radius")
    for layer in reversed(layers["layers"][:top + 1]):
        forest = layers.forest(layer["supports"])
        near = [tip] if at is None else sorted((v for v in tips(forest) if dist(forest.at[v], at) <= 2.5 * rho), key=lambda v: dist(forest.at[v], at))
        chain = branch_of(forest, near[0]) if near else None
        if chain is None:
            break
        at = forest.at[chain[-1]]
        points = [forest.at[v] for v in chain]
        paths = [layers.points(p["points"]) for p in layer["paths"] if p["kind"] == "support"]
        length = sum(dist(a, b) for a, b in zip(points, points[1:]))
        if rows and length > rows[-1][1] + rho:
            break  # the junction is another one: the branch it shared a trunk with is gone
        begins = printed_from(points, paths)
        apart = layers.setting("nozzle") / 2
        if begins is not None and begins < apart and any(r[2] is not None and r[2] > apart for r in rows):
            break  # shorter than the gap, it is printed as the trunk's end from here on
        rows.append((layer["z_mm"], length, begins))
    return rows


def longest_lived(layers):
    """The branch that keeps off its trunk on most layers; another path goes through the junction."""
    def apart(rows):
        return sum(r[2] > layers.setting("nozzle") / 2 for r in rows)

    best = []
    for top in range(len(layers["layers"]) - 2, max(0, len(layers["layers"]) - 12), -1):
        forest = layers.forest(layers["layers"][top]["supports"])
        for tip in tips(forest):
            chain = branch_of(forest, tip)
            if chain is None:
                continue
            rows = follow(layers, top, tip)
            reaches = rows and rows[0][2] is not None and rows[0][2] < layers.setting("nozzle") / 2
            if reaches and all(r[2] is not None for r in rows) and apart(rows) > apart(best):
                best = rows
    return best


def draw(layers):
    rows = longest_lived(layers)
    if not rows:
        raise results.Unusable(f"{layers.file}: no branch in it is printed apart from its trunk; ribvault_steps layers --gaps paper makes such files")
    h, d = layers.mm(layers["settings"]["layer_height"]), layers.setting("nozzle")
    figure, axis = look.pyplot.subplots(figsize=(look.COLUMN, look.COLUMN * 0.8))
    top = rows[0][0]
    for z, length, begins in rows:
        axis.add_patch(look.pyplot.Rectangle((-d / 2, z - h / 2), d, h * 0.92, facecolor="#bbbbbb", edgecolor="white", linewidth=0.4))
        if begins is None:
            continue
        first = begins < d / 2
        axis.add_patch(look.pyplot.Rectangle((begins if not first else 0, z - h / 2), max(length - begins, 0.05), h * 0.92, facecolor=look.HANG if first else look.WALL,
                                             edgecolor="white", linewidth=0.4, alpha=0.95, zorder=3))
    axis.set_xlim(-1.2 * d, max(r[1] for r in rows) + 0.3)
    axis.set_ylim(rows[-1][0] - 2 * h, top + h)
    axis.set_aspect("equal")
    axis.set_xlabel("mm along the branch")
    axis.set_ylabel("z in mm")
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)
    handles = [look.pyplot.Rectangle((0, 0), 1, 1, color=c, label=t) for c, t in (("#bbbbbb", "trunk"), (look.HANG, "reaches the junction"), (look.WALL, "one width away"))]
    axis.legend(handles=handles, loc="upper center", bbox_to_anchor=(0.42, -0.2), ncol=3, frameon=False, handlelength=1.2, columnspacing=1.0)
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
