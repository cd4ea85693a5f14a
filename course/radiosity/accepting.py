"""Which scenes radiosity can do: surfaces that reflect diffusely, lamps with an area, and nothing that moves."""

from __future__ import annotations

import numpy as np

from course.formats.yaml import description as d
from course.formats.yaml.description import MotionDescription, rgb
from course.formats.yaml.document import KeyPath
from course.formats.yaml.loading import Loaded

LAMPS = "a rectangle or a sphere with radiance: radiosity takes lamps that are surfaces"
SHINES = "a light that is a rectangle or a sphere with radiance, or a material with emission"


def check_accepted(loaded: Loaded) -> None:
    """Refuse what has no radiosity.

    Raises SceneError: the scene has a mirror, glass, a highlight, a light without a surface, light from outside, a
    lens, or something that moves; names file, line, key path and the remedy.
    """
    scene = loaded.description
    used = {thing.material for thing in scene.objects}
    for name in sorted(used):
        _check_material(scene.materials[name], ("materials", name), loaded)
    for number, light in enumerate(scene.lights):
        _check_light(light, ("lights", number), loaded)
    if not any(
        isinstance(light, d.RectangleLight | d.SphereLight) and np.any(rgb(light.radiance or 0))
        for light in scene.lights
    ) and not any(np.any(rgb(scene.materials[name].emission)) for name in used):
        raise loaded.document.error(("lights",), f"nothing shines: expected {SHINES}")
    for number, thing in enumerate(scene.objects):
        _check_still(thing.motion, ("objects", number, "motion"), loaded)
        if thing.from_behind != "turned":
            raise loaded.document.unexpected(
                ("objects", number, "from_behind"), "turned: patches are seen from both sides"
            )
    _check_surroundings(loaded)


def _check_material(material: d.MaterialDescription, path: KeyPath, loaded: Loaded) -> None:
    diffuse_only = "for radiosity, which knows diffuse reflection only; or use course render"
    for key in ("dielectric", "conductor"):
        if getattr(material, key, None) is not None:
            raise loaded.document.error((*path, key), f"expected null {diffuse_only}")
    if material.texture is not None:
        raise loaded.document.error(
            (*path, "texture"), "expected null for radiosity, whose patches have one color each"
        )
    for key in ("mirror", "specular"):
        if rgb(getattr(material, key)).any():
            raise loaded.document.unexpected((*path, key), f"0 {diffuse_only}")


def _check_light(light: d.Light, path: KeyPath, loaded: Loaded) -> None:
    if isinstance(light, d.AmbientLight):
        if rgb(light.radiance).any():
            raise loaded.document.unexpected(
                (*path, "radiance"),
                "0: an ambient light stands in for the light between surfaces, which radiosity works out",
            )
    elif isinstance(light, d.RectangleLight | d.SphereLight):
        if light.radiance is None:
            raise loaded.document.unexpected((*path, "intensity"), f"radiance instead, of {LAMPS}")
        if isinstance(light, d.RectangleLight) and not light.visible:
            raise loaded.document.unexpected(
                (*path, "visible"), "true: a lamp is a patch as other surfaces are"
            )
        _check_still(light.motion, (*path, "motion"), loaded)
    # An object that is a light sends out what its material does, and that is in the patches already.
    elif not isinstance(light, d.ObjectLight):
        raise loaded.document.unexpected((*path, "type"), LAMPS)


def _check_still(motion: MotionDescription, path: KeyPath, loaded: Loaded) -> None:
    if any(motion.velocity):
        raise loaded.document.unexpected(
            (*path, "velocity"), "0: radiosity is worked out once, for surfaces that stand still"
        )


def _check_surroundings(loaded: Loaded) -> None:
    scene = loaded.description
    environment = scene.environment
    if not isinstance(environment, d.ConstantEnvironment):
        raise loaded.document.unexpected(
            ("environment", "type"), "constant, and black: radiosity knows no light from outside"
        )
    if rgb(environment.radiance).any():
        raise loaded.document.unexpected(
            ("environment", "radiance"), "0: radiosity knows no light from outside"
        )
    if scene.camera.image_plane is not None:
        raise loaded.document.error(
            ("camera", "image_plane"), "expected vertical_fov instead, which fits cameras anywhere"
        )
    if scene.camera.handedness == "left":
        raise loaded.document.unexpected(
            ("camera", "handedness"), "right: solutions are looked at as they are"
        )
    if scene.camera.near > 0:
        raise loaded.document.unexpected(
            ("camera", "near"), "0: solutions are looked at from the eye itself"
        )
    if scene.camera.lens is not None and scene.camera.lens.aperture_radius > 0:
        raise loaded.document.unexpected(
            ("camera", "lens", "aperture_radius"), "0: solutions are looked at through a pinhole"
        )
    _check_still(scene.camera.motion, ("camera", "motion"), loaded)
