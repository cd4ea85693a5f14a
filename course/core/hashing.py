"""Integer hashing: the same well-mixed 32 bits for the same pixel, dimension and seed, anywhere and in any order."""

from __future__ import annotations

import numpy as np

from course.core.types import Words

GOLDEN, FIRST, SECOND = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB
"""What SplitMix64 adds, and what it multiplies by."""

_MASK64 = (1 << 64) - 1


def mix(value: int) -> int:
    """One 64-bit word mixed into another (the finaliser of SplitMix64; Steele, Lea & Flood 2014)."""
    value = (value + GOLDEN) & _MASK64
    value = ((value ^ (value >> 30)) * FIRST) & _MASK64
    value = ((value ^ (value >> 27)) * SECOND) & _MASK64
    return value ^ (value >> 31)


def combine(*keys: int) -> int:
    """A 64-bit word that depends on every key and on their order; keys are non-negative integers."""
    state = 0
    for key in keys:
        state = mix(state ^ (key & _MASK64))
    return state


def hash_words(keys: Words, *salts: int) -> Words:
    """Uniformly distributed 32-bit words, independent from key to key and from salt to salt.

    Parameters
    ----------
    keys : (n,) uint32, for instance pixel numbers
    salts : 64-bit integers, for instance ``combine(seed, dimension)`` for some dimensions

    Returns
    -------
    (len(salts), n) uint32
    """
    state = keys.astype(np.uint64) * np.uint64(GOLDEN)
    state = state + np.array([salt & _MASK64 for salt in salts], np.uint64)[:, None]
    state ^= state >> np.uint64(30)
    state *= np.uint64(FIRST)
    state ^= state >> np.uint64(27)
    state *= np.uint64(SECOND)
    state >>= np.uint64(32)
    return state.astype(np.uint32)
