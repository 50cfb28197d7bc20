"""References that the case itself holds, in its [expected.NAME] tables: written once, judged by every run and study."""

from dataclasses import replace

from case_values import read_tree
from study import Reference


def with_expectations(case, references):
    """The study's references with what they leave open from the case, then all others that the case expects."""
    expected = {name: _reference(name, table) for name, table in read_tree(case).get("expected", {}).items()
                if isinstance(table, dict) and isinstance(table.get("value"), (int, float))}
    own = [_filled(reference, expected.pop(reference.result, None)) for reference in references]
    return own + list(expected.values())


def _reference(name, table):
    return Reference(name, float(table["value"]), table.get("spread") or None, table.get("tolerance") or None,
                     source=str(table.get("source", "")))


def _filled(reference, expected):
    """A study that gives its own value means another reference: nothing of the case's is mixed in."""
    if expected is None or reference.value is not None:
        return reference
    return replace(expected, uncertainty=reference.uncertainty or expected.uncertainty,
                   tolerance=reference.tolerance or expected.tolerance, source=reference.source or expected.source,
                   relative_to=reference.relative_to, group=reference.group, note=reference.note)
