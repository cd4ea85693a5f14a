"""Which student functions a scene calls, and which line asks for each; whether it needs light."""

from __future__ import annotations

from dataclasses import dataclass
from typing import get_args

from course.core.samplers import FUNCTIONS
from course.scene import description as d
from course.scene.acceleration_compiling import FUNCTIONS as HIERARCHY
from course.scene.document import KeyPath
from course.scene.environment_compiling import LOOKUPS, hemisphere_functions
from course.scene.lens_compiling import DISKS
from course.scene.light_compiling import light_function
from course.scene.light_power import power, why_dark
from course.scene.loading import Loaded
from course.scene.lobe_compiling import lobe_function
from course.scene.motion_compiling import movers
from course.scene.path_compiling import path_functions
from course.scene.roughness_compiling import FUNCTIONS as ROUGH_GLASS
from course.scene.roughness_compiling import is_rough, reflecting
from course.scene.scene import Scene
from course.scene.shutter import shutter_of
from course.scene.texture_compiling import places_function, shows_texture
from course.scene.world import Settings, World


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


def needs_of(loaded: Loaded, settings: Settings, world: World) -> list[Need]:
    """Every function that rendering with these settings calls, in the order of the pipeline."""
    scene = loaded.description
    needs = [
        Need(".".join(function), ("sampler", "type")) for function in FUNCTIONS[settings.sampler]
    ]
    if scene.film.filter == "gaussian":
        needs.append(Need("supersampling.gaussian_weights", ("film", "filter")))
    if settings.samples > 1:
        needs.append(Need("supersampling.resolve", ("sampler", "samples")))
    if settings.subdivision is not None:
        needs.append(Need("adaptive_sampling.needs_subdivision", ("film", "subdivision")))
        if settings.subdivision.depth:
            needs.append(Need("adaptive_sampling.subdivide", ("film", "subdivision")))
    for number, light in enumerate(scene.lights):
        if why_dark(light, world.materials):
            continue
        function = light_function(light)
        if function:
            needs.append(Need(".".join(function), ("lights", number)))
    if settings.max_depth:
        used = dict.fromkeys(thing.material for thing in scene.objects)
        for name in used:
            material = scene.materials[name]
            lobe = lobe_function(reflecting(material), settings.cutoff)
            if lobe:
                asked_by = ("materials", name, "gloss")
                needs.append(Need(f"glossy.{lobe}", asked_by))
                if scene.integrator.into_surface == "mirror":
                    needs.append(Need("glossy.keep_above", asked_by))
            if is_rough(material):
                needs += [
                    Need(
                        f"blurred_transparency.{f}", ("materials", name, "dielectric", "roughness")
                    )
                    for f in ROUGH_GLASS
                ]
    if scene.acceleration.type == "hierarchy":
        needs += [Need(f"bounding_volumes.{f}", ("acceleration", "type")) for f in HIERARCHY]
    needs += _of_textures(scene)
    needs += [
        Need(f"path_tracing.{name}", ("integrator", "type"))
        for name in path_functions(scene.integrator, settings.max_depth, world.materials)
    ]
    lens = scene.camera.lens
    if lens is not None and lens.aperture_radius > 0:
        asked_by = ("camera", "lens", "aperture_radius")
        if lens.shape == "disk":
            samples = ("camera", "lens", "samples") if lens.samples != "point" else asked_by
            needs.append(Need(".".join(DISKS[lens.samples]), samples))
        needs.append(Need("thin_lens.lens_rays", asked_by))
    if not (isinstance(scene.environment, d.ConstantEnvironment) or world.environment.black):
        lookup = LOOKUPS[scene.environment.lookup]
        needs.append(Need(f"cube_map.{lookup}", ("environment", "type")))
    if not world.environment.black:
        needs += [
            Need(f"importance_sampling.{name}", ("environment", "sampling"))
            for name in hemisphere_functions(loaded)
        ]
    moving = movers(loaded, shutter_of(loaded), world.materials)
    if moving:
        needs.append(Need("motion_blur.shutter_times", moving[0]))
        needs.append(Need("motion_blur.displacement", moving[0]))
        objects = [path for path in moving if path[0] == "objects"]
        if objects:
            needs.append(Need("motion_blur.to_object_space", objects[0]))
    return needs


def _of_textures(scene: d.SceneDescription) -> list[Need]:
    """A function for each kind of shape that shows a texture, and the lookup."""
    asked: dict[str, KeyPath] = {}
    for thing in scene.objects:
        if shows_texture(scene.materials[thing.material]):
            for name in (places_function(thing), "texture_lookup"):
                asked.setdefault(name, ("materials", thing.material, "texture"))
    return [Need(f"textures.{name}", path) for name, path in asked.items()]


_REASONS = {
    "supersampling": "one sample a pixel needs no mean, and this sampler none of its patterns",
    "soft_shadows": "no light takes its points on a rectangle or in a ball",
    "glossy": "no mirror is glossy",
    "thin_lens": "the aperture is 0",
    "motion_blur": "nothing moves while the shutter is open",
    "cube_map": "the environment is no picture, or a black one",
    "blurred_transparency": "no glass is rough",
    "textures": "no surface shows a texture",
    "bounding_volumes": "Embree answers the rays",
    "importance_sampling": "no directions towards an environment are chosen by its functions",
}


def skipped_modules(needs: list[Need], integrator: d.IntegratorDescription) -> dict[str, str]:
    """Modules that are never imported for this scene, each with the reason."""
    used = {need.function.partition(".")[0] for need in needs}
    reasons = {module: reason for module, reason in _REASONS.items() if module not in used}
    if "path_tracing" not in used:
        reasons["path_tracing"] = (
            "no path goes on from a diffuse surface"
            if integrator.type == "path"
            else "the integrator is the distribution ray tracer"
        )
    return reasons


def why_black(scene: Scene) -> str:
    """Say why every picture of a scene is black for want of light; empty where there is some."""
    world, lights = scene.compiled.world, scene.loaded.description.lights
    seen = world.materials.ambient * world.ambient[:, None] + world.materials.emission
    if world.lights or seen.any() or not world.environment.black:
        return ""
    if not lights:
        kinds = ", ".join(str(kind.__struct_config__.tag) for kind in get_args(d.Light))
        return (
            "the picture will be black: the scene has no lights, and its environment is black; "
            f"known are {kinds}, such as {{type: ambient, radiance: 1}}"
        )
    reasons = dict(world.skipped_lights)
    for number, light in enumerate(lights):
        if isinstance(light, d.AmbientLight):
            dark = not power(light).any()
            reasons[f"light {number}"] = (
                "it has no power" if dark else "no material has an ambient term"
            )
    listed = [f"{name}: {reason}" for name, reason in list(reasons.items())[:3]]
    return (
        "the picture will be black: the environment is black, and no light shows anything "
        f"({'; '.join(listed)}{'; ...' if len(reasons) > 3 else ''})"
    )
