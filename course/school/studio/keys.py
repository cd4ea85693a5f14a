"""Numbers of a scene that can be changed by sliders: those that its module is about, with ranges from the format."""

from __future__ import annotations

import typing
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from math import floor, log10
from typing import Any

import msgspec

from course.engine.formats.yaml.document import KeyPath, spell
from course.engine.formats.yaml.loading import Loaded

ABOUT: Mapping[str, tuple[str, ...]] = {
    "supersampling": ("sampler.samples", "film.sigma"),
    "soft_shadows": ("lights.*.radius",),
    "glossy": ("materials.*.gloss.*",),
    "thin_lens": ("camera.lens.aperture_radius", "camera.lens.focus_distance"),
    "motion_blur": ("camera.shutter.close",),
    "blurred_transparency": ("materials.*.dielectric.roughness",),
    "adaptive_sampling": ("film.subdivision.threshold", "film.subdivision.depth"),
    "path_tracing": ("integrator.max_depth",),
    "importance_sampling": ("materials.*.exponent",),
    "bounding_volumes": ("acceleration.leaf_size",),
    "film": ("film.exposure", "film.tone.key", "film.tone.burn", "film.tone.saturation"),
    "multiple_importance": ("lights.*.radius", "materials.*.gloss.exponent"),
    "microfacets": ("materials.*.conductor.roughness", "materials.*.dielectric.roughness"),
    "environment_light": ("environment.scale",),
    "cube_map": ("environment.scale", "integrator.max_depth"),
    "quasi_monte_carlo": ("camera.lens.aperture_radius", "lights.*.radius"),
    "blue_noise": ("lights.*.radius",),
    "many_lights": ("integrator.max_depth",),
    "sampling": ("camera.lens.aperture_radius", "lights.*.radius"),
}
"""Module -> key paths; * is any key or item. The number of samples has a slider in any case."""

SQUARES = ("jittered", "regular")
"""Samplers that need a square number of samples."""

MOST_SLIDERS = 8

TIMES = 3.0
"""A range without an upper bound ends at so many times the file's value."""


STOPS = 5.0
"""The range of an exposure, on both sides of none."""


@dataclass(frozen=True)
class Slider:
    """A number that can be changed.

    Attributes
    ----------
    path : its key path
    label : the same as people write it
    description, unit : from the format
    value, low, high, step : of the number
    choices : the values that it may have; empty for all between ``low`` and ``high``
    """

    path: KeyPath
    label: str
    description: str
    unit: str
    value: float
    low: float
    high: float
    step: float
    choices: tuple[int, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """Plain data."""
        return asdict(self)


def sliders(loaded: Loaded, modules: typing.Collection[str]) -> list[Slider]:
    """The sliders for what some modules are about, and the number of samples."""
    wanted = ["sampler.samples"]
    wanted += [each for module in modules for each in ABOUT.get(module, ())]
    film, unused = loaded.description.film, set()
    if film.filter != "gaussian":
        unused.add("film.sigma")
    if not (film.exposure or film.gamut != "srgb" or film.tone or film.dither):
        unused.add("film.exposure")
    wanted = [each for each in wanted if each not in unused]
    found: dict[KeyPath, Slider] = {}
    for pattern in wanted:
        for path, value, meta in _numbers(loaded.description, tuple(pattern.split("."))):
            if path not in found:
                found[path] = _slider(path, value, meta, loaded)
    return list(found.values())[:MOST_SLIDERS]


def _numbers(
    value: Any, pattern: tuple[str, ...], path: KeyPath = (), meta: Any = None
) -> Iterator[tuple[KeyPath, float, Any]]:
    """Numbers at the paths of a pattern, with the metadata of their keys."""
    if not pattern:
        if isinstance(value, int | float) and not isinstance(value, bool):
            yield path, value, meta
        return
    first, rest = pattern[0], pattern[1:]
    if isinstance(value, msgspec.Struct):
        hints = typing.get_type_hints(type(value), include_extras=True)
        for name in value.__struct_fields__:
            if first in ("*", name):
                metas = getattr(hints[name], "__metadata__", (None,))
                yield from _numbers(getattr(value, name), rest, (*path, name), metas[0])
    elif isinstance(value, Mapping):
        for key, item in value.items():
            if first in ("*", key):
                yield from _numbers(item, rest, (*path, key))
    elif isinstance(value, tuple) and first == "*":
        for number, item in enumerate(value):
            yield from _numbers(item, rest, (*path, number))


def _slider(path: KeyPath, value: float, meta: Any, loaded: Loaded) -> Slider:
    low = _first(getattr(meta, "ge", None), getattr(meta, "gt", None), 0.0)
    high = _first(getattr(meta, "le", None), getattr(meta, "lt", None), None)
    extra = getattr(meta, "extra_json_schema", None) or {}
    whole = isinstance(value, int)
    about = getattr(meta, "description", "") or "", extra.get("x-unit", "")
    if path == ("sampler", "samples"):
        squares = loaded.description.sampler.type in SQUARES
        choices = tuple(n * n for n in range(1, 17)) if squares else tuple(1 << n for n in range(9))
        choices = tuple(sorted({*choices, value}))  # type: ignore[arg-type]
        return Slider(path, spell(path), *about, value, 1, choices[-1], 1, choices)
    if extra.get("x-unit") == "stop":
        return Slider(path, spell(path), *about, value, min(-STOPS, value), max(STOPS, value), 0.1)
    most = TIMES * value if value > 0 else 1.0
    high = most if high is None else min(high, most)
    if whole:
        return Slider(path, spell(path), *about, value, low, max(high, value), 1)
    step = 10.0 ** (floor(log10(max(high - low, 1e-9))) - 2)
    light = loaded.description.lights[int(path[1])] if path[0] == "lights" else None
    # Of a light by radiance a point has no area to emit from.
    shines = path[-1] == "radius" and getattr(light, "radiance", None) is not None
    if getattr(meta, "gt", None) is not None or shines:
        low += step
    if getattr(meta, "lt", None) is not None and high == meta.lt:
        high -= step
    if path == ("camera", "shutter", "close"):
        low = loaded.description.camera.shutter.open
    return Slider(path, spell(path), *about, value, low, high, step)


def _first(*numbers: Any) -> Any:
    return next((number for number in numbers if number is not None), None)
