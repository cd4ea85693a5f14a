"""What the lookup makes of an environment: by a wide camera, or close to the cube's edges with few texels."""

from types import ModuleType
from typing import Any

import numpy as np
from PIL import Image

from course.engine.functions.effects import PROJECT
from sitebuild.mistakes.look import SIZE, Draw, Look
from sitebuild.mistakes.rendered import shown

Array = np.ndarray[Any, Any]

VALLEY = PROJECT / "scenes" / "environments" / "valley.png"

PLACES = ((2, 1), (0, 1), (1, 0), (1, 2), (1, 1), (3, 1))
"""Column and row of each face in the cross."""


def _faces() -> Array:
    """Six faces (6, S, S, 3), linear."""
    with Image.open(VALLEY) as opened:
        side = opened.width // 4
        cross = opened.convert("RGB")
        parts = [
            cross.crop((x * side, y * side, (x + 1) * side, (y + 1) * side)).resize((96, 96))
            for x, y in PLACES
        ]
    return (np.stack([np.asarray(part) for part in parts]) / 255.0).astype(np.float32) ** 2.2


def _few(size: int) -> Array:
    """Faces of few texels, each of a colour by chance around its face's own."""
    rng = np.random.default_rng(4)
    own = np.array(
        [
            (0.7, 0.2, 0.1),
            (0.1, 0.5, 0.6),
            (0.7, 0.6, 0.2),
            (0.2, 0.5, 0.15),
            (0.2, 0.25, 0.7),
            (0.6, 0.3, 0.6),
        ]
    )
    faces = own[:, None, None] + rng.uniform(-0.3, 0.3, (6, size, size, 3))
    return np.clip(faces, 0.02, 1).astype(np.float32)


def _looking(towards: tuple[float, float, float], degrees: float) -> Array:
    """Directions (3, H * W) of a camera's pixels."""
    width, height = SIZE
    forward = np.array(towards, float) / np.linalg.norm(towards)
    right = np.cross(forward, (0, 1, 0))
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    reach = np.tan(np.radians(degrees) / 2)
    x = (np.arange(width) + 0.5 - width / 2) / (height / 2) * reach
    y = (height / 2 - np.arange(height) - 0.5) / (height / 2) * reach
    rays = forward + x[None, :, None] * right + y[:, None, None] * up
    rays /= np.linalg.norm(rays, axis=2, keepdims=True)
    return np.ascontiguousarray(rays.reshape(-1, 3).T, np.float32)


def _around() -> Array:
    """Directions of a map of all longitudes and latitudes; its middle is +z."""
    width, height = SIZE
    longitude, latitude = np.meshgrid(
        (np.arange(width) + 0.5) / width * 2 * np.pi,
        np.pi / 2 - (np.arange(height) + 0.5) / height * np.pi,
    )
    flat = np.cos(latitude)
    rays = (-flat * np.sin(longitude), np.sin(latitude), -flat * np.cos(longitude))
    return np.stack([each.ravel() for each in rays]).astype(np.float32)


def _picture(function: str, faces: Array, directions: Array) -> Draw:
    def draw(made: ModuleType, _: ModuleType) -> Image.Image:
        width, height = SIZE
        colors = getattr(made, function)(faces, directions)
        return shown(np.asarray(colors).reshape(3, height, width))

    return draw


def _ties(made: ModuleType, _: ModuleType) -> Image.Image:
    """Faces as colours, on a patch around a corner of the cube, on whole numbers so that ties are frequent."""
    cells = 13
    x, y = np.meshgrid(np.arange(cells) - cells // 2, cells // 2 - np.arange(cells))
    # Points of the plane through the corner (8, 8, 8): all three components are equal in the middle.
    direction = np.stack((8 - x - y, 8 + y, 8 + x)).reshape(3, -1).astype(np.float32)
    face = np.asarray(made.face_and_uv(direction)[0]).reshape(cells, cells)
    colors = np.array(
        [(200, 90, 30), (0, 0, 0), (60, 140, 60), (0, 0, 0), (50, 90, 170), (0, 0, 0)]
    )
    picture = Image.fromarray(colors[face.astype(int)].astype(np.uint8)).resize(
        (160, 160), Image.Resampling.NEAREST
    )
    framed = Image.new("RGB", SIZE, "white")
    framed.paste(picture, (40, 0))
    return framed


def _lazy(function: str, directions: Array) -> Draw:
    """With the valley, which is read when it is drawn."""

    def draw(made: ModuleType, right: ModuleType) -> Image.Image:
        return _picture(function, _faces(), directions)(made, right)

    return draw


CORNER = (1.0, 0.75, 1.0)

LOOKS = {
    "face_and_uv": (
        Look("All directions around, as a map", _lazy("lookup", _around()), files=(VALLEY,)),
        Look(
            "The faces +x (brown), +y (green) and +z (blue) around their corner; on the lines between there is a tie",
            _ties,
            ("z_before_x",),
        ),
    ),
    "lookup": (
        Look(
            "All directions around, as a map",
            _lazy("lookup", _around()),
            ("transposed", "rows_bottom_up"),
            files=(VALLEY,),
        ),
        Look(
            "Faces of 3 x 3 texels, where three of them meet",
            _picture("lookup", _few(3), _looking(CORNER, 70)),
        ),
    ),
    "lookup_seamless": (
        Look(
            "The corner where three faces of 3 x 3 texels meet, from near",
            _picture("lookup_seamless", _few(3), _looking((1.0, 0.98, 1.0), 22)),
        ),
    ),
}
