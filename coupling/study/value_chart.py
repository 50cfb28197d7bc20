"""values.png: results against what is varied, as [chart] asks: a row a result, a column an axis."""

import math

import curves
import figures
import numpy
import style
from evaluation import along
from matplotlib.ticker import MaxNLocator
from points import axis_name, key_words

SHIPPED = "#222222"


def draw(evaluation, folder):
    """Writes values.png and returns its path; None if the study asks for none, or while no point has such a result."""
    chart = evaluation.study.chart
    given = {name for outcome in evaluation.outcomes for name in outcome.results}
    if not chart or given.isdisjoint(chart.results):
        return None
    picture, panels = style.figure(len(chart.results), len(chart.axes), height=2.3, sharex="col", sharey="row")
    for row, name in zip(panels, chart.results):
        results, unit = figures.in_readable_unit(name, [outcome.results.get(name) for outcome in evaluation.outcomes])
        results = numpy.array([math.nan if value is None else value for value in results])
        for panel, axis in zip(row, chart.axes):
            _draw_panel(panel, evaluation, axis, results)
        row[0].set_ylabel(_with_unit(figures.quantity(name), unit))
    for panel, axis in zip(panels[-1], chart.axes):
        panel.set_xlabel(_with_unit(axis_name(evaluation.study, axis), _places(evaluation, axis)[1]))
    return style.save(picture, folder, "values")


def _draw_panel(panel, evaluation, axis, results):
    """Points that differ in this axis only are joined. What the case ships has a ring, a point that failed, or has no
    such result, a cross at the bottom."""
    places, _ = _places(evaluation, axis)
    lines = along(evaluation.points, axis)
    lines = [line for line in lines if len(line[1]) > 1] or lines
    for others, members in lines:
        members = [i for _, i in sorted(members)]
        known = [i for i in members if math.isfinite(results[i])]
        lost = [i for i in members if i not in known and evaluation.outcomes[i].status != "waiting"]
        line, = panel.plot(places[known], results[known], marker="o", label=_words(evaluation, others, lines))
        panel.plot(places[lost], [0.04] * len(lost), transform=panel.get_xaxis_transform(), marker="x",
                   linestyle="none", color=line.get_color())
        if evaluation.default in known:
            panel.plot(places[evaluation.default], results[evaluation.default], marker="o", markersize=13,
                       fillstyle="none", linestyle="none", color=SHIPPED)
    panel.grid(True)
    panel.margins(0.1)
    panel.xaxis.set_major_locator(MaxNLocator(6))
    if len(lines) > 1:
        panel.legend(fontsize=7.5, frameon=False)


def _places(evaluation, axis):
    """Of each point the value of the axis' first key, nan where it has none: (values, unit), in a unit in which they
    are not tiny."""
    values = [point.values.get(axis.keys[0], math.nan) for point in evaluation.points]
    return curves.readable(numpy.array(values, dtype=float), axis.unit)


def _words(evaluation, others, lines):
    """What tells a line from the others of its panel."""
    differing = [key for key in others if any(line[0].get(key) != others[key] for line in lines)]
    return ", ".join(key_words(evaluation.study, key, others[key]) for key in differing)


def _with_unit(words, unit):
    return words + (f" [{unit}]" if unit else "")
