"""Runs of the program for the tests of its pages. PROGRAM from RIBVAULT."""
import os
import pathlib
import subprocess

PROGRAM = os.environ["RIBVAULT"]
CUBE = pathlib.Path(__file__).resolve().parent.parent.parent / "experiments/models/cube20.stl"


def generate(folder, *arguments):
    done = subprocess.run([PROGRAM, "generate", *map(str, arguments), "--quiet"], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def make_page(folder, *arguments):
    return subprocess.run([PROGRAM, "page", *map(str, arguments)], cwd=folder, capture_output=True, text=True)
