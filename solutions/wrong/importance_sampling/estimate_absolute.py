"""The integrand's size, whatever its sign."""

import numpy as np

FUNCTION = "estimate"
CAUGHT_BY = "mean"
MISTAKE = "sign-lost"
SAYS = "Your estimate loses the integrand's sign: where f is negative, the sample has to lower the mean."


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
    value = np.abs(f) / safe
    mean = value.sum(axis=-1) / n
    off = value - mean[..., None]
    variance = (off * off).sum(axis=-1) / max(n - 1, 1) / n
    return mean.astype(dtype), variance.astype(dtype)
