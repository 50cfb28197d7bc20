"""How the points of a study look in its chart: words by colour and marker, sizes by lines and the marker's size."""

from dataclasses import dataclass

import style
from case_values import same
from points import axis_name, value_words

MARKERS = ["o", "s", "^", "D", "v", "P", "X", "*"]
FILLS = ["full", "none", "left", "top"]


@dataclass
class Mark:
    colour: str
    marker: str = "o"
    fill: str = "full"
    size: float = 6.0

    def options(self):
        return {"color": self.colour, "marker": self.marker, "fillstyle": self.fill, "markersize": self.size,
                "markeredgewidth": 1.2, "linestyle": "none"}


class Marks:
    """Mark of each point, the lines that join them, and entries (words, Mark) of the legend."""

    def __init__(self, study, points):
        self._study = study
        spoken = [axis for axis in study.axes if any(isinstance(value[0], (str, bool)) for value in axis.values)]
        sizes = [axis for axis in study.axes if axis not in spoken and len(axis.values) > 1]
        sizes.sort(key=lambda axis: not axis.order)
        self._along = sizes[0] if sizes else None
        self._ways = list(zip(spoken + sizes[1:], self._shown_by(len(spoken), len(sizes))))
        self._apart = self._beside_the_axes(points)
        self.of = [self._apart.get(point.label) or self._mark(point) for point in points]
        self.lines = self._lines(points)

    @staticmethod
    def _shown_by(spoken, sizes):
        ways = ["colour and marker"] if spoken == 1 else ["colour", "marker", "fill"][:spoken]
        return ways + (["size"] if spoken or sizes < 3 else ["size", "colour and marker"])

    def _beside_the_axes(self, points):
        """Points that change what no axis does: label -> Mark of its own."""
        on_axes = {key for axis in self._study.axes for key in axis.keys}
        beside = [key for key in self._study.varied_keys() if key not in on_axes]
        labels = [point.label for point in points if any(key in point.settings for key in beside)]
        return {label: Mark(style.COLOURS[-1 - i % len(style.COLOURS)], MARKERS[-1 - i % len(MARKERS)], size=7.5)
                for i, label in enumerate(labels)}

    def _mark(self, point):
        mark = Mark(style.COLOURS[0])
        for axis, way in self._ways:
            i = self._number(axis, point)
            if i is not None:
                self._apply(mark, way, i, len(axis.values))
        return mark

    @staticmethod
    def _apply(mark, way, i, count):
        if "colour" in way:
            mark.colour = style.COLOURS[i % len(style.COLOURS)]
        if "marker" in way:
            mark.marker = MARKERS[i % len(MARKERS)]
        if way == "fill":
            mark.fill = FILLS[i % len(FILLS)]
        if way == "size":
            mark.size = 9.0 - 5.0 * i / max(1, count - 1)

    def _number(self, axis, point):
        """Which value of the axis a point has; None if it is on none of them."""
        values = [tuple(value) for value in axis.values]
        own = tuple(point.values.get(key) for key in axis.keys)
        return next((i for i, value in enumerate(values) if all(map(same, value, own))), None)

    def _lines(self, points):
        """Indices of points that differ in the main size only, in its order."""
        if not self._along:
            return []
        bundles = {}
        for i, point in enumerate(points):
            others = repr(sorted((key, value) for key, value in point.values.items() if key not in self._along.keys))
            bundles.setdefault(others, []).append(i)
        for bundle in bundles.values():
            bundle.sort(key=lambda i: -points[i].values.get(self._along.keys[0], 0))
        return [bundle for bundle in bundles.values() if len(bundle) > 1]

    def legend(self):
        """(words, Mark) for every value that has a look of its own."""
        entries = []
        for axis, way in self._ways:
            for i, value in enumerate(axis.values):
                mark = Mark("#555555" if "colour" not in way else style.COLOURS[0])
                self._apply(mark, way, i, len(axis.values))
                entries.append((value_words(self._study, axis, value), mark))
        return entries + list(self._apart.items())

    def line_words(self):
        return f"joined: {axis_name(self._study, self._along)}" if self._along else ""
