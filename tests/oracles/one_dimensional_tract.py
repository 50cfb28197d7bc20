#!/usr/bin/python3
"""Resonances of vocal tracts and tubes from one-dimensional transfer matrices, without losses or with those of the walls.

The oracle of the acoustic cases: numpy alone, independent of the solver. A duct is a chain of short cylinders,

    p_in = cos(kl) p_out + i (rho c / A) sin(kl) U_out,    U_in = i (A / rho c) sin(kl) p_out + cos(kl) U_out,

time convention exp(+i omega t), ended by a radiation impedance. Driven by a volume velocity at the closed glottis, it
resonates where |U_lips / U_glottis| peaks. In the plane A is the height, a volume velocity per metre of depth. Formants are
the poles of this ratio in the complex plane, which exist where wide peaks run into each other, too.

Run it to print the tables quoted in cases/*/README.md; `--check` compares them with the published numbers. A case file of
cases/vowel_i/tract.geo as its argument gives the formants of its areas, rigid and with walls of several kinds.
"""

import math
import pathlib
import sys
import tomllib

import numpy

SPEED_OF_SOUND = 350.0  # [m/s]
DENSITY = 1.14  # [kg/m^3]

# Story, Titze and Hoffman 1996, J. Acoust. Soc. Am. 100, 537: /i/, glottis to lips [m^2]; sections 350 / (2 * 44100) m.
STORY_SECTION = 0.00396825
STORY_I = 1e-4 * numpy.array([
    0.33, 0.30, 0.36, 0.34, 0.68, 0.50, 2.43, 3.15, 2.66, 2.49, 3.39, 3.80, 3.78, 4.35, 4.50, 4.43, 4.68, 4.52, 4.15,
    4.09, 3.51, 2.95, 2.03, 1.66, 1.38, 1.05, 0.60, 0.35, 0.32, 0.12, 0.10, 0.16, 0.25, 0.24, 0.38, 0.28, 0.36, 0.65,
    1.58, 2.05, 2.01, 1.58])


def bessel_j1(x, terms=40):
    """J1 by its power series; double precision is kept for |x| < 12."""
    x = numpy.asarray(x)
    return sum((-1) ** m * (x / 2) ** (2 * m + 1) / float(math.factorial(m) * math.factorial(m + 1)) for m in range(terms))


def struve_h1(x, terms=40):
    """The Struve function H1 by its power series; double precision is kept for |x| < 12."""
    x = numpy.asarray(x)
    return sum((-1) ** m * (x / 2) ** (2 * m + 2) / (math.gamma(m + 1.5) * math.gamma(m + 2.5)) for m in range(terms))


def circular_piston(ka):
    """Z / (rho c) of a circular piston of radius a in an infinite baffle: 1 - J1(2ka)/ka + i H1(2ka)/ka (Rayleigh)."""
    return 1 - bessel_j1(2 * ka) / ka + 1j * struve_h1(2 * ka) / ka


def strip_piston(ka, terms=30):
    """Z / (rho c) of a strip of half width a in an infinite baffle in the plane, averaged over the strip.

    Z = (k / 2a) int_0^2a (2a - s) H0^(2)(k s) ds, each term of the series of J0 and Y0 integrated exactly:
    with b = 2a, int (b-s) s^n ds = b^(n+2)/((n+1)(n+2)) and
    int (b-s) s^n ln(s) ds = that * (ln b - 1/(n+1) - 1/(n+2)).
    """
    x = 2 * numpy.asarray(ka, dtype=float)
    j0 = numpy.zeros_like(x)
    y0 = numpy.zeros_like(x)
    harmonic = 0.0
    for m in range(terms):
        if m > 0:
            harmonic += 1 / m
        n = 2 * m
        coefficient = (-1) ** m / (math.factorial(m) ** 2 * 4.0 ** m)
        integral = x ** (n + 2) / ((n + 1) * (n + 2))
        logarithm = integral * (numpy.log(x / 2) - 1 / (n + 1) - 1 / (n + 2))
        j0 += coefficient * integral
        y0 += 2 / math.pi * coefficient * (logarithm + (numpy.euler_gamma - harmonic) * integral)
    return (j0 - 1j * y0) / x


def chain(lengths, areas, wavenumber, admittance=0.0, slopes=None):
    """The 2 x 2 transfer matrix (p, U) of cylinders from the first to the last; entries one per frequency.

    admittance  of locally reacting walls, times rho c, a number or a function of the wavenumber; circular sections:
                k^2 -> k^2 - i k admittance S / A
    slopes      dR/dx of circular walls: the flow goes along lines that keep their share r / R of the radius, which makes
                it heavier by 1 + slope^2 / 2; and there is more wall. None: plane waves
    """
    impedance = DENSITY * SPEED_OF_SOUND
    a, b = numpy.ones_like(wavenumber, dtype=complex), numpy.zeros_like(wavenumber, dtype=complex)
    c, d = numpy.zeros_like(a), numpy.ones_like(a)
    slopes = numpy.zeros(len(lengths)) if slopes is None else slopes
    admittance = admittance(wavenumber) if callable(admittance) else admittance
    for length, area, slope in zip(lengths, areas, slopes):
        inertance = 1 + slope ** 2 / 2
        perimeter = 2 * math.sqrt(math.pi * area * (1 + slope ** 2))
        inside = numpy.sqrt(inertance * (wavenumber ** 2 - 1j * wavenumber * admittance * perimeter / area) + 0j)
        ratio = inertance * wavenumber / inside
        cosine, sine = numpy.cos(inside * length), numpy.sin(inside * length)
        up, down = 1j * sine * impedance * ratio / area, 1j * sine * area / (impedance * ratio)
        a, b = a * cosine + b * down, a * up + b * cosine
        c, d = c * cosine + d * down, c * up + d * cosine
    return a, b, c, d


def yielding_wall(mass, resistance, stiffness):
    """rho c Y of a wall m w'' + b w' + k w = p [kg/m^2, Pa s/m, Pa/m], as a function of the wavenumber."""
    def admittance(wavenumber):
        rate = 1j * SPEED_OF_SOUND * wavenumber
        return DENSITY * SPEED_OF_SOUND / (mass * rate + resistance + stiffness / rate)
    return admittance


# Ishizaka, French and Flanagan 1975, IEEE Trans. Acoust. Speech Signal Process. 23, 370: 2.1 g/cm^2, 800 dyn s/cm^3 and
# 84,500 dyn/cm^3 for the relaxed cheek; 2.4, 2320 and 491,000 for the neck.
CHEEK = yielding_wall(21, 8000, 845e3)
NECK = yielding_wall(24, 23200, 4910e3)


def boundary_layer(kinematic_viscosity=1.64e-5, thermal_diffusivity=2.32e-5, heat_capacity_ratio=1.4):
    """rho c Y of the viscothermal losses at a wall along which sound travels (Kirchhoff 1868), of the wavenumber."""
    factor = math.sqrt(kinematic_viscosity) + (heat_capacity_ratio - 1) * math.sqrt(thermal_diffusivity)
    return lambda wavenumber: numpy.sqrt(1j * SPEED_OF_SOUND * wavenumber + 0j) * factor / SPEED_OF_SOUND


def story_cylinders(areas=STORY_I):
    """The paper's own picture: one right cylinder a section."""
    return numpy.full(len(areas), STORY_SECTION), numpy.asarray(areas)


def linear_between_centres(areas, size_of_area, area_of_size, pieces=12):
    """A size (radius, half height) linear between the centres of sections, constant in the first and last half."""
    size = size_of_area(numpy.asarray(areas))
    fraction = (numpy.arange(pieces) + 0.5) / pieces
    inner = (size[:-1, None] * (1 - fraction) + size[1:, None] * fraction).ravel()
    half = [STORY_SECTION / 2]
    lengths = numpy.concatenate((half, numpy.full(inner.size, STORY_SECTION / pieces), half))
    return lengths, area_of_size(numpy.concatenate(([size[0]], inner, [size[-1]])))


def conical(areas=STORY_I, pieces=12):
    """Circular sections, radius linear between centres: the geometry of cases/vowel_i/tract.geo."""
    return linear_between_centres(areas, lambda a: numpy.sqrt(a / math.pi), lambda r: math.pi * r ** 2, pieces)


def cones(positions, areas, pieces=12):
    """Circular sections, radius linear between the areas at `positions` [m], the first at the glottis: lengths, areas and
    slopes."""
    radius = numpy.sqrt(numpy.asarray(areas) / math.pi)
    fraction = (numpy.arange(pieces) + 0.5) / pieces
    inner = (radius[:-1, None] * (1 - fraction) + radius[1:, None] * fraction).ravel()
    slopes = numpy.repeat(numpy.diff(radius) / numpy.diff(positions), pieces)
    return numpy.repeat(numpy.diff(positions) / pieces, pieces), math.pi * inner ** 2, slopes


def ducts_of_case(path):
    """The cylinders of a case of cases/vowel_i/tract.geo, and the radius of its mouth [m]."""
    with open(path, "rb") as file:
        parameters = tomllib.load(file)["mesh"]["parameters"]
    areas = parameters.get("area_unit", 1) * numpy.array(parameters["areas"])
    mouth = math.sqrt(areas[-1] / math.pi)
    if "stations" in parameters:
        return cones(parameters.get("station_unit", 1) * numpy.array(parameters["stations"]), areas), mouth
    section = parameters.get("section_length", STORY_SECTION)
    length = section * len(areas)
    positions = numpy.concatenate(([0], section * (numpy.arange(len(areas)) + 0.5), [length]))
    return cones(positions, numpy.concatenate((areas[:1], areas, areas[-1:]))), mouth


def planar(depth=0.015, areas=STORY_I, pieces=12):
    """Plane sections of full height area / depth, linear between centres: cases/vowel_i/larynx.geo [m]."""
    return linear_between_centres(areas, lambda a: a / depth, lambda h: h, pieces)


def entering(frequencies, ducts, radiation, shunt=None, admittance=0.0):
    """U_source / U_lips. radiation: Z / (rho c) of wavenumber; shunt: admittance seen backwards at the source."""
    k = 2 * math.pi * frequencies / SPEED_OF_SOUND
    lengths, areas, *slopes = ducts
    a, b, c, d = chain(lengths, areas, k, admittance, *slopes)
    load = radiation(k) * DENSITY * SPEED_OF_SOUND / areas[-1]
    flow = c * load + d
    return flow if shunt is None else flow + shunt(k) * (a * load + b)


def transfer(frequencies, ducts, radiation, shunt=None, admittance=0.0):
    """U_lips / U_source: the inverse of `entering`."""
    return 1 / entering(frequencies, ducts, radiation, shunt, admittance)


def poles(ducts, radiation, admittance=0.0, highest=6000.0):
    """Resonances as (frequency, bandwidth) [Hz], in rising order: the zeros of U_source / U_lips at complex frequencies
    f + i b / 2, by Newton's method from a grid of the half plane b > 0."""
    f, b = numpy.meshgrid(numpy.arange(100.0, highest, 100.0), [0.0, 100.0, 300.0, 600.0, 1000.0, 1500.0])
    z = (f + 0.5j * b).ravel()
    for _ in range(15):
        here = entering(z, ducts, radiation, admittance=admittance)
        slope = (entering(z + 1e-3, ducts, radiation, admittance=admittance) - here) / 1e-3
        step = here / slope
        z = z - step * numpy.minimum(1, 200 / numpy.maximum(numpy.abs(step), 1e-300))
    found = []
    for zero, last in sorted(zip(z, step), key=lambda pair: pair[0].real):
        frequency, bandwidth = zero.real, max(0.0, 2 * zero.imag)
        is_new = all(abs(frequency - other) > 1 or abs(bandwidth - width) > 1 for other, width in found)
        if is_new and abs(last) < 1e-3 and 1 < frequency < highest and -0.01 < zero.imag < 1000:
            found.append((frequency, bandwidth))
    return found


def closed_end_admittance(lengths, areas, k, end=0.0):
    """U / p looking into cylinders that end with the normalised admittance `end` (0 rigid, 1 absorbing)."""
    a, b, c, d = chain(lengths, areas, k)
    ending = end * areas[-1] / (DENSITY * SPEED_OF_SOUND)
    return (c + d * ending) / (a + b * ending)


def peaks(frequencies, response):
    """Frequencies [Hz] and 3 dB bandwidths [Hz, nan if none] of the local maxima of |response|."""
    level = numpy.abs(response)
    found = []
    for i in numpy.flatnonzero((level[1:-1] > level[:-2]) & (level[1:-1] >= level[2:])) + 1:
        left, right = i, i
        half = level[i] / math.sqrt(2)
        while left > 0 and level[left] > half:
            left -= 1
        while right < level.size - 1 and level[right] > half:
            right += 1
        bounded = level[left] <= half and level[right] <= half
        found.append((frequencies[i], frequencies[right] - frequencies[left] if bounded else math.nan))
    return found


def no_radiation(k):
    return numpy.zeros_like(k, dtype=complex)


def larynx_shunt(half_gap, lungs, subglottal_length=0.02):
    """Admittance of glottis (M5 fold in slices) and subglottal duct, in the plane; lungs: 0 rigid, 1 absorbing,
    infinitely large pressure release."""
    x = numpy.linspace(0, 0.7807, 79)
    middle = (x[1:] + x[:-1]) / 2
    fold = numpy.interp(middle, [0, 0.36579, 0.39610, 0.43269, 0.47285, 0.67683, 0.71616, 0.74994, 0.77268, 0.7807],
                        [0, 0.43593, 0.46338, 0.48162, 0.48931, 0.5, 0.49403, 0.47303, 0.44040, 0.40144])
    heights = 2 * (half_gap + 1e-2 * (0.5 - fold))[::-1]
    lengths = numpy.append(numpy.diff(x)[::-1] * 1e-2, subglottal_length)
    heights = numpy.append(heights, 2 * (half_gap + 0.005))
    return lambda k: closed_end_admittance(lengths, heights, k, lungs)


def with_ventricle(ducts, half_gap, depth=0.015, base=0.0006, length=0.002, slices=20):
    """The first `length` of a plane tract opened to the wedge-shaped ventricle of larynx.geo: as high as the laryngeal
    duct over `base`, then falling linearly to the tract's first height."""
    duct, tract = 2 * (half_gap + 0.005), STORY_I[0] / depth
    middle = (numpy.arange(slices) + 0.5) / slices
    lengths = [base] + [(length - base) / slices] * slices
    heights = [duct] + (duct + (tract - duct) * middle).tolist()
    replaced = length
    for piece, height in zip(*ducts):
        used = min(piece, replaced)
        replaced -= used
        if piece > used:
            lengths.append(piece - used)
            heights.append(height)
    return numpy.array(lengths), numpy.array(heights)


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
