"""photon_mapping: light that is followed from the lamps."""

from collections.abc import Callable
from typing import Any

AFTER = "media"

FUNCTIONS = (
    "emit_cone emit_area emit_directional roulette stored density_estimate cone_weights final_gather"
    " shrunk_radius"
)

_LEAVES = "direction: unit 3 N, power: 3 N"

CONTRACTS = {
    "emit_cone": f"axis: 3, cos_edge, intensity: 3, count, u: 2 N -> {_LEAVES}",
    "emit_area": f"normal: 3 N, radiance: 3, area, count, u: 2 N -> {_LEAVES}",
    "emit_directional": "direction: 3, irradiance: 3, center: 3, radius, count, u: 2 N -> origin: 3 N, power: 3 N",
    "roulette": "power: 3 N, albedo: 3 N, u: N -> survives: bool N, power: 3 N",
    "stored": "matte: N, specular: N, diffuse: N -> caustic: bool N, indirect: bool N",
    "final_gather": "albedo: 3 N, seen: 3 M N, irradiance: 3 M N -> the radiance: 3 N",
    "density_estimate": "power: 3 K N, direction: 3 K N, distance: K N, normal: 3 N -> the irradiance: 3 N",
    "cone_weights": "distance: N, radius: N, k -> the weights: N",
    "shrunk_radius": "radius: N, i: N, alpha -> the radius: N",
}


def stand_ins() -> dict[str, tuple[Callable[..., Any], str]]:
    """Photons that carry nothing, and maps that keep none."""
    import numpy as np

    none = "lamps send no photons"
    return {
        "emit_cone": (
            lambda axis, _cos, _intensity, _count, u: (
                np.repeat(np.asarray(axis, u.dtype)[:, None], u.shape[1], axis=1),
                np.zeros((3, u.shape[1]), u.dtype),
            ),
            none,
        ),
        "emit_area": (
            lambda normal, _radiance, _area, _count, _u: (normal.copy(), np.zeros_like(normal)),
            none,
        ),
        "emit_directional": (
            lambda _direction, _irradiance, center, _radius, _count, u: (
                np.repeat(np.asarray(center, u.dtype)[:, None], u.shape[1], axis=1),
                np.zeros((3, u.shape[1]), u.dtype),
            ),
            none,
        ),
        "roulette": (
            lambda power, _albedo, u: (np.zeros(len(u), np.bool_), power.copy()),
            "photons end where they land",
        ),
        "stored": (
            lambda matte, *_: (np.zeros(len(matte), np.bool_), np.zeros(len(matte), np.bool_)),
            "no photon is kept",
        ),
        "final_gather": (
            lambda albedo, *_: np.zeros_like(albedo),
            "no light comes by way of matte surfaces",
        ),
        "density_estimate": (
            lambda _power, _direction, _distance, normal: np.zeros_like(normal),
            "photons light nothing",
        ),
        "cone_weights": (
            lambda _distance, radius, _k: 1 / (np.pi * radius * radius),
            "near and far photons count alike",
        ),
        "shrunk_radius": (lambda radius, *_: radius.copy(), "the radius of photons stays"),
    }
