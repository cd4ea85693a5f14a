"""The scenes that radiosity can solve: surfaces that reflect diffusely, lamps with an area, and nothing that moves."""

from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.document import Place
from course.engine.formats.yaml.loading import Loaded
from course.engine.scene.building.further import KEYS

LAMPS = "a rectangle or a sphere with radiance: radiosity takes lamps that are surfaces"
SHINES = "a light that is a rectangle or a sphere with radiance, or a material with emission"


def check_accepted(loaded: Loaded) -> None:
    """Refuse what has no radiosity.

    Raises SceneError: the scene has a mirror, glass, a highlight, a light without a surface, light from outside, a
    lens, or something that moves; names file, line, key path and the remedy.
    """
    scene, whole = loaded.description, Place(loaded.document)
    for key in KEYS:
        what = "none: radiosity knows light from matte surface to matte surface alone"
        whole.check(not getattr(scene, key), key, what)
    used = sorted({thing.material for thing in scene.objects})
    for name in used:
        _check_material(scene.materials[name], whole.at("materials", name))
    for number, light in enumerate(scene.lights):
        _check_light(light, whole.at("lights", number))
    emitted = [scene.materials[name].emission for name in used]
    emitted += [
        light.radiance or 0
        for light in scene.lights
        if isinstance(light, d.RectangleLight | d.SphereLight)
    ]
    if not any(rgb(color).any() for color in emitted):
        raise whole.at("lights").error(f"nothing shines: expected {SHINES}")
    for number, thing in enumerate(scene.objects):
        here = whole.at("objects", number)
        _check_still(thing.motion, here)
        turned = thing.from_behind == "turned"
        here.check(turned, "from_behind", "turned: patches are seen from both sides")
    _check_environment(scene.environment, whole.at("environment"))
    _check_camera(scene.camera, whole.at("camera"))


def _check_material(material: d.MaterialDescription, here: Place) -> None:
    diffuse_only = "for radiosity, which knows diffuse reflection only; or use course render"
    for key in ("dielectric", "conductor"):
        if getattr(material, key) is not None:
            raise here.at(key).error(f"expected null {diffuse_only}")
    here.check(material.noise is None, "noise", "null: patches have one color each")
    for key in ("normal_map", "bump"):
        here.check(getattr(material, key) is None, key, "null: patches have one normal")
    if material.texture is not None:
        raise here.at("texture").error(
            "expected null for radiosity, whose patches have one color each"
        )
    for key in ("mirror", "specular", "unlit"):
        here.check(not rgb(getattr(material, key)).any(), key, f"0 {diffuse_only}")


def _check_light(light: d.Light, here: Place) -> None:
    match light:
        case d.AmbientLight():
            expected = "0: an ambient light stands in for the light between surfaces, which radiosity works out"
            here.check(not rgb(light.radiance).any(), "radiance", expected)
        case d.RectangleLight() | d.SphereLight():
            here.check(light.radiance is not None, "intensity", f"radiance instead, of {LAMPS}")
            visible = isinstance(light, d.SphereLight) or light.visible
            here.check(visible, "visible", "true: a lamp is a patch as other surfaces are")
            _check_still(light.motion, here)
        case _:
            # An object that is a light sends out what its material does, and that is in the patches already.
            here.check(isinstance(light, d.ObjectLight), "type", LAMPS)


def _check_still(motion: d.MotionDescription, here: Place) -> None:
    expected = "0: radiosity is worked out once, for surfaces that stand still"
    here.at("motion").check(not any(motion.velocity), "velocity", expected)


def _check_environment(environment: d.Environment, here: Place) -> None:
    outside = "radiosity knows no light from outside"
    constant = isinstance(environment, d.ConstantEnvironment)
    here.check(constant, "type", f"constant, and black: {outside}")
    if isinstance(environment, d.ConstantEnvironment):
        here.check(not rgb(environment.radiance).any(), "radiance", f"0: {outside}")


def _check_camera(camera: d.CameraDescription, here: Place) -> None:
    if camera.image_plane is not None:
        expected = "expected vertical_fov instead, which fits cameras anywhere"
        raise here.at("image_plane").error(expected)
    right = camera.handedness == "right"
    here.check(right, "handedness", "right: solutions are looked at as they are")
    here.check(camera.near == 0, "near", "0: solutions are looked at from the eye itself")
    aperture = camera.lens.aperture_radius if camera.lens else 0
    pinhole = "0: solutions are looked at through a pinhole"
    here.at("lens").check(aperture == 0, "aperture_radius", pinhole)
    _check_still(camera.motion, here)
