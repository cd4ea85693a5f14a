"""From light descriptions to lights in the frame of the compiled scene."""

from __future__ import annotations

import math

import numpy as np

from course.appearance.lights import (
    DirectionalLight,
    Light,
    PointLight,
    RectangleLight,
    SphereLight,
)
from course.appearance.materials import MaterialTable
from course.core.types import Floats32, Floats64
from course.effects import Effects
from course.errors import SceneError
from course.scene import description as d
from course.scene.brightness import in_range
from course.scene.description.values import rgb
from course.scene.frame import Frame
from course.scene.light_power import given, why_dark
from course.scene.loading import Loaded


def compile_lights(
    loaded: Loaded, frame: Frame, effects: Effects, materials: MaterialTable
) -> tuple[tuple[Light, ...], dict[str, str]]:
    """Lights that light something, and name -> reason for those that don't."""
    lights: list[Light] = []
    skipped: dict[str, str] = {}
    for number, light in enumerate(loaded.description.lights):
        name = f"light {number}"
        if isinstance(light, d.AmbientLight):
            continue
        reason = why_dark(light, materials)
        if reason:
            skipped[name] = reason
            continue
        lights.append(_compiled(light, name, number, loaded, frame, effects))
    return tuple(lights), skipped


def _compiled(
    light: d.Light, name: str, number: int, loaded: Loaded, frame: Frame, effects: Effects
) -> Light:
    path = ("lights", number)

    def color(value: Floats64) -> Floats32:
        return in_range(value / math.pi, loaded, path, "the light's power")

    # An intensity counts per squared length, so it shrinks with the square of the scene's unit; a radiance doesn't.
    match light:
        case d.PointLight():
            intensity = rgb(light.intensity) / frame.scale / frame.scale
            return PointLight(name, _single(frame.position(light.position)), color(intensity))
        case d.DirectionalLight():
            direction = np.array(light.direction) / np.abs(light.direction).max()
            towards = -direction / np.linalg.norm(direction)
            return DirectionalLight(name, _single(towards), color(rgb(light.irradiance)))
        case d.RectangleLight():
            edge_u, edge_v = frame.vector(light.edge_u), frame.vector(light.edge_v)
            normal = np.cross(edge_u, edge_v)
            area = float(np.linalg.norm(normal))
            emits = light.radiance is not None
            power = _area_power(light, frame, area)
            return RectangleLight(
                name,
                _single(frame.position(light.corner)),
                _single(edge_u),
                _single(edge_v),
                _single(normal / area) if emits else None,
                color(power),
                effects.function("soft_shadows", "point_on_rectangle"),
            )
        case d.SphereLight():
            radius = light.radius / frame.scale
            power = _area_power(light, frame, 4 * math.pi * radius * radius)
            center = _single(frame.position(light.center))
            if np.float32(radius) == 0:
                return PointLight(name, center, color(power))
            return SphereLight(
                name,
                center,
                radius,
                light.radiance is not None,
                color(power),
                effects.function("soft_shadows", "point_on_sphere"),
            )
        case d.AmbientLight():
            raise SceneError(f"{loaded.document.where(path)}: ambient light has no place")


def _area_power(light: d.RectangleLight | d.SphereLight, frame: Frame, area: float) -> Floats64:
    """Intensity in compiled units, or radiance times compiled area."""
    if light.radiance is not None:
        return rgb(light.radiance) * area
    return rgb(given(light.intensity)) / frame.scale / frame.scale


def _single(x: Floats64) -> Floats32:
    return x.astype(np.float32)
