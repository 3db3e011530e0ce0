#!/usr/bin/python3
"""Figure 6: ribbed supports around cavities that others bridge (a stand-in for the paper's skull)."""
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
