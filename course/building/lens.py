"""From a lens description to the lens of the compiled scene."""

from __future__ import annotations

import numpy as np

from course.building.frame import Frame
from course.building.ranges import in_reach
from course.building.sampled_points import DISK, DISKS
from course.core.camera import Lens
from course.effects import Bound
from course.extras.apertures import PolygonLens, SquareLens
from course.extras.sampled import SampledLens
from course.formats.yaml.loading import Loaded

NEAREST = 1e-6
"""Least distance of the plane in focus, in sizes of the scene: the functions of the course are asked for no less."""


def compile_lens(loaded: Loaded, frame: Frame, bound: Bound) -> Lens | None:
    """The lens, or None for a pinhole (no lens, or an aperture of 0).

    Raises
    ------
    SceneError
        Neither or both of focus_distance and focus_point, or a focus that isn't in front of the camera.
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
