"""Judging a picture: SSIM where noise is negligible, a z-test on the means of blocks where it isn't.

SSIM rewards smoothness and forgives a constant error; a z-test knows nothing of what one sees. So a function that
makes noise is judged by both: by SSIM on a picture of many Sobol samples, with a tolerance that `course calibrate` has
put between right and wrong, and by the means of blocks over pictures of several seeds.
"""

import json
from functools import lru_cache
from importlib.resources import files

import numpy as np
from scipy.special import stdtrit

from course.base.errors import CourseError
from course.engine.comparing.seen import seen
from course.engine.comparing.significance import SIGNIFICANCE, compare
from course.engine.formats.pictures.display import linear_to_srgb8
from course.school.grading.checks.check import Array, Failure

BIAS_FALSE_FAIL = 1e-6
"""Of one test of all blocks of a picture."""

BLOCKS = (6, 8)
"""Blocks down and across."""


def ssim(yours: Array, expected: Array) -> float:
    """Structural similarity of two (3, H, W) linear pictures, as they are displayed."""
    from skimage.metrics import structural_similarity

    a, b = (_display(picture) for picture in (yours, expected))
    return float(structural_similarity(a, b, channel_axis=2, data_range=1.0))  # type: ignore[no-untyped-call]


def _display(picture: Array) -> Array:
    return linear_to_srgb8(np.asarray(picture, np.float32)).astype(np.float64) / 255


@lru_cache(maxsize=1)
def tolerances() -> dict[str, dict[str, float]]:
    """What `course calibrate` found, by check: "thin_lens.lens_rays/picture"."""
    text = (files("course.school.grading") / "data" / "tolerances.json").read_text(encoding="utf-8")
    found: dict[str, dict[str, float]] = json.loads(text)["checks"]
    return found


UNCALIBRATED = 0.98


def check_ssim(yours: Array, expected: Array, check: str) -> None:
    """The picture looks like the reference. Raises Failure."""
    tolerance = tolerances().get(check, {}).get("tolerance", UNCALIBRATED)
    found = ssim(yours, expected)
    if not found >= tolerance:
        y, x = _worst(yours, expected)
        raise Failure(
            f"SSIM of at least {tolerance:.4f}",
            f"{found:.4f}",
            f"largest difference at pixel ({x}, {y}): {_rgb(yours, y, x)} instead of {_rgb(expected, y, x)}",
            _described(yours, expected),
        )


def _described(yours: Array, expected: Array) -> str:
    """What differs, in a sentence; empty where that can't be said."""
    a, b = (np.moveaxis(np.asarray(one, np.float32), 0, -1) for one in (yours, expected))
    if not (np.isfinite(a).all() and np.isfinite(b).all()):
        return ""
    try:
        found = seen(compare(a, b), SIGNIFICANCE)
    except CourseError:
        return ""
    return f"A is yours, and B the reference's. {found[0].text}." if found else ""


def block_means(picture: Array) -> Array:
    """Means of the blocks (down, across) of a (3, H, W) picture's brightness."""
    rows, columns = BLOCKS
    gray = np.asarray(picture, np.float64).mean(axis=0)
    height, width = gray.shape
    means: Array = gray.reshape(rows, height // rows, columns, width // columns).mean(axis=(1, 3))
    return means


def check_bias(yours: list[Array], expected: Array) -> None:
    """Means of blocks agree with the reference's.

    Raises Failure.

    Parameters
    ----------
    yours : pictures of several seeds
    expected : (seeds, down, across), the reference's means of blocks for other seeds
    """
    means = np.stack([block_means(picture) for picture in yours])
    count = len(expected)
    # A block without noise (plain background) may differ by rounding: 1e-4 of a unit is no bias.
    deviation = np.sqrt(expected.var(axis=0, ddof=1) * (1 / count + 1 / len(means))) + 1e-5
    t = (means.mean(axis=0) - expected.mean(axis=0)) / deviation
    limit = -float(stdtrit(count - 1, BIAS_FALSE_FAIL / 2 / t.size))
    if not np.abs(t).max() <= limit:
        row, column = np.unravel_index(int(np.argmax(np.abs(t))), t.shape)
        raise Failure(
            f"the means of {t.size} blocks within {limit:.1f} standard errors",
            f"{t[row, column]:+.1f}",
            f"block {int(column)} across, {int(row)} down: {means.mean(axis=0)[row, column]:.4g} instead of "
            f"{expected.mean(axis=0)[row, column]:.4g}",
            "The picture is right in no number of samples: something is distributed wrongly.",
        )


def _worst(yours: Array, expected: Array) -> tuple[int, int]:
    off = np.abs(yours - expected).sum(axis=0)
    y, x = np.unravel_index(int(np.argmax(off)), off.shape)
    return int(y), int(x)


def _rgb(picture: Array, y: int, x: int) -> str:
    return "(" + ", ".join(f"{float(v):.3g}" for v in picture[:, y, x]) + ")"
