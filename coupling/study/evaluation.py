"""What a study says: errors of each point, the Pareto front, lines along the axes that have an order."""

import math
from dataclasses import dataclass

from case_values import same, same_settings
from convergence import convergence
from references import targets


EQUAL = 1e-3  # errors that differ by less, relative, are the same
CLEARLY = 0.9  # times measured twice differ by as much


@dataclass
class Line:
    """Points that differ in the sizes of one axis only, from coarse to fine."""

    axis: object
    points: list  # indices
    sizes: list


@dataclass
class Evaluation:
    study: object
    points: list
    outcomes: list
    targets: dict  # result -> Target
    errors: list  # of each point: result -> signed relative error
    largest: list  # of each point: largest |error| over all targets; nan if it has not all of them
    front: list  # indices of the points that no other beats in cost and error, cheapest first
    lines: list
    default: int | None  # index of the point that the case ships

    def of_reference(self, i):
        """Whether the errors are measured against this very point."""
        return any(target.reference.value is None for target in self.targets.values()) and all(
            same(self.points[i].values.get(key), value) for key, value in self.study.reference_point.items())

    def groups(self):
        """Quantity -> its results: drag -> [drag_mean_N, drag_amplitude_N]."""
        groups = {}
        for name, target in self.targets.items():
            groups.setdefault(target.group(), []).append(name)
        return groups

    def convergence(self, line, result):
        pairs = [(size, self.outcomes[i].results[result]) for i, size in zip(line.points, line.sizes)
                 if result in self.outcomes[i].results]
        return convergence([size for size, _ in pairs], [value for _, value in pairs])

    def better_than_default(self):
        """Indices of points that cost clearly less than the default and are as accurate, cheapest first."""
        i = self.default
        if i is None or not math.isfinite(self.largest[i]):
            return []
        cost = CLEARLY * self.outcomes[i].core_seconds
        return [j for j in self.front if self.outcomes[j].core_seconds < cost and self.largest[j] <= self.largest[i]]


def evaluate(study, points, outcomes):
    """Raises UserError if the reference point is none of the points."""
    found = targets(study, points, outcomes)
    errors = [{name: target.error(outcome.results[name]) for name, target in found.items() if name in outcome.results}
              for outcome in outcomes]
    largest = [max(map(abs, error.values())) if error and len(error) == len(found) else math.nan for error in errors]
    default = next((i for i, point in enumerate(points) if point.default), None)
    evaluation = Evaluation(study, points, outcomes, found, errors, largest, [], lines_of(study, points), default)
    candidates = [i for i in range(len(points)) if math.isfinite(largest[i]) and not evaluation.of_reference(i)]
    evaluation.front = pareto_front(candidates, [outcome.core_seconds for outcome in outcomes], largest)
    return evaluation


def pareto_front(candidates, costs, errors):
    """The candidates that no other beats, cheapest first: each is more accurate than all that cost no more."""
    front, best = [], math.inf
    for i in sorted(candidates, key=lambda i: (costs[i], errors[i])):
        if errors[i] < best * (1 - EQUAL):
            front.append(i)
            best = errors[i]
    return front


def along(points, axis):
    """Points that differ in this axis only: of each such bundle the values of all other keys, and what each point has
    for the axis' first key, with the point's index."""
    bundles = []
    for i, point in enumerate(points):
        if axis.keys[0] not in point.values:
            continue
        others = {key: value for key, value in point.values.items() if key not in axis.keys}
        bundle = next((bundle for bundle in bundles if same_settings(bundle[0], others)), None)
        if bundle is None:
            bundle = (others, [])
            bundles.append(bundle)
        bundle[1].append((point.values[axis.keys[0]], i))
    return bundles


def lines_of(study, points):
    """Lines along every axis with order = true; single points are none."""
    lines = []
    for axis in (axis for axis in study.axes if axis.order):
        for _, members in along(points, axis):
            members.sort(key=lambda member: -member[0])
            if len(members) > 1:
                lines.append(Line(axis, [i for _, i in members], [size for size, _ in members]))
    return lines
