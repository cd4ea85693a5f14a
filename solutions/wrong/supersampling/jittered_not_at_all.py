"""Every point in its cell's centre."""

FUNCTION = "jittered"
CAUGHT_BY = "uniform"
MISTAKE = "not-jittered"
SAYS = "Your points are the same in every cell and every pixel: there is no randomness in them."


def jittered(k, n, rng):  # noqa: ARG001
    """One point in each cell."""
    return regular(k, n)
