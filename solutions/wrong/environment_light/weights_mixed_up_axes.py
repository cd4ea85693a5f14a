"""You took the picture's width for its height."""

import numpy as np

FUNCTION = "texel_weights"
CAUGHT_BY = "values"
MISTAKE = "rows-for-columns"
SAYS = "You took the picture's width for its height."


def texel_weights(image):
    """With a mistake."""
    if np.ndim(image) != 3 or np.shape(image)[2] != 3 or not np.size(image):
        raise ValueError(f"image must have shape (H, W, 3), got {np.shape(image)}")
    if not (image >= 0).all():
        raise ValueError(f"image must be >= 0, got {np.min(image)}")
    height, width, _ = image.shape
    width, height = height, width
    edge = np.cos(np.pi * np.arange(height + 1) / height)
    solid_angle = 2 * np.pi / width * (edge[:-1] - edge[1:])
    return (
        image.mean(axis=2, dtype=np.float64) * np.resize(solid_angle, image.shape[0])[:, None]
    ).astype(image.dtype)
