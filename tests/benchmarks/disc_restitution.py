"""Restitution of an elastic disc that bounces off a rigid wall in a vacuum, alone and beside runs of the ball.

    /usr/bin/python3 tests/benchmarks/disc_restitution.py
    ./vocalis study cases/contact/ball_speed_study.toml
    /usr/bin/python3 tests/benchmarks/disc_restitution.py runs/studies/ball_speed/points/*
    /usr/bin/python3 tests/benchmarks/disc_restitution.py --core 0.7 100 4     the disc of ball_core.toml

The reference: plane strain, neo-Hookean as in docs/theory.md or linear, half of the disc. P1 on triangles, mass lumped,
central differences: nothing is dissipated, and what the rebound lacks is vibration. The wall is springs under the
vertices, whose stiffness goes with the cells'; with friction they also hold a vertex where it touched first. It shares
no code with Vocalis. Lengths are in radii R, speeds in c = sqrt(E / rho) (of the rim, if there is a core), times in
R / c. Needs python3-scipy.
"""

import argparse
import dataclasses
import pathlib
import tomllib

import numpy as np
import scipy.sparse as sparse
import scipy.spatial

PART_OF_STABLE_STEP = 0.5
END = 14.0  # after a contact of 5 to 8
RADIUS = 0.01  # [m] of ball.geo


@dataclasses.dataclass
class Core:
    """Of a disc with two materials: radius over that of the disc, E and density over those of the rim."""

    radius: float = 0.0
    modulus: float = 1.0
    density: float = 1.0


@dataclasses.dataclass
class Disc:
    points: np.ndarray  # (vertices, 2), the lowest at the origin
    slopes: list  # two sparse matrices (cells, vertices): d/dx and d/dy
    area: np.ndarray  # (cells)
    mass: np.ndarray  # (vertices), lumped
    share: np.ndarray  # (vertices), of the boundary's length
    modulus: np.ndarray  # (cells)
    step: float  # a stable one


def half_disc(rings, grading, core):
    """Rings of triangles of one size, drawn together at the lowest point by a conformal map of the disc to itself.

    Cells at the contact are (1 - grading) / (1 + grading) times as long as those in the middle.
    """
    z = [0j] + [i / rings * np.exp(1j * np.pi * k / (3 * i)) for i in range(1, rings + 1) for k in range(3 * i + 1)]
    z = np.array(z)
    z.imag[np.abs(z.imag) < 1e-12] = 0
    cells = scipy.spatial.Delaunay(np.c_[z.real, z.imag]).simplices
    rim = np.arange(len(z) - 3 * rings - 1, len(z))
    z = (z - grading) / (1 - grading * z)
    points = np.c_[z.imag, z.real + 1]
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    cells = cells[np.abs(np.linalg.det(edges)) > 1e-12]
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    area = np.abs(np.linalg.det(edges)) / 2
    gradient = np.linalg.inv(edges).transpose(0, 2, 1)
    gradient = np.concatenate([-gradient.sum(1, keepdims=True), gradient], 1)
    rows = np.repeat(np.arange(len(cells)), 3)
    shape = len(cells), len(points)
    slopes = [sparse.csr_matrix((gradient[:, :, k].ravel(), (rows, cells.ravel())), shape) for k in range(2)]
    share = np.zeros(len(points))
    lengths = np.linalg.norm(np.diff(points[rim], axis=0), axis=1)
    np.add.at(share, rim[:-1], lengths / 2)
    np.add.at(share, rim[1:], lengths / 2)
    inside = np.linalg.norm(points[cells].mean(1) - (0, 1), axis=1) < core.radius
    modulus, density = np.where(inside, core.modulus, 1.0), np.where(inside, core.density, 1.0)
    mass = np.bincount(cells.ravel(), np.repeat(density * area / 3, 3), len(points))
    rate = np.sqrt(modulus / density) * np.linalg.norm(gradient, axis=2).max(1)
    return Disc(points, slopes, area, mass, share, modulus, 1 / rate.max())


def stress(f, poisson_ratio, linear):
    """First Piola-Kirchhoff stress and stored energy, E = 1; f: (2, 2, cells)."""
    shear, lame = 0.5 / (1 + poisson_ratio), poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))
    one = np.eye(2)[:, :, None]
    if linear:
        strain = 0.5 * (f + f.transpose(1, 0, 2)) - one
        trace = strain[0, 0] + strain[1, 1]
        return 2 * shear * strain + lame * trace * one, shear * (strain**2).sum((0, 1)) + 0.5 * lame * trace**2
    j = f[0, 0] * f[1, 1] - f[0, 1] * f[1, 0]
    log = np.log(j)
    inverse = np.array([[f[1, 1], -f[1, 0]], [-f[0, 1], f[0, 0]]]) / j
    energy = 0.5 * shear * ((f**2).sum((0, 1)) - 2 - 2 * log) + 0.5 * lame * log**2
    return shear * f + (lame * log - shear) * inverse, energy


def bounce(speed, poisson_ratio=0.4, rings=32, gravity=0.0, sticks=False, linear=False, stiffness=4.0, grading=0.6,
           core=Core()):
    """The disc touches at time 0 with this speed. gravity [c^2 / R]; stiffness: of the wall, in that of a cell there.

    Restitution of the centre of mass, from the height that it is to reach with gravity; the vibration's part of the
    energy at the start; the error of the balance; the time of contact; the largest half-width of it.
    """
    disc = half_disc(rings, grading, core)
    spring = stiffness * rings * (1 + grading) / (1 - grading) * disc.share
    dt = PART_OF_STABLE_STEP * disc.step / np.sqrt(max(1, stiffness / 2))
    x, v = disc.points.copy(), np.zeros_like(disc.points)
    v[:, 1] = -speed
    held = np.where(disc.points[:, 0] > 0, 1.0, 0.0)
    foot = np.full(len(x), np.nan)
    last_touch = width = 0.0
    total = disc.mass.sum()

    def forces(x):
        nonlocal width
        p, energy = stress(np.array([disc.slopes[k] @ x for k in range(2)]).transpose(2, 0, 1), poisson_ratio, linear)
        p *= disc.area * disc.modulus
        force = -np.stack([disc.slopes[0].T @ p[i, 0] + disc.slopes[1].T @ p[i, 1] for i in range(2)], 1)
        depth = np.maximum(-x[:, 1], 0) * (disc.share > 0)
        force[:, 1] += spring * depth - gravity * disc.mass
        stored = (disc.area * disc.modulus) @ energy + 0.5 * spring @ depth**2
        touches = depth > 0
        if sticks:
            foot[touches & np.isnan(foot)] = x[touches & np.isnan(foot), 0]
            foot[~touches] = np.nan
            slip = np.where(touches, x[:, 0] - foot, 0)
            force[:, 0] -= spring * slip
            stored += 0.5 * spring @ slip**2
        force[:, 0] *= held
        if touches.any():
            width = max(width, x[touches, 0].max())
        return force / disc.mass[:, None], stored, touches.any()

    acceleration, _, _ = forces(x)
    for step in range(int(END / dt)):
        v += 0.5 * dt * acceleration
        x += dt * v
        acceleration, stored, touches = forces(x)
        v += 0.5 * dt * acceleration
        if touches:
            last_touch = step * dt
    rise, mean = disc.mass @ (x[:, 1] - disc.points[:, 1]) / total, disc.mass @ v[:, 1] / total
    begin = 0.5 * total * speed**2
    kinetic = 0.5 * disc.mass @ (v**2).sum(1)
    bounced = 0.5 * total * mean**2 + total * gravity * rise
    vibration = kinetic - 0.5 * total * mean**2 + stored
    return {
        "restitution": np.sqrt(bounced / begin),
        "vibration": vibration / begin,
        "error": (bounced + vibration) / begin - 1,
        "contact": last_touch,
        "width": width,
    }


def read(run):
    """History and resolved case of a run folder."""
    lines = [line for line in (run / "history.csv").read_text().splitlines() if not line.startswith("#")]
    columns = np.array([line.split(",") for line in lines[1:]], dtype=float).T
    return dict(zip(lines[0].split(","), columns)), tomllib.loads((run / "resolved.toml").read_text())


def rebound(history):
    """Fall and rise of the centre of mass, from the work of gravity, and where the rest of the energy is.

    The fall's energy [J]; restitution; as parts of that energy what is dissipated until the top, what is lost otherwise
    until walls part (by steps and changes of contact), and vibration: that at the top, with what steps damp on the way.
    """
    work = np.cumsum(history["power_supplied_W"] * history["dt_s"])
    dissipated = np.cumsum(history["power_dissipated_W"] * history["dt_s"])
    impact = np.argmax(history["energy_elastic_J"] > 1e-3 * history["energy_elastic_J"].max()) - 1
    lowest = impact + np.argmax(np.diff(work[impact:]) < 0)
    top = lowest + np.argmax(np.diff(work[lowest:], append=np.inf) > 0)
    parting = np.nonzero(history["gap_m"][:top] < 1.25 * history["gap_m"][:top].min())[0][-1]
    fall, left = work[impact], work[top] - dissipated[top] + history["energy_residual_J"][parting]
    return fall, {
        "restitution": np.sqrt(1 - work[top] / fall),
        "vibration": left / fall,
        "dissipated": dissipated[top] / fall,
        "lost": -history["energy_residual_J"][parting] / fall,
    }


def core_of(case):
    """Material of the rim, or of the whole disc, and its core."""
    solids = {region["name"]: region for region in case["region"] if region["kind"] == "solid"}
    core, rim = solids.get("core"), solids["disc"]
    if core is None:
        return rim, Core()
    radius = case["mesh"]["parameters"]["core"]
    return rim, Core(radius, *(core[key] / rim[key] for key in ("young_modulus", "density")))


def beside_reference(run, rings):
    """Of a run of ball.toml or ball_core.toml: `rebound` with its speed [c] of the rim, and the reference's `bounce`."""
    history, case = read(run)
    rim, core = core_of(case)
    square = rim["young_modulus"] / rim["density"]
    mass = 0.5 * np.pi * RADIUS**2 * rim["density"] * (1 + (core.density - 1) * core.radius**2)
    fall, found = rebound(history)
    found["speed"] = np.sqrt(2 * fall / mass / square)
    gravity = -case["flow"]["gravity"][1] * RADIUS / square
    return found, bounce(found["speed"], rim["poisson_ratio"], rings, gravity, sticks=True, core=core)


def compare(runs, rings):
    print("| run | v / c | restitution | in a vacuum | vibration | in a vacuum | dissipated | lost |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for run in runs:
        found, exact = beside_reference(run, rings)
        print(f"| {run.name} | {found['speed']:.4f} | {found['restitution']:.3f} | {exact['restitution']:.3f} "
              f"| {found['vibration']:.3f} | {exact['vibration']:.3f} | {found['dissipated']:.3f} "
              f"| {found['lost']:.3f} |")


def table(rings, core):
    print("| v / c | neo-Hookean, slides | sticks | linear, slides | time of contact [R / c] | half-width [R] |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: |")
    for speed in (0.1, 0.05, 0.02, 0.01, 0.005, 0.0025):
        slides, sticks, linear = (bounce(speed, rings=rings, core=core, **kind)
                                  for kind in ({}, {"sticks": True}, {"linear": True}))
        print(f"| {speed} | {slides['restitution']:.4f} | {sticks['restitution']:.4f} | {linear['restitution']:.4f} "
              f"| {slides['contact']:.2f} | {slides['width']:.3f} |")


def draw(file, runs, rings):
    """Restitution against speed: the reference, falling by half of a radius, as a line, runs as points."""
    import matplotlib  # only here

    matplotlib.use("Agg")
    from matplotlib import pyplot

    speeds = np.geomspace(0.0025, 0.1, 12)
    falls = [bounce(speed, rings=rings, gravity=speed**2)["restitution"] for speed in speeds]
    figure, axes = pyplot.subplots(figsize=(6.4, 3.6), layout="constrained")
    axes.semilogx(speeds, falls, label="disc in a vacuum")
    found = [beside_reference(run, rings)[0] for run in runs]
    axes.plot([f["speed"] for f in found], [f["restitution"] for f in found], "o", label="cases/contact/ball.toml")
    unlost = [np.sqrt(f["restitution"] ** 2 + f["dissipated"] + f["lost"]) for f in found]
    label = "with what fluid, steps and changes of contact took"
    axes.plot([f["speed"] for f in found], unlost, "o", fillstyle="none", label=label)
    axes.set(xlabel="speed of impact / √(E/ρ)", ylabel="restitution")
    axes.grid(alpha=0.3)
    axes.legend()
    figure.savefig(file, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="*", type=pathlib.Path, help="folders of runs of ball.toml, ball_core.toml")
    parser.add_argument("--rings", type=int, default=32, help="of cells in the disc of the reference")
    parser.add_argument("--core", nargs=3, type=float, default=(0, 1, 1), metavar=("R", "E", "DENSITY"),
                        help="of the reference alone: radius, E and density over those of the disc")
    parser.add_argument("--chart", type=pathlib.Path, help="a picture instead of a table")
    words = parser.parse_args()
    if words.chart:
        draw(words.chart, words.runs, words.rings)
    elif words.runs:
        compare(words.runs, words.rings)
    else:
        table(words.rings, Core(*words.core))


if __name__ == "__main__":
    main()
