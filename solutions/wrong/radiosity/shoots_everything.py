"""Shoots the whole radiosity instead of what has not been shot."""

import numpy as np

FUNCTION = "shoot"
CAUGHT_BY = "shot"
MISTAKE = "shoots-everything"
SAYS = "You shoot the whole radiosity again, with what has been shot before."


def shoot(radiosity, unshot, reflectance, areas, form_factors, shooter):
    """One shot."""
    _check_colors("radiosity", radiosity)
    patches = np.shape(radiosity)[1]
    _check_colors("unshot", unshot, patches)
    _check_colors("reflectance", reflectance, patches)
    _check_shape("areas", areas, (patches,))
    _check_shape("form_factors", form_factors, (patches,))
    if not 0 <= shooter < patches:
        raise ValueError(f"shooter must be from 0 to {patches - 1}, got {shooter}")
    received = reflectance * radiosity[:, shooter, None] * form_factors * areas[shooter] / areas
    left = unshot + received
    left[:, shooter] = received[:, shooter]
    return radiosity + received, left
