"""Smallest mesh quality of each of the last periods of a run: a mesh motion that is not reversible lets it drift.

    ./vocalis run cases/turek_hron/fsi2.toml --out runs/fsi2
    /usr/bin/python3 tests/benchmarks/mesh_quality_over_periods.py runs/fsi2
"""

import argparse
import pathlib

import numpy as np


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("--column", default="tip_y_m", help="whose upward crossings of its mean begin a period")
    parser.add_argument("--periods", type=int, default=10)
    given = parser.parse_args()
    lines = [line for line in (given.run / "history.csv").read_text().splitlines() if not line.startswith("#")]
    columns = np.array([line.split(",") for line in lines[1:]], dtype=float).T
    history = dict(zip(lines[0].split(","), columns))
    late = history[given.column][len(columns[0]) * 3 // 4 :]
    offset = history[given.column] - 0.5 * (late.max() + late.min())
    begins = np.nonzero((offset[:-1] < 0) & (offset[1:] >= 0))[0][-given.periods - 1 :]
    smallest = [history["smallest_quality"][a:b].min() for a, b in zip(begins, begins[1:])]
    print("smallest quality of each period:", " ".join(f"{value:.4f}" for value in smallest))
    print(f"mean {np.mean(smallest):.4f}, drift a period {np.polyfit(range(len(smallest)), smallest, 1)[0]:+.1e}")


if __name__ == "__main__":
    main()
