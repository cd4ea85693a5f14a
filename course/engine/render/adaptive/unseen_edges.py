"""What pixels may lack of an edge that passes close to their border: none of their samples has fallen beyond it.

Two neighbours whose own samples are alike, but not each other's, have an edge near their border. Within 1 / n of it n
samples that are spread evenly may miss the sliver behind, and then tell no error at all. Where a lamp's edge is along
the pixels, a whole row of them may lack as much.

Let the edge lie t inside one of the two, anywhere with the same chance. Its n samples all miss the sliver with the
chance 1 - n t, so given that they did, t^2 is 1 / (6 n^2) on average. The edge lies in the first of the two with the
chance n' / (n + n').
"""

import numpy as np

from course.engine.core.types import Floats32, Indices, Numbers

STILL = np.float32(0.5)
"""Variance of a pixel, in parts of (jump / n)^2, below which none of its samples has met the edge."""

MISSED = np.float32(1 / 6)
"""Mean of (n t)^2 where nothing was met."""


def unseen_edges(
    colours: Floats32, variance: Floats32, samples: Numbers
) -> tuple[Indices, Floats32]:
    """Pixels (m,) beside which an edge may be unseen, and n^2 times the squared error (m,) that is expected of them.

    Parameters
    ----------
    colours : (3, H, W) float32, the picture so far
    variance : (H, W) float32, estimated variance of each pixel
    samples : (H, W) int32
    """
    # As large a jump as its samples may have missed; a picture that is interrupted at once has pixels without any.
    hidden = samples * np.sqrt(variance / STILL)
    lacking = np.zeros(variance.shape, np.float32)
    for axis in (0, 1):
        _add_along(
            *(np.moveaxis(colours, axis + 1, 1), hidden.swapaxes(0, axis)),
            *(samples.swapaxes(0, axis), lacking.swapaxes(0, axis)),
        )
    pixels = np.flatnonzero(lacking)
    return pixels, lacking.reshape(-1)[pixels]


def _add_along(colours: Floats32, hidden: Floats32, samples: Numbers, lacking: Floats32) -> None:
    """Add what is lacking beside borders from each row to the next."""
    difference = np.diff(colours, axis=1)
    jump = np.sqrt(np.einsum("chw,chw->hw", difference, difference) * np.float32(1 / 3))
    # A slope has as large ones before and after it.
    beside = np.zeros_like(jump)
    np.maximum(beside[1:], jump[:-1], out=beside[1:])
    np.maximum(beside[:-1], jump[1:], out=beside[:-1])
    y, x = np.nonzero((jump > beside) & (jump > hidden[:-1]) & (jump > hidden[1:]))
    square = (jump[y, x] - beside[y, x]) ** 2 * MISSED
    one, other = samples[y, x], samples[y + 1, x]
    both = np.maximum(one + other, 1).astype(np.float32)
    lacking[y, x] += square * other / both
    lacking[y + 1, x] += square * one / both
