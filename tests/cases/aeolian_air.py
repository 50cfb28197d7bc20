#!/usr/bin/python3
"""The aeolian tone by acoustic analogies in the air around the flow, cases/cylinder/aeolian_air.toml on a coarser mesh: each of
them, and Curle, against the compact dipole of the lift that the same run has.

    aeolian_air.py PROGRAM [--mpiexec mpiexec]      runs the case, five minutes of a core, and asserts
"""

import sys

from aeolian_tone import CASES, expect_loudness, measure, show
from program import main

COARSER = ("mesh.parameters.size=1", "time.dt=2.4e-4", "time.theta=0.51", "time.end=0.36")


def test(program, folder):
    changes = [word for change in COARSER for word in ("--set", change)]
    result = program.start(1, "run", CASES / "aeolian_air.toml", "--out", folder, *changes)
    if not program.expect_code(0, result, "the run"):
        return
    flow, predicted, sounds = measure(folder)
    show(flow, predicted, sounds)
    program.expect(len(sounds) == 6, "five analogies and Curle were to be heard")
    expect_loudness(program, sounds)


if __name__ == "__main__":
    sys.exit(main(test))
