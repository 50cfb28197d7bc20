"""Where to look: windows on the mesh, and instants in the run."""

import numpy


def extent(points, mirrored):
    """Bounding box (x0, x1, y0, y1) of points, with their mirror images if asked."""
    x0, y0 = points.min(axis=0)
    x1, y1 = points.max(axis=0)
    return (x0, x1, -y1, y1) if mirrored else (x0, x1, y0, y1)


def solid_regions(run):
    kinds = run.kinds()
    return [name for name in run.fields.region_names if kinds.get(name) == "solid"]


def flow_regions(run):
    """Regions with flow: those of kind fluid, or all that are neither solid nor air if the kinds are not known."""
    kinds = run.kinds()
    return [name for name in run.fields.region_names if kinds.get(name, "fluid") == "fluid"]


def air_regions(run):
    kinds = run.kinds()
    return [name for name in run.fields.region_names if kinds.get(name) == "air"]


def points_of(fields, plane, names):
    chosen = fields.in_regions(names)[plane.cell_of_triangle]
    return plane.points[numpy.unique(plane.triangles[chosen])]


def around_solids(run, plane, mirrored):
    """Window on the solids and what the flow does behind them, or the flow's extent if there are none."""
    fields = run.fields
    solids = points_of(fields, plane, solid_regions(run))
    flow = points_of(fields, plane, flow_regions(run))
    if not len(solids):
        return extent(flow if len(flow) else plane.points, mirrored)
    x0, x1, y0, y1 = extent(solids, mirrored)
    length, height = x1 - x0, y1 - y0
    every = flow if len(flow) else plane.points
    x0, x1 = x0 - 0.6 * length, x1 + max(2.5 * length, 1.5 * height)
    inside = every[(every[:, 0] >= x0) & (every[:, 0] <= x1)]
    fx0, fx1, fy0, fy1 = extent(inside if len(inside) else every, mirrored)
    margin = 0.04 * (fy1 - fy0)
    return max(fx0, x0), min(fx1, x1), max(fy0, y0 - 0.5 * height) - margin, min(fy1, y1 + 0.5 * height) + margin


def around_gap(run, plane, mirrored):
    """Window on the narrowest place between the solids and the symmetry line, or None."""
    solids = points_of(run.fields, plane, solid_regions(run))
    if not mirrored or not len(solids):
        return None
    middle = solids[solids[:, 1].argmin(), 0]
    half = max(0.3 * (solids[:, 0].max() - solids[:, 0].min()), 4 * solids[:, 1].min())
    return (middle - half, middle + half, -0.45 * half, 0.45 * half)


def instants(run, steps, count=6):
    """Steps to show: over the last period of the voice if it is resolved and known, else over the whole run."""
    times = run.fields.times[steps]
    results = run.results()
    f0 = next((value for name, value in results.items() if name.split(".")[0] == "f0_Hz"), None)
    if isinstance(f0, (int, float)) and f0 > 0:
        last = numpy.flatnonzero(times > times[-1] - 1 / f0 * (1 + 1e-6))
        if len(last) >= 4:
            steps = [steps[i] for i in last]
    steps = [step for step in steps if run.fields.times[step] > 0] or steps
    chosen = numpy.unique(numpy.linspace(0, len(steps) - 1, min(count, len(steps))).round().astype(int))
    return [steps[i] for i in chosen]
