"""The points of a study: which combinations of values are computed, their names and folders."""

import itertools
import re
from dataclasses import dataclass, field

from case_values import same, same_settings
from mistakes import UserError


@dataclass
class Point:
    label: str
    settings: dict  # what is changed in the case, "ranks" among it
    values: dict = field(default_factory=dict)  # of every varied key: set here, or in the case; unknown: left out
    folder: str = ""
    default: bool = False  # what the case ships


def make_points(study, base):
    """All points, each combination once. `base`: the value that each varied key has in the case, as far as known."""
    shipped = base | study.default
    varied = study.varied_keys()
    common = {key: value for key, value in study.settings.items() if key in varied}
    points = []
    for label, chosen in _combinations(study, shipped):
        settings = study.settings | chosen
        if not any(same_settings(settings, other.settings) for other in points):
            points.append(Point(label or _label(study, chosen), settings, base | common | chosen))
    used = set()
    for point in points:
        folder = name = re.sub(r"[^\w.+-]+", "_", point.label).strip("_.") or "point"
        for number in itertools.count(2):
            if folder not in used:
                break
            folder = f"{name}_{number}"
        used.add(folder)
        point.folder = folder
        point.default = all(key in shipped and same(point.values.get(key), shipped[key]) for key in varied)
    return points


def point_of(points, values):
    """The first point that has all of these values, or None."""
    return next((point for point in points
                 if all(key in point.values and same(point.values[key], value) for key, value in values.items())), None)


def _combinations(study, shipped):
    if study.vary == "grid" and study.axes:
        for values in itertools.product(*(axis.values for axis in study.axes)):
            yield "", {key: part for axis, value in zip(study.axes, values) for key, part in zip(axis.keys, value)}
    if study.vary == "one_at_a_time":
        middle = {}
        for key in (key for axis in study.axes for key in axis.keys):
            if key not in shipped:
                raise UserError(f"{study.path}: one axis at a time is varied from the case's own values",
                                f"no value of {key} in the case", f'name it: [default] "{key}" = VALUE')
            middle[key] = shipped[key]
        for axis in study.axes:
            for value in axis.values:
                yield "", middle | dict(zip(axis.keys, value))
    yield from study.chosen_points


def _label(study, chosen):
    """Words such as "P2P1, size 0.02": what distinguishes this point from the others."""
    parts = []
    for axis in study.axes:
        if all(key in chosen for key in axis.keys):
            parts.append(value_words(study, axis, tuple(chosen[key] for key in axis.keys)))
    on_axes = {key for axis in study.axes for key in axis.keys}
    parts += [key_words(study, key, value) for key, value in chosen.items() if key not in on_axes]
    return ", ".join(parts) or "as it is"


def axis_name(study, axis):
    return axis.label or " and ".join(short_name(study, key) for key in axis.keys)


def value_words(study, axis, value):
    """A value of an axis with its name, unless it speaks for itself: "P2P1", "size 0.02", "size 0.02 dt 0.01"."""
    if axis.label:
        return f"{axis.label} {' / '.join(words(part) for part in value)}"
    return " ".join(key_words(study, key, part) for key, part in zip(axis.keys, value))


def key_words(study, key, value):
    return value if isinstance(value, str) else f"{short_name(study, key)} {words(value)}"


def short_name(study, key):
    """The last name of a key, or all of it where two keys share that."""
    last = key.rpartition(".")[2]
    shared = any(other != key and other.rpartition(".")[2] == last for other in study.varied_keys())
    return key if shared else last


def words(value):
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:.6g}" if isinstance(value, float) else str(value)
