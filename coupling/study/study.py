"""A study as data: a case, what is varied in it, and what its results should be."""

import pathlib
from dataclasses import dataclass

VARIATIONS = ("grid", "one_at_a_time", "points")


@dataclass
class Axis:
    """One or more keys of the case that change together. Each value is a tuple, one entry a key."""

    keys: tuple
    values: list
    label: str  # "" if the file gives none
    order: bool  # the first key is a size h: results converge as h -> 0
    unit: str = ""  # of the first key


@dataclass
class Chart:
    """Results against the values of some axes."""

    axes: list
    results: list


@dataclass
class Reference:
    """What a result should be. `value` None: taken from the study's reference point. All in the result's own unit."""

    result: str
    value: float | None = None
    uncertainty: float | None = None  # the reference's own
    tolerance: float | None = None
    relative_to: float | str | None = None  # errors are relative to this number, or to this result's reference
    group: str = ""  # results of one group share a panel of the chart
    source: str = ""
    note: str = ""


@dataclass
class Study:
    path: pathlib.Path
    name: str
    description: str
    case: pathlib.Path
    settings: dict  # of all points: key -> value; "ranks" among them
    vary: str
    axes: list
    chosen_points: list  # (label, settings) of each [[point]]
    references: list
    default: dict  # key -> value of the point that the case ships, as far as the file says
    reference_point: dict
    chart: Chart | None = None

    def varied_keys(self):
        """Every key that some point changes, in the order of the file."""
        keys = [key for axis in self.axes for key in axis.keys]
        keys += [key for _, settings in self.chosen_points for key in settings]
        return list(dict.fromkeys(keys))
