#!/usr/bin/python3
"""The same case on 1, 2, 3 and 4 ranks has the same answer: all columns of all series, each relative to its own largest
magnitude, and all results of the summary."""

import math
import sys

from program import HERE, main, read_series, read_summary

TOLERANCE = 1e-8  # above what iterative solvers leave (1e-10 to 1e-13 in these cases), below any other fault
ABOUT_EFFORT = ("newton_iterations", "jacobians", "acoustic_iterations")  # these may differ
# Folds that fall upon their mirror images: the sound goes on in the air that they leave.
CLOSING = ("--set", "mesh.parameters.half_gap=6e-5", "--set", "contact.alpha=0.5", "--set", "flow.gravity=[0,-3000]",
           "--set", "acoustic.contact_cells=strip")
# Sound on a mesh of its own that moves with the folds.
FOLLOWING = ("--set", "acoustic.sound.mesh.geometry=../../cases/vowel_i/larynx.geo", "--set",
             "acoustic.sound.mesh.follows_flow=true", "--set", "acoustic.sound.mesh.parameters.size_factor=6", "--set",
             "acoustic.sound.mesh.parameters.room_radius=0.03")
CASES = {"larynx": ("larynx",), "channel": ("channel",), "tube": ("tube",), "closing": ("larynx", *CLOSING),
         "touching": ("touching",), "coarse": ("coarse",), "following": ("larynx", *FOLLOWING)}


def difference(one, other):
    largest = max(max(map(abs, one), default=0.0), max(map(abs, other), default=0.0))
    return max((abs(a - b) for a, b in zip(one, other)), default=0.0) / largest if largest > 0 else 0.0


def compare_series(program, name, one, other, what):
    columns, values = read_series(one / name)
    other_columns, other_values = read_series(other / name)
    if not program.expect(columns == other_columns, f"{what}: {name} has the columns {other_columns}"):
        return 0.0
    worst = 0.0
    for column, a, b in zip(columns, values, other_values):
        if column in ABOUT_EFFORT:
            continue
        program.expect(len(a) == len(b), f"{what}: {name} has {len(b)} rows, not {len(a)}")
        here = difference(a, b)
        worst = max(worst, here)
        program.expect(here <= TOLERANCE, f"{what}: {name}, {column} differs by {here:.1e}")
    return worst


def compare_results(program, one, other, what):
    a, b = read_summary(one), read_summary(other)
    for key in ("cells", "unknowns", "steps", "status"):
        program.expect(a[key] == b[key], f"{what}: {key} is {b[key]}, not {a[key]}")
    if not program.expect(a["results"].keys() == b["results"].keys(), f"{what}: results {sorted(b['results'])}"):
        return
    for name, value in a["results"].items():
        other_value = b["results"][name]
        same = value == other_value or (value is not None and other_value is not None
                                        and math.isclose(value, other_value, rel_tol=TOLERANCE))
        program.expect(same, f"{what}: {name} is {other_value}, not {value}")


def test(program, folder):
    for case, (file, *settings) in CASES.items():
        for ranks in (1, 2, 3, 4):
            run = folder / f"{case}{ranks}"
            result = program.start(ranks, "run", HERE / f"{file}.toml", *settings, "--out", run)
            if not program.expect_code(0, result, f"{case} on {ranks} ranks") or ranks == 1:
                continue
            first = folder / f"{case}1"
            what = f"{case} on {ranks} ranks"
            names = [path.name for path in sorted(first.glob("*.csv")) if path.name != "spectra.csv"]
            worst = max(compare_series(program, name, first, run, what) for name in names)
            compare_results(program, first, run, what)
            print(f"{what}: largest difference {worst:.1e}", flush=True)


if __name__ == "__main__":
    sys.exit(main(test))
