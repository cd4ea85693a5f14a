"""How two noisy pictures differ, in units of their noise."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter

from course.engine.core.types import Floats32, Mask

WINDOW = 7
"""Pixels along the side of the square over which differences and variances are averaged."""

CERTAIN = 4.0
"""Standard deviations of the noise from which on a difference is shown as one."""

DARKEST = 16.0
"""Standard deviations at which its colour is darkest."""

LEAST = 1e-3
"""Radiance that nobody sees: smaller differences are none."""

CODES = 1.5
"""Mean difference over a window, of 255, from which on pictures of the same radiance are shown differently."""

_BRIGHTER, _DARKER, _SAME = (
    np.array(c, np.float64) for c in ((178, 24, 43), (33, 102, 172), (236, 236, 232))
)


@dataclass(frozen=True)
class Shot:
    """A picture as a worker has sent it.

    Attributes
    ----------
    linear : (3, H, W) float32
    there : (H, W) bool, pixels that have a sample
    samples : a pixel, of complete passes
    seconds : spent on them
    variance : (H, W) float32 of one sample's mean over the channels; None where nothing is known of it
    codes : (H, W, 3) uint8, as functions of `film` show it; None where the scene asks for none of them
    """

    linear: Floats32
    there: Mask
    samples: int
    seconds: float
    variance: Floats32 | None = None
    codes: NDArray[np.uint8] | None = None


def deviations(a: Shot, b: Shot) -> Floats32:
    """(H, W) float32, difference a - b of means over windows, in standard deviations of their noise.

    The same numbers of samples lead to the same noise in both, so the true deviation is smaller, not larger.
    """
    difference = (a.linear - b.linear).mean(axis=0)
    # What one picture's few samples have missed the other's may have met.
    known = [shot.variance for shot in (a, b) if shot.variance is not None]
    variance = np.max(known, axis=0) if known else np.zeros_like(difference)
    variance = variance * (1 / max(a.samples, 1) + 1 / max(b.samples, 1))
    mean = uniform_filter(difference, WINDOW, mode="nearest")
    # Sums that slide over a row may end a little below 0.
    noise = np.sqrt(np.maximum(uniform_filter(variance, WINDOW, mode="nearest"), 0.0)) / WINDOW
    result = mean / np.maximum(noise, LEAST / CERTAIN)
    # A window that isn't there as a whole has no mean.
    both: Floats32 = uniform_filter((a.there & b.there).astype(np.float32), WINDOW, mode="nearest")
    result = np.where(both > 1 - 0.5 / WINDOW**2, result, 0.0)
    if a.codes is not None and b.codes is not None and np.allclose(a.linear, b.linear, atol=1e-5):
        # The same light: what differs is how it is shown, and has no noise.
        shown = (a.codes.astype(np.float64) - b.codes).mean(axis=2)
        result = uniform_filter(shown, WINDOW, mode="nearest") * (CERTAIN / CODES)
    deviation: Floats32 = result.astype(np.float32)
    return deviation


def share_differing(z: Floats32) -> float:
    """The part of a picture that differs by more than noise."""
    return float((np.abs(z) > CERTAIN).mean())


def coloured(z: Floats32) -> NDArray[np.uint8]:
    """(H, W, 3) uint8: red where the first is brighter, blue where it is darker, grey within the noise."""
    depth = np.clip((np.abs(z) - CERTAIN) / (DARKEST - CERTAIN), 0.0, 1.0)[..., None]
    strength = np.where(np.abs(z)[..., None] > CERTAIN, 0.35 + 0.65 * depth, 0.0)
    end = np.where(z[..., None] > 0, _BRIGHTER, _DARKER)
    colours: NDArray[np.uint8] = (_SAME + strength * (end - _SAME)).round().astype(np.uint8)
    return colours


def rms(a: Shot, b: Shot) -> float:
    """Root-mean-square difference over pixels and channels [radiance]."""
    return float(np.sqrt(((a.linear - b.linear).astype(np.float64) ** 2).mean()))
