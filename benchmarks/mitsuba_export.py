"""A scene of ours as plain arrays, for a program that knows nothing of ours.

Everything is read from the checked description, in the units of the scene file, not from what our renderer has made
of it; only the triangles of named shapes come from our code. So a mistake in how we compile a camera, a light or a
material shows as a difference between the two pictures.
"""

import json
from collections.abc import Set
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from course.engine.core.environment import CubeEnvironment
from course.engine.formats.meshes.parts import same
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.scene.building.further import KEYS
from course.engine.scene.building.gloss import is_rough, lobe_of
from course.engine.scene.building.materials import Columns, base_color, material_columns
from course.engine.scene.building.motion import shutter_of
from course.engine.scene.building.objects import object_mesh
from course.engine.scene.scene import Scene
from course.engine.shapes.mesh import Mesh

LOBES = ("", "jitter_on_plane", "jitter_in_ball", "sample_phong_lobe")
"""Kinds of gloss by number; 0 is a perfect mirror."""

EXPORTED: dict[type[msgspec.Struct], frozenset[str]] = {
    d.MaterialDescription: frozenset(
        {"color", "ambient", "diffuse", "specular", "exponent", "mirror", "gloss", "dielectric"}
        | {"conductor"}
    ),
    d.Dielectric: frozenset({"refraction_index", "absorption", "roughness", "distribution"}),
    d.Conductor: frozenset({"refraction_index", "absorption_index", "roughness"}),
    d.CameraDescription: frozenset(
        {"eye", "look_at", "up", "vertical_fov", "lens", "shutter", "motion"}
    ),
    d.RectangleLight: frozenset({"corner", "edge_u", "edge_v", "radiance", "samples", "motion"}),
    d.ConstantEnvironment: frozenset({"radiance", "lights"}),
    d.CubeEnvironment: frozenset({"faces", "cross", "scale", "lookup", "lights", "sampling"}),
    d.LatLongEnvironment: frozenset({"image", "size", "scale", "lookup", "lights", "sampling"}),
}
"""The keys that are exported; what any other one says beyond its default is refused by name."""

LAT_LONG_COLUMNS = 4
"""Columns of the latitude-longitude picture for each texel along a face of the cube, unless more are asked for."""


class NotExportableError(Exception):
    """The scene asks for what is not exported."""


@dataclass(frozen=True)
class Part:
    """Triangles that move alike, as they are when the shutter opens.

    Attributes
    ----------
    vertices, normals : (V, 3) float32; a flat triangle has corners of its own
    triangles : (T, 3) uint32
    material : (T,) uint32
    velocity : units of the scene file a second
    """

    vertices: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray
    material: np.ndarray
    velocity: tuple[float, float, float]


@dataclass(frozen=True)
class Materials:
    """One row a material, float32.

    Attributes
    ----------
    ambient : (M, 3) radiance that the ambient lights make every point of the surface send out
    diffuse, specular, mirror : (M, 3)
    exponent : (M,) of the highlight
    lobe : (M,) index into LOBES; parameter : (M,) its roughness, glossiness or exponent
    refraction_index : (M,), 0 where opaque; absorption : (M, 3) [1 / unit of the scene file]
    n, k : (M, 3) of metals, whose ``mirror`` their Fresnel reflectance multiplies; 0 where no metal
    alpha : (M,) of GGX microfacets of metal or glass; 0 where smooth
    """

    ambient: np.ndarray
    diffuse: np.ndarray
    specular: np.ndarray
    mirror: np.ndarray
    exponent: np.ndarray
    lobe: np.ndarray
    parameter: np.ndarray
    refraction_index: np.ndarray
    absorption: np.ndarray
    n: np.ndarray
    k: np.ndarray
    alpha: np.ndarray

    @property
    def metal(self) -> np.ndarray:
        """(M,) which are metals by Fresnel's equations."""
        found: np.ndarray = (self.n > 0).any(axis=1) | (self.k > 0).any(axis=1)
        return found


@dataclass(frozen=True)
class Exported:
    """A scene.

    Attributes
    ----------
    lights : plain maps as in the scene file, without the ambient ones
        A light of type `object` is told by the number of a material that no other object has, and its radiance.
    camera : eye, look_at, up, vertical_fov [degree], aperture_radius, focus_distance
    shutter : seconds that it is open
    background : radiance from every direction, where the environment is no picture
    cube : (6, S + 2, S + 2, 3) float32, faces with a border of their neighbours' texels; empty where it is no picture
    lat_long : (H, W, 3) float32, the same as Mitsuba's `envmap` reads it, see ``lat_long_directions``
    sky : whether the environment lights diffuse surfaces
    paths : whether light is followed from one diffuse surface to the next
    roulette : bounces that a path makes before Russian roulette may end it, None for never
    """

    width: int
    height: int
    parts: tuple[Part, ...]
    materials: Materials
    lights: tuple[dict[str, Any], ...]
    camera: dict[str, Any]
    shutter: float
    background: tuple[float, float, float]
    cube: np.ndarray
    lat_long: np.ndarray
    sky: bool
    max_depth: int
    cutoff: float
    names: tuple[str, ...] = field(default=())
    paths: bool = False
    roulette: int | None = None

    @property
    def triangles(self) -> int:
        """How many."""
        return sum(len(part.triangles) for part in self.parts)


def export(scene: Scene, width: int, height: int, finer: int = LAT_LONG_COLUMNS) -> Exported:
    """Take a scene apart.

    Raises NotExportableError for what no benchmark scene has: lights by radiance that move, grids of lights, objects
    that are lights and open or not black, apertures other than disks, glass that blurs by a square or a lobe, and keys
    that are not EXPORTED.

    ``finer``: columns of the latitude-longitude picture for each texel along a face of the cube.
    """
    description = scene.loaded.description
    columns = material_columns(description)
    names = list(columns.names)
    lit = set(columns.of_lights.values())
    for key in KEYS:
        if getattr(description, key):
            raise NotExportableError(f"{key} are not exported")
    _refuse_others(description.camera, "camera")
    _refuse_others(description.environment, "environment")
    for number, light in enumerate(description.lights):
        _refuse_others(light, f"lights[{number}]")
    for number, name in enumerate(names):
        material = description.materials[name]
        _refuse_others(material, f"materials.{name}", {"emission"} if number in lit else set())
        if material.dielectric is not None:
            _refuse_others(material.dielectric, f"materials.{name}.dielectric")
            if material.gloss is not None:
                raise NotExportableError(f"materials.{name}.gloss of glass is not exported")
            if is_rough(material):
                raise NotExportableError(
                    f"materials.{name}.dielectric.roughness is exported with distribution ggx alone"
                )
        if material.conductor is not None:
            _refuse_others(material.conductor, f"materials.{name}.conductor")
    return Exported(
        width,
        height,
        _parts(scene, columns),
        _materials(scene, names),
        tuple(
            _lit_object(description, columns, number)
            if isinstance(light, d.ObjectLight)
            else _light(light)
            for number, light in enumerate(description.lights)
            if not isinstance(light, d.AmbientLight)
        ),
        _camera(description.camera),
        shutter_of(scene.loaded).duration,
        *_environment(scene, finer),
        description.environment.lights,
        description.integrator.max_depth,
        description.integrator.cutoff,
        tuple(names),
        description.integrator.type == "path",
        description.integrator.roulette,
    )


def _refuse_others(described: msgspec.Struct, where: str, besides: Set[str] = frozenset()) -> None:
    exported = EXPORTED.get(type(described))
    for key in msgspec.structs.fields(described) if exported is not None else ():
        value = getattr(described, key.name)
        if key.name not in exported | besides and value is not None and value != key.default:
            raise NotExportableError(f"{where}.{key.name} is not exported")


def _parts(scene: Scene, columns: Columns) -> tuple[Part, ...]:
    loaded = scene.loaded
    shutter = shutter_of(loaded)
    groups: dict[tuple[float, float, float], list[tuple[np.ndarray, ...]]] = {(0.0, 0.0, 0.0): []}
    for number, thing in enumerate(loaded.description.objects):
        mesh = object_mesh(thing, number, loaded.document, loaded.path.parent)
        velocity = thing.motion.velocity if shutter.moves(thing.motion) else (0.0, 0.0, 0.0)
        vertices, triangles, normals = mesh.vertices, mesh.triangles, mesh.normals
        vertices = vertices + shutter.start(thing.motion)
        column = columns.of_objects[number]
        lit = column in columns.of_lights.values()
        if lit and not _encloses(mesh):
            # Both sides shine, and of an open surface both are seen.
            raise NotExportableError(
                f"materials.{thing.material}.emission is not exported for objects[{number}]: Mitsuba's surfaces shine"
                " from their fronts alone, so it must be a closed body that faces outwards"
            )
        # Mitsuba takes the front, and the cosine there, by the normals that it shades by.
        if normals is None or lit:
            vertices, triangles, normals = _flat(vertices, triangles)
        material = np.full(len(triangles), column)
        groups.setdefault(velocity, []).append((vertices, normals, triangles, material))
    return tuple(_joined(meshes, velocity) for velocity, meshes in groups.items())


def _encloses(mesh: Mesh) -> bool:
    """Whether a mesh is closed, with its fronts outwards: each edge is passed as often one way as the other."""
    _, place = same(*mesh.vertices.T)
    start = place[mesh.triangles]
    end = np.roll(start, -1, axis=1)
    there, back = (np.sort(a * len(place) + b, axis=None) for a, b in ((start, end), (end, start)))
    p = mesh.vertices[mesh.triangles]
    volume = (p[:, 0] * np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])).sum()
    return np.array_equal(there, back) and bool(volume > 0)


def _flat(vertices: np.ndarray, triangles: np.ndarray) -> tuple[np.ndarray, ...]:
    """Give each triangle corners of its own, with its own normal."""
    corners = vertices[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    normal = np.where(length > 0, normal / np.where(length > 0, length, 1), [0.0, 1.0, 0.0])
    return (
        corners.reshape(-1, 3),
        np.arange(3 * len(triangles)).reshape(-1, 3),
        normal.repeat(3, axis=0),
    )


def _joined(meshes: list[tuple[np.ndarray, ...]], velocity: tuple[float, float, float]) -> Part:
    first = np.cumsum([0, *(len(vertices) for vertices, *_ in meshes)])
    return Part(
        np.concatenate([m[0] for m in meshes] or [np.zeros((0, 3))]).astype(np.float32),
        np.concatenate([m[1] for m in meshes] or [np.zeros((0, 3))]).astype(np.float32),
        np.concatenate(
            [m[2] + start for m, start in zip(meshes, first, strict=False)] or [np.zeros((0, 3))]
        ).astype(np.uint32),
        np.concatenate([m[3] for m in meshes] or [np.zeros(0)]).astype(np.uint32),
        velocity,
    )


def _materials(scene: Scene, names: list[str]) -> Materials:
    description = scene.loaded.description
    arriving = np.zeros(3)
    for light in description.lights:
        if isinstance(light, d.AmbientLight):
            arriving += rgb(light.radiance)
    rows: dict[str, list[Any]] = {name: [] for name in Materials.__dataclass_fields__}
    for name in names:
        material = description.materials[name]
        glass, metal = material.dielectric, material.conductor
        color = base_color(material) * (glass is None)
        _, lobe, parameter = lobe_of(material, description.integrator.cutoff) or ("", "", 0.0)
        rows["ambient"].append(color * material.ambient * arriving)
        rows["diffuse"].append(color * material.diffuse)
        rows["specular"].append(rgb(material.specular))
        rows["mirror"].append(rgb(material.mirror))
        rows["exponent"].append(material.exponent)
        rows["lobe"].append(LOBES.index(lobe))
        rows["parameter"].append(parameter)
        rows["refraction_index"].append(glass.refraction_index if glass else 0.0)
        rows["absorption"].append(rgb(glass.absorption) if glass else np.zeros(3))
        rows["n"].append(rgb(metal.refraction_index) if metal else np.zeros(3))
        rows["k"].append(rgb(metal.absorption_index) if metal else np.zeros(3))
        rough = metal or glass
        rows["alpha"].append(rough.roughness if rough else 0.0)
    return Materials(**{key: np.array(values, np.float32) for key, values in rows.items()})


def _lit_object(description: d.SceneDescription, columns: Columns, number: int) -> dict[str, Any]:
    """The light of an object, by its number among the lights."""
    column = columns.of_lights[number]
    thing = description.objects[columns.of_objects.index(column)]
    if any(thing.motion.velocity):
        raise NotExportableError("lights that move are not exported")
    material = description.materials[thing.material]
    reflects = (base_color(material), rgb(material.specular), rgb(material.mirror))
    if np.any(reflects) or material.dielectric is not None:
        raise NotExportableError(
            f"materials.{thing.material} of a light reflects, which is not exported: its normals are those of its"
            " triangles there"
        )
    return {"type": "object", "material": column, "radiance": _list(material.emission)}


def _light(light: d.Light) -> dict[str, Any]:
    assert not isinstance(light, d.ObjectLight)
    if not isinstance(light, d.DirectionalLight | d.AmbientLight) and any(light.motion.velocity):
        raise NotExportableError("lights that move are not exported")
    match light:
        case d.SpotLight():
            raise NotExportableError("spot lights are not exported: Mitsuba's have another edge")
        case d.PointLight():
            return {"type": "point", "center": light.position, "intensity": _list(light.intensity)}
        case d.DirectionalLight():
            towards = -np.array(light.direction) / np.linalg.norm(light.direction)
            return {
                "type": "directional",
                "towards": towards.tolist(),
                "irradiance": _list(light.irradiance),
            }
        # Where on a sphere by radiance the points are is no matter of the picture.
        case d.SphereLight() if light.samples in ("sphere", "visible"):
            quantity = "intensity" if light.radiance is None else "radiance"
            return {
                "type": "sphere",
                "center": light.center,
                "radius": light.radius,
                quantity: _list(getattr(light, quantity)),
            }
        case d.RectangleLight() if light.radiance is not None and light.samples == "point":
            edges = {"edge_u": light.edge_u, "edge_v": light.edge_v}
            return {
                "type": "rectangle",
                "corner": light.corner,
                "radiance": _list(light.radiance),
            } | edges
    raise NotExportableError(f"a light {light.__struct_config__.tag} like this is not exported")


def _list(color: float | tuple[float, ...] | None) -> list[float]:
    assert color is not None
    return [float(x) for x in rgb(color)]


def _camera(camera: d.CameraDescription) -> dict[str, Any]:
    radius, distance = 0.0, 1.0
    if camera.lens is not None:
        if camera.lens.shape != "disk":
            raise NotExportableError(f"an aperture that is a {camera.lens.shape} is not exported")
        radius = camera.lens.aperture_radius
        distance = camera.lens.focus_distance or 0.0
        if camera.lens.focus_point is not None:
            view = np.array(camera.look_at) - np.array(camera.eye)
            to_focus = np.array(camera.lens.focus_point) - np.array(camera.eye)
            distance = float(to_focus @ view / np.linalg.norm(view))
    if any(camera.motion.velocity):
        raise NotExportableError("a camera that moves is not exported")
    return {
        "eye": camera.eye,
        "look_at": camera.look_at,
        "up": camera.up,
        "vertical_fov": camera.vertical_fov,
        "aperture_radius": radius,
        "focus_distance": distance,
    }


def _environment(
    scene: Scene, finer: int
) -> tuple[tuple[float, float, float], np.ndarray, np.ndarray]:
    """Background, cube and latitude-longitude picture."""
    environment = scene.compiled.world.environment
    described = scene.loaded.description.environment
    nothing = np.zeros((0, 0, 3), np.float32)
    if isinstance(described, d.ConstantEnvironment):
        red, green, blue = _list(described.radiance)
        return (red, green, blue), nothing[None], nothing
    assert isinstance(environment, CubeEnvironment)

    def seen(directions: np.ndarray) -> np.ndarray:
        columns = np.ascontiguousarray(directions.reshape(-1, 3).T, np.float32)
        radiance = environment.radiance(columns).T.reshape(directions.shape)
        return np.ascontiguousarray(radiance, np.float32)

    size = environment.faces.shape[1]
    cube = seen(_bordered_directions(size))
    cube[:, 1:-1, 1:-1] = environment.faces
    # Three texels meet at a corner of the cube: their mean stands for the fourth.
    for row, column in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
        inner_row, inner_column = row or 1, column or 1
        inner_row, inner_column = (-2 if i == -1 else i for i in (inner_row, inner_column))
        cube[:, row, column] = (
            cube[:, inner_row, column]
            + cube[:, row, inner_column]
            + cube[:, inner_row, inner_column]
        ) / 3
    rows = finer * size // 2 + 1
    return (0.0, 0.0, 0.0), cube, seen(lat_long_directions(rows))


def _bordered_directions(size: int) -> np.ndarray:
    """Directions (6, size + 2, size + 2, 3) through the texels of all faces and those next to them beyond the edges."""
    place = 2 * np.arange(-1, size + 1) + 1 - size
    t, s = np.meshgrid(place, place, indexing="ij")
    # A texel beyond an edge lies on the neighbouring face, half a texel below that edge.
    m = np.where((np.abs(s) > size) | (np.abs(t) > size), size - 1, size)
    s, t = np.clip(s, -size, size), np.clip(t, -size, size)
    faces = [(m, -t, -s), (-m, -t, s), (s, m, t), (s, -m, -t), (s, -t, m), (-s, -t, -m)]
    return np.stack([np.stack(face, axis=-1) for face in faces]).astype(np.float64)


def lat_long_directions(rows: int) -> np.ndarray:
    """Directions (rows, 2 (rows - 1), 3) of the texels of a picture as Mitsuba's `envmap` reads it.

    The first and the last row are the poles +y and -y. The middles of the columns divide the circle evenly; the
    picture's middle looks along +z, its right half to -x.
    """
    columns = 2 * (rows - 1)
    theta = np.pi * np.arange(rows) / (rows - 1)
    phi = 2 * np.pi * (np.arange(columns) + 0.5) / columns
    x = np.sin(theta)[:, None] * np.sin(phi)
    z = -np.sin(theta)[:, None] * np.cos(phi)
    y = np.broadcast_to(np.cos(theta)[:, None], x.shape)
    return np.stack((x, y, z), axis=-1)


def write(exported: Exported, folder: Path) -> None:
    """Write a scene as scene.json and scene.npz."""
    folder.mkdir(parents=True, exist_ok=True)
    arrays = {"cube": exported.cube, "lat_long": exported.lat_long}
    arrays |= {f"materials.{key}": value for key, value in asdict(exported.materials).items()}
    for number, part in enumerate(exported.parts):
        for key in ("vertices", "normals", "triangles", "material"):
            arrays[f"{number}.{key}"] = getattr(part, key)
    np.savez(folder / "scene.npz", **arrays)
    plain = {
        key: getattr(exported, key)
        for key in Exported.__dataclass_fields__
        if key not in ("parts", "materials", "cube", "lat_long")
    }
    plain["velocities"] = [part.velocity for part in exported.parts]
    (folder / "scene.json").write_text(json.dumps(plain, indent=1))


def read(folder: Path) -> Exported:
    """Read what ``write`` has written."""
    plain = json.loads((folder / "scene.json").read_text())
    velocities = plain.pop("velocities")
    with np.load(folder / "scene.npz", allow_pickle=False) as arrays:
        parts = tuple(
            Part(
                *(arrays[f"{number}.{key}"] for key in ("vertices", "normals")),
                *(arrays[f"{number}.{key}"] for key in ("triangles", "material")),
                tuple(velocity),
            )
            for number, velocity in enumerate(velocities)
        )
        materials = Materials(
            **{key: arrays[f"materials.{key}"] for key in Materials.__dataclass_fields__}
        )
        return Exported(
            parts=parts,
            materials=materials,
            cube=arrays["cube"],
            lat_long=arrays["lat_long"],
            **plain,
        )
