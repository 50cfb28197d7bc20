#!/usr/bin/python3
"""Sound alone on a recorded flow is the sound of the coupled run: with a mesh that moves, with contact, with several
voices of which one lags, on another number of ranks, with another analogy, after a stop."""

import shutil
import sys

import h5py
import numpy

from program import HERE, main, read_series, read_summary
from write_record import write_record

SAME, OTHER_RANKS = 1e-10, 1e-8
RECORD = ("--set", "record.precision=double")
FIVE_POINT = ("--set", "acoustic.0.pressure_derivative=five_point")


def difference(program, one, other, name, what):
    """Of the worst column, relative to its own largest magnitude."""
    (columns, a), (others, b) = read_series(one / name), read_series(other / name)
    if not program.expect(columns == others, f"{what}: {name} has the columns {others}"):
        return 0.0
    worst = 0.0
    for column, x, y in zip(columns, map(numpy.array, a), map(numpy.array, b)):
        if program.expect(len(x) == len(y), f"{what}: {name}, {column} has {len(y)} rows, not {len(x)}"):
            worst = max(worst, numpy.abs(x - y).max() / max(numpy.abs(x).max(), 1e-300))
    return worst


def compare(program, one, other, tolerance, what):
    """Microphones, and the results that are made of them."""
    for path in sorted(one.glob("microphones*.csv")):
        found = difference(program, one, other, path.name, what)
        print(f"{what}: {path.name} differs by {found:.1e}", flush=True)
        program.expect(found <= tolerance, f"{what}: {path.name} differs by {found:.1e}")
    a, b = read_summary(one)["results"], read_summary(other)["results"]
    program.expect(a.keys() == b.keys(), f"{what}: results {sorted(b)}, not {sorted(a)}")
    for key in a.keys() & b.keys():
        same = a[key] == b[key] or (None not in (a[key], b[key]) and abs(a[key] - b[key]) <= 1e-6 * abs(a[key]))
        program.expect(same, f"{what}: {key} is {b[key]}, not {a[key]}")


def start(program, ranks, what, *arguments):
    return program.expect_code(0, program.start(ranks, *arguments), what)


def same_record(program, one, other, what):
    with h5py.File(one / "flow_record.h5") as a, h5py.File(other / "flow_record.h5") as b:
        program.expect(sorted(a) == sorted(b) and a.attrs["steps"] == b.attrs["steps"], f"{what}: {sorted(b)}")
        for name in set(a) & set(b) - {"mesh"}:
            program.expect(numpy.array_equal(a[name][()], b[name][()]), f"{what}: {name} differs")


def contact_and_ranks(program, folder):
    """A block closes a duct: P2P1, a moving mesh, cells in contact, air that is stripped anew."""
    case, coupled, what = HERE / "touching.toml", folder / "touching", "touching"
    if not start(program, 1, what, "run", case, "--out", coupled, *RECORD, "--set", "output.fields_interval=0"):
        return
    with h5py.File(coupled / "flow_record.h5") as record:
        steps = read_summary(coupled)["steps"] + 1
        program.expect(record.attrs["steps"] == steps, f"{what}: {record.attrs['steps']} steps, not {steps}")
        program.expect(record["in_contact"][()].any(), f"{what}: nothing touched")
    for ranks, tolerance in ((1, SAME), (3, OTHER_RANKS)):
        again, words = folder / f"touching_replay{ranks}", f"{what}, replay on {ranks} ranks"
        if start(program, ranks, words, "replay", coupled, "--out", again):
            compare(program, coupled, again, tolerance, words)

    # Analogies that take the velocity of quadratic elements, in the middles of edges, too.
    whole, what = folder / "whole_pressure", "touching, analogies of the whole pressure"
    analogies = ("--set", "acoustic.contact_cells=keep", "--set", 'acoustic.analogy=["lighthill", "pcwe"]')
    if start(program, 1, what, "run", case, "--out", whole, "--set", "output.fields_interval=0", *analogies):
        start(program, 1, what, "replay", coupled, "--out", folder / "whole_replay", *analogies)
        compare(program, whole, folder / "whole_replay", SAME, what)

    stopped = folder / "touching_stopped"
    for arguments in (("run", case, "--out", stopped, *RECORD, "--set", "output.fields_interval=0", "--steps", 17),
                      ("resume", stopped)):
        start(program, 1, "stopped while it records", *arguments)
    same_record(program, coupled, stopped, "stopped while it records")
    again = folder / "replay_stopped"
    for arguments in (("replay", coupled, "--out", again, "--steps", 23), ("resume", again)):
        start(program, 1, "a replay that was stopped", *arguments)
    compare(program, coupled, again, SAME, "a replay that was stopped")
    refused(program, coupled, folder)


def refused(program, coupled, folder):
    """Records that are cut off, and overrides that are no sound."""
    cut = folder / "cut"
    shutil.copytree(coupled, cut)
    data = (cut / "flow_record.h5").read_bytes()
    (cut / "flow_record.h5").write_bytes(data[: len(data) // 2])
    for arguments, words in (((cut,), "must be whole"), ((coupled, "--set", "time.dt=1e-5"), "can change the sound"),
                             ((coupled, "--out", coupled), "over the record"),
                             ((coupled, "--set", "output.directory=" + str(coupled)), "over the record")):
        code, text = program.start(1, "replay", *arguments)
        program.expect(code == 2 and words in text and "remedy" in text, f"replay {arguments}: code {code}\n{text}")
    program.expect((coupled / "flow_record.h5").exists(), "the record was lost")


def voices_and_analogies(program, folder):
    """Two voices, one of which lags by two steps, on folds that move; then another analogy."""
    case, coupled, what = HERE / "larynx.toml", folder / "larynx", "larynx"
    short = ("--set", "time.end=3e-4", "--set", "output.fields_interval=0")
    if not start(program, 2, what, "run", case, "--out", coupled, *RECORD, *FIVE_POINT, *short):
        return
    for ranks, tolerance in ((2, SAME), (1, OTHER_RANKS)):
        again, words = folder / f"larynx_replay{ranks}", f"{what}, replay on {ranks} ranks"
        if start(program, ranks, words, "replay", coupled, "--out", again):
            compare(program, coupled, again, tolerance, words)
    other, again, what = folder / "lighthill", folder / "lighthill_replay", "larynx, another analogy"
    swap = ("--set", "acoustic.1.analogy=lighthill")
    if start(program, 2, what, "run", case, "--out", other, *FIVE_POINT, *short, *swap):
        start(program, 2, what, "replay", coupled, "--out", again, *swap)
        compare(program, other, again, SAME, what)


def of_others(program, folder):
    """A formula, and the same flow in a file that another program wrote: vertices in another order, no cells, a time of its
    own. Records that are no such thing are refused."""
    case, formula, what = HERE / "formula.toml", folder / "formula", "a record of others"
    if not start(program, 1, what, "run", case, "--out", formula):
        return
    start(program, 1, "a formula, stopped", "run", case, "--out", folder / "formula_stopped", "--steps", 23)
    start(program, 1, "a formula, stopped", "resume", folder / "formula_stopped")
    compare(program, formula, folder / "formula_stopped", 0, "a formula, stopped")
    same_record(program, formula, folder / "formula_stopped", "a formula, stopped")
    text = case.read_text(encoding="utf-8")
    begin, end = text.index("[flow]"), text.index("[time]")
    other = folder / "other.toml"
    other.write_text(text[:begin] + '[flow]\nrecord = "other.h5"\n\n' + text[end:], encoding="utf-8")
    shutil.copy(HERE / "channel.geo", folder)
    with h5py.File(formula / "flow_record.h5") as record:
        points, times, pressures, velocities = (record[name][()] for name in
                                                ("mesh/coordinates", "time", "pressure", "velocity"))
    order = numpy.random.default_rng(1).permutation(len(points))
    write_record(folder / "other.h5", points[order], times + 1, pressures[:, order], velocities[:, order])
    for command in ("check", "run"):
        start(program, 2, what, command, other, "--out", folder / "other")
    compare(program, formula, folder / "other", 1e-9, what)  # times lose four digits behind the 1 s
    for name, bad, words in (("points", (points + 1e-5, times, pressures, velocities), "must be of the flow's mesh"),
                             ("times", (points, times[::-1], pressures, velocities), "must rise"),
                             ("shape", (points, times, pressures.T, velocities), "must have a row a step"),
                             ("rows", (points, times, pressures[:-1], velocities), "must be whole"),
                             ("number", (points, times, pressures * numpy.nan, velocities), "must be finite")):
        write_record(folder / "other.h5", *bad)
        code, said = program.start(1, "run", other, "--out", folder / "bad")
        program.expect(code == 2 and words in said, f"a record with wrong {name}: code {code}\n{said}")


def test(program, folder):
    contact_and_ranks(program, folder)
    of_others(program, folder)
    voices_and_analogies(program, folder)


if __name__ == "__main__":
    sys.exit(main(test))
