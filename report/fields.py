"""The mesh and the fields of fields.h5, and their cut through a plane in three dimensions."""

import h5py
import numpy


class Fields:
    """Mesh once, one step at a time: a run can be larger than the memory.

    cells (n, d + 1), coordinates (nv, 3) [m], region (n), region_names; times [s], ascending.
    """

    def __init__(self, path):
        self.path = path
        with h5py.File(path, "r") as file:
            mesh = file["mesh"]
            self.cells = numpy.asarray(mesh["cells"], dtype=numpy.int64)
            self.coordinates = numpy.asarray(mesh["coordinates"], dtype=float)
            if self.coordinates.shape[1] == 2:
                self.coordinates = numpy.column_stack((self.coordinates, numpy.zeros(len(self.coordinates))))
            self.region = numpy.zeros(len(self.cells), dtype=int)
            names = ""
            if "region" in mesh:
                self.region = numpy.asarray(mesh["region"], dtype=int).ravel()
                names = mesh["region"].attrs.get("region_names", "")
            names = names.decode() if isinstance(names, bytes) else str(names)
            self.region_names = [name.strip() for name in names.split(",") if name.strip()]
            steps = [(float(group.attrs.get("time", 0)), name) for name, group in file.items()
                     if name.startswith("step_")]
        steps.sort()
        self.times = numpy.array([time for time, _ in steps])
        self._steps = [name for _, name in steps]
        self.dimension = self.cells.shape[1] - 1
        for index in range(self.region.max() + 1 - len(self.region_names) if len(self.region) else 0):
            self.region_names.append(f"region {index}")

    def read(self, step, name):
        """The named field at a step (index into times) on all vertices, or None."""
        with h5py.File(self.path, "r") as file:
            group = file[self._steps[step]]
            return numpy.asarray(group[name], dtype=float) if name in group else None

    def steps_with(self, name):
        """Steps at which the field is there."""
        with h5py.File(self.path, "r") as file:
            return [i for i, group in enumerate(self._steps) if name in file[group]]

    def in_regions(self, names):
        """Mask of the cells that lie in the named regions."""
        wanted = [i for i, name in enumerate(self.region_names) if name in names]
        return numpy.isin(self.region, wanted)


class Plane:
    """Triangles of the plane (x, y): the mesh itself in two dimensions, else its cut at constant z.

    points (np, 2) and each vertex field `f` on them: on_points(f); cell_of_triangle names the cut cell.
    """

    def __init__(self, fields, displacement=None):
        moved = fields.coordinates
        if displacement is not None:
            moved = moved + numpy.nan_to_num(_three(displacement))
        self._ends = None
        if fields.dimension == 2:
            self.points, self.triangles = moved[:, :2], fields.cells
            self.cell_of_triangle = numpy.arange(len(fields.cells))
            return
        low, high = moved[:, 2].min(), moved[:, 2].max()
        # A little off z = 0 (or the lowest plane): a cut through vertices, which meshes often have there, leaves slivers.
        height = (0.0 if low < -1e-6 * (high - low) else low) + 1e-3 * (high - low)
        ends, self.cell_of_triangle = cut(moved[:, 2] - height, fields.cells)
        edges, inverse = numpy.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
        distance = moved[:, 2] - height
        distance = numpy.where(distance == 0, 1e-300, distance)
        a, b = distance[edges[:, 0]], distance[edges[:, 1]]
        self._ends, self._fraction = edges, a / (a - b)
        self.triangles = inverse.reshape(-1, 3)
        self.points = self.on_points(moved)[:, :2]

    def on_points(self, values):
        if self._ends is None:
            return values
        first, second = values[self._ends[:, 0]], values[self._ends[:, 1]]
        fraction = self._fraction.reshape((-1,) + (1,) * (values.ndim - 1))
        return first + fraction * (second - first)


def cut(distance, cells):
    """Triangles in which the zero of a vertex function cuts tetrahedra: (n, 3, 2) edges by vertices, and cells."""
    above = numpy.where(distance == 0, 1e-300, distance)[cells] > 0
    count = above.sum(axis=1)
    order = numpy.argsort(~above, axis=1, kind="stable")  # vertices above first
    sorted_cells = numpy.take_along_axis(cells, order, axis=1)
    triangles, owners = [], []
    for number_above, corners in ((1, [((0, 1), (0, 2), (0, 3))]),
                                  (3, [((0, 3), (1, 3), (2, 3))]),
                                  (2, [((0, 2), (0, 3), (1, 3)), ((0, 2), (1, 3), (1, 2))])):
        chosen = numpy.flatnonzero(count == number_above)
        for triangle in corners:
            ends = [numpy.sort(sorted_cells[chosen][:, list(edge)], axis=1) for edge in triangle]
            triangles.append(numpy.stack(ends, axis=1))
            owners.append(chosen)
    return numpy.concatenate(triangles), numpy.concatenate(owners)


def _three(vectors):
    if vectors.shape[1] == 3:
        return vectors
    return numpy.column_stack((vectors, numpy.zeros(len(vectors))))
