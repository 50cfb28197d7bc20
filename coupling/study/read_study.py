"""Reads a study file strictly; docs/study.md lists its keys."""

import pathlib
import re
import tomllib

from check_study import check_names, check_study
from expectations import with_expectations
from mistakes import UserError, did_you_mean
from strict_table import StrictTable, flat
from study import VARIATIONS, Axis, Chart, Reference, Study


def read_study(path):
    path = pathlib.Path(path)
    try:
        tree = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as problem:
        raise UserError("a study file must be readable", f"{path}: {getattr(problem, 'strerror', None) or problem}",
                        _files_nearby(path)) from None
    except tomllib.TOMLDecodeError as problem:
        raise UserError(f"{path}: must be a TOML file", str(problem), "mend this line, see docs/study.md") from None
    root = StrictTable(tree, str(path))
    head = StrictTable(root.take("study", dict, required=True), f"{path}, [study]")
    name = head.take("name", str, path.stem)
    if not re.fullmatch(r"[\w.+-]+", name):
        raise UserError(f"{path}, [study]: name becomes a folder's name", repr(name), "use letters, digits, _ . + -")
    settings = _settings(head, "set")
    settings["ranks"] = _ranks(head.take("ranks", int, settings.get("ranks", 1)), head.place)
    study = Study(path, name, head.take("description", str, ""), _case(path, head), settings,
                  head.take("vary", str, "grid"), [], [], [], {}, _settings(head, "reference_point"))
    of_the_case = head.take("expected", bool, True)
    head.end()
    if study.vary not in VARIATIONS:
        raise UserError(f"{path}, [study]: vary must be known", repr(study.vary), did_you_mean(study.vary, VARIATIONS))
    study.axes = [_axis(StrictTable(table, f"{path}, [[axis]] {i}"), study.vary) for i, table in _tables(root, "axis")]
    study.chosen_points = [_point(StrictTable(table, f"{path}, [[point]] {i}")) for i, table in _tables(root, "point")]
    for axis in study.axes:
        axis.values = axis.values or _values_of_points(axis, study.chosen_points)
    study.references = [_reference(StrictTable(table, f"{path}, [[reference]] {i}"))
                        for i, table in _tables(root, "reference")]
    check_names(study)
    if of_the_case:
        study.references = with_expectations(study.case, study.references)
    study.default = flat(root.take("default", dict, {}))
    if "chart" in root:
        study.chart = _chart(StrictTable(root.take("chart", dict), f"{path}, [chart]"), study.axes)
    root.end()
    check_study(study)
    return study


def _tables(root, key):
    return enumerate(root.take(key, list, []), 1)


def _settings(table, key):
    return flat(table.take(key, dict, {}))


def _ranks(value, place):
    if isinstance(value, bool) or not isinstance(value, int) or value < 1:
        raise UserError(f"{place}: ranks must be a whole number of at least 1", repr(value), "write ranks = 2")
    return value


def _case(path, head):
    case = (path.parent / head.take("case", str, required=True)).resolve()
    if not case.is_file():
        raise UserError(f"{path}, [study]: case must be a case file, its path as seen from the study file", case,
                        _files_nearby(case))
    return case


def _files_nearby(path):
    return did_you_mean(path.name, sorted(file.name for file in path.parent.glob("*.toml") if file != path))


def _axis(table, vary):
    keys = table.take_any("key")
    several = isinstance(keys, list)
    keys = tuple(keys) if several else (keys,)
    if not keys or not all(isinstance(key, str) and key for key in keys):
        raise UserError(f"{table.place}: key must name a key of the case, or a list of keys that change together",
                        repr(table.take_any("key")), 'write for example key = "mesh.parameters.size"')
    values = table.take("values", list, [])
    if not values and vary != "points":
        raise UserError(f"{table.place}: values must be at least one", f"{', '.join(keys)} without values",
                        "write for example values = [0.04, 0.02, 0.01]")
    if several and not all(isinstance(value, list) and len(value) == len(keys) for value in values):
        raise UserError(f"{table.place}: each of values must be a list with one value for each key",
                        f"{len(keys)} keys, {values}", "write for example values = [[0.04, 0.01], [0.02, 0.005]]")
    axis = Axis(keys, [tuple(value) if several else (value,) for value in values], table.take("label", str, ""),
                table.take("order", bool, False), table.take("unit", str, ""))
    table.end()
    for value in axis.values:
        for key, part in zip(keys, value):
            if key == "ranks":
                _ranks(part, table.place)
        if axis.order and not (isinstance(value[0], (int, float)) and value[0] > 0):
            raise UserError(f"{table.place}: an order needs sizes, numbers above 0", repr(value[0]),
                            "leave out order, or give sizes, the smaller the finer")
    return axis


def _chart(table, axes):
    """`x` names axes by one of their keys, all axes of numbers otherwise; `y` results. Each one or a list."""
    numbers = [axis for axis in axes
               if all(isinstance(value[0], (int, float)) and not isinstance(value[0], bool) for value in axis.values)]
    known = {key: axis for axis in numbers for key in axis.keys}
    keys = _one_or_more(table, "x", [axis.keys[0] for axis in numbers])
    for key in keys:
        if key not in known:
            raise UserError(f"{table.place}: x must be a key that an axis varies over numbers", repr(key),
                            did_you_mean(key, list(known)))
    chart = Chart([known[key] for key in keys], _one_or_more(table, "y", []))
    if not chart.axes or not chart.results:
        raise UserError(f"{table.place}: a chart needs an axis of numbers and a result",
                        f"{len(chart.axes)} and {len(chart.results)}", 'write for example y = "f0_Hz"')
    table.end()
    return chart


def _one_or_more(table, key, default):
    value = table.take_any(key, default)
    names = value if isinstance(value, list) else [value]
    if not all(isinstance(name, str) for name in names):
        raise UserError(f"{table.place}: {key} must be a name, or a list of names", repr(value),
                        f'write {key} = "NAME"')
    return names


def _point(table):
    settings = _settings(table, "set")
    label = table.take("label", str, "")
    table.end()
    if "ranks" in settings:
        _ranks(settings["ranks"], table.place)
    return label, settings


def _values_of_points(axis, chosen_points):
    """Of an axis without values, where only [[point]] tables are computed."""
    values = (tuple(settings.get(key) for key in axis.keys) for _, settings in chosen_points)
    return list(dict.fromkeys(value for value in values if None not in value))


def _reference(table):
    relative_to = table.take_any("relative_to")
    if relative_to is not None and not isinstance(relative_to, (int, float, str)) or relative_to == 0:
        raise UserError(f"{table.place}: relative_to must be a number other than 0, or the name of a result",
                        repr(relative_to), 'write for example relative_to = "lift_amplitude_N"')
    reference = Reference(table.take("result", str, required=True), table.take("value", float),
                          table.take("uncertainty", float), table.take("tolerance", float), relative_to,
                          table.take("group", str, ""), table.take("source", str, ""), table.take("note", str, ""))
    table.end()
    return reference
