"""Receivers reflect everything."""

import numpy as np

FUNCTION = "shoot"
CAUGHT_BY = "shot"
MISTAKE = "nothing-absorbed"
SAYS = "You leave out the reflectance of the receivers."


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
    received = unshot[:, shooter, None] * form_factors * areas[shooter] / areas
    left = unshot + received
    left[:, shooter] = received[:, shooter]
    return radiosity + received, left
