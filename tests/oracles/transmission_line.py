"""Short cylinders in a chain, by their transfer matrices, with walls that yield or rub:

    p_in = cos(kl) p_out + i (rho c / A) sin(kl) U_out,    U_in = i (A / rho c) sin(kl) p_out + cos(kl) U_out,

time convention exp(+i omega t). In the plane A is the height, a volume velocity per metre of depth."""

import math

import numpy

SPEED_OF_SOUND = 350.0  # [m/s]
DENSITY = 1.14  # [kg/m^3]


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


def closed_end_admittance(lengths, areas, k, end=0.0):
    """U / p looking into cylinders that end with the normalised admittance `end` (0 rigid, 1 absorbing)."""
    a, b, c, d = chain(lengths, areas, k)
    ending = end * areas[-1] / (DENSITY * SPEED_OF_SOUND)
    return (c + d * ending) / (a + b * ending)
