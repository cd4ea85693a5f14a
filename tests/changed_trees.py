"""Changes somewhere in the plain data of a scene file, drawn by Hypothesis."""

import copy
from collections.abc import Sequence
from typing import Any

from hypothesis import strategies as st


def change(
    tree: Any, data: st.DataObject, values: st.SearchStrategy[Any], words: Sequence[str]
) -> None:
    """Replace, remove, add, rename or double one value at a random place.

    ``values``, ``words``: what is put in, and names of what is added
    """
    place = tree
    while True:
        keys = list(place) if isinstance(place, dict) else list(range(len(place)))
        if not keys:
            return
        key = data.draw(st.sampled_from(keys))
        inner = place[key]
        if not isinstance(inner, dict | list) or not inner or data.draw(st.integers(0, 4)) == 0:
            break
        place = inner
    match data.draw(st.sampled_from(["replace", "remove", "add", "rename"])):
        case "replace":
            place[key] = data.draw(values)
        case "remove":
            del place[key]
        case "add" if isinstance(place, dict):
            place[data.draw(st.sampled_from(words) | st.text(max_size=6))] = data.draw(values)
        case "add":
            place.append(data.draw(values))
        case "rename" if isinstance(place, dict):
            place[f"{key}{data.draw(st.text(max_size=2))}"] = place.pop(key)
        case _:
            place.insert(0, copy.deepcopy(place[key]))
