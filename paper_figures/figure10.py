#!/usr/bin/python3
"""Figure 10: the hollow kitten, split in half."""
import sys

import look
import script

INPUTS = {"left": "picture", "right": "picture"}


def draw(left, right):
    figure, axes = look.panels(2, width=look.PAGE)
    for axis, picture in zip(axes, (left, right,)):
        axis.imshow(look.cropped(picture), interpolation="antialiased")
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
