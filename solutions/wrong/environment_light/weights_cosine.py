"""The cosine of the angle from +y: rows at the horizon get none."""

import numpy as np

FUNCTION = "texel_weights"
CAUGHT_BY = "values"
MISTAKE = "cosine-for-sine"
SAYS = "You took the cosine of the angle from +y: rows at the horizon get none."


def texel_weights(image):
    """With a mistake."""
    if np.ndim(image) != 3 or np.shape(image)[2] != 3 or not np.size(image):
        raise ValueError(f"image must have shape (H, W, 3), got {np.shape(image)}")
    if not (image >= 0).all():
        raise ValueError(f"image must be >= 0, got {np.min(image)}")
    height, width, _ = image.shape
    edge = np.cos(np.pi * np.arange(height + 1) / height)
    solid_angle = (
        2
        * np.pi
        / width
        * np.pi
        / height
        * np.abs(np.cos(np.pi * (np.arange(height) + 0.5) / height))
    )
    return (image.mean(axis=2, dtype=np.float64) * solid_angle[:, None]).astype(image.dtype)
