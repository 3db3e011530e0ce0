#!/usr/bin/python3
"""Figure 6: ribbed supports around cavities that others bridge (a stand-in for the paper's skull)."""
import sys

import look
import script

INPUTS = {"cut": "picture"}


def draw(cut):
    return look.photographs([(cut,)], width=look.COLUMN)


if __name__ == "__main__":
    sys.exit(script.run(globals()))
