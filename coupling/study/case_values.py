"""What value a key has in a case: the same paths as --set takes, in the tree of a case file."""

import hashlib
import json
import pathlib
import tomllib

from mistakes import UserError


def read_tree(path):
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as problem:
        raise UserError(f"{path}: must be a TOML file", str(problem), "mend this line") from None


def value_of(tree, key):
    """The value at a path such as "region.cover.young_modulus"; of unnamed tables of an array the first that has it.
    None if there is no such key."""
    return _descend(tree, key.split("."))


def _descend(node, parts):
    if not parts:
        return node
    if isinstance(node, dict):
        return _descend(node[parts[0]], parts[1:]) if parts[0] in node else None
    if isinstance(node, list):
        named = [item for item in node if isinstance(item, dict) and parts[0] in (item.get("name"), item.get("group"))]
        if not named and parts[0].isdigit() and int(parts[0]) < len(node):
            named = [node[int(parts[0])]]
        found = (_descend(item, parts[1:] if named else parts) for item in named or node)
        return next((value for value in found if value is not None), None)
    return None


def same(a, b):
    """Whether two values of a key mean the same."""
    numbers = all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in (a, b))
    return abs(a - b) <= 1e-9 * max(abs(a), abs(b)) if numbers else a == b


def same_settings(a, b):
    return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)


def fingerprint(case, settings):
    """Tells whether a case has changed: of all that it says but its words and expectations, and of its geometry."""
    tree = read_tree(case)
    tree.pop("expected", None)
    tree.pop("case", None)
    digest = hashlib.sha256(json.dumps(tree, sort_keys=True, default=str).encode())
    for key in ("mesh.geometry", "mesh.file"):
        name = settings.get(key, value_of(tree, key))
        path = case.parent / name if isinstance(name, str) else pathlib.Path()
        if path.is_file():
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]
