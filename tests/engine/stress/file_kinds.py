"""A right file of every kind that the course reads, and what reads it."""

import gzip
import io
import json
import struct
import tarfile
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from course import load_scene
from course.base.inputs import InputLimit
from course.engine.formats.meshes.files import read_mesh
from course.engine.formats.metu.converting import convert
from course.engine.formats.pictures.reading import read_picture
from course.engine.radiosity.viewing import load_solution
from course.school.grading.classes.policy import read_policy
from course.school.grading.classes.roster import read_roster
from course.school.grading.classes.submitted import read_one
from course.school.grading.references import read_references
from tests.engine.formats.meshes.gltf_files import SQUARE, Writer
from tests.engine.formats.pictures import picture_files

MODULES = ("motion_blur", "glossy")
MOST_PIXELS = 1 << 20
"""Of the pictures here, so that a header's claim costs no second; larger ones are the user's wish."""

Change = Callable[[bytes], bytes]


@dataclass(frozen=True)
class Kind:
    """One kind of file.

    Attributes
    ----------
    name : of the file, whose suffix says what it is
    content : of a right one
    read : reads a file; raises a CourseError where it is wrong
    inside : makes a change of what a check sum or a compression hides; the file as it lies there, if nothing does
    share : how many of its files are tried, as a share of the others'; less than 1 where each takes a second
    """

    name: str
    content: bytes
    read: Callable[[Path], object]
    inside: Callable[[bytes, Change], bytes] = lambda content, change: change(content)
    share: float = 1.0


# ---------------------------------------------------------------- what the scene holds

SCENE = """title: a room  # and a comment
camera: {eye: [0, 1, 4], look_at: [0, 1, 0], vertical_fov: 40}
film: {width: 8, height: 6, filter: gaussian}
sampler: {type: sobol, samples: 4}
integrator: {max_depth: 3}
environment: {type: constant, radiance: [0.1, 0.2, 0.3]}
materials:
  white: &white {color: 0.8, diffuse: 1}
  glass: {dielectric: {refraction_index: 1.5, absorption: [0.1, 0.1, 0.2]}}
lights:
  - {type: point, position: [0, 3, 1], intensity: 12}
objects:
  - {shape: quad, material: white, width: 4, depth: 4, transform: [{rotate: {axis: [1, 0, 0], degrees: 9}}]}
  - shape: box
    material: glass
    size: [1, 1, 1]
    transform:
      - translate: [0, 0.5, 0]
"""

METU: dict[str, Any] = {
    "MaxRecursionDepth": "4",
    "Cameras": {
        "Camera": {
            "_id": "1",
            "Position": "0 0 0",
            "Gaze": "0 0 -1",
            "Up": "0 1 0",
            "NearPlane": "-1 1 -1 1",
            "NearDistance": "1",
            "ImageResolution": "8 6",
            "ImageName": "one.png",
        }
    },
    "Lights": {
        "AmbientLight": "10 10 10",
        "PointLight": {"_id": "1", "Position": "0 2 0", "Intensity": "90 90 90"},
    },
    "Materials": {
        "Material": [{"_id": "1", "AmbientReflectance": "1 1 1", "DiffuseReflectance": "1 0.5 0"}]
    },
    "Transformations": {"Translation": {"_id": "1", "_data": "0 1 -1"}},
    "VertexData": "-9 -9 -4  9 -9 -4  9 9 -4  -9 9 -4",
    "Objects": {
        "Mesh": {"_id": "1", "Material": "1", "Transformations": "t1", "Faces": "1 2 3 1 3 4"},
        "Sphere": {"_id": "1", "Material": "1", "Center": "1", "Radius": "0.5"},
    },
}

METU_XML = """<?xml version="1.0"?>
<Scene>
  <BackgroundColor>1 2 3</BackgroundColor>
  <Cameras><Camera id="1"><Position>0 0 0</Position><Gaze>0 0 -1</Gaze><Up>0 1 0</Up>
    <NearPlane>-1 1 -1 1</NearPlane><NearDistance>1</NearDistance>
    <ImageResolution>8 6</ImageResolution><ImageName>one.png</ImageName></Camera></Cameras>
  <Lights><AmbientLight>10 10 10</AmbientLight>
    <PointLight id="1"><Position>0 2 0</Position><Intensity>90 90 90</Intensity></PointLight></Lights>
  <Materials><Material id="1" type="mirror"><MirrorReflectance>0.1 0.1 0.1</MirrorReflectance>
    <DiffuseReflectance>1 0.5 0</DiffuseReflectance></Material></Materials>
  <VertexData>-9 -9 -4  9 -9 -4  9 9 -4  -9 9 -4</VertexData>
  <Objects><Mesh id="1"><Material>1</Material><Faces>1 2 3
    1 3 4</Faces></Mesh>
    <Triangle id="1"><Material>1</Material><Indices>1 2 3</Indices></Triangle></Objects>
</Scene>
"""


def _convert(path: Path) -> object:
    return convert(path, path.parent / "converted" / "scene.yaml")


# ---------------------------------------------------------------- meshes

OBJ = """# a quad and a triangle
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1.0\nv 0.5 2e0 0
vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nvn 0 0.6 0.8
g one
f 1/1/1 2/2/1 3/3/1 4/1/1
f -3//2 -1//2 \\
 4//2
usemtl none
"""

PLY = """ply
format {order} 1.0
comment by hand
element vertex 4
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face 2
property list uchar int vertex_indices
property list uchar float texcoord
end_header
"""
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0))
FACES = ((0, 1, 2), (0, 1, 2, 3))


def _ply(order: str) -> bytes:
    header = PLY.format(order=order).encode()
    if order == "ascii":
        rows = [f"{x} {y} {z} 0 0 1" for x, y, z in CORNERS]
        for face in FACES:
            uv = [f"{CORNERS[k][0]} {CORNERS[k][1]}" for k in face]
            rows.append(f"{len(face)} {' '.join(map(str, face))} {2 * len(face)} {' '.join(uv)}")
        return header + "\n".join(rows).encode() + b"\n"
    sign = "<" if "little" in order else ">"
    body = b"".join(struct.pack(f"{sign}6f", *corner, 0, 0, 1) for corner in CORNERS)
    for face in FACES:
        body += struct.pack(f"{sign}B{len(face)}i", len(face), *face)
        uv = [value for k in face for value in CORNERS[k][:2]]
        body += struct.pack(f"{sign}B{len(uv)}f", len(uv), *uv)
    return header + body


def _trimesh(suffix: str) -> bytes:
    from trimesh.creation import icosphere

    made = icosphere(subdivisions=0).export(file_type=suffix)
    return made if isinstance(made, bytes) else made.encode()


def _moved_glb() -> bytes:
    """A square of whole numbers with morph targets, a skin, and instances beside it."""
    writer = Writer()
    corners = writer.primitive["attributes"]
    corners["POSITION"] = writer.add((SQUARE * 100).astype("i1"), normalized=True)
    corners["JOINTS_0"] = writer.add(np.array([(0, 1, 0, 0)] * 4, "u1"))
    corners["WEIGHTS_0"] = writer.add(np.array([(99, 156, 0, 0)] * 4, "u1"), normalized=True)
    target = writer.add(np.array([(0, 0, 2)] * 4, "<f4"))
    values = {"bufferView": writer.view(np.ones((1, 3), "<f4"))}
    where = {"bufferView": writer.view(np.array([2], "<u2")), "componentType": 5123}
    writer.header["accessors"][target]["sparse"] = {"count": 1, "indices": where, "values": values}
    writer.primitive["targets"] = [{"POSITION": target}]
    writer.header["meshes"][0]["weights"] = [0.5]
    writer.header["meshes"].append({"primitives": [{"attributes": {"POSITION": 1}, "mode": 5}]})
    places = {"TRANSLATION": writer.add(np.array([(3, 0, 0), (6, 0, 0)], "<f4"))}
    writer.header["skins"] = [{"joints": [1, 2]}]
    writer.header["nodes"] = [
        {"mesh": 0, "skin": 0, "children": [1, 3]},
        {"translation": [0, 1, 0], "children": [2]},
        {"rotation": [0, 0, 0.6, 0.8], "scale": [1, 2, 1]},
        {"mesh": 1, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": places}}},
    ]
    return writer.glb()


GROUPS = """s 1
v 0 0 0
v 3 0 0
v 3 3 0
v 2 3 0
v 2 1 0
v 1 1 0
v 1 3 0
v 0 3 0
usemtl wood
f 1 2 3 4 5 6 7 8
s off
f 8 7 6 5 4 3 2 1
usemtl tin
f 3 4 5
f 1 2 8 7
"""

SPACED_STL = """solid a plate
facet normal 0 0 1
 outer loop
  vertex 0 0 0
  vertex 1 0 0
  vertex 1 1 0
 end loop
end facet
end solid a plate
"""


# ---------------------------------------------------------------- pictures


def _codes(channels: int, bits: int = 8) -> Any:
    return np.random.default_rng(0).integers(0, 1 << bits, (6, 8, channels))


def _jpeg() -> bytes:
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(_codes(3).astype(np.uint8)).save(file, "JPEG")
    return file.getvalue()


def _layers() -> bytes:
    planes = {f"a.b.{name}": np.ones((5, 9), np.float16) for name in "RGB"}
    primaries = (0.68, 0.32, 0.265, 0.69, 0.15, 0.06, 0.3127, 0.329)
    return picture_files.exr(planes, (2, 1), (12, 7), primaries)


_CODED = {"gAMA": struct.pack(">I", 55_556), "cICP": bytes((12, 13, 0, 1))}


def _webp() -> bytes:
    from PIL import Image, ImageCms

    exif = Image.Exif()
    exif[0x0112] = 6
    profile = ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()
    file = io.BytesIO()
    image = Image.fromarray(_codes(3).astype(np.uint8))
    image.save(file, "WEBP", lossless=True, exif=exif, icc_profile=profile)
    return file.getvalue()


def _read_picture(path: Path) -> object:
    return read_picture(path, pixels=InputLimit(MOST_PIXELS))


def _png_inside(content: bytes, change: Change) -> bytes:
    """A change of one chunk, or of the rows in it, with a check sum that is right."""
    chunks = []
    at = 8
    while at + 12 <= len(content):
        (length,) = struct.unpack_from(">I", content, at)
        chunks.append((content[at + 4 : at + 8], content[at + 8 : at + 8 + length]))
        at += 12 + length
    # Which one, and whether rows or what they are packed to, is drawn by the change itself.
    drawn = len(change(content))
    which = drawn % len(chunks)
    kind, data = chunks[which]
    packed = kind == b"IDAT" and drawn % 2
    data = zlib.compress(change(zlib.decompress(data))) if packed else change(data)
    chunks[which] = (kind, data)
    return content[:8] + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        for kind, data in chunks
    )


# ---------------------------------------------------------------- archives of arrays and of submissions


def _npz(**arrays: Any) -> bytes:
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)
    return file.getvalue()


def _zip_inside(content: bytes, change: Change) -> bytes:
    """A change of one file in an archive, which is packed anew."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    chosen = sorted(files)[len(change(content)) % len(files)]
    files[chosen] = change(files[chosen])
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return packed.getvalue()


def _gzip_inside(content: bytes, change: Change) -> bytes:
    return gzip.compress(change(gzip.decompress(content)), 1)


def _solution() -> bytes:
    return _npz(
        format=np.array([1]),
        vertices=np.zeros((4, 3), np.float32),
        triangles=np.array([[0, 1, 2], [0, 2, 3]], np.int32),
        corners=np.ones((3, 3, 4), np.float32),
        radiosity=np.ones((3, 4), np.float32),
        center=np.zeros(3),
        scale=np.ones(1),
        camera=np.arange(10.0),
        size=np.array([8, 6]),
        steps=np.array([5]),
        left=np.array([0.01]),
    )


MODULE = b'"""A submission."""\n\nimport numpy as np\n\n\ndef shutter_times(a, b, u):\n    return a + (b - a) * u\n'


def _zip() -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("work/motion_blur.py", MODULE)
        archive.writestr("work/glossy.py", MODULE)
    return file.getvalue()


def _tar() -> bytes:
    file = io.BytesIO()
    with tarfile.open(fileobj=file, mode="w:gz") as archive:
        about = tarfile.TarInfo("work/motion_blur.py")
        about.size = len(MODULE)
        archive.addfile(about, io.BytesIO(MODULE))
    return file.getvalue()


def _notebook() -> bytes:
    cell = {
        "cell_type": "code",
        "metadata": {},
        "source": MODULE.decode().splitlines(keepends=True),
        "outputs": [],
    }
    return json.dumps({"cells": [cell], "metadata": {}, "nbformat": 4}, indent=1).encode()


def _read_submission(path: Path) -> object:
    # What is wrong with it is told in the submission itself.
    return read_one("ada", path, MODULES)


# ---------------------------------------------------------------- tables and rules of a class

POLICY = """total: 100
deadline: 2026-10-01T23:59:00+02:00
times: times.csv
late: {percent_per_day: 10, grace_minutes: 5}
weights: {motion_blur: 2, glossy: 1}
drop_lowest: 1
students:
  Ada Lovelace: {deadline: 2026-10-03T23:59:00+02:00}
"""
TIMES = (
    "student,submitted,attempts\nada,2026-10-01T20:00:00+02:00,2\nbob,,1\n"
    '"Lee, Ann",2026-10-02T01:00:00Z,\n'
)
ROSTER = 'Student,ID,SIS Login ID,Section\n"Lovelace, Ada",1001,ada,1\n"Lee, Ann",1002,ann,2\n'


def _read_policy(path: Path) -> object:
    (path.parent / "times.csv").write_text(TIMES, encoding="utf-8")
    return read_policy(path, MODULES)


def _read_times(path: Path) -> object:
    rules = path.parent / "rules.yaml"
    rules.write_text(f"times: {path.name}\n", encoding="utf-8")
    return read_policy(rules, MODULES)


def file_kinds() -> list[Kind]:
    """Every kind, made anew."""
    mesh = partial(Kind, read=read_mesh)
    picture = partial(Kind, read=_read_picture)
    png = partial(picture, inside=_png_inside)
    palette = np.array([[255, 0, 10], [7, 200, 30], [0, 0, 0], [90, 90, 90]])
    mantissas = np.random.default_rng(4).integers(90, 160, (4, 16, 4))
    return [
        Kind("scene.yaml", SCENE.encode(), load_scene),
        Kind("metu.xml", METU_XML.encode(), _convert),
        Kind("metu.json", json.dumps({"Scene": METU}, indent=1).encode(), _convert),
        mesh("mesh.obj", OBJ.encode()),
        mesh("text.ply", _ply("ascii")),
        mesh("little.ply", _ply("binary_little_endian")),
        mesh("big.ply", _ply("binary_big_endian")),
        mesh("binary.stl", _trimesh("stl")),
        mesh("text.stl", _trimesh("stl_ascii")),
        mesh("mesh.glb", _trimesh("glb")),
        mesh("groups.obj", GROUPS.encode()),
        mesh("spaced.stl", SPACED_STL.encode()),
        mesh("moved.glb", _moved_glb()),
        png("8.png", picture_files.png(_codes(3))),
        png("16.png", picture_files.png(_codes(3, 16), 16)),
        png("palette.png", picture_files.png(_codes(1) % 4, palette=palette)),
        picture("photo.jpg", _jpeg()),
        picture("sky.exr", picture_files.exr_rgb(np.ones((5, 9, 3), np.float32))),
        picture("layers.exr", _layers()),
        png("coded.png", picture_files.png(_codes(3), more=_CODED)),
        picture("turned.webp", _webp()),
        picture("sky.hdr", picture_files.radiance(mantissas)),
        picture("flat.hdr", picture_files.radiance(mantissas, run_lengths=False)),
        Kind("solution.npz", _solution(), load_solution, _zip_inside),
        Kind(
            "references.npz",
            _npz(**{"seed": np.array(0), "glossy.lobe/mean/a": np.ones((3, 2))}),
            lambda path: read_references(path, 0),
            _zip_inside,
        ),
        Kind("work.zip", _zip(), _read_submission, _zip_inside),
        Kind("work.tar.gz", _tar(), _read_submission, _gzip_inside),
        # Its code is read by a process of its own.
        Kind("motion_blur.ipynb", _notebook(), _read_submission, share=1 / 8),
        Kind("policy.yaml", POLICY.encode(), _read_policy),
        Kind("times.csv", TIMES.encode(), _read_times),
        Kind("roster.csv", ROSTER.encode(), read_roster),
    ]
