"""Only lamps ever shoot."""

import numpy as np

FUNCTION = "shoot"
CAUGHT_BY = "shot"
MISTAKE = "not-passed-on"
SAYS = "Receivers don't get anything to shoot: light is reflected once only."


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
    left = unshot + 0 * received
    left[:, shooter] = 0
    return radiosity + received, left
