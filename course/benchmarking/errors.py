"""The error of a picture against its reference: three numbers, each 0 if the pictures are the same."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.base.errors import CourseError
from course.engine.core.types import Floats64

RELATIVE_FLOOR = 0.01
"""Added to the squared reference, so that black pixels don't decide; a tenth of white, squared."""

WINDOW = 11
"""Pixels: what a Gaussian of sigma 1.5 fills when cut off at 3.5 sigma."""

Picture = NDArray[np.floating[Any]]


def rmse(image: Picture, reference: Picture) -> float:
    """Root of the mean squared error, over pixels and channels.

    Raises CourseError: the pictures differ in shape, or hold a number that is not finite.
    ``image``, ``reference``: (H, W, 3) floating, linear radiance.
    Returns the error in the unit of the pictures.
    """
    a, b = _pair(image, reference)
    return float(np.sqrt(np.mean((a - b) ** 2)))


def relative_mse(image: Picture, reference: Picture) -> float:
    """Mean of (image - reference)^2 / (reference^2 + 0.01), over pixels and channels.

    An error in the dark counts as much as one in the light, down to a tenth of white.
    Raises CourseError as `rmse` does.
    ``image``, ``reference``: (H, W, 3) floating, linear radiance, white near 1.

    Rousselle, Knaus and Zwicker, "Adaptive sampling and reconstruction using greedy error minimization", 2011.
    """
    a, b = _pair(image, reference)
    return float(np.mean((a - b) ** 2 / (b * b + RELATIVE_FLOOR)))


def dissimilarity(image: Picture, reference: Picture) -> float:
    """1 - SSIM of the pictures as a screen shows them (sRGB, cut off at white).

    Raises CourseError as `rmse` does, or the pictures are smaller than the window.
    ``image``, ``reference``: (H, W, 3) floating, linear radiance; H and W at least 11.
    Returns 0 for equal pictures, at most 2.

    Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error visibility to structural similarity",
    2004, with their Gaussian window of sigma 1.5; by scikit-image, the mean over the channels.
    """
    # It takes half a second to import, which no other number needs.
    from skimage.metrics import structural_similarity

    a, b = _pair(image, reference)
    if min(a.shape[:2]) < WINDOW:
        height, width = a.shape[:2]
        raise CourseError(
            f"SSIM needs pictures of at least {WINDOW} x {WINDOW} pixels, not {width} x {height}"
        )
    # Some versions of scikit-image have annotations, some have not.
    compare: Any = structural_similarity
    similarity = compare(
        _shown(a),
        _shown(b),
        channel_axis=2,
        data_range=1.0,
        gaussian_weights=True,
        sigma=1.5,
        use_sample_covariance=False,
    )
    return 1.0 - float(similarity)


def _pair(image: Picture, reference: Picture) -> tuple[Floats64, Floats64]:
    a, b = np.asarray(image, np.float64), np.asarray(reference, np.float64)
    if a.shape != b.shape or a.ndim != 3 or a.shape[2] != 3 or a.size == 0:
        raise CourseError(
            f"pictures of the shapes {a.shape} and {b.shape} can't be compared: expected two (H, W, 3) alike"
        )
    if not (np.isfinite(a).all() and np.isfinite(b).all()):
        raise CourseError("a picture that holds a NaN or an infinity has no error")
    return a, b


def _shown(linear: Floats64) -> Floats64:
    """The sRGB curve of IEC 61966-2-1, without rounding to 8 bits."""
    x = np.clip(linear, 0.0, 1.0)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
