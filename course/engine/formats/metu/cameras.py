"""`Cameras`: where each picture is taken from, its size and its samples."""

import math
from dataclasses import dataclass, replace
from pathlib import PurePath
from typing import Any

import numpy as np

from course.engine.core.types import Floats64
from course.engine.formats.metu.element import MetuElement, Notes
from course.engine.formats.metu.renderers import Renderer, read_renderer
from course.engine.formats.metu.transformations import matrix_of, point
from course.engine.formats.yaml.consistency import sine
from course.engine.formats.yaml.description import LARGEST_SIDE, MOST_SAMPLES
from course.engine.formats.yaml.document import show

PARALLEL = 1e-6
"""Sine below which up and gaze count as parallel."""


@dataclass(frozen=True)
class MetuCamera:
    """One camera and its picture.

    Attributes
    ----------
    name : its id
    image : name of its picture, .png or .exr, without folders
    camera, film, sampler : of the project's own scene file
    paths : which light is followed
    """

    name: str
    image: str
    camera: dict[str, Any]
    film: dict[str, Any]
    sampler: dict[str, Any]
    paths: Renderer


def read_cameras(
    scene: MetuElement, steps: dict[str, dict[str, Any]], notes: Notes
) -> list[MetuCamera]:
    """All cameras of a scene; SceneError where there is none."""
    parent = scene.child("Cameras", "one Camera or more")
    cameras: list[MetuCamera] = []
    for element in parent.all("Camera"):
        camera = _camera(element, steps, notes)
        element.id([other.name for other in cameras])
        taken = {other.image for other in cameras}
        if camera.image in taken:
            # Another camera may have been given even that name.
            image, more = f"camera-{camera.name}.png", 1
            while image in taken:
                more += 1
                image = f"camera-{camera.name}-{more}.png"
            notes.add(element, f"has the ImageName of another camera, so {image} is written")
            camera = replace(camera, image=image)
        cameras.append(camera)
    if not cameras:
        raise parent.error("Camera is missing: expected one or more")
    return cameras


def _camera(element: MetuElement, steps: dict[str, dict[str, Any]], notes: Notes) -> MetuCamera:
    name = element.id()
    size = element.child("ImageResolution", "such as 800 600")
    width, height = size.numbers(2, "800 600")
    if not all(side == int(side) and 1 <= side <= LARGEST_SIDE for side in (width, height)):
        raise size.unexpected(f"2 whole numbers from 1 to {LARGEST_SIDE}, such as 800 600")
    position = np.array(element.child("Position", "such as 0 0 5").vector())
    gaze = _gaze(element, position)
    up_element = element.child("Up", "such as 0 1 0")
    up = np.array(up_element.vector())
    # Its directions may change in length; how wide it sees, and from how far, stays what it was.
    matrix = matrix_of(element, steps)
    position, gaze, up = point(matrix, position), matrix[:3, :3] @ gaze, matrix[:3, :3] @ up
    # As long as the position is far, so that their sum keeps its digits.
    gaze *= max(1.0, float(np.abs(position).max())) / float(np.abs(gaze).max())
    if not up.any() or sine(gaze, up) < PARALLEL:
        raise up_element.unexpected("a direction that is not 0 0 0 and not parallel to the gaze")
    camera = {
        "eye": position.tolist(),
        "look_at": (position + gaze).tolist(),
        "up": up.tolist(),
        **_window(element, notes),
        **_lens(element),
    }
    handedness = element.attribute("handedness") or "right"
    if handedness not in ("right", "left"):
        raise element.error(f"handedness is {show(handedness)}: expected right or left")
    if handedness == "left":
        camera["handedness"] = "left"
    film: dict[str, Any] = {
        "width": int(width),
        "height": int(height),
        "white": 255.0,
        "encoding": "linear",
        **_tone(element, notes),
    }
    rest = _sampler(element, notes), read_renderer(element)
    return MetuCamera(name, _image_name(element, notes), camera, film, *rest)


def _tone(element: MetuElement, notes: Notes) -> dict[str, Any]:
    """The film's tone mapping, by the first Tonemap that is Photographic; others are named and left out."""
    found: dict[str, Any] = {}
    for each in element.all("Tonemap"):
        operator = each.child("TMO", "such as Photographic")
        name, photographic = " ".join(operator.words()), operator.words() == ["Photographic"]
        if not photographic or found:
            why = "a second tone mapping" if photographic else "only Photographic is known"
            notes.add(each, f"has TMO {name}: {why}, so it was left out")
            for tag in ("TMOOptions", "Saturation", "Gamma"):
                if (part := each.maybe(tag)) is not None:
                    part.words()
            continue
        options = each.child("TMOOptions", "key and burn [%], such as 0.18 1")
        key, burn = options.numbers(2, "0.18 1")
        if not (0 < key <= 100 and 0 <= burn <= 100):
            raise options.unexpected("a key from 0 to 100 and a percentage, such as 0.18 1")
        saturation = each.child("Saturation", "such as 1").number(0)
        tone = {"key": key, "burn": burn, "saturation": saturation}
        curve = each.child("Gamma", "such as 2.2 or sRGB")
        if [word.lower() for word in curve.words()] == ["srgb"]:
            found = {"tone": tone, "encoding": "srgb"}
        else:
            found = {"tone": tone | {"gamma": curve.number(0, above=True)}}
    return found


def _gaze(element: MetuElement, position: Floats64) -> Floats64:
    # A gaze point is where it looks, a gaze the way there, of any length.
    where, looks_at = element.maybe("GazePoint"), _looks_at(element)
    if where is not None and (looks_at or element.maybe("Gaze") is None):
        gaze = np.array(where.vector()) - position
    else:
        where = element.child("Gaze", f"such as 0 0 -1{', or a GazePoint' if looks_at else ''}")
        gaze = np.array(where.vector())
    if not gaze.any():
        raise where.unexpected("a direction that is not 0 0 0, or another point than Position")
    return np.asarray(gaze)


def _looks_at(element: MetuElement) -> bool:
    """True for a lookAt camera: by its type, or by a field of view in place of a near plane."""
    kind = element.attribute("type")
    if kind not in (None, "", "simple", "lookAt"):
        raise element.error(f"type is {kind!r}: expected lookAt or none")
    if kind == "lookAt":
        return True
    tags = {child.tag for child in element.children}
    return "FovY" in tags and "NearPlane" not in tags


def _window(element: MetuElement, notes: Notes) -> dict[str, Any]:
    looks_at = _looks_at(element)
    distance = element.child("NearDistance", "such as 1").number(0, above=True)
    if looks_at:
        angle = element.child("FovY", "such as 60")
        if not 0 < (degrees := angle.number(0, above=True)) < 180:
            raise angle.unexpected("a number of degrees between 0 and 180")
        return {"vertical_fov": degrees}
    where = element.child("NearPlane", "left right bottom top, such as -1 1 -1 1")
    if len(where.words()) == 5:
        notes.add(where, "has 5 numbers: the first 4 are taken")
        where.text = " ".join(where.words()[:4])
    left, right, bottom, top = where.numbers(4, "-1 1 -1 1")
    if not (left < right and bottom < top):
        raise where.unexpected("left < right and bottom < top, in this order, such as -1 1 -1 1")
    plane = {"left": left, "right": right, "bottom": bottom, "top": top, "distance": distance}
    return {"image_plane": plane}


def _lens(element: MetuElement) -> dict[str, Any]:
    distance = element.number_of("FocusDistance", 0.0)
    edge = element.number_of("ApertureSize", 0.0)
    if edge == 0:
        return {}
    if not distance:
        raise element.error(
            "FocusDistance is missing or 0: expected a distance > 0, as ApertureSize is given"
        )
    # The square around a disk of that radius has edges twice as long.
    lens = {"aperture_radius": edge / 2, "shape": "square", "focus_distance": distance}
    return {"lens": lens}


def _sampler(element: MetuElement, notes: Notes) -> dict[str, Any]:
    found = element.maybe("NumSamples")
    count = 1 if found is None else found.whole(1)
    if found is None or count == 1:
        # A grid of one is the middle of the pixel, without any jitter.
        return {"type": "regular", "samples": 1}
    # The square number that is nearest: of 44 samples that of 7 x 7, not of 6 x 6.
    most = math.isqrt(MOST_SAMPLES)
    root = min(round(math.sqrt(count)), most)
    if root * root != count:
        grid = f"a grid has as many rows as columns, at most {most}"
        notes.add(found, f"is {count}: {grid}, so {root * root} are taken")
    return {"type": "jittered", "samples": root * root}


def _image_name(element: MetuElement, notes: Notes) -> str:
    found = element.maybe("ImageName")
    if found is None:
        return f"camera-{element.id()}.png"
    given = " ".join(found.words())
    # Only the last part: a scene file has no say in which folder is written to.
    name = PurePath(given.replace("\\", "/")).name
    if not name or not name.isprintable():
        raise found.unexpected("the name of a picture, such as box.png")
    if PurePath(name).suffix.lower() not in (".png", ".exr"):
        png = f"{PurePath(name).stem}.png"
        notes.add(found, f"is {name}: pictures are .png or .exr, so {png} is written")
        return png
    return name
