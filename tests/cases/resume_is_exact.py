#!/usr/bin/python3
"""A run that was stopped or killed, and resumed, leaves the same bytes as one that was not: series and fields, and the same
numbers in the record of its flow. Files with wall times in them (summary.json, log.txt, checkpoint.h5) are not compared."""

import sys
import time

import h5py
import numpy

from program import HERE, main, read_series, read_summary

SERIES = ("history.csv", "microphones.csv", "microphones_damped.csv", "microphones_of_surfaces.csv",
          "microphones_near.csv", "kymogram_glottis.csv")
# Steps before each stop: after the first step, before, at and after a scheduled checkpoint (every 5 steps), and twice.
STOPS = {1: ((1,), (4,), (5,), (6,), (6, 6)), 2: ((1,), (6,))}
# So few iterations that steps are rejected, halved and grow again.
WITH_REJECTIONS = ("--set", "flow.newton_iterations=2", "--set", "time.end=1.5e-4")
# A mesh of its own, coarser, that moves with the folds.
FOLLOWING = ("--set", "acoustic.sound.mesh.geometry=../../cases/vowel_i/larynx.geo", "--set",
             "acoustic.sound.mesh.follows_flow=true", "--set", "acoustic.sound.mesh.parameters.size_factor=6", "--set",
             "acoustic.sound.mesh.parameters.room_radius=0.03")
# A step that adapts: it does not converge, is too coarse, waits, grows.
WITH_ADAPTATION = ("--set", "time.tolerance=1e-3", "--set", "time.smallest_dt=1e-7", "--set", "time.end=1e-4",
                   "--set", "flow.newton_iterations=2")
# Folds that fall upon their mirror images: the air is stripped anew while the sound goes on.
WITH_CONTACT = ("--set", "mesh.parameters.half_gap=6e-5", "--set", "contact.alpha=0.5", "--set", "flow.gravity=[0,-3000]",
                "--set", "acoustic.contact_cells=strip")


def compare_fields(program, one, other, what):
    with h5py.File(one / "fields.h5", "r") as a, h5py.File(other / "fields.h5", "r") as b:
        if not program.expect(sorted(a) == sorted(b), f"{what}: fields.h5 holds {sorted(b)}, not {sorted(a)}"):
            return
        for group in a:
            program.expect(dict(a[group].attrs) == dict(b[group].attrs), f"{what}: the attributes of {group}")
            for name in a[group]:
                same = numpy.array_equal(a[group][name][()], b[group][name][()], equal_nan=name not in ("cells", "region"))
                program.expect(same, f"{what}: {group}/{name} differs")


def compare_records(program, one, other, what):
    with h5py.File(one / "flow_record.h5", "r") as a, h5py.File(other / "flow_record.h5", "r") as b:
        program.expect(a.attrs["steps"] == b.attrs["steps"], f"{what}: {b.attrs['steps']} steps are recorded")
        for name in set(a) - {"mesh"}:
            same = name in b and numpy.array_equal(a[name][()], b[name][()])
            program.expect(same, f"{what}: {name} of flow_record.h5 differs")


def first_difference(one, other):
    (columns, a), (_, b) = read_series(one), read_series(other)
    for column, x, y in zip(columns, a, b):
        if len(x) != len(y):
            return f"{len(y)} rows, not {len(x)}"
        for row, (p, q) in enumerate(zip(x, y)):
            if p != q:
                return f"{column} in row {row} is {q!r}, not {p!r}"
    return "the numbers agree"


def compare(program, one, other, what):
    for name in SERIES:
        if not (one / name).exists() and not (other / name).exists():
            continue
        if (one / name).read_bytes() != (other / name).read_bytes():
            program.expect(False, f"{what}: {name} differs: {first_difference(one / name, other / name)}")
    if (one / "fields.h5").exists():
        compare_fields(program, one, other, what)
    if (one / "flow_record.h5").exists():
        compare_records(program, one, other, what)
    a, b = read_summary(one), read_summary(other)
    for key in ("status", "steps", "rejected_steps", "simulated_seconds", "results"):
        program.expect(a[key] == b[key], f"{what}: {key} is {b[key]}, not {a[key]}")


def stop_and_resume(program, ranks, whole, arguments, stops, folder, what):
    code = program.start(ranks, *arguments, "--out", folder, "--steps", stops[0])
    program.expect_code(0, code, what)
    summary = read_summary(folder)
    program.expect((summary["status"], summary["steps"]) == ("stopped", stops[0]), f"{what}: {summary}")
    for steps in stops[1:]:
        program.expect_code(0, program.start(ranks, "resume", folder, "--steps", steps), what)
    program.expect_code(0, program.start(ranks, "resume", folder), what)
    compare(program, whole, folder, what)


def kill_and_resume(program, ranks, whole, arguments, folder, what):
    """Kills the run once its checkpoint has been renewed, in the midst of a step."""
    process = program.start_in_background(ranks, *arguments, "--out", folder)
    checkpoint = folder / "checkpoint.h5"
    first = None
    while process.poll() is None:
        time.sleep(0.002)
        if not checkpoint.exists():
            continue
        now = checkpoint.stat().st_mtime_ns
        first = first or now
        if now != first:
            break
    program.kill(process)
    program.expect(not (folder / "summary.json").exists(), f"{what}: it was finished before it was killed")
    program.expect_code(0, program.start(ranks, "resume", folder), what)
    compare(program, whole, folder, what)


def test(program, folder):
    run = ("run", HERE / "larynx.toml", "--set", "record.precision=double")
    for ranks, all_stops in STOPS.items():
        whole = folder / f"whole{ranks}"
        if not program.expect_code(0, program.start(ranks, *run, "--out", whole), f"{ranks} ranks"):
            continue
        for stops in all_stops:
            words = " and ".join(map(str, stops))
            stop_and_resume(program, ranks, whole, run, stops, folder / f"stop{ranks}_{words}",
                            f"stopped after {words} steps on {ranks} ranks")
        kill_and_resume(program, ranks, whole, run, folder / f"kill{ranks}", f"killed on {ranks} ranks")

    run = run[:2]
    whole, run, what = folder / "rejecting", (*run, *WITH_REJECTIONS), "stopped between rejections"
    program.expect_code(0, program.start(1, *run, "--out", whole), what)
    program.expect(read_summary(whole)["rejected_steps"] > 1, f"{what}: {read_summary(whole)}")
    stop_and_resume(program, 1, whole, run, (11,), folder / "rejecting_stopped", what)

    whole, run, what = folder / "adapting", ("run", HERE / "larynx.toml", *WITH_ADAPTATION), "stopped while dt adapts"
    program.expect_code(0, program.start(1, *run, "--out", whole), what)
    columns, values = read_series(whole / "history.csv")
    program.expect(len(set(values[columns.index("dt_s")])) > 4, f"{what}: dt {values[columns.index('dt_s')]}")
    stop_and_resume(program, 1, whole, run, (7, 10), folder / "adapting_stopped", what)

    for ranks, stops in ((1, (9, 5)), (1, (15,)), (2, (12,))):
        whole, run, what = folder / f"closing{ranks}", ("run", HERE / "larynx.toml", *WITH_CONTACT), f"closed on {ranks} ranks"
        if not whole.exists():
            program.expect_code(0, program.start(ranks, *run, "--out", whole), what)
        summary = read_summary(whole)
        program.expect(summary["results"]["acoustic_rebuilds.sound"] > 2, f"{what}: {summary}")
        stop_and_resume(program, ranks, whole, run, stops, folder / f"closing{ranks}_{stops[0]}", what)

    # In the midst of a closure: cells have just closed, are closed, have just opened.
    for ranks in (1, 2):
        whole, run, what = folder / f"touching{ranks}", ("run", HERE / "touching.toml"), f"touching on {ranks} ranks"
        program.expect_code(0, program.start(ranks, *run, "--out", whole), what)
        contact = read_summary(whole)["contact"]
        program.expect(contact["closings"] > 0 and contact["closed_steps"] > 10, f"{what}: {contact}")
        stop_and_resume(program, ranks, whole, run, (16, 3, 11), folder / f"touching_stopped{ranks}", what)

    # Sound on a mesh of its own beside sound on the flow's.
    for ranks in (1, 3):
        whole, run, what = folder / f"coarse{ranks}", ("run", HERE / "coarse.toml"), f"two meshes on {ranks} ranks"
        program.expect_code(0, program.start(ranks, *run, "--out", whole), what)
        stop_and_resume(program, ranks, whole, run, (4, 2), folder / f"coarse_stopped{ranks}", what)

    # And where that mesh follows the folds.
    for ranks in (1, 2):
        whole, run, what = folder / f"following{ranks}", ("run", HERE / "larynx.toml", *FOLLOWING), f"a mesh follows, {ranks} ranks"
        program.expect_code(0, program.start(ranks, *run, "--out", whole), what)
        stop_and_resume(program, ranks, whole, run, (7, 5), folder / f"following_stopped{ranks}", what)

    # Sound alone, with a microphone outside of the mesh that the surface's past is still under way to.
    for ranks in (1, 3):
        whole, run, what = folder / f"tube{ranks}", ("run", HERE / "tube.toml"), f"sound alone on {ranks} ranks"
        program.expect_code(0, program.start(ranks, *run, "--out", whole), what)
        columns, values = read_series(whole / "microphones.csv")
        heard = values[columns.index("pressure_Pa.beyond")]
        program.expect(max(map(abs, heard)) > 0, f"{what}: nothing is heard beyond")
        stop_and_resume(program, ranks, whole, run, (33,), folder / f"tube_stopped{ranks}", what)


if __name__ == "__main__":
    sys.exit(main(test))
