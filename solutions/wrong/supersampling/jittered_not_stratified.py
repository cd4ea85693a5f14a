"""Uniform in the whole pixel instead of one point a cell."""

FUNCTION = "jittered"
CAUGHT_BY = "cells"
MISTAKE = "not-stratified"


def jittered(k, n, rng):
    """One uniform point in each cell."""
    return random(k, n, rng)
