#!/usr/bin/python3
"""Figure 15: a point is linked to the end of a wall although another wall is nearer: equation (4) takes 4r off distances to vertices of low valence."""
import sys
import math

import look
import results
import script

INPUTS = {"stages": "stages"}


def chosen(stages):
    """The new wall that the bonus drew farthest from where the plain distance would have put it, and its number."""
    def drawn(wall):
        if wall["joint_kind"] != "vertex" or not wall["wall"] or math.dist(wall["joint"], wall["wall"]) < 0.3 * wall["wall_distance"]:
            return -1
        return wall["joint_distance"] - min(wall["shell_distance"], wall["wall_distance"])
    walls = stages["growth"]["walls"]
    best = max(range(len(walls)), key=lambda k: drawn(walls[k]), default=None)
    if best is None or drawn(walls[best]) <= 0:
        raise results.Unusable("no wall of this layer was placed by the branch bonus; take another layer, or leave --no-branch-bonus out")
    return best


def draw(stages):
    k = chosen(stages)
    walls = stages["growth"]["walls"]
    wall, mm = walls[k], lambda p: (stages.mm(p[0]), stages.mm(p[1]))
    p, shell, near, joint = mm(wall["point"]), mm(wall["shell"]), mm(wall["wall"]), mm(wall["joint"])
    figure, (axis,) = look.panels(1, width=look.COLUMN, ratio=0.85)
    look.frame(axis, look.fitted([p, shell, near, joint], 0.85, 0.9))
    look.shell(axis, stages.region(stages["slice"]), stages.region(stages["cavity"]))
    old = stages.forest(stages["straightened"]).segments() + [(mm(w["point"]), mm(w["joint"])) for w in walls[:k]]
    look.lines(axis, old, look.HANG, points=2.0)
    away = -1 if joint[0] >= p[0] else 1  # the labels of what was not taken stand on the other side of p

    def say(text, at, side, up):
        axis.annotate(text, at, xytext=(5 * side, up), textcoords="offset points", fontsize=6.5, zorder=9, va="center", ha="left" if side > 0 else "right",
                      bbox={"boxstyle": "round,pad=0.15", "fc": "white", "ec": "none", "alpha": 0.85})

    for end, text, value in ((shell, "$p_b$", wall["shell_distance"]), (near, "$p[2]$", wall["wall_distance"])):
        look.lines(axis, [[p, end]], "#666666", points=0.9, style="dotted", order=4)
        look.dots(axis, [end], "black", 3.2)
        say(f"{text}: {stages.mm(value):.2f} mm", end, away, -7 if p[1] > end[1] else 7)  # beyond the wall as seen from p, clear of what stands on p's side
    look.lines(axis, [[p, joint]], look.WALL, points=2.2, order=5)
    bonus, far = stages.setting("branch_bonus"), stages.mm(wall["joint_distance"])
    look.dots(axis, [joint], look.WALL, 4)
    say(f"$p[1]$, valence {wall['valence']}:\n{far:.2f} - {bonus:.2g} = {far - bonus:.2f} mm", joint, -away, 11)
    look.dots(axis, [p], look.GREEN, 5)
    axis.annotate("$p$", p, xytext=(5, 5), textcoords="offset points", fontsize=8, zorder=9)
    look.scale_bar(axis)
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
