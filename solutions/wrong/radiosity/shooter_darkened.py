"""What is shot is taken from the shooter's radiosity."""

import numpy as np

FUNCTION = "shoot"
CAUGHT_BY = "shot"
MISTAKE = "shooter-darkened"
SAYS = "You take the light that is shot away from the shooter's radiosity: it stays bright."


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
    received = reflectance * unshot[:, shooter, None] * form_factors * areas[shooter] / areas
    after = radiosity + received
    after[:, shooter] -= unshot[:, shooter]
    left = unshot + received
    left[:, shooter] = received[:, shooter]
    return after, left
