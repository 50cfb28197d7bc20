"""study.png: error against core-seconds, the Pareto front, what the case ships, how sure the reference itself is."""

import math

import curves
import style
from marks import Marks
from panel import draw_panel
from panel_key import draw_key, front_words, height_of_key, legend_entries


def draw(evaluation, folder):
    """Writes study.png and returns its path; None while no point has all results. The first panel holds the largest
    error of each point, the others one quantity each."""
    if not evaluation.front:
        return None
    marks = Marks(evaluation.study, evaluation.points)
    entries, named = legend_entries(evaluation, marks), front_words(evaluation)
    groups = evaluation.groups() if len(evaluation.groups()) > 1 else {}
    columns = 2 if len(groups) in (2, 4) else 3
    rows = math.ceil(len(groups) / columns)
    heights = [max(4.0, height_of_key(entries, named))] + [2.5] * rows
    picture = style.pyplot.figure(figsize=(style.WIDTH, sum(heights)), constrained_layout=True)
    grid = picture.add_gridspec(1 + rows, 6, height_ratios=heights)
    main = picture.add_subplot(grid[0, :4])
    names = list(evaluation.targets)
    draw_panel(main, evaluation, marks, names, "largest error of all quantities" if groups else _title(names[0], names))
    main.set_ylabel("error [%]")
    main.set_xlabel("cost [core-seconds]")
    draw_key(picture.add_subplot(grid[0, 4:]), entries, named)
    width = 6 // columns
    for i, (group, members) in enumerate(groups.items()):
        place = width * (i % columns)
        axis = picture.add_subplot(grid[1 + i // columns, place:place + width], sharex=main)
        draw_panel(axis, evaluation, marks, members, _title(group, members), small=True)
        if place == 0:
            axis.set_ylabel("error [%]")
        if i + columns >= len(groups):
            axis.set_xlabel("cost [core-seconds]")
    return style.save(picture, folder, "study")


def _title(name, members):
    return curves.split_unit(name)[0].replace("_", " ") + (f", largest of {len(members)}" if len(members) > 1 else "")
