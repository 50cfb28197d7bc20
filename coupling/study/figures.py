"""Numbers as people read them, alike in chart, page and table."""

import math

import numpy

import curves
import page


def number(value, digits=6):
    """Significant digits; nothing for what is not known."""
    return "" if value is None or not math.isfinite(value) else f"{value:.{digits}g}"


def cost(value):
    """[s] of wall or core time."""
    if value is None or not math.isfinite(value):
        return ""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def percent(value, otherwise="", digits=2):
    """Of a ratio, without the sign %."""
    return otherwise if value is None or not math.isfinite(value) else short(100 * value, digits)


def short(value, digits):
    """No powers of ten where a few digits say it, too."""
    return f"{value:,.0f}" if abs(value) >= 10**digits else f"{value:.{digits}g}"


def signed_percent(value, digits=2):
    text = percent(value, digits=digits)
    return text if not text or text.startswith("-") else f"+{text}"


def quantity(name):
    """Words of a result's name without its unit."""
    return page.result_name(name)[0]


def in_readable_unit(name, values):
    """Values of a result, None where there is none, in a unit in which they are not tiny: (values, unit)."""
    known = numpy.array([math.nan if value is None else value for value in values], dtype=float)
    scaled, unit = curves.readable(known, page.result_name(name)[1])
    return [None if math.isnan(value) else value for value in scaled], unit
