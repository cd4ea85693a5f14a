"""The six faces of a cube map, from pictures of other forms."""

from collections.abc import Callable, Iterator

import numpy as np

from course.engine.core.types import Floats32, Floats64
from course.engine.terms.environments.sampling import FRAMES

SAMPLES = 8_000_000
"""Of a picture at most, where texels are means of more than four."""

AT_ONCE = 16_000
"""Samples of a face: what is computed of them stays in the processor's cache."""


def texel_directions(size: int, subsamples: int = 1, rows: slice = slice(None)) -> Floats64:
    """Directions through samples of the texels of all faces, or of some of their rows.

    Returns
    -------
    (6, 3, subsamples^2, rows, size) float64, not normalised
    """
    n = size * subsamples
    places = ((np.arange(n) + 0.5) * 2 / n - 1).reshape(size, subsamples).T
    across = np.tile(places, (subsamples, 1))[:, None]
    along = np.repeat(places, subsamples, axis=0)[:, rows, None]
    middle, right, down = FRAMES.swapaxes(0, 1)[..., None, None, None]
    directions: Floats64 = middle + across * right + along * down
    return directions


def cube_from_lat_long(image: Floats32, size: int) -> Floats32:
    """Faces (6, size, size, 3) from a latitude-longitude picture (H, W, 3).

    The picture's middle looks along -z, its right half to +x, its top row to +y. Each texel is the mean of 4 to 16
    bilinear samples. Next to the poles, where pixels are narrower than the samples are apart, rows are blurred before:
    a sun of one pixel keeps its light, to some 3% but for the rows at the poles.
    """
    height, width = image.shape[:2]

    def place(x: Floats64, y: Floats64, z: Floats64) -> tuple[Floats64, Floats64]:
        column = (0.5 + np.arctan2(x, -z) / (2 * np.pi)) * width - 0.5
        return column, np.arctan2(np.hypot(x, z), y) / np.pi * height - 0.5

    subsamples = min(max(int((SAMPLES / (6 * size * size)) ** 0.5), 2), 4)
    return _resampled(_blurred_at_poles(image, size), size, place, subsamples)


def _blurred_at_poles(image: Floats32, size: int) -> Floats32:
    """Each row's means over half a texel of the faces, where that is wider than a pixel."""
    height, width = image.shape[:2]
    # A texel in a face's middle is 2 / size wide [rad].
    at_equator = width / (2 * np.pi) / size
    widths = at_equator / np.sin(np.pi * (np.arange(height) + 0.5) / height)
    blurred = image.copy()
    for row in np.flatnonzero(widths > 1):
        half = min(widths[row], width) / 2
        # The row goes once around: three turns of it, so that no window ends.
        turns = np.tile(image[row].astype(np.float64), (3, 1))
        sums = np.concatenate((np.zeros((1, 3)), np.cumsum(turns, axis=0), np.zeros((1, 3))))
        low, high = (
            _between(sums, width + 0.5 + np.arange(width) + side) for side in (-half, half)
        )
        blurred[row] = (high - low) / (2 * half)
    return blurred


def _between(sums: Floats64, place: Floats64) -> Floats64:
    """Rows of sums at places between them."""
    first = place.astype(np.intp)
    share = (place - first)[:, None]
    found: Floats64 = sums[first] * (1 - share) + sums[first + 1] * share
    return found


def cube_from_angular(image: Floats32, size: int) -> Floats32:
    """Faces (6, size, size, 3) from an angular map (N, N, 3), a light probe (P. Debevec, 1998).

    The picture's middle looks along -z, its right half to +x, its top to +y. The distance from the middle is in
    proportion to the angle from -z; the rim of the inscribed disk is +z. What lies beyond it is never read. Each texel
    is the mean of four bilinear samples.
    """
    count = len(image)

    def place(x: Floats64, y: Floats64, z: Floats64) -> tuple[Floats64, Floats64]:
        across = np.hypot(x, y)
        # The four pixels of a sample lie within the disk.
        share = np.minimum(np.arctan2(across, -z) / np.pi, max(1 - 2 / count, 0))
        share /= np.maximum(across, 1e-300)
        return (1 + share * x) / 2 * count - 0.5, (1 - share * y) / 2 * count - 0.5

    return _resampled(image, size, place)


def _resampled(
    image: Floats32,
    size: int,
    place: Callable[[Floats64, Floats64, Floats64], tuple[Floats64, Floats64]],
    subsamples: int = 2,
) -> Floats32:
    """Faces by the columns and rows of a picture that directions (x, y, z) have."""
    faces = np.empty((6, size, size, 3), np.float32)
    shape = image.shape[:2]
    channels = np.ascontiguousarray(image.reshape(-1, 3).T, np.float64)
    height = max(AT_ONCE // (size * subsamples**2), 1)
    for first in range(0, size, height):
        rows = slice(first, first + height)
        for face, xyz in zip(faces, texel_directions(size, subsamples, rows), strict=True):
            for channel, samples in enumerate(_bilinear(channels, shape, *place(*xyz))):
                face[rows, :, channel] = samples.mean(axis=0)
    return faces


def _bilinear(
    channels: Floats64, shape: tuple[int, ...], column: Floats64, row: Floats64
) -> Iterator[Floats64]:
    """Samples of each channel of a picture that repeats sideways and ends at the poles."""
    height, width = shape
    left, top = np.floor(column), np.floor(row)
    a, b = column - left, row - top
    c0 = left.astype(np.intp) % width
    c1 = (c0 + 1) % width
    r0 = np.clip(top.astype(np.intp), 0, height - 1) * width
    r1 = np.clip(top.astype(np.intp) + 1, 0, height - 1) * width
    corners = r0 + c0, r0 + c1, r1 + c0, r1 + c1
    for channel in channels:
        upper_left, upper_right, lower_left, lower_right = (channel.take(at) for at in corners)
        upper = upper_left * (1 - a) + upper_right * a
        lower = lower_left * (1 - a) + lower_right * a
        yield upper * (1 - b) + lower * b


def cube_from_cross(image: Floats32) -> Floats32:
    """Faces (6, S, S, 3) from a cross: horizontal (3 S, 4 S, 3) or vertical (4 S, 3 S, 3).

    Both have -x, +z, +x side by side with +y above and -y below +z; -z stands right of +x, or upside down below -y.
    Raises ValueError: the picture has other proportions.
    """
    height, width = image.shape[:2]
    if height * 4 == width * 3 and width % 4 == 0:
        size = width // 4
        minus_z = image[size : 2 * size, 3 * size :]
    elif height * 3 == width * 4 and width % 3 == 0:
        size = width // 3
        minus_z = image[3 * size :, size : 2 * size][::-1, ::-1]
    else:
        raise ValueError(f"a cross has proportions 4:3 or 3:4, not {width} x {height}")

    def cell(row: int, column: int) -> Floats32:
        return image[row * size : (row + 1) * size, column * size : (column + 1) * size]

    return np.ascontiguousarray(
        np.stack((cell(1, 2), cell(1, 0), cell(0, 1), cell(2, 1), cell(1, 1), minus_z))
    )
