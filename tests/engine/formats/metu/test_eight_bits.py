"""From radiance to codes: clamped and cut down, without a gamma."""

import numpy as np
import pytest

from course.engine.formats.pictures.display import SRGB, Display, linear_to_srgb8
from course.engine.functions.effects import Effects

METU = Display(255.0, "linear")


@pytest.mark.parametrize(
    ("radiance", "code"),
    [
        (0, 0),
        (0.99, 0),
        (1, 1),
        (99.99, 99),
        (100.5, 100),
        (254.9, 254),
        (255, 255),
        (1e9, 255),
        (-3, 0),
    ],
)
def test_codes_are_clamped_and_cut_down(radiance: float, code: int) -> None:
    assert (METU.codes(np.full((3, 1, 1), radiance, np.float32)) == code).all()


@pytest.mark.parametrize("samples", [1, 9, 36, 49, 100, 289, 841, 900])
def test_the_mean_of_equal_samples_is_their_code(samples: int) -> None:
    """Its sum in float32 may be a little less than the whole number that each sample is."""
    resolve = Effects().function("supersampling", "resolve")
    code = np.arange(256, dtype=np.float32)
    radiance = np.broadcast_to(code[None, :, None], (3, 256, samples)).copy()
    mean = resolve(radiance, np.ones((256, samples), np.float32))
    np.testing.assert_array_equal(METU.codes(mean[:, None, :])[0, :, 0], code)


def test_white_scales_both_encodings() -> None:
    linear = np.linspace(0, 3, 3 * 4 * 5, dtype=np.float32).reshape(3, 4, 5)
    np.testing.assert_array_equal(Display(2.0).codes(linear), linear_to_srgb8(linear / 2))
    half = Display(2.0, "linear").codes(np.full((3, 1, 1), 1.0, np.float32))
    assert half.tolist() == [[[127, 127, 127]]]


def test_the_default_is_the_srgb_curve() -> None:
    linear = np.linspace(-1, 2, 3 * 4 * 5, dtype=np.float32).reshape(3, 4, 5)
    np.testing.assert_array_equal(SRGB.codes(linear), linear_to_srgb8(linear))
