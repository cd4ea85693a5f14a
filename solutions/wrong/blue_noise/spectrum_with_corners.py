"""Frequencies beyond half a cycle per pixel are in your last bin."""

import numpy as np

FUNCTION = "radial_spectrum"
CAUGHT_BY = "board"
MISTAKE = "corners-counted"
SAYS = "Frequencies beyond half a cycle per pixel are in your last bin."


def radial_spectrum(error, bins):
    """With a mistake."""
    _check_picture("error", error)
    if not 1 <= bins <= min(np.shape(error)) // 2 or bins != int(bins):
        raise ValueError(f"bins must be an integer from 1 to min(H, W) // 2, got {bins}")
    height, width = error.shape
    power = np.abs(np.fft.fft2(error.astype(np.float64))) ** 2 / error.size
    frequency = np.hypot(np.fft.fftfreq(height)[:, None], np.fft.fftfreq(width))
    place = np.ceil(frequency * 2 * bins).astype(np.intp).ravel()
    place = np.minimum(place, bins)
    inside = place > 0
    sums = np.bincount(place[inside] - 1, power.ravel()[inside], bins)
    return (sums / np.bincount(place[inside] - 1, minlength=bins)).astype(error.dtype)
