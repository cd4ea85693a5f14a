"""Half of the bits of the seed decide."""

import numpy as np

FUNCTION = "shuffled_z_order"
CAUGHT_BY = "all_of_it"
MISTAKE = None


def shuffled_z_order(x, y, levels, seed):
    """With a mistake."""
    if not 0 <= levels <= 15 or levels != int(levels):
        raise ValueError(f"levels must be an integer from 0 to 15, got {levels}")
    if not 0 <= seed < 1 << 32:
        raise ValueError(f"seed must be from 0 to 2^32 - 1, got {seed}")
    _check_pixels(x, y, 1 << levels)

    def chosen(level, above):
        """A number from 0 to 23 (N,) for each quadrant: its level, and its digits above that level as a number (N,)."""
        return _hashed(above, 32 * (seed & 0xFFFF) + level) % 24

    z = _interleaved(x, y)
    order = np.zeros_like(z)
    for height in range(levels):
        digit = z >> 2 * height & 3
        above = z >> 2 * height + 2
        order |= _PERMUTATIONS[chosen(height, above), digit] << 2 * height
    return order
