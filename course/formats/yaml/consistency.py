"""Checks that take more than one key: each names the key to change.

Every value is of the right type and within its own range by now.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from course.formats.yaml.description.camera import CameraDescription, ImagePlaneDescription
from course.formats.yaml.description.lights import (
    DirectionalLight,
    Light,
    RectangleLight,
    SphereLight,
)
from course.formats.yaml.description.objects import (
    MOST_KNOT_SEGMENTS,
    DisplacedSphere,
    Object,
    Torus,
    TorusKnot,
)
from course.formats.yaml.description.sampler import SamplerDescription
from course.formats.yaml.description.scene import SceneDescription
from course.formats.yaml.description.transforms import Affine, Rotate, Scale, Transform
from course.formats.yaml.description.values import Vector, rgb
from course.formats.yaml.document import Document, KeyPath
from course.formats.yaml.object_lights import check_object_lights
from course.formats.yaml.suggestions import suggest
from course.formats.yaml.surroundings import check_surroundings, in_its_surroundings

# Below these sines two directions are held to be one: a picture turned by a rounding error, or a
# light without area.
_PARALLEL_UP: Final = 1e-6
_PARALLEL_EDGES: Final = 1e-9
# Of the distance from the origin; float64 keeps 16 digits, and a view needs some of them.
_SAME_POINT: Final = 1e-12
# Of a highlight's colour: times the brightest light it stays within float32.
_SHARPEST: Final = 1e6


def check_consistency(description: SceneDescription, document: Document) -> None:
    """Check the values of a scene against each other.

    Raises
    ------
    SceneError
        For the first contradiction, by file, line, key path and value.
    """
    _check_camera(description.camera, document)
    _check_sampler(description.sampler, document)
    for name, material in description.materials.items():
        if max(rgb(material.specular)) > _SHARPEST:
            raise document.unexpected(
                ("materials", name, "specular"), f"numbers of at most {_SHARPEST:g}"
            )
        if material.dielectric is not None and material.conductor is not None:
            raise document.error(
                ("materials", name), "both dielectric and conductor are given: expected one of them"
            )
    for index, light in enumerate(description.lights):
        _check_light(light, ("lights", index), document)
    for index, thing in enumerate(description.objects):
        _check_object(thing, ("objects", index), description, document)
    check_object_lights(description, document)
    check_surroundings(description, document)
    for name, material in description.materials.items():
        glass = in_its_surroundings(material, description.materials).dielectric
        if glass is not None and glass.roughness and not 0.1 < glass.refraction_index < 10:
            raise document.unexpected(
                ("materials", name, "dielectric", "refraction_index"),
                "a number between 0.1 and 10 for rough glass, against what surrounds it",
            )


def nearest_squares(samples: int) -> tuple[int, ...]:
    """Return the one or two square numbers nearest to a number of samples, itself if it is one."""
    root = math.isqrt(samples)
    return (samples,) if root * root == samples else (root * root, (root + 1) ** 2)


def _check_camera(camera: CameraDescription, document: Document) -> None:
    eye, look_at = np.array(camera.eye), np.array(camera.look_at)
    view = look_at - eye
    farthest = max(np.abs(eye).max(), np.abs(look_at).max())
    if np.abs(view).max() <= _SAME_POINT * farthest:
        raise document.unexpected(
            ("camera", "look_at"), "another point than camera.eye, to look towards"
        )
    _check_not_zero(camera.up, ("camera", "up"), document)
    if sine(view, np.array(camera.up)) < _PARALLEL_UP:
        raise document.unexpected(
            ("camera", "up"), "a direction that is not parallel to the view from eye to look_at"
        )
    if camera.image_plane is not None:
        _check_image_plane(camera.image_plane, ("camera", "image_plane"), document)


def _check_image_plane(plane: ImagePlaneDescription, path: KeyPath, document: Document) -> None:
    if not plane.left < plane.right:
        raise document.unexpected((*path, "right"), f"a number > left, {plane.left:g} [world unit]")
    if not plane.bottom < plane.top:
        raise document.unexpected(
            (*path, "top"), f"a number > bottom, {plane.bottom:g} [world unit]"
        )


def _check_sampler(sampler: SamplerDescription, document: Document) -> None:
    squares = nearest_squares(sampler.samples)
    if sampler.type in {"regular", "jittered"} and len(squares) > 1:
        raise document.unexpected(
            ("sampler", "samples"),
            f"a square number for the {sampler.type} sampler, "
            f"such as {' or '.join(map(str, filter(None, squares)))}",
        )


def _check_light(light: Light, path: KeyPath, document: Document) -> None:
    if isinstance(light, DirectionalLight):
        _check_not_zero(light.direction, (*path, "direction"), document)
    if isinstance(light, RectangleLight | SphereLight):
        _check_emission(light, path, document)
    if isinstance(light, RectangleLight):
        _check_not_zero(light.edge_u, (*path, "edge_u"), document)
        _check_not_zero(light.edge_v, (*path, "edge_v"), document)
        if sine(np.array(light.edge_u), np.array(light.edge_v)) < _PARALLEL_EDGES:
            raise document.unexpected((*path, "edge_v"), "an edge that is not parallel to edge_u")
        if light.two_sided and light.visible and light.radiance is not None:
            raise document.unexpected(
                (*path, "visible"),
                "false for a two-sided light by radiance; for one that is seen, give two lights, one a side",
            )


def _check_emission(light: RectangleLight | SphereLight, path: KeyPath, document: Document) -> None:
    given = [light.intensity is not None, light.radiance is not None]
    if all(given):
        raise document.error(path, "both intensity and radiance are given: expected one of them")
    if not any(given):
        raise document.error(
            path, "intensity or radiance is missing: expected one of them, in W/sr or W/(m^2 sr)"
        )
    if isinstance(light, SphereLight) and light.radiance is not None and light.radius == 0:
        raise document.unexpected(
            (*path, "radius"),
            "a number > 0 [world unit] for a light by radiance; a point has no area to emit from",
        )
    if not isinstance(light, SphereLight):
        return
    of_surface = ("sphere", "sphere by polar", "visible")
    if light.radiance is not None and light.samples not in of_surface:
        raise document.unexpected(
            (*path, "samples"),
            '"sphere", "sphere by polar" or "visible" for a light by radiance, which shines from its surface; by'
            " intensity it may be a ball or a facing disk",
        )
    if light.radiance is None and light.samples == "visible":
        raise document.unexpected(
            (*path, "samples"),
            '"sphere", "ball" or "facing disk" (or "sphere by polar", "ball by polar", "ball by rejection") for a'
            " light by intensity: all of it shines everywhere, and only a light by radiance has a side that can't"
            " be seen",
        )


def _check_object(
    thing: Object, path: KeyPath, description: SceneDescription, document: Document
) -> None:
    if thing.material not in description.materials:
        hint = suggest(thing.material, description.materials)
        raise document.unexpected((*path, "material"), f"the name of one of the materials; {hint}")
    if thing.from_behind == "kept":
        if description.materials[thing.material].dielectric is not None:
            raise document.unexpected(
                (*path, "from_behind"), "turned for glass, whose inside is another than its outside"
            )
        if description.integrator.shading_normals == "bent":
            raise document.unexpected(
                ("integrator", "shading_normals"),
                f"interpolated, as objects[{path[-1]}].from_behind is kept",
            )
    if isinstance(thing, Torus):
        _check_less(("tube", thing.tube), ("radius", thing.radius), path, document)
    if isinstance(thing, DisplacedSphere):
        _check_less(("amplitude", thing.amplitude), ("radius", thing.radius), path, document)
    if isinstance(thing, TorusKnot):
        _check_knot(thing, path, document)
    for index, step in enumerate(thing.transform):
        _check_step(step, (*path, "transform", index), document)


def _check_less(
    small: tuple[str, float], large: tuple[str, float], path: KeyPath, document: Document
) -> None:
    """Check that one key of an object is less than another; each may be a default."""
    (name, value), (bound_name, bound) = small, large
    if value < bound:
        return
    if name in document.value(path):
        raise document.unexpected((*path, name), f"a number < {bound_name}, {bound:g} [world unit]")
    raise document.unexpected(
        (*path, bound_name), f"a number > {name}, {value:g} where it is not given [world unit]"
    )


def _check_knot(knot: TorusKnot, path: KeyPath, document: Document) -> None:
    if (divisor := math.gcd(knot.p, knot.q)) > 1:
        raise document.error(
            path,
            f"p is {knot.p} and q is {knot.q}: expected numbers without a common divisor; "
            f"these wind {divisor} times over the same curve",
        )
    fewest = 8 * (knot.p + knot.q)
    if knot.segments < fewest:
        raise document.unexpected(
            (*path, "segments"),
            f"a whole number from {fewest}, which is 8 (p + q), to {MOST_KNOT_SEGMENTS}",
        )


def _check_step(step: Transform, path: KeyPath, document: Document) -> None:
    if isinstance(step, Rotate):
        _check_not_zero(step.rotate.axis, (*path, "rotate", "axis"), document)
    if isinstance(step, Scale):
        factors = step.scale if isinstance(step.scale, tuple) else (step.scale,)
        if 0 in factors:
            raise document.unexpected((*path, "scale"), "factors that are not 0")
    if isinstance(step, Affine):
        if step.matrix[3] != (0.0, 0.0, 0.0, 1.0):
            raise document.unexpected(
                (*path, "matrix", 3), "[0, 0, 0, 1], the last row of any affine map"
            )
        if flattens(np.array(step.matrix)):
            raise document.unexpected(
                (*path, "matrix"), "rows that are independent; this matrix flattens what it maps"
            )


def _check_not_zero(vector: Vector, path: KeyPath, document: Document) -> None:
    if not any(vector):
        raise document.unexpected(path, "a vector that is not zero")


def flattens(matrix: NDArray[np.float64]) -> bool:
    """Whether an affine map (4, 4) has no inverse."""
    linear = matrix[:3, :3]
    largest = np.abs(linear).max()
    # By the largest component first, so that no product underflows or overflows.
    return bool(largest == 0 or np.linalg.matrix_rank(linear / largest) < 3)


def sine(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Sine of the angle between two vectors, neither of them zero."""
    # Divided by the largest component first, so that no square underflows or overflows.
    a, b = a / np.abs(a).max(), b / np.abs(b).max()
    return float(np.linalg.norm(np.cross(a, b)) / (np.linalg.norm(a) * np.linalg.norm(b)))
