"""study.html: the chart and every number behind it, on one page that needs no other file."""

import math

import figures
import page
from points import axis_name, words

ORDER_WORDS = """Of the three finest levels of each line; the limit is Richardson's, at size 0. Nothing is said of fewer
levels, nor where values do not change steadily."""
CAPTION = """Error against cost. Differences within the band say nothing: the reference is no better. Cost: user and
system time of all ranks, start and mesh with it."""
VALUES_CAPTION = """Results against what is varied. A ring marks what the case ships, a cross at the bottom a point
without this result."""


def write_page(evaluation, values, chart, path):
    """values, chart: pictures, each or None."""
    study = evaluation.study
    body = [_state(evaluation)]
    if values:
        body.append(page.picture(values, VALUES_CAPTION))
    if chart:
        body.append(page.picture(chart, CAPTION))
    body += ["<h2>Cost</h2>", _costs(evaluation)]
    for group, names in evaluation.groups().items():
        body += [f"<h2>{page.result_name(group)[0]}</h2>", _values(evaluation, names)]
    if evaluation.lines:
        body += ["<h2>Orders</h2>", f"<p>{ORDER_WORDS}</p>"] + [_orders(evaluation, line) for line in evaluation.lines]
    body += ["<h2>References</h2>", _references(evaluation)]
    path.write_text(page.page(study.name, study.description, "\n".join(body)), encoding="utf-8")
    return path


def _state(evaluation):
    """What is missing, and whether the case ships a point of the front."""
    lines = []
    states = [outcome.status for outcome in evaluation.outcomes]
    if "waiting" in states:
        lines.append(f'<p class="missing">{states.count("waiting")} of {len(states)} points are not computed yet.</p>')
    if "failed" in states:
        lines.append(f'<p class="missing">{states.count("failed")} of {len(states)} points failed.</p>')
    return "\n".join(lines + [f"<p>{page.escape(verdict(evaluation))}</p>"])


def verdict(evaluation):
    """One sentence about the point that the case ships."""
    i = evaluation.default
    if i is None:
        return "What the case ships is none of these points."
    if not math.isfinite(evaluation.largest[i]):
        return f"What the case ships ({evaluation.points[i].label}) has no complete result yet."
    better = evaluation.better_than_default()
    ships = f"The case ships {evaluation.points[i].label}, {_cost_and_error(evaluation, i)}"
    if better:
        return f"{ships}; {evaluation.points[better[0]].label} is better, {_cost_and_error(evaluation, better[0])}."
    return f"{ships}: {'on the front' if i in evaluation.front else 'no other costs clearly less and is as accurate'}."


def _cost_and_error(evaluation, i):
    cost = figures.cost(evaluation.outcomes[i].core_seconds)
    return f"{cost} core-seconds for {figures.percent(evaluation.largest[i])} %"


def _costs(evaluation):
    rows = []
    for i, (point, outcome) in enumerate(zip(evaluation.points, evaluation.outcomes)):
        marks = {"shipped": point.default, "front": i in evaluation.front, "reference": evaluation.of_reference(i)}
        marks = ", ".join(f"<b>{mark}</b>" for mark, set_here in marks.items() if set_here)
        label = page.escape(point.label) + (f" ({marks})" if marks else "")
        state = outcome.status if outcome.status != "failed" else f"failed: {page.escape(outcome.reason)}"
        unknowns = ", ".join(f"{count:,}".replace(",", "&#8239;") for count in outcome.unknowns.values())
        rows.append([label, (state, "bad" if outcome.status == "failed" else ""), figures.cost(outcome.wall_seconds),
                     figures.cost(outcome.core_seconds), outcome.ranks, figures.cost(outcome.memory_bytes / 2**20),
                     unknowns, outcome.steps or "", figures.percent(evaluation.largest[i], digits=3)])
    return page.table(rows, ["point", "state", "wall [s]", "core-seconds", "ranks", "MiB", "unknowns", "steps",
                             "largest error [%]"], {2, 3, 4, 5, 6, 7, 8})


def _values(evaluation, names):
    """Rows are points, two columns for each result: value, signed error."""
    head, columns = ["point"], [[page.escape(point.label) for point in evaluation.points] + ["reference"]]
    for name in names:
        target = evaluation.targets[name]
        values = [outcome.results.get(name) for outcome in evaluation.outcomes] + [target.value]
        values, unit = figures.in_readable_unit(name, values)
        head += [_with_unit(name, unit), "error [%]"]
        columns.append([figures.number(value) or (("none", "bad") if outcome.finished else "")
                        for value, outcome in zip(values, evaluation.outcomes)] + [figures.number(values[-1])])
        columns.append([_judged(error.get(name), target.tolerance()) for error in evaluation.errors]
                       + [f"± {figures.percent(target.uncertainty(), '?')}"])
    return page.table(zip(*columns), head, set(range(1, len(head))))


def _judged(error, tolerance):
    kind = "" if error is None or tolerance is None else "good" if abs(error) <= tolerance else "bad"
    return figures.signed_percent(error, 3), kind


def _with_unit(name, unit):
    return figures.quantity(name) + (f" [{unit}]" if unit else "")


def _orders(evaluation, line):
    first = evaluation.points[line.points[0]]
    others = [f"{key} {words(value)}" for key, value in first.values.items() if key not in line.axis.keys]
    name = axis_name(evaluation.study, line.axis)
    rows = []
    for result, target in evaluation.targets.items():
        found = evaluation.convergence(line, result)
        values = [evaluation.outcomes[i].results.get(result) for i in line.points] + [found.limit]
        values, unit = figures.in_readable_unit(result, values)
        rows.append([_with_unit(result, unit), *(figures.number(value) for value in values),
                     figures.signed_percent(target.error(found.limit), 3) if found.limit is not None else "",
                     figures.number(found.order, 3) or page.escape(found.words)])
    levels = [page.escape(f"{name} {words(size)}") for size in line.sizes]
    head = ["quantity", *levels, "limit", "its error [%]", "order"]
    title = f"<p><b>{page.escape(name)}</b>{page.escape(', with ' + ', '.join(others)) if others else ''}</p>"
    return title + page.table(rows, head, set(range(1, len(head))))


def _references(evaluation):
    rows = []
    for name, target in evaluation.targets.items():
        reference = target.reference
        values = [target.value, reference.uncertainty, reference.tolerance, target.scale]
        values, unit = figures.in_readable_unit(name, values)
        value, uncertainty, tolerance, scale = map(figures.number, values)
        rows.append([figures.quantity(name), value, uncertainty or "not known", tolerance, unit, scale,
                     page.escape(reference.source), page.escape(reference.note)])
    head = ["quantity", "value", "own uncertainty", "tolerance", "unit", "errors relative to", "source", "note"]
    return page.table(rows, head, {1, 2, 3, 5})
