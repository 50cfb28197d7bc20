"""Resonances of a chain of cylinders: peaks of its response, and poles at complex frequencies."""

import math

import numpy

from transmission_line import entering


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
