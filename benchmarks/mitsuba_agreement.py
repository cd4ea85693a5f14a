"""Converged pictures of both programs, and whether they agree beyond noise.

A converged picture is the mean of batches with seeds of their own, so the scatter of the batches tells its noise
without assuming anything. Two pictures are compared by the means of blocks of pixels: Welch's t of each block and
channel. In a right pair about 1 block in 10^4 lies beyond 4.5, with 32 batches in all.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

BLOCK = 8
"""Pixels along a block's side."""

FAR = 4.5
"""Blocks beyond this are counted."""


@dataclass(frozen=True)
class Converged:
    """The mean of batches.

    Attributes
    ----------
    linear : (H, W, 3) float64
    noise : its own mean squared error
    blocks, block_noise : means of blocks and the variances of these means
    """

    linear: np.ndarray
    noise: float
    blocks: np.ndarray
    block_noise: np.ndarray

    def mse(self, picture: np.ndarray) -> float:
        """Mean squared error of a picture of other seeds; the noise of this one has been taken off."""
        return float(np.mean((picture.astype(np.float64) - self.linear) ** 2)) - self.noise


@dataclass(frozen=True)
class Agreement:
    """How two converged pictures differ.

    Attributes
    ----------
    largest : the largest |t| of all blocks
    far : share of blocks beyond FAR
    rms : of what differs beyond noise, over pixels and channels; 0 where all is noise
    mean : difference of the whole pictures' means, relative
    where : (x, y) of the pixel in the middle of the worst block
    """

    largest: float
    far: float
    rms: float
    mean: float
    where: tuple[int, int]


def converge(render: Callable[[int], np.ndarray], batches: int, path: Path) -> Converged:
    """The mean of ``render(seed)`` over seeds 10^6, 10^6 + 1, ...; kept in a file."""
    if path.exists():
        with np.load(path, allow_pickle=False) as data:
            return Converged(
                data["linear"], float(data["noise"]), data["blocks"], data["block_noise"]
            )
    total, squares, blocks = 0.0, 0.0, []
    for seed in range(batches):
        picture = render(1_000_000 + seed).astype(np.float64)
        total, squares = total + picture, squares + picture**2
        blocks.append(_block_means(picture))
    mean = np.asarray(total / batches)
    variance = np.maximum(squares / batches - mean**2, 0) / (batches - 1)
    result = Converged(
        mean,
        float(variance.mean()),
        np.mean(blocks, axis=0),
        np.var(blocks, axis=0, ddof=1) / batches,
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savez(path, **vars(result))
    return result


def compare(a: Converged, b: Converged) -> Agreement:
    """Block by block."""
    # Where nothing is random the last bits of float32 sums still are.
    rounding = (1e-6 * (1 + np.abs(b.blocks))) ** 2
    t = np.abs(a.blocks - b.blocks) / np.sqrt(a.block_noise + b.block_noise + rounding)
    row, column, _ = np.unravel_index(t.argmax(), t.shape)
    squared = float(np.mean((a.linear - b.linear) ** 2)) - a.noise - b.noise
    return Agreement(
        float(t.max()),
        float(np.mean(t > FAR)),
        float(np.sqrt(max(squared, 0.0))),
        float(a.linear.mean() / b.linear.mean() - 1),
        (int(column) * BLOCK + BLOCK // 2, int(row) * BLOCK + BLOCK // 2),
    )


def save_difference(a: Converged, b: Converged, path: Path, scale: float = 0.02) -> None:
    """Both pictures and their difference side by side; grey is equal, black and white differ by half of ``scale``."""
    from course.engine.formats.pictures.files import save

    difference = np.clip(0.5 + (a.linear - b.linear) / scale, 0, 1)
    row = np.concatenate((a.linear, b.linear, difference**2.2), axis=1)
    path.parent.mkdir(parents=True, exist_ok=True)
    save(path, np.moveaxis(row, 2, 0).astype(np.float32))


def _block_means(picture: np.ndarray) -> np.ndarray:
    rows, columns = (n // BLOCK for n in picture.shape[:2])
    whole = picture[: rows * BLOCK, : columns * BLOCK]
    return whole.reshape(rows, BLOCK, columns, BLOCK, 3).mean(axis=(1, 3))
