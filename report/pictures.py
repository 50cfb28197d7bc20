"""Pictures of the mesh and of the fields on it."""

import matplotlib
import numpy
from matplotlib.patches import Patch
from matplotlib.tri import Triangulation

import style
import views
from fields import Plane

MILLIMETRE = 1e3


def mesh(run, folder):
    """The regions in colour, whole, then the gap between the solids if there is one."""
    fields = run.fields
    plane = Plane(fields)
    mirrored = run.is_half_model(fields.coordinates)
    windows = [("whole", views.extent(plane.points, mirrored and fields.dimension == 3))]
    if fields.dimension == 2:
        near = views.around_solids(run, plane, False)
        if views.solid_regions(run):
            windows.append(("around the solids", (*near[:2], max(near[2], 0) if mirrored else near[2], near[3])))
        gap = views.around_gap(run, plane, mirrored)
        if gap:
            windows.append(("narrowest place", (gap[0], gap[1], 0, 2 * gap[3])))
    kinds = run.kinds()
    colours = []
    for name in fields.region_names:
        same = [other for other in fields.region_names if kinds.get(other) == kinds.get(name)]
        base = matplotlib.colors.to_rgb(style.KIND_COLOURS.get(kinds.get(name), "#cccccc"))
        shade = 1 - 0.22 * same.index(name) / max(1, len(same) - 1)
        colours.append(tuple(shade * part for part in base))
    picture, axes = _panels([window for _, window in windows])
    shown = matplotlib.colors.ListedColormap(colours)
    region = fields.region[plane.cell_of_triangle]
    triangulation = _triangulation(plane)
    for row, (axis, (title, window)) in enumerate(zip(axes, windows)):
        fine = 0.08 if row == 0 else 0.25
        axis.tripcolor(triangulation, facecolors=region.astype(float), cmap=shown, vmin=-0.5, vmax=len(colours) - 0.5,
                       edgecolors="none", rasterized=True)
        axis.triplot(triangulation, color="#404040", linewidth=fine)
        cut = " (cut through the axis)" if fields.dimension == 3 else ""
        _window(axis, window, title + cut)
    patches = [Patch(facecolor=colour, edgecolor="#808080", linewidth=0.5, label=name)
               for colour, name in zip(colours, fields.region_names)]
    axes[0].legend(handles=patches, loc="lower right", bbox_to_anchor=(1, 1), ncol=min(6, len(patches)), frameon=False,
                   borderaxespad=0.1, handlelength=1.2)
    return style.save(picture, folder, "mesh")


def speed(run, folder):
    return _flow(run, folder, "velocity", "speed", "speed [m/s]")


def pressure(run, folder):
    return _flow(run, folder, "pressure", "pressure", "pressure [Pa]")


def _flow(run, folder, dataset, name, label):
    """A flow field around the solids at up to six instants, one colour scale."""
    fields = run.fields
    steps = fields.steps_with(dataset)
    if not steps:
        return None
    mirrored = run.is_half_model(fields.coordinates)
    flow_cells = fields.in_regions(views.flow_regions(run))
    frames, largest, smallest = [], 0.0, 0.0
    for step in views.instants(run, steps):
        plane = Plane(fields, fields.read(step, "displacement"))
        values = fields.read(step, dataset)
        values = plane.on_points(numpy.linalg.norm(values, axis=1) if values.ndim == 2 else values)
        drawn = flow_cells[plane.cell_of_triangle] & numpy.isfinite(values[plane.triangles]).all(axis=1)
        if not drawn.any():
            continue
        used = values[numpy.unique(plane.triangles[drawn])]
        largest, smallest = max(largest, numpy.percentile(used, 99.8)), min(smallest, numpy.percentile(used, 0.2))
        frames.append((fields.times[step], plane, values, drawn))
    if not frames:
        return None
    window = views.around_solids(run, frames[0][1], mirrored)
    picture, axes = _panels([window] * len(frames), columns=2 if len(frames) > 1 else 1)
    options = {"vmin": 0, "vmax": largest or 1, "cmap": "viridis"}
    if name == "pressure":
        options = {"vmin": smallest, "vmax": largest if largest > smallest else smallest + 1, "cmap": "RdYlBu_r"}
    for axis, (time, plane, values, drawn) in zip(axes, frames):
        solid = fields.in_regions(views.solid_regions(run))[plane.cell_of_triangle]
        for sign in (1, -1) if mirrored else (1,):
            if solid.any():
                axis.tripcolor(_triangulation(plane, solid, sign), facecolors=numpy.zeros(solid.sum()),
                               cmap=matplotlib.colors.ListedColormap([style.SOLID]), edgecolors="none")
            shades = _draw(axis, plane, values, drawn, sign, options)
        _window(axis, window, f"t = {time * 1e3:.3f} ms")
    picture.colorbar(shades, ax=axes, label=label, shrink=0.8, pad=0.01, aspect=40)
    return style.save(picture, folder, name)


def sound(run, folder):
    """Acoustic pressure at the last instant that has it: everywhere, and in the air alone on its own scale."""
    fields = run.fields
    steps = fields.steps_with("acoustic_pressure")
    for step in reversed(steps):
        plane = Plane(fields, fields.read(step, "displacement"))
        values = plane.on_points(fields.read(step, "acoustic_pressure"))
        drawn = numpy.isfinite(values[plane.triangles]).all(axis=1)
        if drawn.any() and numpy.abs(values[plane.triangles[drawn]]).max() > 0:
            break
    else:
        return None
    mirrored = run.is_half_model(fields.coordinates)
    panels = [(f"everywhere, t = {fields.times[step] * 1e3:.3f} ms", drawn)]
    rooms = [name for name in views.air_regions(run) if len(views.air_regions(run)) < len(fields.region_names)]
    if len(views.air_regions(run)) == len(fields.region_names) and len(fields.region_names) > 1:
        rooms = [fields.region_names[fields.region[fields.coordinates[fields.cells].mean(axis=1)[:, 0].argmax()]]]
    room = drawn & fields.in_regions(rooms)[plane.cell_of_triangle]
    if room.any() and not room.all():
        panels.append((f"{', '.join(rooms)}, own scale", room))
    windows = [views.extent(plane.points[numpy.unique(plane.triangles[cells])], mirrored) for _, cells in panels]
    picture, axes = _side_by_side(windows)
    for axis, window, (title, cells) in zip(axes, windows, panels):
        scale = numpy.percentile(numpy.abs(values[numpy.unique(plane.triangles[cells])]), 99.5) or 1.0
        for sign in (1, -1) if mirrored else (1,):
            shades = _draw(axis, plane, values, cells, sign, {"vmin": -scale, "vmax": scale, "cmap": "RdBu_r"})
        _window(axis, window, title)
        picture.colorbar(shades, ax=axis, label="pressure [Pa]", pad=0.02, aspect=25, location="bottom")
    return style.save(picture, folder, "sound")


def _triangulation(plane, chosen=None, sign=1):
    triangles = plane.triangles if chosen is None else plane.triangles[chosen]
    return Triangulation(MILLIMETRE * plane.points[:, 0], sign * MILLIMETRE * plane.points[:, 1], triangles)


def _draw(axis, plane, values, chosen, sign, options):
    return axis.tripcolor(_triangulation(plane, chosen, sign), numpy.nan_to_num(values), shading="gouraud",
                          rasterized=True, **options)


def _panels(windows, columns=1):
    """Axes stacked so that each window fills its width at equal scales, none higher than half a page."""
    width = style.WIDTH / columns - 0.9
    rows = [windows[i:i + columns] for i in range(0, len(windows), columns)]
    heights = [min(4.5, max(0.7, width * max((w[3] - w[2]) / (w[1] - w[0]) for w in row))) + 0.75 for row in rows]
    picture = style.pyplot.figure(figsize=(style.WIDTH, sum(heights) + 0.3), constrained_layout=True)
    grid = picture.add_gridspec(len(rows), columns, height_ratios=heights)
    return picture, [picture.add_subplot(grid[i // columns, i % columns]) for i in range(len(windows))]


def _side_by_side(windows):
    """Axes of equal height beside each other, each as wide as its window is at that height."""
    widths = [max(0.25, (w[1] - w[0]) / (w[3] - w[2])) for w in windows]
    height = min(4.5, (style.WIDTH - 0.9 * len(windows)) / sum(widths))
    picture = style.pyplot.figure(figsize=(style.WIDTH, height + 1.4), constrained_layout=True)
    grid = picture.add_gridspec(1, len(windows), width_ratios=[height * width + 0.7 for width in widths])
    return picture, [picture.add_subplot(grid[0, i]) for i in range(len(windows))]


def _window(axis, window, title):
    x0, x1, y0, y1 = (MILLIMETRE * side for side in window)
    axis.set_xlim(x0, x1)
    axis.set_ylim(y0, y1)
    axis.set_aspect("equal")
    axis.set_title(title, loc="left")
    place = axis.get_subplotspec()
    if place.is_last_row() or place.get_gridspec().ncols == 1:
        axis.set_xlabel("x [mm]")
    if place.is_first_col():
        axis.set_ylabel("y [mm]")
