"""Vocal tracts and the larynx below them as chains of cylinders: lengths and areas [m, m^2], in the plane heights [m]."""

import math
import tomllib

import numpy

from transmission_line import closed_end_admittance

# Story, Titze and Hoffman 1996, J. Acoust. Soc. Am. 100, 537: /i/, glottis to lips [m^2]; sections 350 / (2 * 44100) m.
STORY_SECTION = 0.00396825
STORY_I = 1e-4 * numpy.array([
    0.33, 0.30, 0.36, 0.34, 0.68, 0.50, 2.43, 3.15, 2.66, 2.49, 3.39, 3.80, 3.78, 4.35, 4.50, 4.43, 4.68, 4.52, 4.15,
    4.09, 3.51, 2.95, 2.03, 1.66, 1.38, 1.05, 0.60, 0.35, 0.32, 0.12, 0.10, 0.16, 0.25, 0.24, 0.38, 0.28, 0.36, 0.65,
    1.58, 2.05, 2.01, 1.58])


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
