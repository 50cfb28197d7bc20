#!/usr/bin/python3
"""Resonances of vocal tracts and tubes from one-dimensional transfer matrices, without losses or with those of the walls.

The oracle of the acoustic cases: numpy alone, independent of the solver. A duct is a chain of short cylinders
(transmission_line.py, tract_shapes.py), ended by a radiation impedance (radiation.py). Driven by a volume velocity at the
closed glottis, it resonates where |U_lips / U_glottis| peaks. Formants are the poles of this ratio in the complex plane,
which exist where wide peaks run into each other, too (resonances.py).

Run it to print the tables quoted in cases/*/README.md; `--check` compares them with the published numbers. A case file of
cases/vowel_i/tract.geo as its argument gives the formants of its areas, rigid and with walls of several kinds.
"""

import math
import pathlib
import sys

import numpy

from radiation import circular_piston, no_radiation, strip_piston
from resonances import peaks, poles
from tract_shapes import STORY_I, conical, ducts_of_case, larynx_shunt, planar, story_cylinders, with_ventricle
from transmission_line import CHEEK, NECK, boundary_layer, transfer


def tables(step=0.5):
    """All tables, name -> list of (frequency, bandwidth)."""
    f = numpy.arange(50.0, 5000.0, step)
    round_mouth = math.sqrt(STORY_I[-1] / math.pi)
    depth = 0.015
    flat_mouth = STORY_I[-1] / depth / 2

    def piston(radius):
        return lambda k: circular_piston(k * radius)

    def strip(half_width):
        return lambda k: strip_piston(k * half_width)

    tube = (numpy.array([0.17]), numpy.array([math.pi * 1e-4]))
    flat_tube = (numpy.array([0.17]), numpy.array([0.02]))
    result = {
        "tube 0.17 m, p = 0": peaks(f, transfer(f, tube, no_radiation)),
        "tube 0.17 m, a = 1 cm, baffle": peaks(f, transfer(f, tube, piston(0.01))),
        "plane tube 0.17 m, half height 1 cm, baffle": peaks(f, transfer(f, flat_tube, strip(0.01))),
        "/i/ cylinders, p = 0": peaks(f, transfer(f, story_cylinders(), no_radiation)),
        "/i/ cylinders, baffle": peaks(f, transfer(f, story_cylinders(), piston(round_mouth))),
        "/i/ cylinders, baffle, wall admittance 0.005": peaks(
            f, transfer(f, story_cylinders(), piston(round_mouth), admittance=0.005)),
        "/i/ conical, p = 0": peaks(f, transfer(f, conical(), no_radiation)),
        "/i/ conical, baffle": peaks(f, transfer(f, conical(), piston(round_mouth))),
        "/i/ conical, baffle, wall admittance 0.005": peaks(
            f, transfer(f, conical(), piston(round_mouth), admittance=0.005)),
        "/i/ plane, baffle": peaks(f, transfer(f, planar(depth), strip(flat_mouth))),
    }
    for half_gap in (1e-4, 2.5e-4, 5e-4):
        ducts = with_ventricle(planar(depth), half_gap)
        gap = f"half gap {half_gap * 1e3:g} mm"
        result[f"/i/ plane, ventricle, {gap}, closed glottis"] = peaks(f, transfer(f, ducts, strip(flat_mouth)))
        for name, lungs in (("rigid", 0.0), ("absorbing", 1.0), ("pressure release at", 1e9)):
            response = transfer(f, ducts, strip(flat_mouth), larynx_shunt(half_gap, lungs))
            result[f"/i/ plane, ventricle, {gap}, {name} lungs"] = peaks(f, response)
    return result


def check(result):
    """Agreement with published values [Hz]; returns the list of disagreements."""
    published = {
        "tube 0.17 m, p = 0": ([514.7, 1544.1, 2573.5, 3602.9, 4632.4], 0.5),
        "tube 0.17 m, a = 1 cm, baffle": ([490.3, 1472.8, 2460.2, 3453.2, 4451.5], 0.5),
        "/i/ cylinders, p = 0": ([224, 2489, 3567, 3990, 4799], 1.0),
        "/i/ cylinders, baffle": ([223, 2482, 3165, 3860, 4664], 1.0),
        "/i/ cylinders, baffle, wall admittance 0.005": ([219, 2486, 3178], 2.0),
        "/i/ conical, baffle": ([226, 2497, 3193, 3916], 1.0),
    }
    arnela, mouth = ducts_of_case(pathlib.Path(__file__).parents[2] / "cases" / "vowel_i" / "tract_arnela.toml")
    f = numpy.arange(50.0, 4000.0, 0.5)

    def baffled(admittance):
        return peaks(f, transfer(f, arnela[:2], lambda k: circular_piston(k * mouth), admittance=admittance))

    result = result | {"Arnela's /i/, p = 0": peaks(f, transfer(f, arnela[:2], no_radiation)),
                       "Arnela's /i/, baffle": baffled(0), "Arnela's /i/, baffle, wall admittance 0.005": baffled(0.005)}
    published |= {"Arnela's /i/, p = 0": ([225, 2072, 3270, 3678], 1.0),
                  "Arnela's /i/, baffle": ([223, 2069, 3200, 3564], 1.0),
                  "Arnela's /i/, baffle, wall admittance 0.005": ([220, 2070, 3234, 3552], 1.0)}
    wrong = []
    for name, (values, tolerance) in published.items():
        found = [frequency for frequency, _ in result[name]]
        for value, computed in zip(values, found + [math.nan] * len(values)):
            if not abs(value - computed) <= tolerance:
                wrong.append(f"{name}: expected {value} Hz, found {computed} Hz")
    for name, ducts in (("Story", conical()), ("Arnela", arnela[:2])):
        dull = peaks(f, transfer(f, ducts, lambda k: circular_piston(k * mouth), admittance=0.05))
        if any(width < 600 for _, width in dull):
            wrong.append(f"{name}'s /i/: wall admittance 0.05 should leave no formant below 4 kHz, found {dull}")
    for ka, resistance, reactance in ((0.1, 0.004992, 0.084657), (1, 0.423275, 0.646768), (5, 0.991305, 0.178366)):
        z = circular_piston(numpy.array([float(ka)]))[0]
        if abs(z - complex(resistance, reactance)) > 5e-6:
            wrong.append(f"piston at ka = {ka}: expected {resistance} + i {reactance}, found {z}")
    return wrong


def print_case(path):
    """Formants of a case's areas with a baffled mouth: poles, and the peaks of |U_lips / U_glottis| with their 3 dB
    bandwidths in brackets [Hz]. Plane waves, pressure being even over each section, are too light, and their resonances
    too high (Rayleigh's principle); a flow that keeps to its lines is too heavy, and its resonances too low (Kelvin's).
    """
    ducts, mouth = ducts_of_case(path)

    def radiation(k):
        return circular_piston(k * mouth)

    f = numpy.arange(50.0, 5500.0, 1.0)
    walls = {"wall admittance 0": 0, "wall admittance 0.005": 0.005, "wall admittance 0.05": 0.05,
             "yielding as the cheek": CHEEK, "yielding as the neck": NECK, "viscothermal": boundary_layer()}
    for name, admittance in walls.items():
        found = {"plane waves, peaks": peaks(f, transfer(f, ducts[:2], radiation, admittance=admittance)),
                 "plane waves, poles": poles(ducts[:2], radiation, admittance),
                 "flow lines,  poles": poles(ducts, radiation, admittance)}
        for kind, row in found.items():
            text = "  ".join(f"{frequency:7.1f} ({bandwidth:.1f})" for frequency, bandwidth in row)
            print(f"{name:<22} {kind}  {text}")


def main(arguments):
    cases = [argument for argument in arguments if argument.endswith(".toml")]
    for path in cases:
        print(path)
        print_case(path)
    if cases:
        return 0
    result = tables()
    for name, row in result.items():
        text = "  ".join(f"{frequency:7.1f} ({bandwidth:.0f})" for frequency, bandwidth in row)
        print(f"{name:58s} {text}")
    if "--check" not in arguments:
        return 0
    wrong = check(result)
    print("\n".join(wrong) if wrong else "agrees with the published values")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
