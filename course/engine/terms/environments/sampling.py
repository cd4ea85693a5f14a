"""Directions towards the light of a cube map: the product of its radiance and the cosine, drawn from tables.

The faces are divided into cells, the cells into texels. For each of some hundred normals there is a table of what
the cells contribute to its irradiance: radiance times cosine times solid angle. A cell is drawn from the table of the
nearest normal, a texel of the cell by its radiance alone, and a point of the texel uniformly on the face. The density
of that is known exactly, however coarse the tables are, and it is 0 nowhere where light comes from.

Radiance and cosine vary within texels and cells. Among densities that are constant there, the root mean square has the
least variance, so the tables hold it.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.engine.core.types import Floats32, Floats64, Indices, Numbers
from course.engine.core.vectors import dot, gather

CELLS = 16
"""Cells along the edge of a face."""

NORMALS = 20
"""Normals along the edge of the square that the octahedron of all normals is unfolded to."""

FINEST = 256
"""Texels along the edge of a face, at most."""

EVEN_ENOUGH = 1.005
"""Larger texels do where they leave no more than this multiple of the second moment."""

STRATUM = 2
"""Squares of the octahedron along the edge of a stratum: as large as some ten samples divide a hemisphere."""

UNEVEN = 0.03
"""Relative variance of the radiance within strata, from which on the tables do better than the cosine alone.

Stratified samples see no other variance, and 0.03 is what the tables leave themselves, of cosines within cells."""

FEW = 8
"""Cells that have more than one in so many of the samples are taken for suns."""

RESOLUTION = 2.0**24
"""Probabilities are multiples of its inverse, as the samplers' numbers are."""

FRAMES = np.array(
    [
        [(1, 0, 0), (0, 0, -1), (0, -1, 0)],
        [(-1, 0, 0), (0, 0, 1), (0, -1, 0)],
        [(0, 1, 0), (1, 0, 0), (0, 0, 1)],
        [(0, -1, 0), (1, 0, 0), (0, 0, -1)],
        [(0, 0, 1), (1, 0, 0), (0, -1, 0)],
        [(0, 0, -1), (-1, 0, 0), (0, -1, 0)],
    ],
    np.float64,
)
"""For each face of the cube its middle, and the ways along its rows and down its columns: OpenGL's table, backwards."""

_FRAMES32 = FRAMES.reshape(6, 9).astype(np.float32)


@dataclass(frozen=True)
class Tables:
    """Discrete distributions with equally many outcomes, drawn by inverting their cumulative sums.

    A guide says where to begin the search (Chen & Asau, "On generating random variates from an empirical
    distribution", 1974). Unlike aliases it keeps the order, so stratified numbers draw stratified outcomes.

    Attributes
    ----------
    edges : (T, k + 1) float32, the cumulative sums, from 0 to 1
    guide : (T, g) int32, the first outcome for numbers in each g-th of [0, 1), as a position in all edges
    """

    edges: Floats32
    guide: Numbers

    def draw(self, table: Indices, u: Floats32) -> tuple[Indices, Floats32, Floats32]:
        """One outcome for each number.

        Parameters
        ----------
        table : (n,) the distribution to draw from
        u : (n,) float32 in [0, 1)

        Returns
        -------
        outcome : (n,)
        rest : (n,) float32 in [0, 1), where u lies between the outcome's edges: a number to draw with again
        probability : (n,) float32 of the outcome
        """
        parts, edges = self.guide.shape[1], self.edges.shape[1]
        part = (u * np.float32(parts)).astype(np.intp)
        part += table * parts
        position = self.guide.take(part).astype(np.intp)
        late = np.flatnonzero(self.edges.take(position + 1) <= u)
        while len(late):
            position[late] += 1
            late = late[self.edges.take(position.take(late) + 1) <= u.take(late)]
        low = self.edges.take(position)
        probability = self.edges.take(position + 1)
        probability -= low
        # Differences of floats to multiples of 2^-24 below them are exact, so this can't be rounded up to 1.
        rest = u - low
        rest /= probability
        position -= table * edges
        return position, rest, probability


def tabulated(weights: Floats64) -> Tables:
    """Distributions by weights (T, k), none negative; where all are 0, the last outcome has probability 1."""
    tables, outcomes = weights.shape
    total = weights.sum(axis=1, keepdims=True)
    possible = weights > 0
    # Whatever is possible gets one of the numbers at least.
    spare = RESOLUTION - possible.sum(axis=1, keepdims=True)
    edges = np.zeros((tables, outcomes + 1))
    np.cumsum(weights / np.where(total > 0, total, 1), axis=1, out=edges[:, 1:])
    edges[:, 1:] = np.rint(edges[:, 1:] * spare) + np.cumsum(possible, axis=1)
    edges[:, -1] = RESOLUTION
    edges /= RESOLUTION
    parts = 1 << (outcomes - 1).bit_length()
    table = np.arange(tables)[:, None]
    # The outcomes that numbers of a part can't draw any more are those that end before it.
    end = np.ceil(edges[:, 1:] * parts).astype(np.intp) + table * (parts + 1)
    ended = np.bincount(end.ravel(), minlength=tables * (parts + 1)).reshape(tables, parts + 1)
    guide = np.cumsum(ended[:, :parts], axis=1) + table * (outcomes + 1)
    return Tables(edges.astype(np.float32), guide.astype(np.int32))


@dataclass(frozen=True)
class ProductSampling:
    """Draws directions for one cube map.

    Attributes
    ----------
    rows : for each normal, the rows of cells of all faces
    columns : for each normal and row of cells, the cells in it
    texel_rows : for each cell, its rows of texels
    texel_columns : for each cell and each of its rows, the texels in it
    """

    rows: Tables
    columns: Tables
    texel_rows: Tables
    texel_columns: Tables

    def sample(self, normal: Floats32, u: Floats32) -> tuple[Floats32, Floats32]:
        """Directions, and what to multiply their radiance by: cosine / (pi density).

        Parameters
        ----------
        normal : (3, n) float32, unit length
        u : (2, n) float32 in [0, 1)

        Returns
        -------
        direction : (3, n) float32, unit length; a few lie below the horizon
        weight : (n,) float32, not above 0 for those
        """
        table = nearest_normal(normal)
        row, v, density = self.rows.draw(table, u[0])
        table *= 6 * CELLS
        table += row
        column, h, probability = self.columns.draw(table, u[1])
        density *= probability
        cell = row * CELLS
        cell += column
        texel_row, v, probability = self.texel_rows.draw(cell, v)
        density *= probability
        split = self.texel_rows.edges.shape[1] - 1
        cell *= split
        cell += texel_row
        texel_column, h, probability = self.texel_columns.draw(cell, h)
        density *= probability

        face = row // CELLS
        size = CELLS * split
        h += column * split + texel_column
        h *= np.float32(2 / size)
        h -= 1
        v += row * split + texel_row - face * size
        v *= np.float32(2 / size)
        v -= 1
        frame = gather(_FRAMES32, face)
        direction = frame[:3]
        frame[3:6] *= h
        direction += frame[3:6]
        frame[6:] *= v
        direction += frame[6:]
        # Seen from the middle, a piece of the face at distance r has a solid angle of 1 / r^3 of its area.
        squared = dot(direction, direction)
        weight = dot(normal, direction)
        density *= squared
        density *= squared
        density *= np.float32(math.pi * size * size / 4)
        weight /= density
        direction *= 1 / np.sqrt(squared)
        return direction, weight

    @property
    def arrays(self) -> tuple[Any, ...]:
        """All that a compiled loop needs of it."""
        tables = self.rows, self.columns, self.texel_rows, self.texel_columns
        edges_and_guides = (array for table in tables for array in (table.edges, table.guide))
        return NORMALS, CELLS, _FRAMES32, *edges_and_guides


def product_sampling(faces: Floats32, seamless: bool) -> ProductSampling | None:
    """Tables for a cube map; None where the density of the cosine is as good.

    Parameters
    ----------
    faces : (6, S, S, 3) float32 radiance
    seamless : whether the interpolation goes on across the cube's edges
    """
    squares = np.einsum("frck,frck->frc", faces, faces, dtype=np.float64) / 3
    radiance = np.sqrt(_large_texels(_padded(squares, seamless)))
    size = radiance.shape[1]
    split = size // CELLS
    solid_angle = _in_cells(np.broadcast_to(_solid_angles(size), radiance.shape), split)
    radiance = _in_cells(radiance, split)
    flux = radiance * solid_angle
    centers, reach = _cells()
    cosine = _cosines(centers, reach)
    if _unevenness(flux, radiance * flux, solid_angle, cosine, _strata(centers)) < UNEVEN:
        return None
    cells = _with_shade(cosine * flux.sum(axis=(1, 2))).reshape(-1, CELLS)
    return ProductSampling(
        rows=tabulated(cells.sum(axis=1).reshape(-1, 6 * CELLS)),
        columns=tabulated(cells),
        texel_rows=tabulated(flux.sum(axis=2)),
        texel_columns=tabulated(flux.reshape(-1, split)),
    )


def _with_shade(weights: Floats64) -> Floats64:
    """Weights (normals, cells) where the few cells that have most of their row have two thirds of it at most.

    Those hold suns, and where a sun is hidden, a third of the samples are left for the sky.
    """
    large = weights > weights.sum(axis=1, keepdims=True) / FEW
    suns = weights.sum(axis=1, keepdims=True, where=large)
    most = 2 * weights.sum(axis=1, keepdims=True, where=~large)
    too_much = large & (suns > most) & (most > 0)
    return np.where(too_much, weights * (most / np.where(suns > 0, suns, 1)), weights)


def _unevenness(
    flux: Floats64, square: Floats64, solid_angle: Floats64, cosine: Floats64, stratum: Indices
) -> float:
    """Variance within strata over the density of the cosine, in squares of the mean, for all normals together.

    Parameters
    ----------
    flux, square, solid_angle : (cells, n, n), the solid angles of texels, times radiance, times its square
    cosine : (normals, cells)
    stratum : (cells,)
    """
    flux, square, solid_angle = (x.sum(axis=(1, 2)) for x in (flux, square, solid_angle))
    mean = (np.bincount(stratum, flux) / np.bincount(stratum, solid_angle)).take(stratum)
    share = cosine / (cosine @ solid_angle)[:, None]
    within = share @ (square - mean * mean * solid_angle)
    return float(within.mean() / np.square(share @ flux).mean())


def _strata(centers: Floats64) -> Indices:
    """Number (n,) of the stratum of each direction (n, 3): not along the cube's edges, as pictures may be."""
    row, column = np.divmod(nearest_normal(centers.T.astype(np.float32)), NORMALS)
    stratum: Indices = row // STRATUM * (NORMALS // STRATUM) + column // STRATUM
    return stratum


def _in_cells(texels: Floats64, split: int) -> Floats64:
    """From (6, size, size) to (6 CELLS^2, split, split)."""
    cells = texels.reshape(6, CELLS, split, CELLS, split)
    return cells.swapaxes(2, 3).reshape(-1, split, split)


# ---------------------------------------------------------------- mean squares over texels


def _large_texels(padded: Floats64) -> Floats64:
    """Means over texels that are as large as they may be, (6, size, size), from the faces with a border."""
    size = CELLS
    while size < min(padded.shape[1] - 2, FINEST):
        size *= 2
    squares = _means(padded, size)
    finest = _flux(squares)
    while size > CELLS:
        size //= 2
        larger = squares.reshape(6, size, 2, size, 2).mean(axis=(2, 4))
        if _flux(larger) ** 2 > EVEN_ENOUGH * finest**2:
            break
        squares = larger
    return squares


def _flux(squares: Floats64) -> float:
    """Its square is the second moment of what is drawn by the root of these mean squares."""
    return float((np.sqrt(squares) * _solid_angles(squares.shape[1])).sum())


def _means(padded: Floats64, parts: int) -> Floats64:
    """Means of the bilinear interpolation over parts x parts equal squares of each face.

    ``padded``: (6, S + 2, S + 2), the faces with a border of one texel
    """
    size = padded.shape[1] - 2
    edge = np.arange(parts + 1) * (size / parts) + 0.5
    first = np.floor(edge[:-1]).astype(np.intp)
    for _ in range(2):
        total = np.zeros((*padded.shape[:2], parts))
        for sample in range(2 + math.ceil(size / parts)):
            texel = first + sample
            # The tent over a texel's centre, integrated from one edge to the next.
            low, high = np.clip((edge[:-1] - texel, edge[1:] - texel), -1, 1)
            weight = (high - high * np.abs(high) / 2) - (low - low * np.abs(low) / 2)
            total += weight * padded.take(texel, axis=2, mode="clip")
        padded = total.swapaxes(1, 2) * (parts / size)
    return padded


def _padded(texels: Floats64, seamless: bool) -> Floats64:
    """(6, S + 2, S + 2): what (6, S, S) texels go on with beyond the edges of their face."""
    padded = np.pad(texels, ((0, 0), (1, 1), (1, 1)), mode="edge")
    if not seamless:
        return padded
    size = texels.shape[1]
    middle, right, down = FRAMES.swapaxes(0, 1)[:, :, None]
    along = ((np.arange(size) + 0.5) * 2 / size - 1)[:, None]
    inner = slice(1, -1)
    for sign, end in ((-1, 0), (1, -1)):
        # On the edge, and half a texel down on the other side. There is no fourth texel at a corner of the cube.
        edge = middle * (1 - 1 / size)
        padded[:, inner, end] = _nearest(texels, edge + sign * right + along * down)
        padded[:, end, inner] = _nearest(texels, edge + along * right + sign * down)
    return padded


def _nearest(texels: Floats64, direction: Floats64) -> Floats64:
    """The texel (..., ) in each direction (..., 3), of any length."""
    face = (direction @ FRAMES[:, 0].T).argmax(axis=-1)
    middle, right, down = np.moveaxis(np.einsum("...i,...ki->...k", direction, FRAMES[face]), -1, 0)
    size = texels.shape[1]
    column, row = (((x / middle + 1) / 2 * size).astype(np.intp) for x in (right, down))
    nearest: Floats64 = texels[face, row, column]
    return nearest


def _solid_angles(size: int) -> Floats64:
    """(size, size) of a face's equal squares."""
    edge = np.linspace(-1, 1, size + 1)
    s, t = edge, edge[:, None]
    corner = np.arctan(s * t / np.sqrt(1 + s * s + t * t))
    return np.diff(np.diff(corner, axis=0), axis=1)


# ---------------------------------------------------------------- cosines of cells


def nearest_normal(normal: Floats32) -> Indices:
    """Number (n,) of the table for each normal (3, n): a square of the octahedron that is unfolded about +z."""
    x, y, z = normal
    # Normals of opposite directions may have cancelled to 0.
    scale = np.maximum(np.abs(normal).sum(axis=0), np.float32(1e-20))
    np.divide(np.float32(NORMALS / 2), scale, out=scale)
    fold = np.abs(np.minimum(z, 0))
    column, row = (
        np.minimum((w + np.copysign(fold, w)) * scale + np.float32(NORMALS / 2), NORMALS - 1)
        for w in (x, y)
    )
    number: Indices = row.astype(np.intp) * NORMALS + column.astype(np.intp)
    return number


def _folded(p: Floats64, q: Floats64) -> Floats64:
    """Directions (..., 3) of points of the unfolded octahedron, -1 to 1: the inverse of `nearest_normal`."""
    z = 1 - np.abs(p) - np.abs(q)
    fold = np.maximum(-z, 0)
    return np.stack((p - np.copysign(fold, p), q - np.copysign(fold, q), z), axis=-1)


def _cells() -> tuple[Floats64, Floats64]:
    """Unit vectors (6 CELLS^2, 3) to the middles of all cells, and the largest angle to their corners."""
    edge = np.linspace(-1, 1, CELLS + 1)
    middle = (edge[1:] + edge[:-1]) / 2
    faces = [_centers(_on_face(frame, middle), _on_face(frame, edge)) for frame in FRAMES]
    centers, reach = (np.concatenate(parts) for parts in zip(*faces, strict=True))
    return centers, reach


def _cosines(cells: Floats64, cell_reach: Floats64) -> Floats64:
    """(normals, cells): root of the mean square of the cosine between them where it is positive.

    The cosine is taken to be distributed like a triangle as wide as the two may reach, so that the result is 0 for
    those cells only of which nothing is above the horizon of any such normal.
    """
    edge = np.linspace(-1, 1, NORMALS + 1)
    middle = (edge[1:] + edge[:-1]) / 2
    normals, reach = _centers(_folded(middle, middle[:, None]), _folded(edge, edge[:, None]))
    cosine = normals @ cells.T
    # A little wider than that for the rounding of normals.
    half = np.sin(np.minimum(reach[:, None] + cell_reach + 1e-5, math.pi / 2))
    square = half * half
    tail = np.square(np.square(np.maximum(half - np.abs(cosine), 0))) / (12 * square)
    mean = np.where(cosine < 0, tail, cosine * cosine + square / 6 - tail)
    return np.asarray(np.sqrt(mean))


def _on_face(frame: Floats64, place: Floats64) -> Floats64:
    """(n, n, 3) directions of the places -1 to 1 on a face."""
    middle, right, down = frame
    directions: Floats64 = middle + place[:, None] * right + place[:, None, None] * down
    return directions


def _centers(centers: Floats64, corners: Floats64) -> tuple[Floats64, Floats64]:
    """Unit vectors (n, 3) to the middles of squares, and the largest angle to their corners (n,)."""
    centers = centers / np.linalg.norm(centers, axis=-1, keepdims=True)
    corners = corners / np.linalg.norm(corners, axis=-1, keepdims=True)
    of_each = (corners[:-1, :-1], corners[1:, :-1], corners[:-1, 1:], corners[1:, 1:])
    nearness = np.min([(centers * corner).sum(axis=-1) for corner in of_each], axis=0)
    return centers.reshape(-1, 3), np.arccos(nearness).ravel()
