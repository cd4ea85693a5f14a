"""You looked at one channel alone: a green lamp has no weight then."""

import numpy as np

FUNCTION = "texel_weights"
CAUGHT_BY = "values"
MISTAKE = "one-channel"
SAYS = "You looked at one channel alone: a green lamp has no weight then."


def texel_weights(image):
    """With a mistake."""
    if np.ndim(image) != 3 or np.shape(image)[2] != 3 or not np.size(image):
        raise ValueError(f"image must have shape (H, W, 3), got {np.shape(image)}")
    if not (image >= 0).all():
        raise ValueError(f"image must be >= 0, got {np.min(image)}")
    height, width, _ = image.shape
    edge = np.cos(np.pi * np.arange(height + 1) / height)
    solid_angle = 2 * np.pi / width * (edge[:-1] - edge[1:])
    return (image[:, :, 0].astype(np.float64) * solid_angle[:, None]).astype(image.dtype)
