"""From texture descriptions to what paints the objects."""

import warnings
from pathlib import Path
from typing import Any

import msgspec
import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.types import Floats32, Floats64
from course.engine.formats.meshes import transforms
from course.engine.formats.meshes.named import NamedMesh
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import TextureDescription, rgb
from course.engine.formats.yaml.document import KeyPath
from course.engine.formats.yaml.loading import Loaded, read_named_picture
from course.engine.functions.effects import Bound
from course.engine.scene.building.materials import ambient_color, base_color, has_body
from course.engine.scene.building.objects import object_mesh
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.painting import Paint
from course.engine.terms.surfaces.textures import (
    Laid,
    OnMesh,
    OnRectangle,
    OnSphere,
    Places,
    Texture,
)


def shows_texture(material: d.MaterialDescription) -> bool:
    """True if a material has a texture or noise, and an ambient or diffuse term that it colours."""
    if (material.texture is None and material.noise is None) or not has_body(material):
        return False
    if rgb(material.unlit).any():
        return bool(base_color(material).any())
    colored = base_color(material) * material.diffuse + ambient_color(material) * material.ambient
    return bool(colored.any())


def shows_specular_texture(material: d.MaterialDescription) -> bool:
    """True if a material has a texture of its highlight, and one."""
    return material.specular_texture is not None and bool(rgb(material.specular).any())


def places_function(thing: d.Object) -> str:
    """Name of the function of the textures module that finds places on an object."""
    if isinstance(thing, d.Quad):
        return "rectangle_uv"
    return "sphere_uv" if isinstance(thing, d.Sphere) else "triangle_uv"


FEWEST = 1e-6
"""Pixels of a picture along a unit of u or v; where it has fewer, it is the same all over."""

UV = {
    ".obj": "vt in an OBJ file",
    ".ply": "properties u and v of the vertices of a PLY file",
    ".glb": "TEXCOORD_0 in a glTF file",
    ".gltf": "TEXCOORD_0 in a glTF file",
    ".stl": "as an OBJ file, for STL has none",
}
"""What texture coordinates are called, by the suffix of a mesh file."""

STEEPEST = 1e30
"""Heights beyond it, in sizes of the scene, are as good as infinite, and their squares are numbers still."""


class Painter:
    """Makes the paint of objects; each picture is read once, and those that nothing shows never.

    ``files``: mesh files that have been read, by their normals and names in the scene; ``scale``: that of the frame.
    """

    def __init__(
        self, loaded: Loaded, bound: Bound, files: dict[str, NamedMesh], scale: float
    ) -> None:
        self._loaded = loaded
        self._scale = scale
        self._bound = bound
        self._files = files
        self._images: dict[tuple[str, str | None], Floats32] = {}
        self._latest: tuple[int, Floats64, Floats64] = -1, *(np.zeros((0, 3, 3)),) * 2

    def paint(self, number: int, mesh: Mesh) -> Paint | None:
        """The paint of an object; None where it has none.

        Raises SceneError: the picture is missing, can't be read or returns more light than it gets, or the mesh has no
        texture coordinates; names the key that asks for it.
        ``mesh``: as it is compiled, of which the triangles and uv count.
        """
        thing = self._loaded.description.objects[number]
        material = self._loaded.description.materials[thing.material]
        if not shows_texture(material):
            return None
        if material.noise is not None:
            return self._noise(material.noise, number, mesh)
        assert material.texture is not None
        return self._picture(material.texture, "texture", number, mesh)

    def shine(self, number: int, mesh: Mesh) -> Paint | None:
        """What colours the highlights of an object; None where nothing does. As ``paint``."""
        thing = self._loaded.description.objects[number]
        material = self._loaded.description.materials[thing.material]
        if material.specular_texture is None or not shows_specular_texture(material):
            return None
        return self._picture(material.specular_texture, "specular_texture", number, mesh)

    def _picture(self, described: TextureDescription, key: str, number: int, mesh: Mesh) -> Paint:
        asked_by = ("materials", self._loaded.description.objects[number].material, key)
        texture = self._texture(described, (*asked_by, "image"))
        corners, places = self._places(number, mesh, asked_by)
        if described.interpolation == "trilinear":
            from course.engine.terms.surfaces.normal_maps import NormalMap
            from course.engine.terms.surfaces.pyramids import Pyramid, make_levels

            wraps = places_function(self._loaded.description.objects[number]) == "sphere_uv"
            levels = make_levels(texture.image, texture.repeat, texture.lookup)
            return Paint(corners, Pyramid(levels, NormalMap(texture, places, wraps)))
        return Paint(corners, Laid(texture, places))

    def _noise(self, described: d.NoiseDescription, number: int, mesh: Mesh) -> Paint:
        """Noise in an object's coordinates before its transformations."""
        from course.engine.terms.surfaces.perlin import PerlinNoise

        corners = self._still(number).vertices[mesh.triangles] * described.scale
        return Paint(corners, PerlinNoise(described.conversion))

    def relief(self, number: int, mesh: Mesh) -> Paint | None:
        """The normal map or the bump map of an object; None where it has none.

        Raises SceneError: the picture is missing or can't be read, or the mesh has no texture coordinates; names the
        key that asks for it.
        ``mesh``: as in ``paint``.
        """
        thing = self._loaded.description.objects[number]
        material = self._loaded.description.materials[thing.material]
        if material.bump is not None:
            return self._bump(material.bump, number, mesh)
        if material.normal_map is None:
            return None
        asked_by = ("materials", thing.material, "normal_map")
        described = material.normal_map
        nearest = described.interpolation == "nearest"
        corners, known = self._relief(described, number, mesh, asked_by, nearest)
        return Paint(corners, known)

    def _bump(self, described: d.BumpDescription, number: int, mesh: Mesh) -> Paint:
        from course.engine.terms.surfaces.bump_maps import BumpMap, NoiseHeights, PictureHeights

        thing = self._loaded.description.objects[number]
        # Heights are in the object's own unit, which steps may change.
        matrix = transforms.compose(map(transforms.of_step, msgspec.to_builtins(thing.transform)))
        turned = matrix[:3, :3]
        largest = np.abs(turned).max()
        unit = abs(np.linalg.det(turned / largest)) ** (1 / 3) * (largest / self._scale)
        height = float(np.clip(described.height * unit, -STEEPEST, STEEPEST))
        if described.noise is not None:
            carved = self._noise(described.noise, number, mesh)
            raised: Any = BumpMap(NoiseHeights(carved.color_at), height)  # type: ignore[arg-type]
            return Paint(carved.corners, raised)
        assert described.image is not None
        asked_by = ("materials", thing.material, "bump")
        corners, known = self._relief(described, number, mesh, asked_by)
        size = np.maximum(np.array(known.color.image.shape[1::-1]) * described.repeat, FEWEST)
        raised = BumpMap(PictureHeights(known, (0.5 / size).astype(np.float32)), height)
        return Paint(corners, raised)

    def _relief(
        self,
        described: d.NormalMapDescription | d.BumpDescription,
        number: int,
        mesh: Mesh,
        asked_by: KeyPath,
        nearest: bool = False,
    ) -> tuple[Floats64, Any]:
        """What an object's corners carry, and its normal map by a picture."""
        from course.engine.terms.surfaces.normal_maps import NormalMap

        assert described.image is not None
        colors = self._normals(described.image, (*asked_by, "image"), described.layer)
        lookup = self._bound.function("textures", "texture_lookup", asked_by)
        texture = Texture(colors, np.array(described.repeat, np.float32), lookup, nearest)
        corners, places = self._places(number, mesh, asked_by)
        wraps = places_function(self._loaded.description.objects[number]) == "sphere_uv"
        return corners, NormalMap(texture, places, wraps)

    def _normals(self, file: str, path: KeyPath, layer: str | None) -> Floats32:
        """Colours of a picture of normals; those of PNG and JPEG are codes, without sRGB's curve."""
        key = f"normals of {file}", layer
        if key not in self._images:
            self._images[key] = read_named_picture(file, path, self._loaded, True, layer)
        return self._images[key]

    def _places(self, number: int, mesh: Mesh, asked_by: KeyPath) -> tuple[Floats64, Places]:
        """What the corners of an object's triangles carry, (T, 3, 3), and the way from there to u and v."""
        thing = self._loaded.description.objects[number]
        name = places_function(thing)
        function = self._bound.function("textures", name, asked_by)
        # A picture and a normal map of one object have the same.
        if self._latest[0] != number:
            of_mesh = name == "triangle_uv"
            vertices = (
                self._uv(number, mesh, asked_by) if of_mesh else self._own_coordinates(number)
            )
            self._latest = number, vertices, vertices[mesh.triangles]
        _, vertices, corners = self._latest
        if name == "rectangle_uv":
            corner, along, _, across = vertices.astype(np.float32)
            return corners, OnRectangle(corner, along, across, function)
        return corners, (OnSphere if name == "sphere_uv" else OnMesh)(function)

    def _uv(self, number: int, mesh: Mesh, asked_by: KeyPath) -> Floats64:
        """Texture coordinates of a mesh as points (V, 3) whose third coordinate is 0."""
        thing = self._loaded.description.objects[number]
        what = str(asked_by[-1]).replace("_", " ")
        if mesh.uv is None:
            suffix = Path(thing.file).suffix.lower() if isinstance(thing, d.MeshFile) else ""
            raise self._loaded.document.error(
                ("objects", number),
                f'material "{thing.material}" has a {what}, but the mesh has no texture coordinates;'
                f" save it with some ({UV.get(suffix, UV['.obj'])}), or give it another material",
            )
        if isinstance(thing, d.MeshFile):
            self._warn_of_bare(thing, number, what)
        return np.pad(mesh.uv.astype(np.float64), ((0, 0), (0, 1)))

    def _warn_of_bare(self, thing: d.MeshFile, number: int, what: str) -> None:
        """Tell how many triangles have no texture coordinates, where others have some."""
        found = self._files[f"{thing.normals} {thing.file}"]
        bare = found.bare
        if bare is not None and thing.only is not None:
            bare = bare[np.isin(found.name, [found.names.index(name) for name in thing.only])]
        if bare is not None and bare.any():
            warnings.warn(
                f"{self._loaded.document.where(('objects', number))}: {np.count_nonzero(bare):,} of the {len(bare):,}"
                f" triangles of {thing.file} have no texture coordinates, and show one point of the {what}; give them"
                " some, or another material",
                CourseWarning,
                stacklevel=2,
            )

    def _own_coordinates(self, number: int) -> Floats64:
        """Vertices (V, 3) of a shape before it is transformed, its longest extent 2."""
        mesh = self._still(number)
        scaled: Floats64 = mesh.vertices / np.abs(mesh.vertices).max()
        return scaled

    def _still(self, number: int) -> Mesh:
        """An object's mesh before it is transformed."""
        loaded = self._loaded
        still = msgspec.structs.replace(loaded.description.objects[number], transform=())
        return object_mesh(still, number, loaded.document, loaded.path.parent, self._files)

    def _texture(self, texture: TextureDescription, path: KeyPath) -> Texture:
        key = texture.image, texture.layer
        if key not in self._images:
            self._images[key] = self._read(*key, path)
        return Texture(
            self._images[key],
            np.array(texture.repeat, np.float32),
            self._bound.function("textures", "texture_lookup", path[:-1]),
            texture.interpolation == "nearest",
        )

    def _read(self, file: str, layer: str | None, path: KeyPath) -> Floats32:
        image = read_named_picture(file, path, self._loaded, layer=layer)
        # By its largest value, for which no array of the picture's size is made.
        if image.max(initial=0) > 1:
            y, x, channel = np.argwhere(image > 1)[0]
            raise self._loaded.document.error(
                path,
                f"{file}: the pixel in column {x}, row {y} is {image[y, x, channel]:g}: a surface returns a share"
                " of the light, expected 0 to 1",
            )
        return np.ascontiguousarray(image)
