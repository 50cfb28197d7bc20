"""Where the balance of energy of runs rises above where it has been, and by how much of what was stored.

    ./vocalis run cases/contact/plates.toml
    /usr/bin/python3 tests/benchmarks/energy_rises.py --period 0.02 runs/plates

Twice: as the monitor `energy` counts it, which is as the time scheme does, and as kinetic and elastic energy at the end
of each step less a trapezoidal sum of the powers.
"""

import argparse
import pathlib

import numpy as np


def largest_rise(times, balance):
    """The largest rise above the lowest value so far [J], when it began, and when it was reached [s]."""
    rise = balance - np.minimum.accumulate(balance)
    top = np.argmax(rise)
    bottom = np.argmin(balance[: top + 1])
    return rise[top], times[bottom], times[top]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--period", type=float, default=0, help="[s] tells what is lost in each")
    parser.add_argument("runs", nargs="+", type=pathlib.Path)
    arguments = parser.parse_args()
    print("| run | stored [mJ] | counted | largest rise [uJ] | of the stored | from [ms] | to [ms] | steps that rise "
          "| lost a period [uJ] |")
    print("| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for run in arguments.runs:
        lines = [line for line in (run / "history.csv").read_text().splitlines() if not line.startswith("#")]
        columns = np.array([line.split(",") for line in lines[1:]], dtype=float).T
        history = dict(zip(lines[0].split(","), columns))
        times, stored = np.r_[0, history["time_s"]], history["energy_elastic_J"].max()
        power = np.r_[0, history["power_supplied_W"] - history["power_dissipated_W"]]
        energy = np.r_[0, history["energy_kinetic_J"] + history["energy_elastic_J"]]
        trapezoids = np.cumsum(np.r_[0, 0.5 * history["dt_s"] * (power[1:] + power[:-1])])
        for name, balance in (("as the scheme does", np.r_[0, history["energy_residual_J"]]),
                              ("by trapezoids", energy - trapezoids)):
            rise, begin, end = largest_rise(times, balance)
            rising = np.count_nonzero(np.diff(balance) > 1e-9 * stored)
            lost = "-"
            if arguments.period > 0:
                ends = np.arange(0, times[-1] + 1e-9, arguments.period)
                falls = -1e6 * np.diff(np.interp(ends, times, balance))
                lost = f"{falls.min():.1f} ... {falls.max():.1f}"
            print(f"| {run.name} | {1e3 * stored:.4g} | {name} | {1e6 * rise:.2g} | {rise / stored:.1e} "
                  f"| {1e3 * begin:.3f} | {1e3 * end:.3f} | {rising} of {len(times) - 1} | {lost} |")


if __name__ == "__main__":
    main()
