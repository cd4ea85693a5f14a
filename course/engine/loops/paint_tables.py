"""The textures and reliefs of a surface as the fused loop has them, as ``paint_kernels`` reads them."""

from typing import Any

import numpy as np

from course.engine.core.hits import Surface
from course.engine.core.types import Floats32
from course.engine.loops import paint_kernels
from course.engine.loops.paint_kernels import FusedPainting
from course.engine.terms.surfaces.bump_maps import BumpMap, NoiseHeights, PictureHeights
from course.engine.terms.surfaces.normal_maps import NormalMap
from course.engine.terms.surfaces.painting import Painting
from course.engine.terms.surfaces.perlin import ABSOLUTE, PerlinNoise
from course.engine.terms.surfaces.surface import FullSurface
from course.engine.terms.surfaces.textures import Laid, OnMesh, OnRectangle, OnSphere, Texture

_SHAPES: dict[type, int] = {
    OnRectangle: paint_kernels.RECTANGLE,
    OnSphere: paint_kernels.SPHERE,
    OnMesh: paint_kernels.MESH,
}


def paint_tables(surface: Surface) -> tuple[FusedPainting, FusedPainting]:
    """The textures of a surface, and its reliefs. Pictures are not copied: they live as long as the surface does."""
    if not isinstance(surface, FullSurface):
        return _table(None), _table(None)
    return _table(surface.painting), _table(None if surface.relief is None else surface.relief.maps)


def _table(painting: Painting | None) -> FusedPainting:
    functions: tuple[Any, ...] = () if painting is None else painting.color_at
    n = len(functions)
    table = FusedPainting(
        row=np.empty(0, np.int32) if painting is None else painting.row,
        corners=np.empty((0, 9), np.float32) if painting is None else painting.corners,
        number=np.empty(0, np.uint16) if painting is None else painting.number,
        kind=np.full(n, paint_kernels.NOISE, np.int64),
        frame=np.zeros((n, 9), np.float32),
        address=np.zeros(n, np.uintp),
        size=np.ones((n, 2), np.int64),
        repeat=np.ones((n, 2), np.float32),
        nearest=np.zeros(n, np.bool_),
        absolute=np.zeros(n, np.bool_),
        raises=np.zeros(n, np.bool_),
        wraps=np.zeros(n, np.bool_),
        height=np.zeros(n),
        step=np.ones((n, 2), np.float32),
    )
    for k, function in enumerate(functions):
        _fill(table, k, function)
    return table


def _fill(table: FusedPainting, k: int, function: Any) -> None:
    """Row k of a table, of a function that ``fits``."""
    if isinstance(function, BumpMap):
        table.raises[k], table.height[k] = True, function.height
        heights: Any = function.heights
        if isinstance(heights, PictureHeights):
            table.step[k] = heights.step
            _fill(table, k, heights.picture)
        else:
            assert isinstance(heights, NoiseHeights)
            _fill(table, k, heights.noise)
    elif isinstance(function, PerlinNoise):
        table.absolute[k] = function.conversion == ABSOLUTE
    elif isinstance(function, NormalMap):
        table.wraps[k] = function.wraps
        _lay(table, k, function.color, function.places)
    else:
        assert isinstance(function, Laid)
        _lay(table, k, function.texture, function.places)


def _lay(table: FusedPainting, k: int, texture: Texture, places: Any) -> None:
    """A picture on a shape."""
    height, width = texture.image.shape[:2]
    table.address[k], table.size[k] = texture.image.ctypes.data, (width, height)
    table.repeat[k], table.nearest[k] = texture.repeat, texture.nearest
    table.kind[k] = _SHAPES[type(places)]
    if isinstance(places, OnRectangle):
        table.frame[k] = _frame(places)


def _frame(places: OnRectangle) -> Floats32:
    """The corner, and what u and v grow by along x, y and z; see ``rectangle_uv``."""
    corner, along, across = (
        np.asarray(p, float) for p in (places.corner, places.along, places.across)
    )
    edges = np.stack([along - corner, across - corner])
    grows = edges / (edges * edges).sum(axis=1, keepdims=True)
    return np.concatenate((corner, grows.ravel())).astype(np.float32)
