"""What the balance of energy leaves over the last full period of runs of FSI3, and how it falls with the step.

    ./vocalis study cases/turek_hron/fsi3_energy.toml
    /usr/bin/python3 tests/benchmarks/energy_over_a_period.py runs/studies/fsi3_energy/points/*

Over a period a limit cycle keeps its energy: what is supplied must be dissipated. What is not is lost to the time
scheme.
"""

import argparse
import pathlib

import numpy as np


def last_period(times, values):
    """The last two upward crossings of the mean [s]."""
    late = values[times > times[-1] - 0.25 * (times[-1] - times[0])]
    offset = values - 0.5 * (late.max() + late.min())
    up = np.nonzero((offset[:-1] < 0) & (offset[1:] >= 0))[0]
    crossings = times[up] - offset[up] * (times[up + 1] - times[up]) / (offset[up + 1] - offset[up])
    return crossings[-2], crossings[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", type=pathlib.Path)
    print("| run | period [s] | supplied [J] | dissipated [J] | left [J] | of the supplied [%] |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    for run in parser.parse_args().runs:
        lines = [line for line in (run / "history.csv").read_text().splitlines() if not line.startswith("#")]
        columns = np.array([line.split(",") for line in lines[1:]], dtype=float).T
        history = dict(zip(lines[0].split(","), columns))
        times = history["time_s"]
        begin, end = last_period(times, history["tip_y_m"])
        inside = np.concatenate([[begin], times[(times > begin) & (times < end)], [end]])

        def work(name):
            return np.trapz(np.interp(inside, times, history[name]), inside)

        supplied, dissipated = work("power_supplied_W"), work("power_dissipated_W")
        left = np.diff(np.interp([begin, end], times, history["energy_residual_J"]))[0]
        print(f"| {run.name} | {end - begin:.4f} | {supplied:.2f} | {dissipated:.2f} | {left:.3f} "
              f"| {100 * left / supplied:.3f} |")


if __name__ == "__main__":
    main()
