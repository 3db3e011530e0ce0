#!/usr/bin/python3
"""Figure 1: the low poly bunny, whole and cut open: the supports inside."""
import sys

import look
import script

INPUTS = {"whole": "picture", "cut": "picture"}


def draw(whole, cut):
    figure, axes = look.panels(2, width=look.PAGE)
    for axis, picture in zip(axes, (whole, cut,)):
        axis.imshow(look.cropped(picture), interpolation="antialiased")
    return figure


if __name__ == "__main__":
    sys.exit(script.run(globals()))
