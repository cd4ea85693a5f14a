"""A student's rays beside the right ones, of the same samples: what the view shows, and what it says in words."""

from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course.engine.core.types import Floats64
from course.engine.recording.recorder import RESOLVE, WEIGHTS
from course.engine.recording.scenery import rounded
from course.engine.recording.story import Story
from course.engine.recording.view import KINDS, MOST_PATHS, rays_data, view_data

ALIKE = 1e-3
"""Difference of results in the compiled scene, which is 2 wide, from which on they are told as others."""

MOST_FUNCTIONS = 4
"""Whose results are told."""

_SAMPLE, _DEPTH, _KIND, _START, _END, _AIM, _CALLS = 0, 2, 3, 4, 5, 7, 9

_OF_COLOURS = (WEIGHTS, RESOLVE)
"""What is asked for the colours of pixels."""

_PATTERNS = ("supersampling", "quasi_monte_carlo")
"""Modules whose other functions say where samples are."""

Data = Mapping[str, Any]

Calls = list[list[Floats64]]
"""What a function returned, call by call: each of its results."""


def pair_data(yours: Story, right: Data, function: str, most: int = MOST_PATHS) -> dict[str, Any]:
    """The view's data with both; the sample is marked whose results of the function are farthest off.

    Parameters
    ----------
    right : ``rays_data`` of the right functions' rays, of as many samples
    function : "module.function" that the rays are shown for; "" for none
    most : samples that are shown
    """
    data = view_data(yours, right, most)
    data["function"] = function
    data["marked"] = marked = _worst(data, right, function)
    own, others = (_results(each).get(function, {}).get(marked, []) for each in (data, right))
    number = _first_other(own, others) or 0
    data["asked"] = _asked(yours, data["samples"][marked]["number"], function, number)
    return data


def departing(yours: Story, right: Data, functions: Sequence[str]) -> str | None:
    """The first of these functions, in the order of their calls, that made something else; None if none is known to.

    A function that comes later is asked for what the first one has made, so its results differ, too. One that was asked
    for other rays has not returned other results for that reason alone.
    """
    data = rays_data(yours)
    # These are asked before there is a ray.
    for function in data["built"]:
        if function in functions and _built_apart(function, data, right):
            return str(function)
    patterns = [f for f in functions if f.startswith(_PATTERNS) and f not in _OF_COLOURS]
    # Of several patterns it isn't known which one has moved the samples.
    if len(patterns) == 1 and not _same("offset", data, right):
        return patterns[0]
    # Along the rays: a tile may have asked another function first, for other pixels. Call is held against call ray by
    # ray, for which of a batch's rays a call was for isn't always known.
    others = _calls_by_ray(right)
    for ray, mine in _calls_by_ray(data).items():
        theirs = others.get(ray, {})
        for function, own in mine.items():
            if function in functions and _first_other(own, theirs.get(function, [])) is not None:
                return function
    return next((f for f in functions if _of_colours(f, data, right)), None)


def _calls_by_ray(data: Data) -> dict[tuple[int, ...], dict[str, Calls]]:
    """Sample, depth, kind and number among such rays -> function -> what it returned, call by call."""
    found: dict[tuple[int, ...], dict[str, Calls]] = {}
    count = Counter[tuple[int, ...]]()
    for row in data["segments"]:
        kind = row[_SAMPLE], row[_DEPTH], row[_KIND]
        calls: dict[str, Calls] = defaultdict(list)
        for number, *results in row[_CALLS]:
            calls[data["functions"][number]].append(_numbers_of(results))
        found[*kind, count[kind]] = calls
        count[kind] += 1
    return found


def _built_apart(function: str, data: Data, right: Data) -> tuple[Floats64, Floats64] | None:
    """Of the first result that is another, of a function's calls while the scene was built, both sides' numbers."""
    own, others = (each.get("built", {}).get(function, ()) for each in (data, right))
    for (size, some), (right_size, right_some) in zip(own, others, strict=False):
        a, b = _numbers(some), _numbers(right_some)
        if size != right_size or not _near(a, b, float(np.abs(b[np.isfinite(b)]).max(initial=0))):
            return a, b
    return None


def unexplained(data: Data, functions: Sequence[str]) -> str | None:
    """What is other than with the course's functions where none is known to depart; None if both are the same.

    Parameters
    ----------
    data : ``pair_data`` of both
    functions : one's own that the picture needs
    """
    right = data["right"]
    same = _same_rays(data, right)
    if same and all(_same(key, data, right) for key in ("radiance", "weight", "color")):
        return None
    asked, use = functions, "needs"
    if same and _same("radiance", data, right):
        asked = [name for name in functions if name in _OF_COLOURS] or functions
        use = "needs for colours" if asked is not functions else use
    what = "send the same rays, which bring other colours" if same else "send other rays"
    named = f" Of yours this picture {use} {', '.join(asked)}." if asked else ""
    return f"The course's functions {what}, but no recorded result of a function differs.{named}"


def _of_colours(function: str, data: Data, right: Data) -> bool:
    """Whether a function made other weights of the same samples, or another colour of the same light and weights."""
    weights, resolve = _OF_COLOURS
    given = {weights: ["offset"], resolve: ["offset", "weight", "radiance"]}.get(function)
    made = "weight" if function == weights else "color"
    return (
        given is not None
        and all(_same(key, data, right) for key in given)
        and not _same(made, data, right)
    )


def _same(key: str, data: Data, right: Data) -> bool:
    """Whether the samples' numbers, or the pixel's "color", are the same but for rounding."""
    a, b = (
        _numbers([each[key]] if key == "color" else [s[key] for s in each["samples"]])
        for each in (data, right)
    )
    return _near(a, b, float(np.abs(b[np.isfinite(b)]).max(initial=0)))


def _same_rays(data: Data, right: Data) -> bool:
    """Whether all rays are the same but for rounding, and meet what they meet there."""
    a, b = data["segments"], right["segments"]
    kinds = [[(r[_SAMPLE], r[_DEPTH], r[_KIND], r[_AIM] != 0) for r in rows] for rows in (a, b)]
    ends, others = (_numbers([r[_START] + r[_END] for r in rows]) for rows in (a, b))
    return kinds[0] == kinds[1] and _near(ends, others, float(np.abs(others).max(initial=0)))


def _near(a: Floats64, b: Floats64, scale: float = 1.0) -> bool:
    """Whether numbers of this size are the same, but for rounding."""
    return a.shape == b.shape and bool(
        np.allclose(a, b, rtol=ALIKE, atol=ALIKE * scale, equal_nan=True)
    )


def _first_other(own: Calls, others: Calls) -> int | None:
    """The first call that returned something else, of those that were made on both sides."""
    pairs = enumerate(zip(own, others, strict=False))
    return next((number for number, (a, b) in pairs if not all(map(_near, a, b))), None)


def _asked(yours: Story, sample: int, function: str, number: int) -> dict[str, Any]:
    """The arguments of the function's call of that number for a sample; none where it wasn't asked for single rays."""
    calls = [call for one in yours.segments if one.sample == sample for call in one.calls]
    own = [call for call in calls if call.function == function][number:]
    return {name: rounded(v) for name, v in own[0].arguments.items()} if own else {}


def _worst(yours: Data, right: Data, function: str) -> int:
    """The sample whose results differ most; whose light does where the function wasn't asked for single rays."""
    own, others = (_results(each).get(function, {}) for each in (yours, right))
    far = {sample: _apart(own[sample], others[sample]) for sample in own.keys() & others.keys()}
    if not any(far.values()):
        pairs = zip(yours["samples"], right["samples"], strict=False)
        far = {
            number: float(np.abs(_numbers(a["radiance"]) - _numbers(b["radiance"])).sum())
            for number, (a, b) in enumerate(pairs)
        }
    return max(far, key=lambda sample: (np.nan_to_num(far[sample], nan=np.inf), -sample))


def _apart(own: Calls, others: Calls) -> float:
    """How far the first call's results are from the right ones that returned something else; 0 if none did."""
    if (number := _first_other(own, others)) is None:
        return 0.0
    pairs = zip(own[number], others[number], strict=False)
    apart = [float(np.linalg.norm(a - b)) if a.shape == b.shape else np.inf for a, b in pairs]
    return float(np.nan_to_num(apart, nan=np.inf).max())


def _numbers(values: Any) -> Floats64:
    return np.array(values, np.float64).ravel()


def _results(data: Data) -> dict[str, dict[int, Calls]]:
    """Function -> sample -> what it returned, call by call and result by result; of text no number."""
    found: dict[str, dict[int, Calls]] = defaultdict(lambda: defaultdict(list))
    for row in data["segments"]:
        for number, *results in row[_CALLS]:
            found[data["functions"][number]][row[_SAMPLE]].append(_numbers_of(results))
    return found


def _numbers_of(results: Sequence[Any]) -> list[Floats64]:
    return [_numbers([] if isinstance(r, str | None) else r) for r in results]


def told(data: Data, other: str = "right is", functions: str = "the right functions") -> list[str]:
    """Sentences about both: their light, what blocks the shadow rays, and what the functions returned.

    Parameters
    ----------
    other : how what the right functions made is told
    functions : how these are called
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
    blocked, right_blocked = _blocked(data), _blocked(right)
    if blocked != right_blocked and not right_blocked[1]:
        lines.append(
            f"{_of(blocked)} shadow rays are blocked; with {functions} no shadow ray is sent there."
        )
    elif blocked != right_blocked:
        sent = f"{_of(blocked)} shadow rays are blocked" if blocked[1] else "No shadow ray is sent"
        lines.append(f"{sent}; {other} {_of(right_blocked)}.")
    for name in data.get("built", ()):
        if (apart := _built_apart(name, data, right)) is not None:
            yours, should = (_spread(list(numbers[:, None])) for numbers in apart)
            lines.append(f"While the scene was built {name} returned {yours}; {other} {should}.")
    own, others = _results(data), _results(right)
    for name in list(own | others)[:MOST_FUNCTIONS]:
        mine, theirs = (each.get(name, {}) for each in (own, others))
        of = _names(data if name in own else right, name)
        for number, result in enumerate(of):
            a, b = (_columns(each, number) for each in (mine, theirs))
            if len(a) != len(b) or not all(map(_near, a, b)):
                lines.append(f"{name} returned {result}{_spread(a)}; {other} {result}{_spread(b)}.")
        of_marked = [each.get(marked, []) for each in (mine, theirs)]
        if (call := _first_other(*of_marked)) is not None:
            sample = data["samples"][marked]["number"]
            asked = data["asked"] if name == data["function"] else {}
            given = ", ".join(f"{key} = {_argument(value)}" for key, value in asked.items())
            returned, should = (
                ", ".join(n + _list(r) for n, r in zip(of, each[call], strict=False) if r.size)
                for each in of_marked
            )
            lines.append(
                f"For sample {sample} {name}{f'({given})' if given else ''} returned {returned};"
                f" {other} {should}."
            )
    return lines


def _names(data: Data, function: str) -> list[str]:
    """What is written before each result of a function; nothing if it has one."""
    names = data["results"][data["functions"].index(function)]
    return [f"{name} " for name in names] if len(names) > 1 else [""]


def _columns(results: Mapping[int, Calls], number: int) -> list[Floats64]:
    """One of a function's results, of all calls in the order of their samples."""
    calls = [call for sample in sorted(results) for call in results[sample]]
    return [call[number] for call in calls if number < len(call) and call[number].size]


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


def _blocked(data: Data) -> tuple[int, int]:
    """How many shadow rays are blocked, and how many there are."""
    shadows = [row for row in data["segments"] if KINDS[row[_KIND]] == "shadow"]
    return sum(row[_AIM] != 0 for row in shadows), len(shadows)


def _of(counts: tuple[int, int]) -> str:
    return f"{counts[0]} of {counts[1]}"


def _spread(values: Sequence[Floats64]) -> str:
    """Mean and range of what was returned, coordinate by coordinate."""
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
