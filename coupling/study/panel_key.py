"""Beside the chart: what its marks mean, and which the points of the Pareto front are."""

import textwrap

from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import figures
from panel import DASHES, DEFAULT, FRONT, SURE, TOLERANCE, UNSURE, named_points, tolerance, uncertainties

GREY = "#555555"
LINE = 46  # letters in one


def legend_entries(evaluation, marks):
    """(handle, words) of all that some panel shows."""
    entries = [(Line2D([], [], **mark.options()), words) for words, mark in marks.legend()]
    if marks.line_words():
        entries.append((Line2D([], [], color=GREY, linewidth=0.8), marks.line_words()))
    entries.append((Line2D([], [], color=FRONT, linewidth=1.2), "Pareto front"))
    if evaluation.default is not None:
        entries.append((Line2D([], [], marker="o", markersize=12, fillstyle="none", color=DEFAULT, linestyle="none"),
                        "what the case ships"))
    known = uncertainties(evaluation, evaluation.targets)
    if known and min(known) < max(known):
        entries += [(Patch(color=SURE), "uncertainty of all references"),
                    (Patch(color=UNSURE), "uncertainty of some references")]
    elif known:
        entries.append((Patch(color=SURE), "the reference's own uncertainty"))
    shared = [tolerance(evaluation, names) for names in [list(evaluation.targets), *evaluation.groups().values()]]
    if any(shared):
        entries.append((Line2D([], [], color=TOLERANCE, linewidth=0.9, linestyle=DASHES), "tolerance"))
    if any(outcome.status == "failed" or outcome.finished and len(error) < len(evaluation.targets)
           for outcome, error in zip(evaluation.outcomes, evaluation.errors)):
        entries.append((Line2D([], [], color=GREY, marker="x", linestyle="none", markeredgewidth=1.6),
                        "failed, or gave no value"))
    return entries


def front_words(evaluation):
    """The numbered points with cost and error, one or two lines each."""
    named = named_points(evaluation)
    lines = ["On the front:"]
    for number, i in enumerate(named, 1):
        label = textwrap.fill(evaluation.points[i].label, LINE, subsequent_indent="    ")
        lines.append(f"{number}  {label}\n    {figures.cost(evaluation.outcomes[i].core_seconds)} core-s, "
                     f"{figures.percent(evaluation.largest[i])} %")
    if len(named) < len(evaluation.front):
        lines.append(f"and {len(evaluation.front) - len(named)} more between them")
    return "\n".join(lines)


def height_of_key(entries, named):
    """[inch]"""
    return 0.195 * len(entries) + 0.145 * (named.count("\n") + 1) + 0.6


def draw_key(axis, entries, named):
    axis.set_axis_off()
    legend = axis.legend(*zip(*entries), loc="upper left", bbox_to_anchor=(0, 1), frameon=False, fontsize=8.5,
                         borderaxespad=0, labelspacing=0.45)
    legend.set_in_layout(False)
    words = axis.text(0, 0, named, transform=axis.transAxes, va="bottom", fontsize=8, linespacing=1.25)
    words.set_in_layout(False)
