"""What a step of FSI3 costs as its mesh grows, phase by phase, and the exponent it grows with.

    tests/benchmarks/cost_of_a_step.py build/release/vocalis [--steps 40] [--sizes 1 0.5 0.2]

The flag rests and the flow begins: with the flag in full swing a step takes more iterations, which the last column of
the run's own history tells. Seconds are wall seconds on one rank: let nothing else run.
"""

import argparse
import json
import math
import pathlib
import subprocess
import tempfile

CASE = pathlib.Path(__file__).resolve().parents[2] / "cases/turek_hron/fsi3.toml"
PHASES = ["flow.solve", "flow.assemble", "mesh_motion", "output"]


def measure(program, size, steps, folder):
    """Unknowns and seconds a step by phase of a short run."""
    dt = 0.005
    settings = [f"mesh.parameters.size={size}", f"time.dt={dt}", f"time.end={dt * steps}"]
    words = [program, "run", str(CASE), "--out", folder]
    for setting in settings:
        words += ["--set", setting]
    subprocess.run(["mpirun", "-n", "1", *words], check=True, stdout=subprocess.DEVNULL)
    summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
    seconds = {phase: summary["phases"].get(phase, 0) / summary["steps"] for phase in PHASES}
    return summary["unknowns"]["flow"], summary["cells"]["flow"], seconds, summary["peak_memory_bytes"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--steps", type=int, default=40)
    parser.add_argument("--sizes", type=float, nargs="+", default=[1, 0.5, 0.2])
    options = parser.parse_args()
    print("| cells | unknowns | " + " | ".join(f"{phase} [ms]" for phase in PHASES) + " | step [ms] | exponent | memory [MB] |")
    print("| ---: " * (len(PHASES) + 5) + "|")
    last = None
    for size in options.sizes:
        with tempfile.TemporaryDirectory() as folder:
            unknowns, cells, seconds, memory = measure(options.program, size, options.steps, folder)
        total = sum(seconds.values())
        exponent = math.log(total / last[1]) / math.log(unknowns / last[0]) if last else None
        row = [cells, unknowns] + [f"{1e3 * seconds[phase]:.1f}" for phase in PHASES]
        row += [f"{1e3 * total:.1f}", f"{exponent:.2f}" if exponent else "", f"{memory / 1e6:.0f}"]
        print("| " + " | ".join(map(str, row)) + " |", flush=True)
        last = (unknowns, total)


if __name__ == "__main__":
    main()
