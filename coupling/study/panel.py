"""One panel of the chart: the largest error of some results against cost, on logarithmic axes."""

import math

import numpy
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

FRONT, DEFAULT, TOLERANCE = "#222222", "#222222", "#777777"
SURE, UNSURE = "#dfd7c4", "#efeae0"  # below the smallest and the largest uncertainty of the references
DASHES = (0, (4, 3))
MOST_NAMED = 8  # points of the front that are named beside the chart


def draw_panel(axis, evaluation, marks, names, title, small=False):
    """Points that failed or have no value stand at the top; a small panel leaves the front out, which is that of all
    results."""
    costs = [outcome.core_seconds for outcome in evaluation.outcomes]
    errors = errors_percent(evaluation, names)
    drawn = [i for i, error in enumerate(errors) if error > 0 and not evaluation.of_reference(i)]
    _limits(axis, evaluation, names, [errors[i] for i in drawn])
    for line in marks.lines:
        line = [i for i in line if i in drawn]
        if line:
            axis.plot([costs[i] for i in line], [errors[i] for i in line], color=marks.of[line[0]].colour,
                      linewidth=0.7, alpha=0.6, zorder=2)
    if not small:
        _front(axis, evaluation)
    for i in drawn:
        axis.plot(costs[i], errors[i], zorder=4, **marks.of[i].options())
    for i in range(len(costs)):
        if i not in drawn and math.isfinite(costs[i]) and not evaluation.of_reference(i) and not errors[i] == 0:
            axis.plot(costs[i], 0.955, transform=axis.get_xaxis_transform(), marker="x", markersize=7,
                      markeredgewidth=1.6, color=marks.of[i].colour, linestyle="none", zorder=4, clip_on=False)
    if evaluation.default in drawn:
        axis.plot(costs[evaluation.default], errors[evaluation.default], marker="o", markersize=15, fillstyle="none",
                  markeredgewidth=1.5, color=DEFAULT, zorder=5)
    axis.set_title(title, loc="left")
    axis.grid(True, which="major", zorder=0)
    axis.margins(x=0.08)
    _ticks(axis.xaxis, [costs[i] for i in drawn], 4 if small else 6)
    _ticks(axis.yaxis, axis.get_ylim(), 5)


def errors_percent(evaluation, names):
    """Of each point the largest |error| of the named results [%]; nan where one is missing."""
    return [100 * max(abs(error[name]) for name in names) if all(name in error for name in names) else math.nan
            for error in evaluation.errors]


def uncertainties(evaluation, names):
    """Of the references to these results, relative, where they are known."""
    known = (evaluation.targets[name].uncertainty() for name in names)
    return [value for value in known if value]


def tolerance(evaluation, names):
    """The tolerance that all of these results share; None if there is none, or they differ."""
    asked = {round(value, 9) for value in (evaluation.targets[name].tolerance() for name in names) if value}
    return asked.pop() if len(asked) == 1 else None


def _limits(axis, evaluation, names, errors):
    """Scales, the reference's own uncertainty as a band, the tolerance as a dashed line."""
    axis.set_xscale("log")
    axis.set_yscale("log")
    known, asked = [100 * value for value in uncertainties(evaluation, names)], tolerance(evaluation, names)
    marked = known + ([100 * asked] if asked else [])
    bottom, top = min(errors + marked, default=0.1) / 2, max(errors + marked, default=1.0) * 3
    axis.set_ylim(bottom, top)
    if known:
        axis.axhspan(bottom, max(known), color=UNSURE, zorder=0, linewidth=0)
        axis.axhspan(bottom, min(known), color=SURE, zorder=0, linewidth=0)
    if asked:
        axis.axhline(100 * asked, color=TOLERANCE, linewidth=0.9, linestyle=DASHES, zorder=1)


def _ticks(axis, values, most):
    """Plain numbers; between the powers of ten, too, where there are few of them."""
    decades = math.log10(max(values) / min(values)) if len(values) > 1 and min(values) > 0 else 1
    if decades < 0.8:
        axis.set_major_locator(MaxNLocator(most))
        axis.set_minor_locator(NullLocator())
    else:
        axis.set_major_locator(LogLocator(10, subs=(1, 2, 5) if decades * 3 < most else (1,), numticks=12))
    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.set_minor_formatter(NullFormatter())


def _front(axis, evaluation):
    """The front as stairs: what can be had for a cost. The key beside the panel tells which its numbered points are."""
    costs = numpy.array([evaluation.outcomes[i].core_seconds for i in evaluation.front])
    errors = numpy.array([100 * evaluation.largest[i] for i in evaluation.front])
    axis.step(numpy.append(costs[0], costs), numpy.append(axis.get_ylim()[1], errors), where="post", color=FRONT,
              linewidth=1.0, zorder=3)
    for number, i in enumerate(named_points(evaluation), 1):
        axis.annotate(str(number), (evaluation.outcomes[i].core_seconds, 100 * evaluation.largest[i]), xytext=(-9, -9),
                      textcoords="offset points", ha="center", va="center", fontsize=8.5, fontweight="bold", zorder=6)


def named_points(evaluation):
    """Points of the front that stand far enough from each other to be numbered, at most MOST_NAMED, spread over it."""
    front = evaluation.front
    places = [(math.log(evaluation.outcomes[i].core_seconds), math.log(max(evaluation.largest[i], 1e-12)))
              for i in front]
    spread = [max(abs(places[0][k] - places[-1][k]), 1.0) for k in (0, 1)]
    kept = []
    for n in reversed(range(len(front))):  # from the accurate end
        far = (max(abs(places[n][k] - places[m][k]) / spread[k] for k in (0, 1)) for m in kept)
        if all(distance > 0.05 for distance in far):
            kept.append(n)
    if len(kept) > MOST_NAMED:
        kept = [kept[round(n)] for n in numpy.linspace(0, len(kept) - 1, MOST_NAMED)]
    return [front[n] for n in sorted(kept)]
