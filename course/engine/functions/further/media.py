"""media: light through fog."""

from collections.abc import Callable
from typing import Any

AFTER = "path_tracing"

FUNCTIONS = (
    "transmittance free_flight free_flight_pdf henyey_greenstein sample_henyey_greenstein delta_tracking"
    " ratio_tracking equiangular in_scattering"
)

_RAYS = "grid: X Y Z, majorant, origin: 3 N, direction: 3 N, limit: N"

CONTRACTS = {
    "transmittance": "sigma_t: 3, distance: N -> the shares: 3 N",
    "free_flight": "sigma_t: 3, weights: 3, u: 2 N -> the distances: infinite N",
    "free_flight_pdf": "sigma_t: 3, weights: 3, distance: N -> the density: N",
    "henyey_greenstein": "cos: N, g -> the values: N",
    "sample_henyey_greenstein": "direction: 3 N, g, u: 2 N -> directions: unit 3 N, density: N",
    "delta_tracking": f"{_RAYS}, u: 2 K N -> distance: N, collided: bool N",
    "ratio_tracking": f"{_RAYS}, u: K N -> share: N, distance: N",
    "equiangular": "origin: 3 N, direction: 3 N, light: 3 N, limit: N, u: N -> distance: N, density: N",
    "in_scattering": "sigma_s: 3, sigma_t: 3, distance: N, beyond: N, phase: N, density: N -> the radiance: 3 N",
}


def stand_ins() -> dict[str, tuple[Callable[..., Any], str]]:
    """Fog that isn't there."""
    import numpy as np

    none = "there is no fog"
    even = "light is scattered evenly in all directions"
    return {
        "transmittance": (
            lambda _sigma, distance: np.ones((3, len(distance)), distance.dtype),
            none,
        ),
        "free_flight": (lambda _sigma, _weights, u: np.full(len(u[0]), np.inf, u.dtype), none),
        "free_flight_pdf": (lambda _sigma, _weights, distance: np.ones_like(distance), none),
        "henyey_greenstein": (lambda cos, _g: np.full_like(cos, 1 / (4 * np.pi)), even),
        "sample_henyey_greenstein": (
            lambda direction, _g, u: (direction.copy(), np.full_like(u[0], 1 / (4 * np.pi))),
            "scattered light goes straight on",
        ),
        "delta_tracking": (
            lambda _grid, _most, _origin, _direction, limit, _u: (
                limit.copy(),
                np.zeros(len(limit), np.bool_),
            ),
            none,
        ),
        "ratio_tracking": (
            lambda _grid, _most, _origin, _direction, limit, _u: (
                np.ones_like(limit),
                limit.copy(),
            ),
            none,
        ),
        "equiangular": (
            lambda _origin, _direction, _light, limit, u: (limit * u, 1 / limit),
            "fog is sampled evenly along rays, which is noisy near lamps",
        ),
        "in_scattering": (
            lambda _s, _t, distance, *_: np.zeros((3, len(distance)), distance.dtype),
            "fog scatters no light into rays",
        ),
    }
