"""The standard deviation of the mean."""

import numpy as np

FUNCTION = "estimate"
CAUGHT_BY = "variance"
MISTAKE = "standard-deviation"
SAYS = "You return the square root of the variance."


def estimate(f, pdf):
    """With a mistake."""
    _check_samples(f, pdf)
    dtype = np.result_type(f, pdf)
    n = pdf.size
    if n == 0:
        return np.zeros(f.shape[:-1], dtype), np.zeros(f.shape[:-1], dtype)
    safe = np.where(pdf == 0, 1, pdf).astype(np.float64)
    x = f / safe
    mean = x.mean(axis=-1)
    variance = np.sqrt(x.var(axis=-1, ddof=1) / n) if n > 1 else 0 * mean
    return np.asarray(mean, dtype), np.asarray(variance, dtype)


def _check_samples(f, pdf):
    if np.ndim(f) not in (1, 2):
        raise ValueError(f"f must have shape (N,) or (C, N), got {np.shape(f)}")
    _check_numbers("pdf", pdf, np.shape(f)[-1])
    _check_none_negative("pdf", pdf)
    if ((pdf == 0) & (f != 0)).any():
        raise ValueError("pdf must be > 0 where f is not 0")
