#!/usr/bin/python3
"""Figure 25: where walls waste, and where they need not. (a) Under a roof of low slope all walls run to one side. (b) A tip inside, far from the
shell and near the floor, gets walls from the shell; with `--pillars` it would get a tree that stands on the floor. (c) Outside such a tip gets a tree that stands on the bed."""
import sys

import look
import script

INPUTS = {"roof": "picture", "roof_run": "run", "tip": "picture", "tip_run": "run", "outside": "picture", "outside_run": "run"}


def draw(roof, roof_run, tip, tip_run, outside, outside_run):
    inside = [f"{run['totals']['support_volume_mm3']:.0f} mm\u00b3 of walls" for run in (roof_run, tip_run)]
    names = (f"(a) low slope: {inside[0]}", f"(b) tip inside: {inside[1]}", f"(c) tip outside: {outside_run['totals']['external_support_volume_mm3']:.1f} mm\u00b3")
    return look.photographs([(roof,), (tip,), (outside,)], names)


if __name__ == "__main__":
    sys.exit(script.run(globals()))
