"""Divided by the sum of the weights 1 / pdf."""

import numpy as np

FUNCTION = "estimate"
CAUGHT_BY = "mean"
MISTAKE = "self-normalised"
SAYS = "You divide by the sum of the samples' weights 1 / pdf: that gives a mean value of f, not its integral."


def estimate(f, pdf):
    """With a mistake."""
    if np.ndim(f) not in (1, 2):
        raise ValueError(f"f must have shape (N,) or (C, N), got {np.shape(f)}")
    _check_numbers("pdf", pdf, np.shape(f)[-1])
    _check_not_negative("pdf", pdf)
    if ((pdf == 0) & (f != 0)).any():
        raise ValueError("pdf must be > 0 where f is not 0")
    dtype, n = np.result_type(f, pdf), max(len(pdf), 1)
    safe = np.where(pdf == 0, 1, pdf).astype(np.float64)
    weight = np.where(pdf == 0, 0, 1 / safe)
    value = f / safe
    mean = value.sum(axis=-1) / max(weight.sum(), 1e-30)
    off = value - value.sum(axis=-1)[..., None] / n
    variance = (off * off).sum(axis=-1) / max(n - 1, 1) / n
    return mean.astype(dtype), variance.astype(dtype)
