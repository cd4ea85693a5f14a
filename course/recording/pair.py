"""A student's rays beside the right ones, of the same samples: what the view shows, and what it says in words."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course.core.types import Floats64
from course.recording.scenery import rounded
from course.recording.story import Story
from course.recording.view import KINDS, MOST_PATHS, rays_data, view_data

ALIKE = 1e-3
"""Difference of results in the compiled scene, which is 2 wide, from which on they are told as others."""

MOST_FUNCTIONS = 4
"""Whose results are told."""

_SAMPLE, _KIND, _AIM, _CALLS = 0, 3, 7, 9

Data = Mapping[str, Any]


def pair_data(yours: Story, right: Data, function: str, most: int = MOST_PATHS) -> dict[str, Any]:
    """The view's data with both; the sample is marked for which the function's result is farthest from the right one.

    Parameters
    ----------
    right : ``rays_data`` of the right functions' rays, of as many samples
    function : "module.function" that the rays are shown for
    most : samples that are shown
    """
    data = view_data(yours, right, most)
    data["function"] = function
    data["marked"] = marked = _worst(data, right, function)
    data["asked"] = _asked(yours, data["samples"][marked]["number"], function)
    return data


def departing(yours: Story, right: Data, functions: Sequence[str]) -> str | None:
    """The first of these functions, in the order of their calls, whose rays are others; None if all are the same.

    A function that comes later is asked for what the first one has made, so its results differ, too.
    """
    data = rays_data(yours)
    own, others = _results(data), _results(right)
    for function in functions:
        if not _alike(own.get(function, {}), others.get(function, {})):
            return function
    pairs = zip(data["samples"], right["samples"], strict=False)
    same = data["color"] == right["color"] and all(a == b for a, b in pairs)
    return None if same or not functions else functions[0]


def _alike(own: Mapping[int, list[Floats64]], others: Mapping[int, list[Floats64]]) -> bool:
    """Whether a function returned the same for all samples, but for rounding."""
    return own.keys() == others.keys() and all(
        len(own[sample]) == len(others[sample])
        and all(
            a.shape == b.shape and np.allclose(a, b, rtol=ALIKE, atol=ALIKE, equal_nan=True)
            for a, b in zip(own[sample], others[sample], strict=True)
        )
        for sample in own
    )


def _asked(yours: Story, sample: int, function: str) -> dict[str, Any]:
    """The arguments of the function's first call for a sample; none where it wasn't asked for single rays."""
    calls = (call for one in yours.segments if one.sample == sample for call in one.calls)
    first = next((call for call in calls if call.function == function), None)
    return {} if first is None else {name: rounded(v) for name, v in first.arguments.items()}


def _worst(yours: Data, right: Data, function: str) -> int:
    """The sample whose results differ most; whose light does where the function wasn't asked for single rays."""
    own, others = (_results(each).get(function, {}) for each in (yours, right))
    far = {
        sample: float(np.linalg.norm(own[sample][0] - others[sample][0]))
        for sample in own.keys() & others.keys()
        if own[sample][0].shape == others[sample][0].shape
    }
    if not any(far.values()):
        pairs = zip(yours["samples"], right["samples"], strict=False)
        far = {
            number: float(np.abs(_numbers(a["radiance"]) - _numbers(b["radiance"])).sum())
            for number, (a, b) in enumerate(pairs)
        }
    return max(far, key=lambda sample: (np.nan_to_num(far[sample], nan=np.inf), -sample))


def _numbers(values: Any) -> Floats64:
    return np.array(values, np.float64).ravel()


def _results(data: Data) -> dict[str, dict[int, list[Floats64]]]:
    """Function -> sample -> what it returned, call by call."""
    found: dict[str, dict[int, list[Floats64]]] = defaultdict(lambda: defaultdict(list))
    for row in data["segments"]:
        for number, result in row[_CALLS]:
            if not isinstance(result, str | None):
                found[data["functions"][number]][row[_SAMPLE]].append(_numbers(result))
    return found


def told(data: Data, other: str = "right is") -> list[str]:
    """Sentences about both: their light, what blocks the shadow rays, and what the functions returned.

    Parameters
    ----------
    other : how what the right functions made is told
    """
    right, marked = data["right"], data["marked"]
    lines = [f"The pixel is {_numbered(data['color'])}; {other} {_numbered(right['color'])}."]
    if (light := _light(data)) != (should := _light(right)):
        lines.append(f"The samples shown bring {light} on average; {other} {should}.")
    if (weights := _weights(data)) != (should := _weights(right)):
        lines.append(f"The filter weighs them {weights}; {other} {should}.")
    elif light == _light(right) and data["color"] != right["color"]:
        plain, mean = light, _light(data, weighted=True)
        if plain != mean:
            lines.append(f"The samples' plain mean is {plain}, their weighted mean {mean}.")
    if (blocked := _blocked(data)) != (should := _blocked(right)):
        lines.append(f"{blocked} shadow rays are blocked; {other} {should}.")
    own, others = _results(data), _results(right)
    for name in list(own | others)[:MOST_FUNCTIONS]:
        mine, theirs = (_spread(each.get(name, {})) for each in (own, others))
        if mine != theirs:
            lines.append(f"{name} returned {mine}; {other} {theirs}.")
        a, b = (each.get(name, {}).get(marked, []) for each in (own, others))
        if a and b and not np.array_equal(a[0], b[0]):
            number = data["samples"][marked]["number"]
            asked = data["asked"] if name == data["function"] else {}
            given = ", ".join(f"{key} = {_argument(value)}" for key, value in asked.items())
            call = f"{name}({given})" if given else name
            lines.append(
                f"For sample {number} {call} returned {_list(a[0])}; {other} {_list(b[0])}."
            )
    return lines


def _light(data: Data, *, weighted: bool = False) -> str:
    radiance = np.array([_numbers(each["radiance"]) for each in data["samples"]])
    weights = _numbers([each["weight"] if weighted else 1 for each in data["samples"]])
    with np.errstate(all="ignore"):
        return _numbered(weights @ radiance / weights.sum())


def _weights(data: Data) -> str:
    weights = _numbers([each["weight"] for each in data["samples"]])
    return f"{weights.min():.3g} to {weights.max():.3g}, mean {weights.mean():.3g}"


def _numbered(values: Any) -> str:
    return " ".join(f"{value:.3g}" for value in _numbers(values))


def _argument(value: Any) -> str:
    return _list(_numbers(value)) if isinstance(value, list) else str(value)


def _blocked(data: Data) -> str:
    shadows = [row for row in data["segments"] if KINDS[row[_KIND]] == "shadow"]
    return f"{sum(row[_AIM] != 0 for row in shadows)} of {len(shadows)}"


def _spread(results: Mapping[int, list[Floats64]]) -> str:
    """Mean and range of what was returned, coordinate by coordinate."""
    values = [each for calls in results.values() for each in calls]
    if not values:
        return "nothing for single rays"
    if len({len(each) for each in values}) > 1 or len(values[0]) > MOST_FUNCTIONS:
        return f"{len(values)} results"
    columns = np.stack(values, axis=1)
    names = "xyzw" if len(columns) > 1 else " "
    parts = [
        f"{name} {column.min():.3g} to {column.max():.3g}, mean {column.mean():.3g}".strip()
        for name, column in zip(names, columns, strict=False)
    ]
    return "; ".join(parts)


def _list(values: Floats64) -> str:
    return f"({', '.join(str(each) for each in rounded(values))})"
