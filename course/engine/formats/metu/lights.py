"""`Lights`: ambient, point, area, directional and spot lights, and the environment.

The engine's reflected radiance is reflectance times irradiance over pi, a METU scene's is without the pi: its lights
are pi times as strong here, unless the reflectances are (``brdfs.pi_is_of_surfaces``). The ambient term has no pi in
either.
"""

import math
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from course.engine.core.types import Floats64
from course.engine.formats.metu.element import MetuElement
from course.engine.formats.metu.transformations import matrix_of, point
from course.engine.formats.metu.transformations import normal as transformed_normal
from course.engine.formats.pictures.reading import LINEAR
from course.engine.formats.yaml.document import show
from course.engine.formats.yaml.suggestions import suggest

ENVIRONMENTS = {"latlong": "lat_long", "probe": "angular"}
"""Types of METU's environments, and those of this course."""


def read_lights(
    scene: MetuElement, steps: dict[str, dict[str, Any]], pi: float = math.pi
) -> list[dict[str, Any]]:
    """The lights of a scene.

    Parameters
    ----------
    steps : of `Transformations`, by letter and id
    pi : what all but the ambient light is multiplied by
    """
    parent = scene.maybe("Lights")
    if parent is None:
        return []
    return [
        *({"type": "ambient", "radiance": list(e.color())} for e in parent.all("AmbientLight")),
        *(_point(e, matrix_of(e, steps), pi) for e in parent.all("PointLight")),
        *(_area(e, matrix_of(e, steps), pi) for e in parent.all("AreaLight")),
        *(_directional(e, matrix_of(e, steps), pi) for e in parent.all("DirectionalLight")),
        *(_spot(e, matrix_of(e, steps), pi) for e in parent.all("SpotLight")),
    ]


def read_environment(
    scene: MetuElement,
    images: Mapping[str, MetuElement],
    name_of: Callable[[Path], str],
    folder: Path,
    pictured: Callable[[MetuElement | None], dict[str, Any] | None],
) -> dict[str, Any]:
    """What rays see that hit nothing: the background, for camera rays only, or the environment, which sends light, too.

    Parameters
    ----------
    images : elements that name files, by id
    name_of : a file's name as seen from the converted scene
    folder : from which files are named
    pictured : the background that is a picture, beside that element
    """
    background = scene.color_of("BackgroundColor")
    parent = scene.maybe("Lights")
    element = None if parent is None else parent.maybe("SphericalDirectionalLight")
    drawn = pictured(element)
    if element is None:
        return drawn or {"type": "constant", "radiance": background, "seen_by": "camera"}
    element.attribute("id")
    kind = element.attribute("type") or "latlong"
    if kind not in ENVIRONMENTS:
        raise element.error(f"its type is {show(kind)}: expected {' or '.join(ENVIRONMENTS)}")
    number = element.child("ImageId", "the id of an Image")
    name = " ".join(number.words())
    if name not in images:
        raise number.unexpected(f"the id of an Image; {suggest(name, images)}")
    image = images[name]
    file = " ".join(image.words())
    path = folder / file.replace("\\", "/")
    if path.suffix.lower() not in LINEAR:
        raise image.unexpected(
            f"a picture of radiance, {' or '.join(LINEAR)}, for a SphericalDirectionalLight"
        )
    if not os.path.exists(path):  # noqa: PTH110
        raise image.error(f"names {show(file)}: no such file in {folder.resolve()}")
    return {"type": ENVIRONMENTS[kind], "image": name_of(path), "lights": True}


def read_images(scene: MetuElement) -> dict[str, MetuElement]:
    """The elements `Image` of `Textures/Images` by id."""
    parent = scene.maybe("Textures")
    table = None if parent is None else parent.maybe("Images")
    images: dict[str, MetuElement] = {}
    for element in () if table is None else table.all("Image"):
        element.words()
        images[element.id(images)] = element
    return images


def _directional(element: MetuElement, matrix: Floats64, pi: float) -> dict[str, Any]:
    element.attribute("id")
    direction = matrix[:3, :3] @ element.child("Direction", "such as 0 -1 0").direction()
    return {
        "type": "directional",
        "direction": direction.tolist(),
        "irradiance": _times(pi, element.child("Radiance", "such as 100 100 100")),
    }


def _point(element: MetuElement, matrix: Floats64, pi: float) -> dict[str, Any]:
    element.attribute("id")
    position = np.array(element.child("Position", "such as 0 5 0").vector())
    return {
        "type": "point",
        "position": point(matrix, position).tolist(),
        "intensity": _times(pi, element.child("Intensity", "such as 1000 1000 1000")),
        "shadow_rays": "whole",
    }


def _spot(element: MetuElement, matrix: Floats64, pi: float) -> dict[str, Any]:
    direction = matrix[:3, :3] @ element.child("Direction", "such as 0 -1 0").direction()
    coverage = element.child("CoverageAngle", "such as 30 [degree], from edge to edge")
    falloff = element.child("FalloffAngle", "such as 20 [degree], from edge to edge")
    outer, inner = coverage.number(0, above=True), falloff.number(0)
    if outer > 360:
        raise coverage.unexpected("an angle up to 360 [degree]")
    if inner > outer:
        raise falloff.unexpected(f"an angle up to CoverageAngle, {outer:g} [degree]")
    return _point(element, matrix, pi) | {
        "type": "spot",
        "direction": direction.tolist(),
        "inner_angle": inner / 2,
        "outer_angle": outer / 2,
    }


def _area(element: MetuElement, matrix: Floats64, pi: float) -> dict[str, Any]:
    element.attribute("id")
    position = np.array(element.child("Position", "such as 0 5 0").vector())
    normal = element.child("Normal", "such as 0 -1 0").direction()
    size = element.child("Size", "such as 2").number(0, above=True)
    # Some files call it an intensity.
    radiance = (
        element.maybe("Radiance")
        or element.maybe("Intensity")
        or element.child("Radiance", "such as 10 10 10")
    )
    center = point(matrix, position)
    # Its size is in the world: no step changes it.
    u, v = tangents(transformed_normal(matrix, normal))
    return {
        "type": "rectangle",
        "corner": (center - (u + v) * (size / 2)).tolist(),
        "edge_u": (u * size).tolist(),
        "edge_v": (v * size).tolist(),
        "radiance": _times(pi, radiance),
        "two_sided": True,
        "visible": False,
    }


def tangents(normal: Floats64) -> tuple[Floats64, Floats64]:
    """Two unit vectors with cross(u, v) along the normal; its smallest component, set to 1, gives the plane of u."""
    n = normal / np.abs(normal).max()
    n /= np.linalg.norm(n)
    tilted = n.copy()
    tilted[np.argmin(np.abs(n))] = 1.0
    u = np.cross(tilted, n)
    u /= np.linalg.norm(u)
    return u, np.cross(n, u)


def _times(factor: float, element: MetuElement) -> list[float]:
    return [factor * value for value in element.color()]
