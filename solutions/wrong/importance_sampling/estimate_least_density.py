"""Densities are kept above a millionth."""

import numpy as np

FUNCTION = "estimate"
CAUGHT_BY = "small_densities"
MISTAKE = None


def estimate(f, pdf):
    """With a mistake."""
    if np.ndim(f) not in (1, 2):
        raise ValueError(f"f must have shape (N,) or (C, N), got {np.shape(f)}")
    _check_numbers("pdf", pdf, np.shape(f)[-1])
    _check_not_negative("pdf", pdf)
    if ((pdf == 0) & (f != 0)).any():
        raise ValueError("pdf must be > 0 where f is not 0")
    dtype = np.result_type(f, pdf)
    n = len(pdf)
    value = f / np.maximum(pdf, 1e-6).astype(np.float64)
    mean = value.sum(axis=-1) / max(n, 1)
    off = value - mean[..., None]
    variance = (off * off).sum(axis=-1) / max(n - 1, 1) / max(n, 1)
    return mean.astype(dtype), variance.astype(dtype)
