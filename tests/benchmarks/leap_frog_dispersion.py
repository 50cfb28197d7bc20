"""Frequency error of the explicit integrator of sound, with the mass lumped alone and with its corrections.

    /usr/bin/python3 tests/benchmarks/leap_frog_dispersion.py

Modes 8 to 23 of a rigid box of 1 x 0.7 (x 0.5), c = 1, on Gmsh's unstructured cells, at 0.9 of the stable step; root of
the mean square over the modes. The scheme is that of docs/theory.md, "Time of sound", written here a second time. Needs
gmsh and python3-scipy.
"""

import itertools
import pathlib
import subprocess
import tempfile

import numpy as np
import scipy.linalg
import scipy.sparse as sparse
import scipy.sparse.linalg as sparse_linalg

SIZE = (1.0, 0.7, 0.5)
MODES = 24
PART_OF_STABLE_STEP = 0.9
CONSISTENT_PART = {2: 1 / 2, 3: 1 / 3}


def box(dimension, length):
    """Points and cells of the box, cells of about this length."""
    shape = "Rectangle(1) = {0, 0, 0, %g, %g};" % SIZE[:2] if dimension == 2 else "Box(1) = {0, 0, 0, %g, %g, %g};" % SIZE
    with tempfile.TemporaryDirectory() as name:
        geometry, mesh = pathlib.Path(name) / "box.geo", pathlib.Path(name) / "box.msh"
        geometry.write_text(f'SetFactory("OpenCASCADE"); {shape}')
        sizes = ["-clmin", str(length), "-clmax", str(length)]
        subprocess.run(["gmsh", f"-{dimension}", "-v", "0", *sizes, "-format", "msh22", "-o", mesh, geometry], check=True)
        lines = mesh.read_text().split("\n")
    nodes, elements = lines.index("$Nodes") + 2, lines.index("$Elements") + 2
    points = np.array([line.split()[1 : dimension + 1] for line in lines[nodes : nodes + int(lines[nodes - 1])]], float)
    kind = "2" if dimension == 2 else "4"
    words = [line.split() for line in lines[elements : elements + int(lines[elements - 1])]]
    return points, np.array([word[-dimension - 1 :] for word in words if word[1] == kind], int) - 1


def matrices(points, cells):
    """Stiffness and consistent mass of P1."""
    d = points.shape[1]
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    measure = np.abs(np.linalg.det(edges)) / (2 if d == 2 else 6)
    slopes = np.linalg.inv(edges).transpose(0, 2, 1)
    slopes = np.concatenate([-slopes.sum(1, keepdims=True), slopes], 1)
    ones = np.ones((d + 1, d + 1)) + np.eye(d + 1)
    parts = np.einsum("eik,ejk,e->eij", slopes, slopes, measure), np.einsum("e,ij->eij", measure / ((d + 1) * (d + 2)), ones)
    rows, columns = np.repeat(cells, d + 1, 1).ravel(), np.tile(cells, (1, d + 1)).ravel()
    return (sparse.csr_matrix((part.ravel(), (rows, columns))) for part in parts)


def errors(dimension, length):
    """Cells a wavelength, and the errors [%] with lumped and with corrected mass."""
    stiffness, mass = matrices(*box(dimension, length))
    lumped = np.asarray(mass.sum(1)).ravel()
    inverse, root = sparse.diags(1 / lumped), sparse.diags(1 / np.sqrt(lumped))
    largest = sparse_linalg.eigsh(root @ stiffness @ root, 1, which="LA", tol=1e-3)[0][0]
    part = CONSISTENT_PART[dimension]
    s = 1 + part * (dimension + 1) / (dimension + 2)
    dt = PART_OF_STABLE_STEP * np.sqrt(6 * (s - np.sqrt(s * s - 4 / 3)) / largest)
    corrected = inverse + inverse @ (part * (sparse.diags(lumped) - mass) - dt * dt / 12 * stiffness) @ inverse
    squares, modes = sparse_linalg.eigsh(stiffness, MODES, M=sparse.diags(lumped), sigma=-1.0)
    modes = modes[:, 1:]  # without the constant
    image = stiffness @ modes
    ritz = scipy.linalg.eigh(image.T @ (corrected @ image), modes.T @ image, eigvals_only=True)
    counts = itertools.product(range(9), repeat=dimension)
    exact = np.sort([np.pi * np.sqrt(sum((n / size) ** 2 for n, size in zip(count, SIZE))) for count in counts])[8:MODES]

    def error(square, step):
        return 100 * np.sqrt(np.mean((2 / step * np.arcsin(np.sqrt(square) * step / 2) / exact - 1) ** 2))

    wave = 2 * np.pi / np.sqrt(np.mean(exact**2)) / length
    return wave, error(squares[8:], PART_OF_STABLE_STEP * 2 / np.sqrt(largest)), error(ritz[7:], dt)


def main():
    print("| dimension | cells a wavelength | lumped [%] | corrected mass and time [%] |\n| --- | ---: | ---: | ---: |")
    for dimension, cells in ((2, 20), (2, 40), (3, 14), (3, 24)):
        wave, lumped, corrected = errors(dimension, 1 / cells)
        print(f"| {dimension} | {wave:.1f} | {lumped:.2f} | {corrected:.2g} |")


if __name__ == "__main__":
    main()
