"""How far the results of a point are from what they should be."""

import re
from dataclasses import dataclass

from mistakes import UserError, did_you_mean
from points import point_of
from study import Reference

STATISTIC = r"_(mean|amplitude|frequency|max|min|peak)(_.*)?$"  # and what follows it


@dataclass
class Target:
    """A reference whose value is known, and the scale that its errors are relative to. In the result's unit."""

    reference: Reference
    value: float
    scale: float

    def error(self, value):
        """Signed, relative."""
        return (value - self.value) / self.scale

    def uncertainty(self):
        """Of the reference itself, relative; None if it is not known."""
        return None if self.reference.uncertainty is None else self.reference.uncertainty / self.scale

    def tolerance(self):
        return None if self.reference.tolerance is None else self.reference.tolerance / self.scale

    def group(self):
        """Results of one quantity, such as drag_mean_N and drag_amplitude_N, share a panel."""
        return self.reference.group or re.sub(STATISTIC, "", self.reference.result)


def targets(study, points, outcomes):
    """Result -> Target, in the file's order. A reference without value takes that of the reference point, and is left
    out until that point is computed; without any [[reference]] all results of that point are references."""
    best = point_of(points, study.reference_point) if study.reference_point else None
    if study.reference_point and not best:
        settings = ", ".join(f"{key} = {value}" for key, value in study.reference_point.items())
        raise UserError(f"{study.path}: reference_point must be one of the points", settings,
                        "name values that one point has, or add that point")
    fine = outcomes[points.index(best)].results if best else {}
    references = study.references or [Reference(name) for name in fine]
    values = {reference.result: fine.get(reference.result) if reference.value is None else reference.value
              for reference in references}
    found = {}
    for reference in references:
        value = values[reference.result]
        scale = reference.relative_to if reference.relative_to is not None else value
        scale = values[scale] if isinstance(scale, str) else scale
        if value is not None and scale:
            if reference.value is None and not reference.source:
                reference.source = f"our own finest point: {best.label}"
            found[reference.result] = Target(reference, value, abs(scale))
    return found


def missing_results(study, outcomes):
    """A UserError for the first result of a reference or of the chart that no finished run gave; None if there is
    none."""
    if not any(outcome.finished for outcome in outcomes):
        return None
    given = sorted({name for outcome in outcomes for name in outcome.results})
    asked = [("a reference", reference.result) for reference in study.references]
    asked += [("a chart", name) for name in (study.chart.results if study.chart else ())]
    for what, name in asked:
        if name not in given:
            return UserError(f"{study.path}: {what} must be of a result that the runs give", f'"{name}"',
                             did_you_mean(name, given))
    return None
