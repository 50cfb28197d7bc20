"""A table of a TOML file that is read strictly: wrong types and keys that nobody asked for are the user's mistakes."""

import math

from mistakes import UserError, did_you_mean

WORDS = {str: "a text in quotes", bool: "true or false", int: "a whole number", float: "a finite number",
         dict: "a table", list: "a list"}


class StrictTable:
    def __init__(self, values, place):
        self.place = place
        self._values = values
        self._asked = []
        if not isinstance(values, dict):
            raise UserError(f"{place}: must be a table", repr(values), "write it as in docs/study.md")

    def __contains__(self, key):
        return key in self._values

    def take(self, key, kind, default=None, required=False):
        """The value of a key: of type `kind` (float takes whole numbers, too), or the default."""
        self._asked.append(key)
        if key not in self._values:
            if required:
                raise UserError(f"{self.place}: {key} must be given", self.unknown_or_nothing(),
                                f"write {key} = {WORDS[kind]}")
            return default
        value = self._values[key]
        right = isinstance(value, (int, float) if kind is float else kind)
        if isinstance(value, bool) and kind is not bool or kind is float and right and not math.isfinite(value):
            right = False
        if not right:
            raise UserError(f"{self.place}: {key} must be {WORDS[kind]}", repr(value), f"write {key} = {WORDS[kind]}")
        return value

    def take_any(self, key, default=None):
        self._asked.append(key)
        return self._values.get(key, default)

    def unknown_or_nothing(self):
        return ", ".join(key for key in self._values if key not in self._asked) or "nothing"

    def end(self):
        """Called when all keys were asked for: what is left is unknown."""
        for key in self._values:
            if key not in self._asked:
                raise UserError(f"{self.place}: this key is not known", f'"{key}"', did_you_mean(key, self._asked))


def flat(values, prefix=""):
    """Nested tables as one with points in its keys: {"time": {"dt": 1}} -> {"time.dt": 1}."""
    result = {}
    for key, value in values.items():
        if isinstance(value, dict):
            result |= flat(value, f"{prefix}{key}.")
        else:
            result[f"{prefix}{key}"] = value
    return result
