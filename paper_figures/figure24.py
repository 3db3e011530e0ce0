#!/usr/bin/python3
"""Figure 24: reduction of the volume against the size of the object."""
import sys

import look
import script

INPUTS = {"table": "table:model,height mm,reduction %"}


def draw(table):
    figure, axis = look.pyplot.subplots(figsize=(look.COLUMN, look.COLUMN * 0.7))
    series = {}
    for row in table:
        if row["reduction %"]:
            series.setdefault(row["model"], []).append((float(row["height mm"]), float(row["reduction %"])))
    for (name, points), marker in zip(series.items(), "osD^v"):
        axis.plot([p[0] for p in points], [p[1] for p in points], "-" + marker, markersize=3, label=name)
    axis.set_xlabel("height in mm")
    axis.set_ylabel("reduction of the volume in %")
    axis.grid(True, linewidth=0.3, color="#cccccc")
    axis.set_ylim(None, 100)
    axis.legend(frameon=False, loc="lower right")
    for side in ("top", "right"):
        axis.spines[side].set_visible(False)
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
