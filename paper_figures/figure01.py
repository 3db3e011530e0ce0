#!/usr/bin/python3
"""Figure 1: the low poly bunny, whole and cut open: the supports inside."""
import sys

import look
import script

INPUTS = {"whole": "picture", "cut": "picture"}


def draw(whole, cut):
    return look.photographs([(whole, cut)], ("whole", "half of the shell away"))


if __name__ == "__main__":
    sys.exit(script.run(globals()))
