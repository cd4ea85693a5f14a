"""Shapes that the engine counts on, so that a wrong one is the student's trouble and not the renderer's."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course.grading.checks.check import Array
from course.grading.errors import StudentError

Shape = tuple[int, ...]

LARGEST = 1e12
"""Beyond any number in the grader's scenes; the engine can square it in float32."""


def _points(k: int, n: int, *_: Any) -> tuple[Shape, ...]:
    return ((2, n, k * k),)


def _like_first(first: Array, *_: Any) -> tuple[Shape, ...]:
    return (first.shape,)


def _on_light(*arguments: Any) -> tuple[Shape, ...]:
    return ((3, arguments[-1].shape[1]),)


def _places(points: Array, *_: Any) -> tuple[Shape, ...]:
    return ((2, points.shape[1]),)


SHAPES: dict[str, Callable[..., tuple[Shape, ...]]] = {
    "supersampling.regular": _points,
    "supersampling.random": _points,
    "supersampling.jittered": _points,
    "supersampling.gaussian_weights": lambda offsets, *_: (offsets.shape[1:],),
    "supersampling.resolve": lambda radiance, _: (radiance.shape[:2],),
    "soft_shadows.light_grid": lambda *arguments: ((3, arguments[-1] ** 2),),
    "soft_shadows.point_on_rectangle": _on_light,
    "soft_shadows.point_on_sphere": _on_light,
    "soft_shadows.point_in_ball": _on_light,
    "soft_shadows.point_on_facing_disk": _on_light,
    "glossy.jitter_on_plane": _like_first,
    "glossy.jitter_in_ball": _like_first,
    "glossy.sample_phong_lobe": _like_first,
    "glossy.keep_above": _like_first,
    "thin_lens.point_on_disk": _like_first,
    "thin_lens.lens_rays": lambda *arguments: (arguments[4].shape, arguments[4].shape),
    "motion_blur.shutter_times": lambda open_, close, u: (u.shape,),  # noqa: ARG005 - the module's arguments
    "motion_blur.displacement": lambda _, time: ((3, len(time)),),
    "motion_blur.to_object_space": _like_first,
    "path_tracing.diffuse_bounce": _like_first,
    "sampling.sphere_by_polar": lambda u: ((3, u.shape[1]),),
    "sampling.ball_by_polar": _like_first,
    "sampling.ball_by_rejection": lambda n, _: ((3, n),),
    "adaptive_sampling.needs_subdivision": lambda corners, _: (corners.shape[2:],),
    "adaptive_sampling.subdivide": lambda *sides: tuple((4, len(side)) for side in sides),
    "textures.rectangle_uv": _places,
    "textures.sphere_uv": _places,
    "textures.triangle_uv": _places,
    "blurred_transparency.refract": lambda d, *_: (d.shape, d.shape[1:]),
    "blurred_transparency.jitter_refraction": _like_first,
    "blurred_transparency.fresnel": _like_first,
    "cube_map.lookup": lambda _, direction: (direction.shape,),
    "cube_map.lookup_seamless": lambda _, direction: (direction.shape,),
}
"""What each function that the engine calls returns for its arguments."""

MASKS = {"blurred_transparency.refract": (1,), "adaptive_sampling.needs_subdivision": (0,)}
"""Which of a function's results says yes or no."""


def usable(function: str, value: Any, arguments: tuple[Any, ...]) -> Any:
    """A student's value as the engine may use it: its own copy, in float32, no number larger than LARGEST; or bool.

    A wrong dtype costs where it is checked; here it is made harmless.

    Raises
    ------
    StudentError
        It isn't arrays of finite numbers of the shapes that the contract says.
    """
    shapes = SHAPES[function](*arguments)
    # What a worker sends is a tuple; a function that is called here may return a list as well.
    several = isinstance(value, tuple | list)
    parts = value if several else (value,)
    if len(parts) != len(shapes):
        raise StudentError(
            "bad value", f"{function} returned {_told(value)} instead of {_listed(shapes)}"
        )
    for part, shape in zip(parts, shapes, strict=True):
        if not isinstance(part, np.ndarray) or part.shape != shape:
            raise StudentError(
                "bad value", f"{function} returned {_told(value)} instead of {_listed(shapes)}"
            )
        if not np.isfinite(part).all():
            raise StudentError("bad value", f"{function} returned numbers that are not finite")
    masks = MASKS.get(function, ())
    arrays = tuple(
        part.astype(bool, order="C")
        if number in masks
        else np.clip(part, -LARGEST, LARGEST).astype(np.float32, order="C")
        for number, part in enumerate(parts)
    )
    return arrays if several else arrays[0]


def _told(value: Any) -> str:
    if isinstance(value, tuple | list):
        return "(" + ", ".join(map(_told, value)) + ")"
    return (
        f"an array of shape {value.shape}"
        if isinstance(value, np.ndarray)
        else f"a {type(value).__name__}"
    )


def _listed(shapes: tuple[Shape, ...]) -> str:
    return " and ".join(map(str, shapes))
