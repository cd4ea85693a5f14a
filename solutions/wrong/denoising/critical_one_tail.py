"""You give the whole level to one tail; both together have it."""

import numpy as np

FUNCTION = "critical_value"
CAUGHT_BY = "values"
MISTAKE = "one-tail"
SAYS = "You give the whole level to one tail; both together have it."


def critical_value(degrees, level):
    """With a mistake."""
    _check("degrees", degrees, "N")
    if not 0 < level < 1:
        raise ValueError(f"level must be > 0 and < 1, got {level}")
    inverse = np.linspace(0, 1, 129)[1:, None]
    w = np.linspace(0, 24, 3001)
    t = np.sinh(w)
    student = -(1 / inverse + 1) / 2 * np.log1p(t**2 * inverse)
    density = np.exp(np.concatenate((-(t[None] ** 2) / 2, student))) * np.cosh(w)
    within = np.zeros_like(density)
    within[:, 1:] = np.cumsum((density[:, 1:] + density[:, :-1]) / 2, axis=1)
    table = [
        np.arcsinh(np.interp((1 - 2 * level) * (level < 0.5) * row[-1], row, t)) for row in within
    ]
    return np.sinh(np.interp(1 / degrees, np.linspace(0, 1, 129), table)).astype(degrees.dtype)
