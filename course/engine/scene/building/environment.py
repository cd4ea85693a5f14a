"""From an environment description to the environment of the compiled scene."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from course.engine.core.environment import ConstantEnvironment, CubeEnvironment, Environment
from course.engine.core.types import Floats32
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.document import KeyPath
from course.engine.formats.yaml.loading import Loaded, read_named_picture
from course.engine.functions.effects import Bound
from course.engine.scene.building.frame import in_range
from course.engine.scene.building.materials import diffuse_share
from course.engine.terms.environments.cube_faces import (
    cube_from_angular,
    cube_from_cross,
    cube_from_lat_long,
)
from course.engine.terms.environments.hemispheres import WAYS, HemisphereSampling
from course.engine.terms.environments.light import PictureSampling, picture_sampling
from course.engine.terms.environments.sampling import product_sampling
from course.engine.terms.environments.sky import CosineSampling, SkySampling
from course.engine.terms.surfaces.textures import Texture

LOOKUPS = {"seamless": "lookup_seamless", "clamped": "lookup"}
"""The cube_map function for each value of ``lookup``."""

HEMISPHERES = {
    "uniform": ("uniform_hemisphere", "phong_lobe_pdf"),
    "cosine": ("cosine_hemisphere", "cosine_hemisphere_pdf"),
    "power": (
        *("uniform_hemisphere", "phong_lobe_pdf", "cosine_hemisphere", "cosine_hemisphere_pdf"),
        "power_heuristic",
    ),
}
"""The importance_sampling functions for values of ``sampling``."""

BY_PICTURE = {
    "inversion": ("texel_weights", "cumulate", "sample_direction", "density"),
    "alias": ("texel_weights", "alias_table", "draw_alias", "density"),
}
"""The environment_light functions for values of ``sampling``."""


def compile_environment(
    loaded: Loaded, bound: Bound
) -> tuple[Environment | None, SkySampling | None]:
    """Read the pictures, if there are any, and make a cube of them.

    Raises SceneError: a picture is missing, can't be read, has the wrong size or is too bright; names the key that asks
    for it.
    Returns the environment, None if it is black, and the sampling of its directions, None if it lights nothing.
    """
    environment = loaded.description.environment
    if isinstance(environment, d.ConstantEnvironment):
        radiance = in_range(rgb(environment.radiance), loaded, ("environment",), "radiance")
        if not radiance.any():
            return None, None
        even = ConstantEnvironment(radiance)
        return even, _sampling(environment.lights, _students(even, loaded, bound))
    if isinstance(environment, d.BackdropEnvironment):
        return _backdrop(environment, loaded, bound), None
    if isinstance(environment, d.CubeEnvironment):
        faces = _faces(environment, loaded)
    else:
        image = _picture(environment.image, ("environment", "image"), loaded, environment)
        height, width = image.shape[:2]
        angular = isinstance(environment, d.AngularEnvironment)
        if width != height * (1 if angular else 2):
            raise loaded.document.error(
                ("environment", "image"),
                f"{'an angular map is as' if angular else 'a picture of all directions is twice as'} wide as high,"
                f" not {width} x {height}",
            )
        resample = cube_from_angular if angular else cube_from_lat_long
        faces = resample(image, environment.size or max(width // 4, 1))
    scale = rgb(environment.scale)
    brightest = faces.max(axis=(0, 1, 2)) * scale
    in_range(brightest, loaded, ("environment", "scale"), "radiance")
    # In double precision, for a scale may be larger than any radiance.
    faces = np.multiply(faces, scale, out=np.empty_like(faces), casting="same_kind")
    faces = np.ascontiguousarray(faces, np.float32)
    if not faces.any():
        # Black, or its light is lost to single precision: nothing is to be looked up.
        return None, None
    lookup = LOOKUPS[environment.lookup]
    cube_map = bound.functions("cube_map", lookup, asked_by=("environment", "type"))
    seamless = environment.lookup == "seamless"
    cube = CubeEnvironment(faces, cube_map, seamless)
    chosen: SkySampling | None = _students(cube, loaded, bound)
    if chosen is None and environment.lights and _anything_diffuse(loaded):
        chosen = product_sampling(faces, seamless)
    return cube, _sampling(environment.lights, chosen)


def _backdrop(environment: d.BackdropEnvironment, loaded: Loaded, bound: Bound) -> Any:
    from course.engine.terms.environments.backdrop import Backdrop

    image = _picture(environment.image, ("environment", "image"), loaded, environment)
    scale = rgb(environment.scale)
    brightest = image.max(axis=(0, 1)) * scale
    in_range(brightest, loaded, ("environment", "scale"), "radiance")
    if not brightest.any():
        return None
    lookup = bound.function("textures", "texture_lookup", ("environment", "type"))
    nearest = environment.interpolation == "nearest"
    picture = Texture(image, np.ones(2, np.float32), lookup, nearest)
    return Backdrop(picture, scale.astype(np.float32))


def _sampling(lights: bool, chosen: SkySampling | None) -> SkySampling | None:
    if not lights:
        return None
    return chosen or CosineSampling()


def _names(ways: Mapping[str, tuple[str, ...]], loaded: Loaded) -> list[str]:
    """The functions of a way, if the environment lights anything in that way."""
    environment = loaded.description.environment
    if not environment.lights or not _anything_diffuse(loaded):
        return []
    return list(ways.get(environment.sampling, ()))


def _students(
    environment: Environment, loaded: Loaded, bound: Bound
) -> HemisphereSampling | PictureSampling | None:
    """The sampling by functions of importance_sampling or environment_light.

    None if neither is asked for; the modules aren't imported then.
    """
    asked_by = ("environment", "sampling")
    if names := _names(HEMISPHERES, loaded):
        functions = bound.functions("importance_sampling", *names, asked_by=asked_by)
        return HemisphereSampling(functions, tuple(name for name in WAYS if name in names))
    if names := _names(BY_PICTURE, loaded):
        functions = bound.functions("environment_light", *names, asked_by=asked_by)
        return picture_sampling(environment, functions, "alias_table" in names)
    return None


def _anything_diffuse(loaded: Loaded) -> bool:
    """True if any object reflects diffusely."""
    scene = loaded.description
    used = (scene.materials[thing.material] for thing in scene.objects)
    return any(diffuse_share(material).any() for material in used)


def _picture(
    file: str,
    path: KeyPath,
    loaded: Loaded,
    environment: d.CubeEnvironment | d.LatLongEnvironment | d.BackdropEnvironment,
) -> Floats32:
    return read_named_picture(file, path, loaded, layer=environment.layer)


def _faces(environment: d.CubeEnvironment, loaded: Loaded) -> Floats32:
    if (environment.faces is None) == (environment.cross is None):
        raise loaded.document.error(("environment",), "give exactly one of faces and cross")
    if environment.cross is not None:
        key = ("environment", "cross")
        try:
            return cube_from_cross(_picture(environment.cross, key, loaded, environment))
        except ValueError as error:
            raise loaded.document.error(key, str(error)) from error
    pictures: list[Floats32] = []
    for number, file in enumerate(environment.faces or ()):
        path = ("environment", "faces", number)
        picture = _picture(file, path, loaded, environment)
        height, width = picture.shape[:2]
        if height != width or picture.shape != (pictures or [picture])[0].shape:
            raise loaded.document.error(
                path, f"all faces are squares of one size, this is {width} x {height}"
            )
        pictures.append(picture)
    return np.stack(pictures)
