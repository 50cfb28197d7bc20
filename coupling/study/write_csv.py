"""study.csv: one row for each point and result, units in the header."""

import csv
import math
import os

COLUMNS = ["point", "default", "front", "status", "reason", "result", "value", "reference", "reference_uncertainty",
           "tolerance", "error_percent", "largest_error_percent", "wall_s", "core_s", "ranks", "ranks_times_wall_s",
           "peak_memory_bytes", "steps", "unknowns", "points_at_once", "version", "build"]
NOTES = {
    "value": "with reference, reference_uncertainty and tolerance in the unit that ends the result's name",
    "error_percent": "of |reference|, or of relative_to where the study gives it; the largest is over all references",
    "wall_s": "the whole start of the program: mesh, steps, results",
    "core_s": "user and system time of all ranks of that start",
    "points_at_once": "above 1: points shared the cores while they were measured",
}


def write_csv(evaluation, path):
    study = evaluation.study
    keys = study.varied_keys()
    with open(path, "w", newline="", encoding="utf-8") as file:
        notes = {"study": study.name, "case": study.case.name, "cores of the machine": os.cpu_count()} | NOTES
        file.writelines(f"# {key}: {value}\n" for key, value in notes.items())
        writer = csv.writer(file, lineterminator="\n")
        varied = [key if key not in COLUMNS else f"{key}_set" for key in keys]
        writer.writerow(COLUMNS[:1] + varied + COLUMNS[1:])
        for i, point in enumerate(evaluation.points):
            names = sorted(evaluation.outcomes[i].results, key=lambda name: _place(evaluation, name)) or [""]
            for name in names:
                row = _row(evaluation, i, name)
                writer.writerow([point.label] + [point.values.get(key, "") for key in keys] + row)


def _place(evaluation, name):
    """Results with a reference first, in the order of the study."""
    names = list(evaluation.targets)
    return names.index(name) if name in names else len(names)


def _row(evaluation, i, name):
    outcome, target = evaluation.outcomes[i], evaluation.targets.get(name)
    error = evaluation.errors[i].get(name)
    reference = target.reference if target else None
    row = [_yes(evaluation.points[i].default), _yes(i in evaluation.front), outcome.status, outcome.reason, name,
           outcome.results.get(name), target.value if target else None, reference.uncertainty if reference else None,
           reference.tolerance if reference else None, None if error is None else 100 * error,
           100 * evaluation.largest[i], outcome.wall_seconds, outcome.core_seconds, outcome.ranks,
           outcome.ranks * outcome.wall_seconds, outcome.memory_bytes, outcome.steps, sum(outcome.unknowns.values()),
           outcome.at_once, outcome.version, outcome.build]
    return ["" if value is None or isinstance(value, float) and not math.isfinite(value) else
            f"{value:.9g}" if isinstance(value, float) else value for value in row]


def _yes(truth):
    return "yes" if truth else "no"
