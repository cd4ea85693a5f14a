"""Directions below are pressed onto the surface."""

import numpy as np

FUNCTION = "keep_above"
CAUGHT_BY = "mirrored"
MISTAKE = "clamped"
SAYS = "You press the directions flat onto the surface; mirrored ones stand as far above it as they were below."


def keep_above(direction, normal):
    """Bring directions above the surface."""
    _check_batch("direction", direction, 3)
    _check_batch("normal", normal, 3, np.shape(direction)[1])
    direction = direction.astype(np.result_type(direction, normal))
    dot = (direction * normal).sum(axis=0)
    flat = direction - dot * normal
    length = np.linalg.norm(flat, axis=0)
    flat = flat / np.where(length == 0, 1, length)
    return np.where(dot < 0, flat, direction)
