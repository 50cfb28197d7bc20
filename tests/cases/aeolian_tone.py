#!/usr/bin/python3
"""The aeolian tone of cases/cylinder/aeolian.toml: Strouhal number, lift and drag against Inoue & Hatakeyama 2002, and what
each microphone hears against the compact dipole of the lift that the same run has.

    aeolian_tone.py PROGRAM [--mpiexec mpiexec]     runs the case, minutes, and asserts
    aeolian_tone.py RUN                             shows the table of a run that is there
"""

import math
import pathlib
import sys

import numpy

from program import HERE, main, read_series

CASES = HERE.parents[1] / "cases" / "cylinder"
DIAMETER, SPEED, DENSITY, SOUND, DISTANCE = 0.2, 70.0, 1.2, 350.0, 15.0  # [m, m/s, kg/m^3, m/s, m]
FORCE = 0.5 * DENSITY * SPEED**2 * DIAMETER  # [N/m] of a coefficient of 1
# Inoue & Hatakeyama 2002, J. Fluid Mech. 471, 285: value, and what 2 % of it is.
REFERENCE = {"Strouhal number": 0.1835, "lift coefficient": 0.52, "drag coefficient": 1.325}
TOLERANCE, LOUDNESS = 0.02, 1.0  # of the flow, relative; of the sound [dB]
NOT_JUDGED = ("pressure",)  # leaves out the viscous stress


def harmonic(times, values, frequency):
    """Mean and complex amplitude P of Re(P exp(iωt)), with two harmonics beside it, by least squares."""
    columns = [numpy.ones_like(times)]
    for n in (1, 2, 3):
        phase = 2 * math.pi * n * frequency * times
        columns += [numpy.cos(phase), numpy.sin(phase)]
    found = numpy.linalg.lstsq(numpy.stack(columns, axis=1), values, rcond=None)[0]
    return found[0], complex(found[1], -found[2])


def last_periods(times, lift, periods=4):
    """Frequency, and the time at which its last few periods begin."""
    up = [i for i in range(len(lift) - 1) if lift[i] < 0 <= lift[i + 1]]
    zeros = [times[i] - lift[i] * (times[i + 1] - times[i]) / (lift[i + 1] - lift[i]) for i in up[-periods - 1:]]
    return periods / (zeros[-1] - zeros[0]), zeros[0], zeros[-1]


def dipole(lift, frequency):
    """|p| of a line with the force `lift` [N/m], at a right angle: (kF / 4) |H1(kr)|."""
    kr = 2 * math.pi * frequency / SOUND * DISTANCE
    return kr / DISTANCE * lift / 4 * math.sqrt(2 / (math.pi * kr) * (1 + 0.375 / kr**2))


def measure(folder):
    """Figures of the flow, and of each microphone its level over the dipole's [dB]."""
    columns, values = read_series(folder / "history.csv")
    history = {name: numpy.array(column) for name, column in zip(columns, values)}
    times, lift = history["time_s"], history["lift_coefficient"]
    frequency, begin, end = last_periods(times, lift)
    late = (times >= begin) & (times < end)
    _, lift_amplitude = harmonic(times[late], lift[late], frequency)
    drag, _ = harmonic(times[late], history["drag_coefficient"][late], frequency)
    flow = {"Strouhal number": frequency * DIAMETER / SPEED, "lift coefficient": abs(lift_amplitude),
            "drag coefficient": drag}
    predicted = dipole(abs(lift_amplitude) * FORCE, frequency)
    sounds = {}
    for path in sorted(folder.glob("microphones*.csv")):
        columns, values = read_series(path)
        heard = {name: numpy.array(column) for name, column in zip(columns, values)}
        late = heard["time_s"] >= heard["time_s"][-1] - 4 / frequency
        for name in columns:
            if name.startswith("pressure_Pa."):
                _, amplitude = harmonic(heard["time_s"][late], heard[name][late], frequency)
                sounds[name.split(".", 1)[1]] = 20 * math.log10(abs(amplitude) / predicted)
    return flow, predicted, sounds


def show(flow, predicted, sounds):
    for name, value in flow.items():
        error = value / REFERENCE[name] - 1
        print(f"{name:<18} {value:8.4f}   {100 * error:+.2f} % of {REFERENCE[name]}")
    print(f"dipole of the lift {predicted:8.3f} Pa, {predicted / (DENSITY * SPEED**2):.4e} rho U^2")
    for name, level in sounds.items():
        print(f"  {name:<28} {level:+.3f} dB")


def expect_loudness(program, sounds):
    for name, level in sounds.items():
        if name not in NOT_JUDGED:
            program.expect(abs(level) <= LOUDNESS, f"microphone {name} is {level:+.2f} dB off")


def test(program, folder):
    result = program.start(1, "run", CASES / "aeolian.toml", "--out", folder)
    if not program.expect_code(0, result, "the run"):
        return
    flow, predicted, sounds = measure(folder)
    show(flow, predicted, sounds)
    for name, value in flow.items():
        program.expect(abs(value / REFERENCE[name] - 1) <= TOLERANCE, f"{name} {value:.4f} is not {REFERENCE[name]}")
    expect_loudness(program, sounds)


if __name__ == "__main__":
    if pathlib.Path(sys.argv[1]).is_dir():
        show(*measure(pathlib.Path(sys.argv[1])))
    else:
        sys.exit(main(test))
