#!/usr/bin/python3
"""Figure 10: the hollow kitten, split in half."""
import sys

import look
import script

INPUTS = {"left": "picture", "right": "picture"}


def draw(left, right):
    return look.photographs([(left, right)], ("left half away", "right half away"))


if __name__ == "__main__":
    sys.exit(script.run(globals()))
