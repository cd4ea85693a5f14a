"""The approximate Fresnel reflectance of metals, by arithmetic with complex numbers in float64."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from course import Scene, render
from course.engine.terms.scattering.conductors import approximate_reflectance

MakeScene = Callable[..., Scene]
N, K = (0.37, 2.82, 0.0), (2.82, 1.1, 1.5)


def straight_down(cos_i: float, n: float, k: float) -> float:
    """Fresnel's equations as if the refracted ray went straight down, with the complex index n + i k."""
    index = complex(n, k)
    s = abs((cos_i - index) / (cos_i + index)) ** 2
    p = abs((1 / cos_i - index) / (1 / cos_i + index)) ** 2
    return (s + p) / 2


@pytest.mark.parametrize("kind", ["distribution", "path"])
@pytest.mark.parametrize("degrees", [0, 40, 70, 85])
def test_a_plate_mirrors_a_white_sky_by_it(
    make_scene: MakeScene, degrees: float, kind: str, compiled: bool
) -> None:
    angle = math.radians(degrees)
    metal = {"refraction_index": N, "absorption_index": K}
    exact = {"color": 0, "mirror": [1, 0.5, 1], "conductor": metal}
    plate = exact | {"conductor": metal | {"fresnel": "approximate"}}

    def picture(material: str) -> np.ndarray:
        scene = make_scene(
            camera={
                "eye": [0, 2 * math.cos(angle), 2 * math.sin(angle)],
                "look_at": [0, 0, 0],
                "up": [1, 0, 0],
                "vertical_fov": 1e-4,
            },
            film={"width": 8, "height": 8},
            environment={"type": "constant", "radiance": 1},
            # The tables hold both.
            materials={"exact": exact, "plate": plate},
            objects=[
                {"shape": "quad", "material": material, "width": 9, "depth": 9},
                {"shape": "quad", "material": "exact", "transform": [{"translate": [0, -1, 0]}]},
                {"shape": "quad", "material": "plate", "transform": [{"translate": [0, -1, 0]}]},
            ],
            integrator={"type": kind, "max_depth": 1},
        )
        return np.asarray(render(scene, compiled=compiled).linear, float)

    cosine = math.cos(angle)
    expected = [m * straight_down(cosine, n, k) for m, n, k in zip((1, 0.5, 1), N, K, strict=True)]
    got = picture("plate")
    # A path that has one way takes it, so there is no noise.
    np.testing.assert_allclose(got, np.broadcast_to(expected, got.shape), rtol=3e-5)
    assert np.allclose(picture("exact"), expected, rtol=3e-5) == (degrees == 0)


@pytest.mark.parametrize(("n", "k"), [(0, 0), (1, 0), (0, 3), (1e8, 1e8), (0.2, 4)])
def test_it_is_a_share_at_every_angle_and_1_at_grazing_incidence(n: float, k: float) -> None:
    cos_i = np.array([0, 1e-20, 1e-6, 0.3, 1, 1.0000001], np.float32)
    columns = (np.full((3, len(cos_i)), value, np.float32) for value in (n, k))
    got = approximate_reflectance(cos_i, *columns)
    assert np.isfinite(got).all()
    assert ((got >= 0) & (got <= 1)).all()
    np.testing.assert_allclose(got[:, 0], 1)
