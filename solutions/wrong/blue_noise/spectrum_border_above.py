"""A frequency at a border is in the bin above it."""

import numpy as np

FUNCTION = "radial_spectrum"
CAUGHT_BY = "wave"
MISTAKE = "border-to-the-bin-above"
SAYS = "A frequency at a border is in the bin above it."


def radial_spectrum(error, bins):
    """With a mistake."""
    _check_picture("error", error)
    if not 1 <= bins <= min(np.shape(error)) // 2 or bins != int(bins):
        raise ValueError(f"bins must be an integer from 1 to min(H, W) // 2, got {bins}")
    height, width = error.shape
    power = np.abs(np.fft.fft2(error.astype(np.float64))) ** 2 / error.size
    frequency = np.hypot(np.fft.fftfreq(height)[:, None], np.fft.fftfreq(width))
    place = np.floor(frequency * 2 * bins + 1) * (frequency > 0).astype(np.intp).ravel()
    inside = (place > 0) & (place <= bins)
    sums = np.bincount(place[inside] - 1, power.ravel()[inside], bins)
    return (sums / np.bincount(place[inside] - 1, minlength=bins)).astype(error.dtype)
