#!/usr/bin/python3
"""More ranks than cells of some kind: a rank has no flow, no air, or nothing at all, and the answer is the same; the
summary and the check tell of it, and what the ranks sent each other."""

import sys

from program import HERE, main, read_series, read_summary

CASE = HERE.parent / "broken_cases" / "scene.toml"  # the sound case there; here with as few cells as its outline allows
TOLERANCE = 1e-7  # the tolerances of its solvers are the defaults


def check_words(program):
    """The check warns where ranks would idle, and is silent where not."""
    for ranks, arguments, warns in ((8, ("--set", "mesh.parameters.h=0.02"), True), (2, (), False)):
        result = program.start(ranks, "check", CASE, *arguments)
        program.expect_code(0, result, f"check on {ranks} ranks")
        program.expect(("NOTE: " in result[1] and "ranks have no cell of" in result[1]) == warns,
                       f"the check on {ranks} ranks says\n{result[1]}")


def check_summaries(program, alone, many):
    """One rank sends nothing and waits for nobody; of eight with a dozen cells some do both."""
    program.expect(set(alone["imbalance"].values()) == {0}, f"imbalance of one rank: {alone['imbalance']}")
    program.expect(min(many["imbalance"].values()) > 0.1, f"imbalance of eight ranks: {many['imbalance']}")
    for counts in alone["communication"].values():
        program.expect(not any(counts.values()), f"one rank sends {counts}")
    step = many["communication"]["step"]
    sent = {"flow.assemble": ("messages", "bytes"), "flow.solve": ("reductions", "reduction_bytes"),
            "acoustic": ("messages", "bytes", "reductions", "reduction_bytes")}
    for phase, counts in sent.items():
        for count in counts:
            part = many["communication"][phase][count]
            program.expect(0 < part <= step[count], f"{phase}: {part} {count} of {step[count]} in a step")


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
    check_words(program)
    check_summaries(program, *(read_summary(runs[ranks]) for ranks in (1, 8)))
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
