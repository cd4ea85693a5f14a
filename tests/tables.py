"""Tables of mistakes, one a line: `OLD -> NEW | MESSAGE`; a row goes on in lines that are indented by four blanks."""

from typing import Any

import yaml


def rows(table: str) -> list[tuple[str, str, str]]:
    """What is replaced, by what, and the message."""
    found = []
    for row in table.strip().replace("\n    ", " ").splitlines():
        change, message = row.split(" |", 1)
        old, new = change.split(" ->", 1)
        found.append((old, new.strip(), message.strip()))
    return found


def put(tree: Any, place: str, value: str) -> None:
    """Put a value, written as YAML, in a place such as `objects/0/radius`; nothing takes away what is there."""
    *parents, last = (int(key) if key.isdigit() else key for key in place.split("/"))
    for key in parents:
        tree = tree.setdefault(key, {}) if isinstance(tree, dict) else tree[key]
    if value == "":
        del tree[last]
    elif isinstance(tree, list) and last == len(tree):
        tree.append(yaml.safe_load(value))
    else:
        tree[last] = yaml.safe_load(value)
