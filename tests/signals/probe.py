"""Calls signal_probe, which shows the signal processing of Vocalis."""

import subprocess
import sys

import numpy

SKIPPED = 77  # exit code that CTest takes for "skipped"


def skip(words):
    print(f"SKIPPED: {words}", file=sys.stderr)
    sys.exit(SKIPPED)


def call(*words):
    """The probe's rows as an array."""
    done = subprocess.run([sys.argv[1], *map(str, words)], check=True, stdout=subprocess.PIPE, text=True)
    return numpy.array([line.split() for line in done.stdout.splitlines()], dtype=float)
