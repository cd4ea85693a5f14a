"""Cameras from where they are and which way they look, and lenses from their descriptions."""

from dataclasses import replace

import numpy as np

from course.engine.core.camera import Camera, Lens
from course.engine.core.types import Floats64
from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Bound
from course.engine.scene.building.frame import Frame, in_reach
from course.engine.scene.building.motion import shutter_of
from course.engine.scene.building.sampled_points import DISK, DISKS
from course.engine.terms.cameras.apertures import PolygonLens, SquareLens
from course.engine.terms.cameras.near_plane import NearPlaneCamera
from course.engine.terms.lights.sampled import SampledLens


def make_camera(
    eye: Floats64,
    view: Floats64,
    up: Floats64,
    vertical_fov: float,
    width: int,
    height: int,
    near: float = 0.0,
) -> Camera:
    """A camera from where it is and which way it looks.

    Parameters
    ----------
    eye, view, up : (3,) float64; the view of any length, up any vector not parallel to it
    vertical_fov : radians
    width, height : pixels
    near : depth at which rays begin
    """
    half_height = np.tan(vertical_fov / 2)
    pixel = 2 * half_height / height
    corner = -(pixel * width / 2), half_height
    return _camera(eye, view, up, corner, (pixel, -pixel), near)


def make_window_camera(
    eye: Floats64,
    view: Floats64,
    up: Floats64,
    edges: Floats64,
    width: int,
    height: int,
    near: float = 0.0,
) -> Camera:
    """A camera whose picture is a window at right angles to the view; see ``make_camera``.

    ``edges``: (4,) float64, where the window's left, right, lower and upper edges are, at distance 1 and from the axis.
    """
    left, right, bottom, top = edges
    steps = (right - left) / width, (bottom - top) / height
    return _camera(eye, view, up, (left, top), steps, near)


def _camera(
    eye: Floats64,
    view: Floats64,
    up: Floats64,
    corner: tuple[float, float],
    steps: tuple[float, float],
    near: float,
) -> Camera:
    """A camera from its upper left corner and a pixel's steps, both to the right and up, at distance 1."""
    forward = _unit(view)
    right = _unit(np.cross(forward, _unit(up)))
    true_up = np.cross(right, forward)
    first = forward + right * corner[0] + true_up * corner[1]
    vectors = eye, right, true_up, forward, first, right * steps[0], true_up * steps[1]
    origin, x, y, z, corner_at, step_x, step_y = (vector.astype(np.float32) for vector in vectors)
    camera = Camera(origin, x, y, z, corner_at, step_x, step_y)
    return NearPlaneCamera(**vars(camera), near=near) if near else camera


def _unit(vector: Floats64) -> Floats64:
    # Scaled by a power of two before the squares, which changes no digit: they neither overflow nor vanish.
    _, exponent = np.frexp(np.abs(vector).max())
    scaled: Floats64 = np.ldexp(vector, -exponent)
    scaled /= np.linalg.norm(scaled)
    return scaled


NEAREST = 1e-6
"""Least distance of the plane in focus, in sizes of the scene: the functions of the course are asked for no less."""


def compile_lens(loaded: Loaded, frame: Frame, bound: Bound) -> Lens | None:
    """The lens, or None for a pinhole (no lens, or an aperture of 0).

    Raises SceneError: neither or both of focus_distance and focus_point, or a focus that isn't in front of the camera.
    """
    camera, document = loaded.description.camera, loaded.document
    lens, path = camera.lens, ("camera", "lens")
    if lens is None:
        return None
    if (lens.focus_distance is None) == (lens.focus_point is None):
        raise document.error(path, "give exactly one of focus_distance and focus_point")
    if lens.focus_distance is not None:
        key, distance = "focus_distance", lens.focus_distance
    else:
        key, view = "focus_point", np.array(camera.look_at) - np.array(camera.eye)
        to_focus = np.array(lens.focus_point) - np.array(camera.eye)
        largest = np.abs(view).max()
        distance = float(to_focus @ (view / largest) / np.linalg.norm(view / largest))
    if not distance > 0:
        raise document.unexpected((*path, key), "a plane in front of the camera")
    if lens.shape != "disk" and lens.samples != "point":
        raise document.unexpected((*path, "samples"), f"point for a {lens.shape}")
    if lens.aperture_radius == 0:
        return None
    radius, focus = lens.aperture_radius / frame.scale, distance / frame.scale
    if focus < NEAREST:
        # The rays' directions hang on the ratio alone, and squares of lengths must not vanish.
        radius, focus = NEAREST * (lens.aperture_radius / distance), NEAREST
    in_reach(np.array(radius), loaded, (*path, "aperture_radius"), "the aperture's size")
    in_reach(np.array(focus), loaded, (*path, key), "the focus's distance")
    named = ["lens_rays"]
    if lens.shape == "disk" and lens.samples == "point":
        named.append("point_on_disk")
    thin_lens = bound.functions("thin_lens", *named, asked_by=(*path, "aperture_radius"))
    known = radius, focus, thin_lens
    if lens.shape == "polygon":
        return PolygonLens(*known, lens.blades)
    if lens.shape == "square":
        return SquareLens(*known)
    if lens.samples == "point":
        return Lens(*known)
    function = DISKS[lens.samples]
    sampling = bound.functions("sampling", function, asked_by=(*path, "samples"))
    return SampledLens(*known, sampling, rejects=lens.samples == DISK)


STEEPEST = 1e6
"""Sideways over forwards, of the widest ray: beyond it float32 forgets that rays go forwards at all."""


def _check_slopes(edges: Floats64, loaded: Loaded, key: str) -> None:
    steepest = float(np.abs(edges).max())
    if not steepest < STEEPEST:
        raise loaded.document.error(
            ("camera", key),
            f"the widest ray goes {steepest:.3g} times as far sideways as forwards: expected less than {STEEPEST:g}",
        )


def compile_camera(loaded: Loaded, frame: Frame, width: int, height: int) -> Camera:
    """The camera for a picture of that size."""
    camera = loaded.description.camera
    start = shutter_of(loaded).start(camera.motion)
    eye = frame.position(np.array(camera.eye) + start)
    in_reach(eye, loaded, ("camera", "eye"), "the camera's distance")
    near = camera.near / frame.scale
    in_reach(np.array(near), loaded, ("camera", "near"), "the distance from which the camera sees")
    # In the file's units: in a huge scene the two positions may round to one.
    view, up = np.array(camera.look_at) - np.array(camera.eye), np.array(camera.up)
    plane = camera.image_plane
    if plane is not None:
        edges = np.array((plane.left, plane.right, plane.bottom, plane.top)) / plane.distance
        _check_slopes(edges, loaded, "image_plane")
    else:
        fov = np.radians(camera.vertical_fov)
        edges = np.tan(fov / 2) * np.array((-width / height, width / height, -1, 1))
        _check_slopes(edges, loaded, "vertical_fov")
        if camera.handedness == "right":
            return make_camera(eye, view, up, fov, width, height, near)
    if camera.handedness == "right":
        return make_window_camera(eye, view, up, edges, width, height, near)
    # A point at x to the right is shown at -x. The lens is mirrored, too.
    edges[:2] *= -1
    mirrored = make_window_camera(eye, view, up, edges, width, height, near)
    return replace(mirrored, right=-mirrored.right)
