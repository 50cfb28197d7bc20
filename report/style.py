"""One look for all pictures: sizes, colours, saving."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as pyplot  # noqa: E402

WIDTH = 9.0  # [inch] of every picture: the width of a printed page
COLOURS = ["#1f5a92", "#b5462f", "#3b7d4f", "#8a5a9e", "#b8860b", "#4c9aa6", "#7a7a7a", "#c06c84"]
KIND_COLOURS = {"fluid": "#a9cbe6", "air": "#d9eef0", "solid": "#e8b18f"}
SOLID = "#d9c7b8"

pyplot.rcParams.update({
    "font.size": 9.5,
    "axes.titlesize": 9.5,
    "axes.labelsize": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": False,
    "grid.color": "#e4e4e4",
    "axes.prop_cycle": matplotlib.cycler(color=COLOURS),
    "figure.dpi": 100,
    "savefig.dpi": 130,
    "lines.linewidth": 1.2,
})


def figure(rows=1, columns=1, height=2.6, **options):
    """A figure of the page's width; `height` [inch] is that of one row. Axes always as a 2-D array."""
    return pyplot.subplots(rows, columns, figsize=(WIDTH, height * rows), squeeze=False,
                           constrained_layout=True, **options)


def save(picture, folder, name):
    """Writes folder/name.png and forgets the figure; returns the path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.png"
    picture.savefig(path, bbox_inches="tight", pad_inches=0.06)
    pyplot.close(picture)
    return path
