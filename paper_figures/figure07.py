#!/usr/bin/python3
"""Figure 7: the inside of a model with many inner edges (a stand-in for the paper's Yoda)."""
import sys

import look
import script

INPUTS = {"cut": "picture"}


def draw(cut):
    return look.photographs([(cut,)], width=look.COLUMN)


if __name__ == "__main__":
    sys.exit(script.run(globals()))
