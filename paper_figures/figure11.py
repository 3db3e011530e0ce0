#!/usr/bin/python3
"""Figure 11: S_i copied to the lower slice: clipped where it leaves the shell's inside, prolonged where it no longer reaches the shell."""
import sys
import math

import look
import results
import script

INPUTS = {"stages": "stages"}


def middle(segment):
    (a, b), (c, d) = segment
    return (a + c) / 2, (b + d) / 2


def left_out(segments, cavity):
    """Stretches of the segments, 0.2 mm or longer, that are not in the cavity."""
    inside, found = look.path_of(cavity), []
    for a, b in segments:
        n = max(1, int(math.dist(a, b) / 0.05))
        at = [(a[0] + k / n * (b[0] - a[0]), a[1] + k / n * (b[1] - a[1])) for k in range(n + 1)]
        outside = [not inside.contains_point(p) for p in at]
        for k in range(n - 3):
            if all(outside[k:k + 5]):
                found.append((at[k], at[k + 4]))
    return found


def draw(stages):
    figure, axes = look.panels(6, rows=2, ratio=0.7)
    above, copied = stages.forest(stages["above"]), stages["copied"]
    slices = [(stages["slice_above"], stages["cavity_above"]), (stages["slice"], stages["cavity"]), (stages["slice"], stages["cavity"])]
    i = stages["layer"] + 1
    forest = stages.forest(copied)
    changed = [forest.segments()[k] for k, p in enumerate(copied["prolonged"]) if p]
    clipped = left_out(above.segments(), stages.region(stages["cavity"]))
    if not changed or not clipped:
        raise results.Unusable(f"layer {i - 1} does not both clip and prolong supports; leave --layer out and ribvault_steps finds one that does")
    windows = [middle(clipped[len(clipped) // 2]), middle(max(changed, key=lambda s: math.dist(*s)))]
    names = [f"(a) $S_{{{i}}}$ in $B_{{{i}}}$", f"(b) $S_{{{i}}}$ in $B_{{{i - 1}}}$", f"(c) $T_{{{i - 1}}}$"]
    half = 2.4
    for k, axis in enumerate(axes):
        x, y = windows[k // 3]
        look.frame(axis, (x - half, y - 0.7 * half, x + half, y + 0.7 * half))
        slice_, cavity = slices[k % 3]
        look.shell(axis, stages.region(slice_), stages.region(cavity))
        if k < 3:
            look.title(axis, names[k])
    for axis in (axes[0], axes[1], axes[3], axes[4]):
        look.lines(axis, above.segments(), look.WALL, points=1.6)
    kept = [s for s, p in zip(forest.segments(), copied["prolonged"]) if not p]
    for axis in (axes[2], axes[5]):
        look.lines(axis, above.segments(), look.HANG, points=1.6)  # what the copy does not cover was clipped
        look.lines(axis, kept, look.WALL, points=1.8, order=4)
        look.lines(axis, changed, look.GREEN, points=2.2, order=5)
    handles = [look.pyplot.Line2D([], [], color=c, linewidth=1.8, label=t) for c, t in ((look.WALL, "kept"), (look.HANG, "clipped"), (look.GREEN, "prolonged"))]
    axes[5].legend(handles=handles, loc="upper center", bbox_to_anchor=(0.5, -0.01), ncol=3, frameon=False, handlelength=1.2, columnspacing=1.0)
    look.scale_bar(axes[3])
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
