"""A page that shows recorded rays in their scene: one HTML file, which asks for no other."""

import json
import re
from base64 import b64encode
from collections.abc import Mapping
from hashlib import sha256
from html import escape
from importlib.resources import files
from typing import Any

import numpy as np

from course.engine.recording.scenery import camera_of, lamps, objects, rounded
from course.engine.recording.segments import Segment
from course.engine.recording.stages import RecordedEffects
from course.engine.recording.story import Line, Story
from course.engine.scene.scene import Scene

MOST_PATHS = 200
"""Samples whose rays are shown; of more, these are spread evenly."""

KINDS = ("camera", "shadow", "mirrored", "refracted", "bounce", "environment")
"""Of rays; the view names them by their numbers."""


def page(story: Story) -> str:
    """An HTML page with the story of a pixel and a view of its rays."""
    parts = {
        "title": escape(story.tree.text),
        "reason": escape(story.reason),
        "tree": _list(story.tree.below[1:]),
        "style": style(),
        "hash": script_hash(),
        "script": script(),
        "view": element(view_data(story)),
    }
    return re.sub(r"\[\[(\w+)\]\]", lambda found: parts[found[1]], _file("rays.html"))


def element(data: Mapping[str, Any]) -> str:
    """The place of a view in a page that has ``style`` and ``script``, which fills it once it is near the window."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    # In a script "</" and "<!--" would mean something, whatever they stand in.
    text = text.replace("<", "\\u003c")
    return f'<div class="rays"><script type="application/json">{text}</script></div>'


def style() -> str:
    """What views need of a page's CSS; --ink, --panel, --line, --accent and --soft are the page's colours."""
    return _file("rays.css")


def script() -> str:
    """The one script of a page with views, whatever their number."""
    return _file("rays.js")


def script_hash() -> str:
    """The script's name in a page's Content-Security-Policy, so that no other runs."""
    # A page has "\n" before and after it.
    digest = sha256(f"\n{script()}\n".encode()).digest()
    return f"sha256-{b64encode(digest).decode()}"


def _file(name: str) -> str:
    return files("course.engine.recording").joinpath(name).read_text(encoding="utf-8")


def _list(lines: list[Line]) -> str:
    items = (f"<li>{escape(line.text)}{_list(line.below)}</li>" for line in lines)
    return f"<ul>{''.join(items)}</ul>" if lines else ""


def view_data(
    story: Story, right: Mapping[str, Any] | None = None, most: int = MOST_PATHS
) -> dict[str, Any]:
    """What the view draws: the scene's triangles, its camera, its lamps and the rays, in the units of the file.

    Parameters
    ----------
    right : ``rays_data`` of the same samples with the right functions; the view shows both
    most : samples that are shown
    """
    recording = story.recording
    data = {
        "kinds": KINDS,
        "objects": objects(recording),
        "lamps": lamps(recording),
        "camera": camera_of(recording),
    }
    return data | rays_data(story, most) | ({} if right is None else {"right": right})


def rays_data(story: Story, most: int = MOST_PATHS) -> dict[str, Any]:
    """The rays of at most so many samples, without the scene around them."""
    recording = story.recording
    _, pixels, count = recording.radiance.shape
    shown = np.unique(np.linspace(0, pixels * count - 1, min(most, pixels * count)).astype(int))
    area = recording.area
    place = {
        ((area.x + n // count % area.width, area.y + n // count // area.width), n % count): number
        for number, n in enumerate(shown.tolist())
    }
    names: dict[str, int] = {}
    functions: dict[str, int] = {}
    results: list[list[str]] = []
    rows: list[list[Any]] = []
    numbers: dict[int, int] = {}
    for one in story.segments:
        if (sample := place.get((one.pixel, one.sample))) is not None:
            numbers[one.number] = len(rows)
            rows.append(_row(one, sample, numbers, names, functions, results))
    radiance = recording.radiance.reshape(3, -1)
    samples = [
        {
            "offset": rounded(recording.offsets.reshape(2, -1)[:, n]),
            "radiance": rounded(radiance[:, n]),
            "share": rounded(story.shares[n]),
            "weight": rounded(recording.weights.ravel()[n]),
            "number": n % count,
        }
        for n in shown.tolist()
    ]
    return {
        "color": rounded(story.color),
        "samples": samples,
        "all": pixels * count,
        "names": list(names),
        "functions": list(functions),
        "results": results,
        "segments": rows,
        "built": rounded_calls(recording.scene),
    }


def rounded_calls(scene: Scene) -> dict[str, Any]:
    """What functions returned while the scene was built; see ``RecordedEffects.built``."""
    assert isinstance(scene.effects, RecordedEffects)
    return {name: rounded(results) for name, results in scene.effects.built.items()}


def _row(
    one: Segment,
    sample: int,
    numbers: dict[int, int],
    names: dict[str, int],
    functions: dict[str, int],
    results: list[list[str]],
) -> list[Any]:
    """Sample, parent, depth, kind, start, end, met, aim (0 unless blocked), light brought, calls: function, results."""
    calls = []
    for call in one.calls:
        if call.function not in functions:
            functions[call.function] = len(functions)
            results.append(list(call.results))
        calls.append([functions[call.function], *map(rounded, call.results.values())])
    return [
        sample,
        -1 if one.parent is None else numbers[one.parent],
        one.depth,
        KINDS.index(one.kind),
        rounded(one.start),
        rounded(one.end),
        names.setdefault(one.met, len(names)),
        rounded(one.aim) if one.blocked else 0,
        rounded(sum(one.radiance) / 3),
        calls,
    ]
