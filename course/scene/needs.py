"""Which student functions a scene calls, and which line of the scene asks for each."""

from __future__ import annotations

from dataclasses import dataclass

from course.appearance.materials import MaterialTable
from course.effects import MODULES
from course.scene import description as d
from course.scene.document import KeyPath
from course.scene.light_power import why_dark
from course.scene.loading import Loaded
from course.scene.world import Settings


@dataclass(frozen=True)
class Need:
    """A function that will be called.

    Attributes
    ----------
    function : "module.function"
    asked_by : the key path in the scene file whose value makes it necessary
    """

    function: str
    asked_by: KeyPath


def needs_of(loaded: Loaded, settings: Settings, materials: MaterialTable) -> list[Need]:
    """Every function that rendering with these settings calls, in the order of the pipeline."""
    scene = loaded.description
    needs = []
    if settings.sampler != "sobol":
        needs.append(Need(f"supersampling.{settings.sampler}", ("sampler", "type")))
    if scene.film.filter == "gaussian":
        needs.append(Need("supersampling.gaussian_weights", ("film", "filter")))
    if settings.samples > 1:
        needs.append(Need("supersampling.resolve", ("sampler", "samples")))
    for number, light in enumerate(scene.lights):
        if why_dark(light, materials):
            continue
        if isinstance(light, d.RectangleLight):
            needs.append(Need("soft_shadows.point_on_rectangle", ("lights", number)))
        elif isinstance(light, d.SphereLight) and light.radius > 0:
            needs.append(Need("soft_shadows.point_on_sphere", ("lights", number)))
    return needs


_REASONS = {
    "supersampling": "one Sobol sample a pixel needs no pattern and no mean",
    "soft_shadows": "no light that has a size lights anything",
}


def skipped_modules(needs: list[Need]) -> dict[str, str]:
    """Modules that are never imported for this scene, each with the reason."""
    used = {need.function.partition(".")[0] for need in needs}
    return {module: _REASONS[module] for module in MODULES if module not in used}
