"""What the mouth of a duct radiates into: pistons in an infinite baffle, Z / (rho c) by the wavenumber times a size."""

import math

import numpy


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


def no_radiation(k):
    return numpy.zeros_like(k, dtype=complex)
