"""Returns float64, as rng.random does by itself."""

FUNCTION = "random"
CAUGHT_BY = "contract"
MISTAKE = "random-float64"
SAYS = (
    "Your result is float64; the course's pictures are float32, and so should the result be here."
)


def random(k, n, rng):
    """Independent uniform points."""
    _check_counts(k, n)
    return rng.random((2, n, k * k))
