"""What the case itself says about the keys that a study varies, and whether the program takes them."""

import tomllib

from case_values import read_tree, value_of
from mistakes import UserError


def base_values(study, program):
    """Value of each varied key in the case: of its file, or the program's default, which `check` tells. A key that
    neither knows is left out (a parameter of the geometry)."""
    tree = read_tree(study.case)
    values = {key: value_of(tree, key) for key in study.varied_keys()}
    if "ranks" in values:
        values["ranks"] = study.settings["ranks"]
    if None in values.values():
        code, resolved, said = program.check(study.case, study.settings)
        if code == 2:
            raise refused(study, "the case as it is", said)
        try:
            tree = tomllib.loads(resolved)
        except tomllib.TOMLDecodeError:
            tree = {}
        values = {key: value_of(tree, key) if value is None else value for key, value in values.items()}
    return {key: value for key, value in values.items() if value is not None}


def check_points(study, program, points):
    """Has the program check one point of each combination of words and truth values, before hours are spent on the
    first. Numbers are taken on trust: a fine mesh would take its time, and a wrong key shows with any number."""
    seen = []
    for point in points:
        kind = {key: None if isinstance(value, (int, float)) and not isinstance(value, bool) else value
                for key, value in point.settings.items()}
        if kind in seen:
            continue
        seen.append(kind)
        code, _, said = program.check(study.case, point.settings)
        if code == 2:
            raise refused(study, point.label, said)


def refused(study, label, said):
    return UserError(f"{study.path}: the program does not take the point \"{label}\"\n{said.removeprefix('vocalis: ')}")
