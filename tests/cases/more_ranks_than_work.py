#!/usr/bin/python3
"""More ranks than cells of some kind: a rank has no flow, no air, or nothing at all, and the answer is the same."""

import sys

from program import HERE, main, read_series, read_summary

CASE = HERE.parent / "broken_cases" / "scene.toml"  # the sound case there; here with as few cells as its outline allows
TOLERANCE = 1e-7  # the tolerances of its solvers are the defaults


def test(program, folder):
    runs = {ranks: folder / str(ranks) for ranks in (1, 8)}
    for ranks, run in runs.items():
        result = program.start(ranks, "run", CASE, "--out", run, "--set", "mesh.parameters.h=0.02")
        if not program.expect_code(0, result, f"{ranks} ranks"):
            return
    cells = read_summary(runs[8])["cells"]
    solid, room = cells["parent"] - cells["acoustic"], cells["parent"] - cells["flow"]
    print(f"{cells['parent']} cells, {solid} of the solid and {room} of the room")
    program.expect(0 < room < 8 and 0 < solid < 8, f"too many cells for this test: {cells}")
    for name in ("history.csv", "microphones.csv"):
        (columns, a), (_, b) = read_series(runs[1] / name), read_series(runs[8] / name)
        for column, one, other in zip(columns, a, b):
            if column.endswith("iterations"):
                continue
            largest = max(map(abs, one)) or 1.0
            worst = max(abs(x - y) for x, y in zip(one, other)) / largest
            program.expect(len(one) == len(other) and worst <= TOLERANCE, f"{name}, {column} differs by {worst:.1e}")


if __name__ == "__main__":
    sys.exit(main(test))
