"""Uniform in the whole pixel instead of one point a cell."""

FUNCTION = "jittered"
CAUGHT_BY = "cells"
MISTAKE = "not-stratified"
SAYS = "Your points are uniform in the whole pixel, so some cells get several and others none."


def jittered(k, n, rng):
    """One uniform point in each cell."""
    return random(k, n, rng)
