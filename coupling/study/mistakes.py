"""The user's mistakes: the rule, the value found and what to do, as the program itself words them (exit code 2)."""

import difflib


class UserError(Exception):
    def __init__(self, rule, value=None, remedy=None):
        super().__init__(rule if remedy is None else f"{rule}\n  found: {value}\n  remedy: {remedy}")


def did_you_mean(word, names):
    """A remedy: the nearest of the names, or all of them."""
    names = [str(name) for name in names]
    near = difflib.get_close_matches(str(word), names, 1, 0.6)
    if near:
        return f'did you mean "{near[0]}"? (possible here: {", ".join(names)})'
    return f"choose one of: {', '.join(names)}" if names else "there is nothing to choose from"
