"""One Markdown file with the tables of several studies."""

import math

import figures
from mistakes import UserError
from study_table import markdown, section, shown

BEGIN = "<!-- studies: begin; written by ./vocalis study --table, do not edit -->"
END = "<!-- studies: end -->"
LEGEND = """Errors are relative to the reference, or to what stands after *of*; bold ones exceed the tolerance. Orders
and limits (Richardson) are of our three finest levels, without the reference; "not monotone": these tell no order."""


def write_table(evaluations, path):
    """Writes the tables of all studies into a file: a new one, or between the two marks of one that is there."""
    before, after = text_around(path)
    parts = [BEGIN, LEGEND, *overview(evaluations), *(section(evaluation) for evaluation in evaluations), END]
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(before + "\n\n".join(parts) + after, encoding="utf-8")
    except OSError as problem:
        raise UserError("--table must name a file that can be written", f"{path}: {problem.strerror}",
                        "choose another") from None


def text_around(path):
    """What a file holds before and after the tables; UserError if it is there without the marks."""
    if not path.exists():
        return "", "\n"
    try:
        before, found, rest = path.read_text(encoding="utf-8").partition(BEGIN)
    except (OSError, UnicodeDecodeError) as problem:
        raise UserError("--table must name a text file", f"{path}: {problem}", "choose another") from None
    _, closed, after = rest.partition(END)
    if not (found and closed):
        raise UserError("--table writes a new file, or between two marks of one that is there", f"{path} without them",
                        f"choose another, or write these two lines where the tables shall stand:\n{BEGIN}\n{END}")
    return before, after


def overview(evaluations):
    """One row a study, if there are several."""
    if len(evaluations) < 2:
        return []
    rows = [["study", "finest shown", "core-seconds", "largest error", "quantities within tolerance"]]
    for evaluation in evaluations:
        finest = shown(evaluation)[0].points[-1]
        errors, outcome = evaluation.errors[finest], evaluation.outcomes[finest]
        worst = max(errors, key=lambda name: abs(errors[name]), default=None)
        judged = [(name, target.tolerance()) for name, target in evaluation.targets.items() if target.tolerance()]
        met = sum(abs(errors.get(name, math.inf)) <= tolerance for name, tolerance in judged)
        rows.append([evaluation.study.name, evaluation.points[finest].label, figures.cost(outcome.core_seconds),
                     _worst(errors, worst) if worst else outcome.status,
                     f"{met} of {len(judged)}" if judged else "none asked"])
    return [markdown(rows)]


def _worst(errors, name):
    return f"{figures.signed_percent(errors[name])} % ({figures.quantity(name)})"
