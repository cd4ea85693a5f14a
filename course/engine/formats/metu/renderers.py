"""A camera's `Renderer` and `RendererParams`: direct light, or paths."""

from dataclasses import dataclass
from typing import Any, Final

from course.engine.formats.metu.element import MetuElement, Notes

RENDERERS: Final = ("DirectLighting", "PathTracing")
NEXT_EVENT, IMPORTANCE, ROULETTE = "NextEventEstimation", "ImportanceSampling", "RussianRoulette"

LONGEST: Final = 32
"""Bounces after which a path ends whatever the roulette says: surfaces without a division by pi may make light."""


@dataclass(frozen=True)
class Renderer:
    """Which light a camera's rays follow.

    Attributes
    ----------
    element : `Renderer`, or None for direct light
    parameters : the words of `RendererParams`
    """

    element: MetuElement | None = None
    parameters: tuple[str, ...] = ()

    def keys(self, direct: dict[str, Any]) -> dict[str, Any]:
        """What the integrator has for paths; ``direct`` is the one for direct light."""
        if self.element is None:
            return {}
        first: int = direct["max_depth"]
        if ROULETTE not in self.parameters:
            return {"type": "path", "roulette": None}
        return {"type": "path", "roulette": first, "max_depth": max(first, LONGEST)}

    def check(self, scene: MetuElement, common: dict[str, Any], notes: Notes) -> None:
        """SceneError for lights that these paths would not find in METU's renderers; and what there is to say.

        ``common``: the converted scene.
        """
        shiny = any("specular" in material for material in common["materials"].values())
        if self.element is None:
            if shiny and common["environment"].get("lights"):
                light = scene.child("Lights", "").child("SphericalDirectionalLight", "")
                notes.add(light, "lights diffuse terms; of highlights it makes none")
            return
        if shiny:
            notes.add(
                self.element,
                "is PathTracing: highlights are those of lights that shadow rays look for, and paths go on by"
                " diffuse and mirrored directions",
            )
        if NEXT_EVENT in self.parameters:
            return
        for light, keys in zip(_lights(scene), common["lights"], strict=False):
            power = keys.get("radiance", keys.get("intensity", keys.get("irradiance")))
            if any(power):
                raise self.element.error(
                    f"is PathTracing without {NEXT_EVENT} in RendererParams, which never finds {light.path}:"
                    f" add {NEXT_EVENT}, or remove that light"
                )


def _lights(scene: MetuElement) -> list[MetuElement]:
    """The lights without a surface, in the order in which they are converted."""
    parent = scene.maybe("Lights")
    kinds = ("AmbientLight", "PointLight", "AreaLight", "DirectionalLight", "SpotLight")
    return [] if parent is None else [light for kind in kinds for light in parent.all(kind)]


def read_renderer(camera: MetuElement) -> Renderer:
    """What a camera says; direct light where it says nothing."""
    element, parameters = camera.maybe("Renderer"), camera.maybe("RendererParams")
    words = () if parameters is None else tuple(parameters.words())
    known = (NEXT_EVENT, IMPORTANCE, ROULETTE)
    if parameters is not None and not set(words) <= set(known):
        raise parameters.unexpected(
            f"{', '.join(known[:-1])} or {ROULETTE}, which are all that is known"
        )
    name = RENDERERS[0] if element is None else " ".join(element.words())
    if element is not None and name not in RENDERERS:
        raise element.unexpected(f"{' or '.join(RENDERERS)}, which are all that is known")
    return Renderer(element if name == "PathTracing" else None, words)
