"""`Objects`: meshes, instances of them, spheres, triangles and planes.

An instance takes its mesh from another object; the engine has no instances, so each becomes an object with the same
mesh file, which is read once.
"""

import json
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from course.engine.core.types import Floats64, Indices
from course.engine.formats.meshes.files import read_mesh
from course.engine.formats.metu.element import MetuElement, Notes
from course.engine.formats.metu.materials import material_name
from course.engine.formats.metu.meshes import (
    MeshTable,
    check_indices,
    corners_of,
    has_normals,
    inline_mesh,
    mesh_file,
    offset_of,
    places_of,
    plane_mesh,
)
from course.engine.formats.metu.textures import TextureMap, Textures
from course.engine.formats.metu.transformations import matrix_of, matrix_of_steps, transform_of
from course.engine.formats.metu.transformations import normal as transformed_normal
from course.engine.formats.metu.transformations import point as moved
from course.engine.formats.yaml.document import show
from course.engine.formats.yaml.suggestions import suggest
from course.engine.shapes.mesh import Mesh

SEGMENTS = ((8, 512), (32, 256), (128, 128))
"""Spheres a scene may have at most for so many flat pieces around each: a million triangles, or two, in all."""

FEWEST_SEGMENTS = 64

LAMP_SEGMENTS = 128
"""Flat pieces around a ball that is a light; each of its triangles is one that shadow rays may look for."""

UNEVEN = 1e-9
"""Relative difference of scales, squared, up to which a ball stays one."""

TINY = 1e-290

BLACK = {"color": [0.0, 0.0, 0.0]}
"""A material that reflects nothing."""

CUBE = np.array(list(product((-1, 1), repeat=3)))
"""Corners of the cube of edge 2 about the origin, (8, 3)."""

INHERITED = ("shape", "file", "shading", "normals", "material")
"""What an instance has from its base; how that moves is its own affair."""


@dataclass(frozen=True)
class InstanceSurface:
    """What an instance with textures needs of its mesh.

    Attributes
    ----------
    faces : the element
    mode : smooth, flat or None for what its file says
    material : the id of its material
    """

    faces: MetuElement
    mode: str | None
    material: str


@dataclass
class Objects:
    """Turns the objects of one scene into those of the project's own scene files.

    Attributes
    ----------
    vertices : (V, 3) float64
    materials : by id, as the converted scene has them
    steps : of `Transformations`, by letter and id
    source : folder of the METU scene, from which its mesh files are named
    meshes : files of the converted scene
    notes : what there is to say about them
    eyes : where the cameras stand
    textures : of the scene
    lamps : materials of the objects that are lights, by the objects' names; made as they are read
    balls : lights that are balls, which are no objects; made as they are read
    """

    vertices: Floats64
    materials: dict[str, dict[str, Any]]
    steps: dict[str, dict[str, Any]]
    source: Path
    meshes: MeshTable
    notes: Notes
    eyes: list[list[float]]
    textures: Textures
    lamps: dict[str, dict[str, Any]] = field(default_factory=dict)
    balls: list[dict[str, Any]] = field(default_factory=list)
    _bases: dict[str, dict[str, Any]] = field(default_factory=dict)
    _surfaces: dict[str, InstanceSurface] = field(default_factory=dict)
    _textured: int = 0

    def read(self, scene: MetuElement) -> list[dict[str, Any]]:
        """All objects of a scene; `meshes.write` then writes the meshes that it holds itself."""
        parent = scene.child("Objects", "one object or more")
        things = [self._mesh(element) for element in parent.all("Mesh")]
        things += self._instances(parent.all("MeshInstance"))
        spheres = parent.all("Sphere")
        segments = next((s for most, s in SEGMENTS if len(spheres) <= most), FEWEST_SEGMENTS)
        things += [self._sphere(element, segments) for element in spheres]
        things += [
            self._lamp(each, self._faces(each, "light", "")) for each in parent.all("LightMesh")
        ]
        balls = []
        for element in parent.all("LightSphere"):
            thing = self._sphere(element, LAMP_SEGMENTS)
            ball = self._ball(element, thing)
            if ball is None:
                things.append(self._lamp(element, thing))
            else:
                balls.append(thing)
                self.balls.append(ball)
        things += self._triangles(parent.all("Triangle"))
        for thing in things:
            self._set_from_behind(thing)
        things += self._planes(parent.all("Plane"), things + balls)
        return [{key: value for key, value in thing.items() if value != []} for thing in things]

    def _materials(self) -> dict[str, dict[str, Any]]:
        """All materials by their names."""
        named = {material_name(number): keys for number, keys in self.materials.items()}
        return named | self.lamps | self.textures.made

    def _set_from_behind(self, thing: dict[str, Any]) -> None:
        """Camera rays pass through backs of flat triangles, and find other normals as they are; but for glass."""
        if "dielectric" not in self._materials()[thing["material"]]:
            thing["from_behind"] = "unseen" if thing.get("shading") == "flat" else "kept"

    def _mesh(self, element: MetuElement) -> dict[str, Any]:
        number = element.id(self._bases)
        thing = self._faces(element, "mesh", f"mesh {number}")
        self._bases[number] = thing
        self._surfaces[number] = InstanceSurface(
            element.child("Faces", ""), element.attribute("shadingMode"), _material_of(element)
        )
        return thing

    def _lamp(self, element: MetuElement, thing: dict[str, Any]) -> dict[str, Any]:
        """An object that is a light: it has a material of its own, which shines."""
        name = f"light {len(self.lamps) + 1}"
        material = self._materials()[thing["material"]]
        radiance = _radiance(element)
        if "unlit" in material:
            raise element.child("Textures", "").refused(
                "a light shows its Radiance, and a texture that replaces all would hide it; remove it to render"
                " without it"
            )
        # That of a texture is its ambient light.
        shown = radiance + material.get("emission", 0.0)
        self.lamps[name] = material | {"emission": shown.tolist()}
        return thing | {"name": name, "material": name}

    def _ball(self, element: MetuElement, thing: dict[str, Any]) -> dict[str, Any] | None:
        """A light of type sphere, looked for where it can be seen from; None where only a mesh is the same.

        It reflects nothing, has no other shape than a ball, and is dark inside.
        """
        matrix = matrix_of_steps(thing["transform"])
        scale = float(np.abs(matrix[:3, :3]).max())
        linear = matrix[:3, :3] / scale
        squares = linear.T @ linear
        even = np.abs(squares - np.eye(3) * squares[0, 0]).max() <= UNEVEN * squares[0, 0]
        radius = float(thing["radius"] * np.sqrt(squares[0, 0]) * scale)
        center, motion = matrix[:3, 3], thing.get("motion", {})
        ends = center, center + motion.get("velocity", np.zeros(3))
        outside = all(_distance(np.array(eye), *ends) > radius for eye in self.eyes)
        if not even or not outside or self._materials()[thing["material"]] != BLACK:
            return None
        light = {"type": "sphere", "center": center.tolist(), "radius": radius}
        light |= {"radiance": _radiance(element).tolist(), "samples": "visible"}
        return light | ({"motion": motion} if motion else {})

    def _faces(self, element: MetuElement, stem: str, name: str) -> dict[str, Any]:
        """The keys of a mesh with a name; its file, if the scene holds it itself, has a name of that stem."""
        element.attribute("id")
        textures = self.textures.of(element)
        common = self._common(element, textures=textures)
        given = element.attribute("shadingMode")
        if given not in (None, "", "flat", "smooth"):
            raise element.error(f"shadingMode is {show(given)}: expected flat or smooth")
        faces = element.child("Faces", "triples of vertex numbers, or a plyFile")
        if faces.attributes.get("type") == "triangle":
            faces.attribute("type")
        offset = offset_of(faces, "vertexOffset")
        if faces.attribute("plyFile") and offset:
            self.notes.add(
                faces,
                f"has vertexOffset {offset}, which counts only for vertex numbers in the scene itself:"
                " a PLY file has its own vertices",
            )
        count = len(self._bases if stem == "mesh" else self.lamps)
        shape = self._shape(faces, given, textures, f"{stem}-{count + 1}")
        return {"shape": "mesh", "name": name, **shape, **common}

    def _shape(
        self, faces: MetuElement, given: str | None, textures: list[TextureMap], stem: str
    ) -> dict[str, Any]:
        """The file of a mesh, and its shading; a file that is written has a name of that stem."""
        placed = [texture for texture in textures if texture.has_places]
        mode = given or "flat"
        file = faces.attribute("plyFile")
        normals = {}
        if file:
            found = mesh_file(faces, file, self.source)
            faces.attribute("textureOffset")
            if not given and has_normals(found):
                mode = "smooth"
            normals = {"normals": "area"} if mode == "smooth" else {}
            path = self.meshes.add_file(found, faces)
            mesh = self._with_uv(found, faces) if placed else None
        else:
            places = self.textures.places if placed else None
            mesh = inline_mesh(faces, self.vertices, mode == "smooth", places)
        if mesh is not None:
            if placed:
                mesh = self.textures.placed(placed, mesh)
            path = self.meshes.add_own(mesh, stem, faces)
        return {"file": path, "shading": mode, **normals}

    def _with_uv(self, file: Path, faces: MetuElement) -> Mesh:
        """A mesh of a file that has texture coordinates; SceneError where it has none."""
        mesh = read_mesh(file, "area")
        if mesh.uv is None:
            raise faces.error(
                "has a texture, and its plyFile no texture coordinates (s and t, or u and v): save it with some,"
                " or take Textures away"
            )
        return mesh

    def _instances(self, elements: list[MetuElement]) -> list[dict[str, Any]]:
        """Instances of meshes and of other instances, whatever their order in the file."""
        left, things = dict(enumerate(elements)), dict[int, dict[str, Any]]()
        ids = Counter(element.id() for element in elements)
        for element in elements:
            name = _base_of(element)
            if ids[name] > 1 and name not in self._bases:
                self.notes.add(
                    element,
                    f"has baseMeshId {name}, an id that {ids[name]} instances have: the first is taken",
                )
        while left:
            ready = {
                k: base
                for k, element in left.items()
                if (base := self._bases.get(_base_of(element))) is not None
            }
            if not ready:
                element = next(iter(left.values()))
                # Where an id is there twice, one of the two was probably to be another.
                twice = [number for number, count in ids.items() if count > 1]
                told = (
                    f"; the id {show(twice[0])} is given to {ids[twice[0]]} instances"
                    if twice
                    else ""
                )
                raise element.error(
                    f"baseMeshId is {show(_base_of(element))}: expected the id of a mesh, or of an instance"
                    f" that comes from one; {suggest(_base_of(element), self._bases)}{told}"
                )
            for k, base in ready.items():
                things[k] = self._instance(left.pop(k), base)
        return [things[k] for k in sorted(things)]

    def _instance(self, element: MetuElement, base: dict[str, Any]) -> dict[str, Any]:
        number = element.id()
        inherited = {key: base[key] for key in INHERITED if key in base}
        thing = inherited | {"name": f"instance {number}"}
        textures = self.textures.of(element)
        surface = self._surfaces[_base_of(element)]
        if element.maybe("Material") is not None:
            surface = replace(surface, material=_material_of(element))
        thing |= self._common(element, surface.material, textures)
        if not textures and element.maybe("Material") is None:
            # With the textures of its mesh.
            thing["material"] = base["material"]
        if any(texture.has_places for texture in textures):
            self._textured += 1
            stem = f"instance-{self._textured}"
            thing |= self._shape(surface.faces, surface.mode, textures, stem)
        if not element.flag("resetTransform"):
            thing["transform"] = base["transform"] + thing["transform"]
        if base["material"] in self.textures.made and not textures and element.maybe("Material"):
            self.notes.add(
                element, "has a Material of its own, and with it none of its mesh's Textures"
            )
        # Meshes and instances are counted apart in some files; then a mesh keeps its number.
        self._bases.setdefault(number, thing)
        self._surfaces.setdefault(number, surface)
        return thing

    def _sphere(self, element: MetuElement, segments: int) -> dict[str, Any]:
        element.attribute("id")
        textures = self.textures.of(element) if element.tag == "Sphere" else []
        center = element.child("Center", "the number of a vertex")
        middle = {"translate": self._vertex(center).tolist()}
        self.textures.tell_of_sphere(textures)
        # METU's pictures begin at -x, on the other side.
        turned = [{"rotate": {"axis": [0, 1, 0], "degrees": 180}}] if textures else []
        thing = {
            "shape": "sphere",
            "radius": element.child("Radius", "such as 1").number(0, above=True),
            "segments": segments,
            **self._common(element, textures=textures),
        }
        return thing | {"transform": [*turned, middle, *thing["transform"]]}

    def _triangles(self, elements: list[MetuElement]) -> list[dict[str, Any]]:
        """Single triangles; those that look and move alike make one mesh."""
        groups: dict[str, tuple[dict[str, Any], list[Indices], MetuElement, list[TextureMap]]] = {}
        for element in elements:
            element.attribute("id")
            indices = element.child("Indices", "three vertex numbers, such as 1 2 3")
            corners = corners_of(indices, self.vertices)
            if len(corners) != 1:
                raise indices.unexpected("three vertex numbers, such as 1 2 3")
            textures = self.textures.of(element)
            common = self._common(element, textures=textures)
            placed = [texture for texture in textures if texture.has_places]
            if placed:
                # Those of a triangle have the numbers of its vertices.
                places_of(indices, corners.ravel(), self.textures.places)
            alike = json.dumps(common)
            groups.setdefault(alike, (common, [], element, placed))[1].append(corners)
        things = []
        for count, (common, found, first, placed) in enumerate(groups.values(), start=1):
            used, triangles = np.unique(np.concatenate(found), return_inverse=True)
            uv = self.textures.places[used] if placed else None
            mesh = Mesh(self.vertices[used], triangles.reshape(-1, 3), None, uv)
            mesh = self.textures.placed(placed, mesh) if placed else mesh
            path = self.meshes.add_own(mesh, f"triangles-{count}", first)
            things.append({"shape": "mesh", "file": path, "shading": "flat", **common})
        return things

    def _planes(
        self, elements: list[MetuElement], others: list[dict[str, Any]]
    ) -> list[dict[str, Any]]:
        """Infinite planes; what else there is tells how large they must be."""
        if not elements:
            return []
        eyes = np.array(self.eyes, np.float64).reshape(-1, 3)
        corners = np.concatenate((self._corners(others), eyes))
        things = []
        for count, element in enumerate(elements, start=1):
            element.attribute("id")
            point = self._vertex(element.child("Point", "the number of a vertex"))
            normal = element.child("Normal", "such as 0 1 0").direction()
            matrix = matrix_of(element, self.steps)
            mesh = plane_mesh(moved(matrix, point), transformed_normal(matrix, normal), corners)
            path = self.meshes.add_own(mesh, f"plane-{count}", element)
            keys = self._common(element) | {"transform": []}
            things.append({"shape": "mesh", "file": path, "shading": "flat", **keys})
        return things

    def _corners(self, things: list[dict[str, Any]]) -> Floats64:
        """Corners (N, 3) of the boxes around all objects, where they start and where their motion takes them."""
        found = [np.zeros((0, 3))]
        read = self.meshes.vertices
        for thing in things:
            sphere = thing["shape"] == "sphere"
            own = CUBE * thing["radius"] if sphere else read[thing["file"]]
            matrix = matrix_of_steps(thing["transform"])
            placed = own @ matrix[:3, :3].T + matrix[:3, 3]
            ends = np.where(CUBE < 0, placed.min(axis=0), placed.max(axis=0))
            found += [ends, ends + thing.get("motion", {}).get("velocity", 0.0)]
        return np.concatenate(found)

    def _vertex(self, element: MetuElement) -> Floats64:
        """The vertex whose number is an element's text, (3,)."""
        number = np.array(element.numbers(1, "1"))
        if number[0] != np.floor(number[0]):
            raise element.unexpected("the number of a vertex, such as 1")
        check_indices(element, number, self.vertices)
        found: Floats64 = self.vertices[int(number[0]) - 1]
        return found

    def _common(
        self,
        element: MetuElement,
        inherited: str | None = None,
        textures: Sequence[TextureMap] = (),
    ) -> dict[str, Any]:
        """Material, transform and motion of an object.

        ``inherited``: the id of a material that is given by another element, and has been checked
        """
        name = inherited or _material_of(element)
        if name not in self.materials:
            material = element.child("Material", "the id of a material")
            raise material.unexpected(
                f"the id of a material; {suggest(name, sorted(self.materials))}"
            )
        if (refused := self.textures.bodies[name].refused) is not None:
            raise refused
        keys: dict[str, Any] = {"material": material_name(name)}
        if textures:
            keys["material"] = self.textures.material(list(textures), name, self.materials[name])
        keys["transform"] = transform_of(element, self.steps)
        blur = element.maybe("MotionBlur")
        if blur is not None and any(velocity := blur.vector()):
            # The shutter of the converted scene is open from 0 to 1.
            keys["motion"] = {"velocity": list(velocity)}
        return keys


def _radiance(lamp: MetuElement) -> Floats64:
    """That of an object that is a light, (3,)."""
    radiance = np.array(lamp.child("Radiance", "such as 30 30 30").color())
    if not radiance.any():
        raise lamp.error("Radiance is 0 0 0: expected a light that shines")
    return radiance


def _distance(point: Floats64, start: Floats64, end: Floats64) -> float:
    """From a point to the line between two others."""
    along = end - start
    share = np.clip((point - start) @ along / max(float(along @ along), TINY), 0, 1)
    return float(np.linalg.norm(point - start - share * along))


def _material_of(element: MetuElement) -> str:
    """The id of the material that an object names."""
    return " ".join(element.child("Material", "the id of a material").words())


def _base_of(element: MetuElement) -> str:
    base = element.attribute("baseMeshId")
    if not base:
        raise element.error("baseMeshId is missing: expected the id of a mesh")
    return base
