"""Which lamps and lobes of a scene are sampled together."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from course.engine.core.gloss import Lobe
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.materials import MaterialTable
from course.engine.core.types import Functions
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.document import KeyPath
from course.engine.functions.effects import Bound
from course.engine.terms.lights.multiple_importance import Combining, FlatLamp, Lamp, RoundLamp
from course.engine.terms.lights.visible_sphere import VisibleSphereLight
from course.engine.terms.scattering.microfacets import Microfacets

POWERS = {"lamp": None, "balance": 1.0, "power": 2.0, "automatic": 2.0}
"""Exponent of the heuristic for each value of ``gloss_sampling`` but ``lobe``."""


def compile_combining(
    scene: d.SceneDescription,
    bound: Bound,
    materials: MaterialTable,
    lobes: Sequence[Lobe],
    microfacets: Mapping[str, Microfacets],
    lights: Sequence[Light],
) -> Combining | None:
    """None where a scene doesn't ask for it, or has no lamp and no lobe that could be sampled together.

    ``microfacets``: by the names of their materials

    Lobes are Phong's and not on glass, or those of rough metals, which ask by themselves. Lamps stand still, rays can
    meet them, and their points have a density in closed form. Where rays start far above surfaces all is left to the
    lobes; so it is, but for lights that no ray can meet, where the distribution ray tracer divides rays at glass.
    """
    integrator = scene.integrator
    way = integrator.gloss_sampling
    metals = {name: one for name, one in microfacets.items() if one.k is not None}
    if integrator.surface_offset > 0 or not (metals or asks_for_phong(integrator)):
        return None
    divides = integrator.type != "path" and materials.refracts.any()
    exponents = np.full(len(materials.exponent), -1, np.float32)
    for lobe in lobes if asks_for_phong(integrator) else ():
        if type(lobe) is Lobe and lobe.kind == "phong" and not materials.refracts[lobe.material]:
            exponents[lobe.material] = lobe.parameter
    surfaces = _surfaces(scene, materials)
    met = {f"light {k}" for k, light in enumerate(scene.lights) if _can_be_met(light)}
    bare = tuple(light for light in lights if metals and light.name not in met)
    known = {light.name: light for light in lights if light.velocity is None}
    found = [(light, surfaces[name]) for name, light in known.items() if name in surfaces]
    found = [pair for pair in found if _has_density(pair[0])]
    if way == "lobe" or divides or not (metals or (exponents >= 0).any()):
        found = []
    if not found and not bare:
        return None
    asked_by: KeyPath = ("integrator", "gloss_sampling")
    if not asks_for_phong(integrator):
        # The first of the metals does.
        asked_by = _roughness(next(iter(metals)))
    names = [] if way == "lamp" or not found else ["heuristic_weights"]
    if any(isinstance(light, RectangleLight) for light, _ in found):
        names.append("area_density")
    if not all(isinstance(light, RectangleLight) for light, _ in found):
        names.append("cone_density")
    functions = bound.functions("multiple_importance", *names, asked_by=asked_by)
    lamps = tuple(_lamp(light, surface, functions) for light, surface in found)
    names = ["brdf", "visible_normal_pdf"] if found else ["brdf"]
    lit = tuple(
        replace(one, functions=bound.functions("microfacets", *names, asked_by=_roughness(name)))
        for name, one in metals.items()
    )
    return Combining(lamps, exponents, POWERS.get(way), functions, lit, bare)


def asks_for_phong(integrator: d.IntegratorDescription) -> bool:
    """Whether Phong's lobes look for points on lamps; those of rough metals do so by themselves."""
    return integrator.gloss_sampling not in ("automatic", "lobe")


def _roughness(material: str) -> KeyPath:
    return "materials", material, "conductor", "roughness"


def _surfaces(scene: d.SceneDescription, materials: MaterialTable) -> dict[str, int]:
    """The materials of the surfaces of lights, by the lights' names."""
    if materials.lamps is None:
        return {}
    columns = np.flatnonzero(materials.lamps).tolist()
    names = [
        f"light {number}"
        for number, light in enumerate(scene.lights)
        if _can_be_met(light) and not isinstance(light, d.ObjectLight)
    ]
    return dict(zip(names, columns, strict=True))


def _can_be_met(light: d.Light) -> bool:
    """Whether rays can meet a light: then a lobe finds it, and its points alone would count it twice."""
    match light:
        case d.ObjectLight():
            return True
        case d.SphereLight():
            return light.radiance is not None
        case d.RectangleLight():
            return light.radiance is not None and light.visible
    return False


def _has_density(light: Light) -> bool:
    if isinstance(light, RectangleLight):
        return light.normal is not None and light.visible and not light.two_sided
    return isinstance(light, VisibleSphereLight) or (
        isinstance(light, SphereLight) and light.emitter
    )


def _lamp(light: Light, surface: int, functions: Functions) -> Lamp:
    if isinstance(light, SphereLight):
        # Wherever matt surfaces look for its points, lobes do on the part that is seen, whose points have a density.
        known = light.name, light.center, light.radius, light.color
        light = VisibleSphereLight(*known)
    if isinstance(light, VisibleSphereLight):
        area = 4 * np.pi * light.radius**2
        return RoundLamp(light, surface, area, functions, light.center, light.radius)
    assert isinstance(light, RectangleLight)
    sides = light.edge_u.astype(np.float64), light.edge_v.astype(np.float64)
    area = float(np.linalg.norm(np.cross(*sides)))
    return FlatLamp(light, surface, area, functions)
