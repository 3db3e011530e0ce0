#!/usr/bin/python3
"""Figure 7: the inside of a model with many inner edges (a stand-in for the paper's Yoda)."""
import sys

import look
import script

INPUTS = {"cut": "picture"}


def draw(cut):
    figure, axes = look.panels(1, width=look.COLUMN)
    for axis, picture in zip(axes, (cut,)):
        axis.imshow(look.cropped(picture), interpolation="antialiased")
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
