"""Mitsuba's own plugins, for its scalar variant: there a plugin in Python would cost microseconds for each ray.

What they can't do the scene has to do without, and ``native_overrides`` says what: each effect has a variant of its
scene that both programs render. Where even that can't be had the pictures are only alike, see ``ALIKE``. The same
plugins run in the LLVM variant too, which makes their references.

Ambient light is emission of the surfaces, with sampling weight 0 so that nobody takes them for lamps. An object that is
a light is an emitter like others, on a mesh of its own.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.mitsuba_export import LOBES, Exported, NotExportableError, Part
from benchmarks.mitsuba_llvm import make_mesh
from benchmarks.mitsuba_phong import register_phong_lobe
from benchmarks.mitsuba_variants import ROBUST, Sensors
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.loading import load_description
from course.engine.formats.yaml.overriding import Overrides

SAMPLES_A_STILL = 4
"""Of a picture of moving things, which is the mean of stills."""

ALIKE = {
    "glossy": "no plane, ball or Phong lobes: roughconductor with lobes as wide, which lose some light",
    "cube_map": "clay can't be kept from lighting itself and the others",
    "mirror_and_matt": "Mitsuba has no cube maps: its environment is resampled to latitude and longitude",
}
"""Effects whose pictures are alike in both programs, not the same, and what Mitsuba can't do."""


def native_overrides(path: Path) -> tuple[Overrides, list[str]]:
    """What a scene has to do without for Mitsuba's own plugins, as values and in words."""
    scene = load_description(path).description
    values: dict[tuple[str | int, ...], Any] = {}
    words = []

    def of_materials(key: str, value: Any, word: str) -> None:
        names = [name for name, m in scene.materials.items() if np.any(rgb(getattr(m, key)))]
        values.update({("materials", name, key): value for name in names})
        if names:
            words.append(word)

    of_materials("specular", 0.0, "no highlights")
    if any(material.gloss for material in scene.materials.values()):
        # Mirrors are what the scene shows, and diffuse surfaces would light each other.
        of_materials("diffuse", 0.0, "ambient light only")
        return values, words
    for name, material in scene.materials.items():
        if material.dielectric is not None and np.any(material.dielectric.absorption):
            values["materials", name, "dielectric", "absorption"] = 0.0
            words.append("clear glass")
    if scene.environment.lights:
        return values, words
    of_materials("mirror", 0.0, "no mirrors")
    moves = any(any(thing.motion.velocity) for thing in scene.objects)
    for number, light in enumerate(scene.lights):
        if isinstance(light, d.SphereLight) and light.intensity is not None:
            radiance = rgb(light.intensity) / (math.pi * light.radius**2)
            values["lights", number] = {
                "type": "sphere",
                "center": list(light.center),
                "radius": light.radius,
                "radiance": radiance.tolist(),
                "samples": "visible",
            }
            words.append("the lamp by radiance, sampled where it is visible")
        if isinstance(light, d.AmbientLight) and moves:
            values["lights", number, "radiance"] = 0.0
            words.append("no ambient light (instances can't send out light)")
    return values, words


class NativeScene:
    """A scene in whichever variant of Mitsuba is switched on, of Mitsuba's own plugins only.

    Parameters
    ----------
    exported : the scene, loaded with ``native_overrides``
    lobes : whether Phong's lobes are a plugin in Python, for the LLVM variant; else they are only as wide
    robust : whether in Embree's robust mode, which lets no ray slip between two triangles
    """

    def __init__(self, exported: Exported, lobes: bool = False, robust: bool = False) -> None:
        import mitsuba as mi

        if lobes:
            register_phong_lobe()
        self._exported = exported
        self._scene = mi.load_dict({**_scene_map(exported, lobes), ROBUST: robust})
        # What moves is rendered as stills.
        self._sensors = Sensors(exported, shutter=0.0)
        self._moving = len(exported.parts) > 1
        self._values = mi.traverse(self._scene)

    def render(self, sampler: str, samples: int, seed: int) -> np.ndarray:
        """A picture (H, W, 3) float32; some samplers take more samples than were asked for."""
        if self._moving:
            return self._stills(sampler, samples, seed)
        return self._still(sampler, samples, seed)

    def samples(self, sampler: str, samples: int) -> int:
        """How many samples the sampler really takes."""
        if self._moving:
            drawn = self._sensors.samples(sampler, SAMPLES_A_STILL)
            return samples // SAMPLES_A_STILL * drawn
        return self._sensors.samples(sampler, samples)

    def _still(self, sampler: str, samples: int, seed: int) -> np.ndarray:
        integrator = self._scene.integrator()
        picture = integrator.render(self._scene, self._sensors[sampler], seed=seed, spp=samples)
        return np.array(picture)

    def _stills(self, sampler: str, samples: int, seed: int) -> np.ndarray:
        """The mean of stills, each at a random moment of its own stretch of the time."""
        count = max(samples // SAMPLES_A_STILL, 1)
        random = np.random.default_rng(seed)
        moments = (np.arange(count) + random.random(count)) / count * self._exported.shutter
        total = 0.0
        for moment in moments:
            self._move(float(moment))
            total = total + self._still(sampler, SAMPLES_A_STILL, int(random.integers(2**31)))
        return np.asarray(total / count, np.float32)

    def _move(self, time: float) -> None:
        import mitsuba as mi

        for number, part in enumerate(self._exported.parts[1:], start=1):
            gone = [v * time for v in part.velocity]
            self._values[f"instance_{number}.to_world"] = mi.Transform4f().translate(gone)
        self._values.update()


def _scene_map(e: Exported, lobes: bool) -> dict[str, Any]:
    """The whole scene but its sensor."""
    import mitsuba as mi

    content: dict[str, Any] = {"type": "scene", "integrator": _integrator(e)}
    for number, part in enumerate(e.parts):
        group: dict[str, Any] = {"type": "shapegroup"} if number else content
        for material in np.unique(part.material):
            group[f"mesh_{number}_{material}"] = _mesh(e, part, int(material), number == 0, lobes)
        if number:
            content[f"group_{number}"] = group
            content[f"instance_{number}"] = {
                "type": "instance",
                "group": {"type": "ref", "id": f"group_{number}"},
            }
    if e.lat_long.size:
        content["environment"] = {"type": "envmap", "bitmap": mi.Bitmap(e.lat_long)}
    elif any(e.background):
        content["environment"] = {"type": "constant", "radiance": _color(e.background)}
    if e.materials.diffuse.any() or e.paths:
        for number, light in enumerate(e.lights):
            # An object shines wherever it is seen, also where nothing reflects: see ``_mesh``.
            if light["type"] != "object":
                content[f"light_{number}"] = _light(light)
        # Without any lamp the environment stays one, for Mitsuba refuses a scene of weights 0.
        if e.lights and not e.sky and "environment" in content:
            content["environment"]["sampling_weight"] = 0.0
    return content


def _integrator(e: Exported) -> dict[str, Any]:
    m = e.materials
    if _glows_only(e):
        return {"type": "path", "max_depth": 1}
    if m.mirror.any() or e.sky or e.paths:
        bounces = e.roulette if e.paths and e.roulette is not None else e.max_depth + 1
        return {"type": "path", "max_depth": e.max_depth + 2, "rr_depth": bounces + 1}
    # One light for each sample: with more, `direct` counts lights without extent as often (Mitsuba 3.9).
    return {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0}


def _glows_only(e: Exported) -> bool:
    """Whether no surface reflects or lets light through."""
    m = e.materials
    return not any(np.any(row) for row in (m.diffuse, m.specular, m.mirror, m.refraction_index))


def _mesh(e: Exported, part: Part, material: int, still: bool, lobes: bool) -> Any:
    """The triangles of one material."""
    import mitsuba as mi

    chosen, numbers = np.unique(part.triangles[part.material == material], return_inverse=True)
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(_bsdf(e, material, lobes))
    # Mitsuba refuses a scene whose lamps all have a weight of 0.
    emitted, weight = e.materials.ambient[material], float(_glows_only(e))
    for light in e.lights:
        if light["type"] == "object" and light["material"] == material:
            emitted, weight = np.array(light["radiance"]), 1.0
    if emitted.any():
        if not still:
            raise NotExportableError("what moves can't send out light: Mitsuba's instances don't")
        lamp = {"type": "area", "radiance": _color(emitted), "sampling_weight": weight}
        properties["emitter"] = mi.load_dict(lamp)
    return make_mesh(
        f"mesh {material}",
        part.vertices[chosen],
        part.normals[chosen],
        numbers.reshape(-1, 3).astype(np.uint32),
        properties,
    )


def _bsdf(e: Exported, material: int, lobes: bool) -> dict[str, Any]:
    m, alpha = e.materials, float(e.materials.alpha[material])
    ggx = {"distribution": "ggx", "alpha": alpha} if alpha else {}
    mirror, diffuse = m.mirror[material], m.diffuse[material]
    if m.specular[material].any() or (mirror.any() and diffuse.any()):
        raise NotExportableError(f"{e.names[material]}: no plugin has these reflections together")
    if m.refraction_index[material]:
        return ggx | {
            "type": "roughdielectric" if ggx else "dielectric",
            "int_ior": float(m.refraction_index[material]),
            "ext_ior": 1.0,
        }
    if not mirror.any():
        return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": _color(diffuse)}}
    if lobes and LOBES[int(m.lobe[material])] == "sample_phong_lobe":
        exponent = float(m.parameter[material])
        return {"type": "phong_lobe", "reflectance": _color(mirror), "exponent": exponent}
    metal = {"type": "conductor", "material": "none", "specular_reflectance": _color(mirror)}
    if m.metal[material]:
        del metal["material"]
        metal |= {"eta": _color(m.n[material]), "k": _color(m.k[material])}
        metal |= ggx | ({"type": "roughconductor"} if ggx else {})
    width = _width(LOBES[int(m.lobe[material])], float(m.parameter[material]))
    if width:
        metal |= {"type": "roughconductor", "distribution": "beckmann", "alpha": width}
    return {"type": "twosided", "bsdf": metal}


def _width(lobe: str, parameter: float) -> float:
    """Roughness of a Beckmann distribution that blurs as much: half the standard deviation of the mirrored angle."""
    match lobe:
        case "jitter_on_plane":
            variance = parameter**2 / 12
        case "jitter_in_ball":
            variance = parameter**2 / 5
        case "sample_phong_lobe":
            variance = 1 / max(parameter, 1.0)
        case _:
            variance = 0.0
    return math.sqrt(variance / 2)


_BLACK = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.0}}
"""Lamps give off light and reflect none; Mitsuba's would be grey."""


def _light(light: dict[str, Any]) -> dict[str, Any]:
    import mitsuba as mi

    match light:
        case {"type": "point"}:
            return {
                "type": "point",
                "position": list(light["center"]),
                "intensity": _color(light["intensity"]),
            }
        case {"type": "directional"}:
            return {
                "type": "directional",
                "direction": [-x for x in light["towards"]],
                "irradiance": _color(light["irradiance"]),
            }
        case {"type": "sphere", "radiance": radiance}:
            return {
                "type": "sphere",
                "center": list(light["center"]),
                "radius": light["radius"],
                "bsdf": _BLACK,
                "emitter": {"type": "area", "radiance": _color(radiance)},
            }
        case {"type": "rectangle", "radiance": radiance}:
            u, v = (np.array(light[edge], float) / 2 for edge in ("edge_u", "edge_v"))
            middle = np.array(light["corner"]) + u + v
            columns = np.stack((u, v, np.cross(u, v), middle), axis=1)
            return {
                "type": "rectangle",
                "to_world": mi.ScalarTransform4f(np.vstack((columns, [0, 0, 0, 1]))),
                "bsdf": _BLACK,
                "emitter": {"type": "area", "radiance": _color(radiance)},
            }
    raise NotExportableError("Mitsuba has no lights by intensity that have a size")


def _color(values: Any) -> dict[str, Any]:
    return {"type": "rgb", "value": [float(x) for x in values]}
