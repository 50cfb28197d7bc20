"""Small made-up run folders for the tests of the report: a plane half model with a voice, and a tract in space."""

import json
import math
import struct
import wave

import h5py
import numpy

RESOLVED = """
[case]
name = "synthetic voice"
description = "a made-up run: only the report's layout is real"
[[region]]
name = "flow"
kind = "fluid"
[[region]]
name = "fold"
kind = "solid"
[[region]]
name = "room"
kind = "air"
[flow]
density = 1.14
[[flow.boundary]]
group = "midline"
kind = "symmetry"
"""

GLOTTIS = """
[[monitor]]
name = "folds"
kind = "glottis"
[[monitor]]
name = "flow"
kind = "flux"
"""


def plane_mesh():
    """A duct 0 < x < 60 mm, y < 10 mm with a block in it (region 1), then a room 60 < x < 90 mm, y < 30 mm."""
    x, y = numpy.meshgrid(numpy.linspace(0, 0.09, 91), numpy.linspace(0, 0.03, 31), indexing="ij")
    points = numpy.column_stack((x.ravel(), y.ravel(), numpy.zeros(x.size)))
    corner = (numpy.arange(90)[:, None] * 31 + numpy.arange(30)[None, :]).ravel()
    cells = numpy.concatenate((numpy.column_stack((corner, corner + 31, corner + 32)),
                               numpy.column_stack((corner, corner + 32, corner + 1))))
    middle = points[cells].mean(axis=1)
    kept = (middle[:, 0] > 0.06) | (middle[:, 1] < 0.01)
    cells, middle = cells[kept], middle[kept]
    region = numpy.where(middle[:, 0] > 0.06, 2, 0)
    region[(middle[:, 0] > 0.02) & (middle[:, 0] < 0.028) & (middle[:, 1] > 0.002) & (middle[:, 1] < 0.01)] = 1
    used, cells = numpy.unique(cells, return_inverse=True)
    return points[used], cells.reshape(-1, 3), region


def space_mesh(n=6):
    """A box of n^3 cubes, each cut into six tetrahedra."""
    axis = numpy.arange(n + 1)
    x, y, z = (part.ravel() for part in numpy.meshgrid(axis, axis, axis, indexing="ij"))
    points = numpy.column_stack((0.1 * x / n, 0.04 * y / n - 0.02, 0.04 * z / n - 0.02))
    cube = numpy.arange(n)
    i, j, k = (part.ravel() for part in numpy.meshgrid(cube, cube, cube, indexing="ij"))
    cells = []
    for order in ((0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)):
        at = [i.copy(), j.copy(), k.copy()]
        corners = [(at[0] * (n + 1) + at[1]) * (n + 1) + at[2]]
        for direction in order:
            at[direction] = at[direction] + 1
            corners.append((at[0] * (n + 1) + at[1]) * (n + 1) + at[2])
        cells.append(numpy.column_stack(corners))
    cells = numpy.concatenate(cells)
    return points, cells, (points[cells].mean(axis=1)[:, 0] > 0.06).astype(int)


def write_fields(path, points, cells, region, names, steps):
    """steps: list of (time, {dataset: values})."""
    with h5py.File(path, "w") as file:
        file["mesh/cells"] = cells.astype(numpy.int64)
        file["mesh/coordinates"] = points
        file["mesh/region"] = region.astype(numpy.int32)
        file["mesh/region"].attrs["region_names"] = ",".join(names)
        for number, (time, datasets) in enumerate(steps):
            group = file.create_group(f"step_{100 * number:08d}")
            group.attrs["time"] = time
            for name, values in datasets.items():
                group[name] = values


def voice_steps(points, cells, region, count=9):
    """Fields over one period of 10 ms: the block moves, a jet, a pressure drop, a wave; NaN where undefined."""
    flow, air = numpy.unique(cells[region == 0]), numpy.unique(cells[region != 1])
    still = numpy.setdiff1d(numpy.arange(len(points)), numpy.unique(cells[region != 2]))
    steps = []
    for n in range(count):
        time = 0.01 * n / (count - 1)
        swing = math.sin(2 * math.pi * time / 0.01)
        displacement = numpy.zeros((len(points), 3))
        displacement[:, 1] = 5e-4 * swing * numpy.exp(-((points[:, 0] - 0.024) / 0.005) ** 2) * (points[:, 1] > 0)
        displacement[:, 1] *= numpy.clip((0.01 - points[:, 1]) / 0.008, 0, 1)
        velocity = numpy.full((len(points), 3), numpy.nan)
        velocity[flow] = 0
        velocity[flow, 0] = (20 + 10 * swing) * numpy.exp(-(points[flow, 1] / 0.002) ** 2)
        velocity[still] = numpy.nan
        pressure = numpy.full(len(points), numpy.nan)
        pressure[flow] = numpy.where(points[flow, 0] < 0.024, 800.0, -30.0 * swing)
        acoustic = numpy.full(len(points), numpy.nan)
        acoustic[air] = 5 * numpy.cos(60 * points[air, 0] - 2 * math.pi * n / 8) / (1 + (points[air, 0] / 0.05) ** 4)
        steps.append((time, {"displacement": displacement, "velocity": velocity, "pressure": pressure,
                             "acoustic_pressure": acoustic}))
    return steps


def write_columns(path, notes, columns):
    with open(path, "w", encoding="utf-8") as file:
        file.writelines(f"# {key}: {value}\n" for key, value in notes.items())
        file.write(",".join(columns) + "\n")
        file.writelines(",".join(f"{value:.9g}" for value in row) + "\n" for row in zip(*columns.values()))


def voice(folder):
    """A complete run folder of a plane half model."""
    (folder / "resolved.toml").write_text(RESOLVED, encoding="utf-8")
    points, cells, region = plane_mesh()
    write_fields(folder / "fields.h5", points, cells, region, ["flow", "fold", "room"],
                 voice_steps(points, cells, region))
    time = numpy.arange(0, 0.08, 5e-5)
    gap = 2.5e-4 * (1 + 0.8 * numpy.sin(2 * math.pi * 110 * time))
    write_columns(folder / "history.csv", {"half_model": "yes"}, {
        "step": numpy.arange(time.size), "time_s": time, "dt_s": numpy.full(time.size, 5e-5),
        "newton_iterations": numpy.full(time.size, 3), "flow_m2_s": 20 * gap, "gap_m": gap,
        "min_cell_quality": 0.4 + 300 * gap})
    sound = numpy.sin(2 * math.pi * 220 * time) + 0.3 * numpy.sin(2 * math.pi * 2500 * time)
    write_columns(folder / "microphones.csv", {"sound": "pressure_rate"}, {
        "time_s": time, "pressure_Pa.mouth": 2 * sound, "pressure_Pa.far": 0.05 * sound})
    frequency = numpy.arange(0, 10000, 10.0)
    level = sum(70 - 20 * numpy.log10(1 + ((frequency - peak) / 40) ** 2) / (1 + i)
                for i, peak in enumerate((220, 2500, 3200))) / 3
    write_columns(folder / "spectra.csv", {}, {
        "frequency_Hz": frequency, "psd_dB.mouth": level, "psd_dB.far": level - 25, "transfer_dB.mouth": level - 60})
    with wave.open(str(folder / "microphone_mouth.wav"), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(20000)
        file.writeframes(b"".join(struct.pack("<h", int(20000 * value / 1.4)) for value in sound))
    summary = {
        "case": "synthetic", "version": "0.1.0", "status": "finished", "reason": "", "ranks": 2, "dimension": 2,
        "steps": 1600, "simulated_seconds": 0.08, "wall_seconds": 91.5, "unknowns": {"flow": 6400, "acoustic": 2800},
        "cells": {"flow": 1200, "acoustic": 2984}, "peak_memory_bytes": 312 * 2**20,
        "phases": {"flow.assemble": 30.1, "flow.solve": 41.2, "mesh_motion": 5.5, "contact": 0.4, "acoustic": 6.2},
        "results": {"f0_Hz.mouth": 110.2, "F1_Hz.mouth": 221.4, "F2_Hz.mouth": 2483.0, "F3_Hz.mouth": 3170.0,
                    "B1_Hz.mouth": 61.0, "SPL_dB.mouth": 84.2, "gap_peak_m": 4.5e-4, "flow_mean_m2_s": 5.1e-3},
        "expected": {"F1_Hz.mouth": {"value": 226, "tolerance": 7, "source": "one-dimensional tract", "error": -4.6},
                     "F2_Hz.mouth": {"value": 2200, "tolerance": 50, "source": "made up", "error": 283}}}
    (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")


def voices(folder):
    """What a run writes more than `voice` where three solvers listen to one flow: the second is 3 dB louder, the third
    silent."""
    voice(folder)
    solvers = {"rate": 0.0, "pcwe": 3.0, "none": -400.0}
    frequency = numpy.arange(0, 10000, 10.0)
    level = 60 - 20 * numpy.log10(1 + ((frequency - 500) / 100) ** 2)
    write_columns(folder / "spectra.csv", {}, {
        "frequency_Hz": frequency,
        **{f"psd_dB.{name}.mouth": numpy.maximum(level + more, -300) for name, more in solvers.items()}})
    bands = numpy.array([250.0, 500, 1000])
    write_columns(folder / "third_octaves.csv", {"solvers": ", ".join(solvers)}, {
        "band_Hz": bands, **{f"level_dB.{name}.mouth": numpy.maximum(70 - bands / 100 + more, -300)
                             for name, more in solvers.items()}})
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    summary["results"] = {"SPL_dB.rate.mouth": 80.0, "SPL_dB.pcwe.mouth": 83.0, "SPL_dB.none.mouth": -300.0}
    (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")


def phonation(folder):
    """What a run adds to `voice` when a glottis is watched: folds that close for a part of each cycle."""
    voice(folder)
    (folder / "resolved.toml").write_text(RESOLVED + GLOTTIS, encoding="utf-8")
    time = numpy.arange(0, 0.08, 5e-5)
    gap = numpy.maximum(0, 5e-4 * numpy.sin(2 * math.pi * 110 * time))
    write_columns(folder / "history.csv", {}, {"step": numpy.arange(time.size), "time_s": time, "flow_m2_s": 20 * gap,
                                               "folds_gap_m": gap, "folds_area_m2": 0.015 * gap})
    places = numpy.linspace(0, 0.008, 40)
    bowl = 1e-3 * ((places - 0.006) / 0.002) ** 2
    opening = {f"opening_m.{place:.9g}": numpy.where(gap > 0, gap + more, 0) if more < 1e-4 else gap + more
               for place, more in zip(places, bowl)}
    opening[f"opening_m.{places[0]:.9g}"][:] = numpy.nan
    write_columns(folder / "kymogram_folds.csv", {}, {"step": numpy.arange(time.size), "time_s": time, **opening})


def tract(folder):
    """Acoustics alone in space: no flow, no history, no wav, no spectra."""
    points, cells, region = space_mesh()
    steps = [(1e-4 * n, {"acoustic_pressure": numpy.cos(80 * points[:, 0] - n)}) for n in range(1, 4)]
    write_fields(folder / "fields.h5", points, cells, region, ["tract", "room"], steps)
    (folder / "resolved.toml").write_text(
        '[case]\nname = "tract"\n[[region]]\nname = "tract"\nkind = "air"\n[[region]]\nname = "room"\nkind = "air"\n',
        encoding="utf-8")
    summary = {"case": "tract", "status": "failed", "reason": "<no reason> & more", "results": {"F1_Hz.front": 224.0}}
    (folder / "summary.json").write_text(json.dumps(summary), encoding="utf-8")
