"""Seconds a step and memory of FSI3 beside turtleFSI, on turtleFSI's own mesh, on one core, alternating.

    git clone https://github.com/KVSlab/turtleFSI DIRECTORY && git -C DIRECTORY checkout 5fa4138
    /usr/bin/python3 tests/benchmarks/beside_turtlefsi.py DIRECTORY build/vocalis

Needs Debian's python3-dolfin. Both take ten steps of 0.01 s with P2 velocities and a Newton tolerance of 1e-7; the
steps 3 to 10 count, so that neither pays for its start. turtleFSI keeps the Jacobian of a step's first
iteration, its fastest way. Its Lamé constant of the flag is half of the benchmark's, so ours is handed to it.
"""

import argparse
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

EXPORT = """
import runpy, numpy, dolfin
problem = runpy.run_path(ROOT + "/turtleFSI/problems/TF_fsi.py")
settings = problem["set_problem_parameters"]({"compiler_parameters": {}})
mesh, cells, facets = problem["get_mesh_domain_and_boundaries"](**settings)
mesh.init(1)
numpy.savez(OUT, points=mesh.coordinates(), cells=mesh.cells(), cell_marks=cells.array(), facet_marks=facets.array(),
            facets=numpy.array([facet.entities(0) for facet in dolfin.facets(mesh)]))
"""
FACETS = {"inlet": 3, "outlet": 4, "walls": 2, "cylinder": 6, "flag": 5, "clamp": 7}
REGIONS = {"fluid": 1, "solid": 2}
ONE_CORE = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "VOCALIS_TERMINAL": "0"}


def write_mesh(turtle, folder):
    """turtleFSI's default mesh of FSI3 with its marks, for Gmsh."""
    import numpy

    code = f"ROOT, OUT = {str(turtle)!r}, {str(folder / 'mesh.npz')!r}\n" + EXPORT
    subprocess.run([sys.executable, "-c", code], check=True, cwd=turtle / "turtleFSI", stdout=subprocess.DEVNULL,
                   env=dict(os.environ, PYTHONPATH=str(turtle)))
    data = numpy.load(folder / "mesh.npz")
    groups = [(1, name, data["facets"][data["facet_marks"] == mark]) for name, mark in FACETS.items()]
    groups += [(2, name, data["cells"][data["cell_marks"] == mark]) for name, mark in REGIONS.items()]
    names, elements = [], []
    for tag, (dimension, name, members) in enumerate(groups, 1):
        names.append(f'{dimension} {tag} "{name}"')
        elements += [f"{dimension} 2 {tag} {tag} " + " ".join(str(v + 1) for v in vertices) for vertices in members]
    points = [f"{i} {x:.17g} {y:.17g} 0" for i, (x, y) in enumerate(data["points"], 1)]
    numbered = [f"{i} {element}" for i, element in enumerate(elements, 1)]
    sections = {"PhysicalNames": names, "Nodes": points, "Elements": numbered}
    text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    for title, lines in sections.items():
        text += "\n".join([f"${title}", str(len(lines)), *lines, f"$End{title}", ""])
    (folder / "turtle.msh").write_text(text)
    return len(data["cells"])


def write_case(folder):
    """The case fsi3 on that mesh with their step."""
    case = pathlib.Path(__file__).parents[2] / "cases" / "turek_hron" / "fsi3.toml"
    text = re.sub(r'geometry = "fsi.geo".*?\n\n\[\[region', 'file = "turtle.msh"\n\n[[region', case.read_text(), 1, re.S)
    text = re.sub(r"(?m)^dt = .*", "dt = 0.01", text)
    text = re.sub(r"(?m)^fields_interval = .*", "fields_interval = 0", text)
    (folder / "case.toml").write_text(text)


def measured(command, folder, environment, pattern=None):
    """Runs a program: when the lines came that match the pattern [s], and its peak memory [MB]."""
    log = folder / "memory.txt"
    process = subprocess.Popen(["/usr/bin/time", "-f", "%M", "-o", str(log), *command], stdout=subprocess.PIPE, text=True,
                               stderr=subprocess.STDOUT, bufsize=1, cwd=folder, env=dict(os.environ, **environment))
    seen = [time.perf_counter() for line in process.stdout if pattern and re.match(pattern, line)]
    if process.wait():
        raise SystemExit(f"{command[0]}: exit code {process.returncode}")
    return seen, int(log.read_text().split()[-1]) / 1024


def theirs(turtle, folder):
    """Seconds a step and memory of turtleFSI."""
    command = [sys.executable, "-u", "-m", "turtleFSI.run_turtle", "-p", "TF_fsi", "--lambda-s", "8e6", "-dt", "0.01", "-T",
               "0.09", "--recompute", "20", "--save-step", "100000", "--checkpoint-step", "100000", "-v", "True"]
    ends, memory = measured(command, folder, dict(ONE_CORE, PYTHONPATH=str(turtle)), "Solved for timestep")
    return statistics.median(ends[i] - ends[i - 1] for i in range(2, 10)), memory


def ours(program, folder):
    """Seconds a step and memory of Vocalis: what steps 3 to 10 add to a run of two."""
    wall = {}
    for steps in (2, 10):
        run = folder / f"run_{steps}"
        command = [program, "run", str(folder / "case.toml"), "--set", f"time.end={0.01 * steps}", "--set",
                   "flow.newton_tolerance=1e-7", "--out", str(run)]
        _, memory = measured(command, folder, ONE_CORE)
        wall[steps] = json.loads((run / "summary.json").read_text())["wall_seconds"]
        shutil.rmtree(run)
    return (wall[10] - wall[2]) / 8, memory


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("turtlefsi", type=pathlib.Path)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--pairs", type=int, default=2)
    given = parser.parse_args()
    turtle, program = given.turtlefsi.resolve(), str(given.program.resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        cells = write_mesh(turtle, folder)
        write_case(folder)
        print(f"{cells} triangles\n| program | seconds a step | peak memory [MB] |\n| --- | ---: | ---: |")
        for _ in range(given.pairs):
            peer, peer_memory = theirs(turtle, folder)
            print(f"| turtleFSI | {peer:.4f} | {peer_memory:.0f} |")
            here, memory = ours(program, folder)
            print(f"| Vocalis | {here:.4f} | {memory:.0f} |\n{peer / here:.1f} times")


if __name__ == "__main__":
    main()
