"""Integer hashing: 32 well-mixed bits that depend only on pixel, dimension and seed."""

import numpy as np

from course.engine.core.types import Words

GOLDEN, FIRST, SECOND = 0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB
"""SplitMix64's increment and its two multipliers."""

_MASK64 = (1 << 64) - 1


def mix(value: int) -> int:
    """Hash of a 64-bit word (one step of SplitMix64; Steele, Lea & Flood 2014)."""
    value = (value + GOLDEN) & _MASK64
    value = ((value ^ (value >> 30)) * FIRST) & _MASK64
    value = ((value ^ (value >> 27)) * SECOND) & _MASK64
    return value ^ (value >> 31)


def combine(*keys: int) -> int:
    """64-bit hash of non-negative integers and their order."""
    state = 0
    for key in keys:
        state = mix(state ^ (key & _MASK64))
    return state


def hash_words(keys: Words, *salts: int) -> Words:
    """Uniform 32-bit words (len(salts), n), independent between keys (n,) and between 64-bit salts.

    Keys are pixel numbers, for instance, and a salt is ``combine(seed, dimension)``.
    """
    state = keys.astype(np.uint64) * np.uint64(GOLDEN)
    state = state + np.array([salt & _MASK64 for salt in salts], np.uint64)[:, None]
    state ^= state >> np.uint64(30)
    state *= np.uint64(FIRST)
    state ^= state >> np.uint64(27)
    state *= np.uint64(SECOND)
    state >>= np.uint64(32)
    return state.astype(np.uint32)
