"""A study as a Markdown table: levels, observed order, reference and its own uncertainty, error of the finest."""

import math
from dataclasses import dataclass

import figures
from case_values import same
from convergence import Convergence
from points import key_words, value_words

LEVELS = 3  # the finest so many are shown


@dataclass
class Shown:
    """Points of one table, coarse to fine, and the Line that they are of (None: a single point)."""

    points: list
    line: object = None


def shown(evaluation):
    """For each axis with an order the line to show, through what the case ships where it can; else that point alone."""
    found = []
    for axis in (axis for axis in evaluation.study.axes if axis.order):
        lines = [line for line in evaluation.lines if line.axis is axis]
        if lines:
            line = max(lines, key=lambda line: _merit(evaluation, line))
            found.append(Shown(line.points[-LEVELS:], line))
    if found:
        return found
    done = [i for i, outcome in enumerate(evaluation.outcomes) if outcome.finished]
    return [Shown([evaluation.default if evaluation.default is not None else done[-1] if done else 0])]


def _merit(evaluation, line):
    """Ways of computing as shipped first, then levels that are computed, then fine sizes of the other axes."""
    own, sizes, ways = line.axis.keys, 0.0, 0
    point = evaluation.points[line.points[0]]
    shipped = evaluation.points[evaluation.default].values if evaluation.default is not None else {}
    fine_axes = {key for axis in evaluation.study.axes if axis.order for key in axis.keys}
    for key, value in point.values.items():
        if key in fine_axes:
            sizes -= math.log(value) if key not in own and isinstance(value, (int, float)) and value > 0 else 0
        elif key not in own:
            ways += key in shipped and same(value, shipped[key])
    return ways, sum(evaluation.outcomes[i].finished for i in line.points), sizes


def section(evaluation):
    study = evaluation.study
    parts = [f"### {study.name}", f"{study.description.rstrip('.')}. `./vocalis study {study.path}`".lstrip(". ")]
    for view in shown(evaluation):
        parts += [_held(evaluation, view), _levels(evaluation, view)]
    sources = {}
    for name, target in evaluation.targets.items():
        sources.setdefault(target.reference.source or "not named", []).append(name)
    for source, names in sources.items():
        of = "" if len(sources) == 1 else f" of {', '.join(figures.quantity(name) for name in names)}"
        parts.append(f"Reference{of}: {source}.")
    notes = [f"- {figures.quantity(name)}: {target.reference.note}" for name, target in evaluation.targets.items()
             if target.reference.note]
    notes += [f"- {point.label}: failed, {outcome.reason}"
              for point, outcome in zip(evaluation.points, evaluation.outcomes) if outcome.status == "failed"]
    return "\n\n".join(part for part in parts + ["\n".join(notes)] if part)


def _held(evaluation, view):
    """What all points of a table have in common."""
    own = view.line.axis.keys if view.line else ()
    values = evaluation.points[view.points[0]].values
    parts = []
    for axis in evaluation.study.axes:
        if not set(axis.keys) & set(own) and all(key in values for key in axis.keys):
            parts.append(value_words(evaluation.study, axis, tuple(values[key] for key in axis.keys)))
    on_axes = {key for axis in evaluation.study.axes for key in axis.keys}
    parts += [key_words(evaluation.study, key, value) for key, value in values.items() if key not in on_axes]
    return f"All with {', '.join(parts)}:" if parts and view.line else f"{', '.join(parts)}:" if parts else ""


def _levels(evaluation, view):
    outcomes = [evaluation.outcomes[i] for i in view.points]
    if view.line:
        axis = view.line.axis
        head = [value_words(evaluation.study, axis, tuple(evaluation.points[i].values[key] for key in axis.keys))
                for i in view.points]
    else:
        head = [evaluation.points[view.points[0]].label]
    orders = ["order", "limit"] if view.line else []
    rows = [["quantity", *head, *orders, "reference", "its own uncertainty", "error of the finest", "tolerance"]]
    rows += [_row(evaluation, view, name) for name in evaluation.targets]
    blank = [""] * (len(orders) + 4)
    rows.append(["unknowns", *(f"{sum(outcome.unknowns.values()):,}" if outcome.unknowns else outcome.status
                               for outcome in outcomes), *blank])
    rows.append(["core-seconds", *(figures.cost(outcome.core_seconds) for outcome in outcomes), *blank])
    return markdown(rows)


def _row(evaluation, view, name):
    target, outcomes = evaluation.targets[name], [evaluation.outcomes[i] for i in view.points]
    found = evaluation.convergence(view.line, name) if view.line else Convergence()
    values = [outcome.results.get(name) for outcome in outcomes] + [found.limit, target.value]
    values, unit = figures.in_readable_unit(name, values)
    row = [figures.quantity(name) + (f" [{unit}]" if unit else "")]
    row += [figures.number(value) or ("none" if outcome.finished else outcome.status)
            for value, outcome in zip(values, outcomes)]
    if view.line:
        row += [figures.number(found.order, 3) or found.words, figures.number(values[-2])]
    error, tolerance = evaluation.errors[view.points[-1]].get(name), target.tolerance()
    shown_error = figures.signed_percent(error)
    if shown_error:
        shown_error += f" %{_of(target.reference.relative_to)}"
    if error is not None and tolerance is not None and abs(error) > tolerance:
        shown_error = f"**{shown_error}**"
    return row + [figures.number(values[-1]), _percent(target.uncertainty(), "not known"), shown_error,
                  _percent(tolerance, "")]


def _of(scale):
    if scale is None:
        return ""
    return f" of {figures.quantity(scale) if isinstance(scale, str) else figures.number(scale)}"


def _percent(value, otherwise):
    return otherwise if value is None else f"{figures.percent(value)} %"


def markdown(rows):
    """Markdown, the first column to the left and all others to the right."""
    lines = ["| " + " | ".join(str(cell).replace("|", "\\|") for cell in row) + " |" for row in rows]
    lines.insert(1, "| --- |" + " ---: |" * (len(rows[0]) - 1))
    return "\n".join(lines)
