"""Area lights against closed forms and quadrature, seen from single points of a floor.

Means are compared as in tests/estimates.py, about 150 of them. Beside their errors stands 1e-4 of the unshadowed value,
for shadow rays leave 2^-19 of the half extent above the floor.
"""

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from tests import estimates
from tests.conftest import MakeScene, PixelRays
from tests.engine.terms.environments import skies
from tests.lengths import fewer

# Both forms where a light is half hidden and where it is a grid: tests/transport/test_shadow_kernels.py holds compiled
# loops to the same bits for the points of every kind of light.
each_form = pytest.mark.usefixtures("each_form")

Array = NDArray[np.float64]
FLOOR = {"shape": "quad", "material": "white", "width": 6, "depth": 6}


def at_point(make_scene: MakeScene, x: float, light: Any, *objects: dict[str, Any]) -> Scene:
    """Looks at (x, 0, 0) of a floor that reflects all of its irradiance as radiance E / pi."""
    return make_scene(
        camera={"eye": [x + 0.01, 0.05, 0.2], "look_at": [x, 0, 0], "vertical_fov": 1e-3},
        film={"width": 16, "height": 16},
        objects=[FLOOR, *objects],
        lights=light if isinstance(light, list) else [light],
        materials={"white": {"color": 1}, "black": {"color": 0}},
    )


def estimate(scene: Scene, samples: int = 64) -> tuple[float, float]:
    """Irradiance and 5 of its standard errors."""
    mean, tolerance = estimates.estimate(scene, samples)
    return float(np.pi * mean[0]), float(np.pi * tolerance[0])


def lambert(corners: Array) -> float:
    """Irradiance at the origin, normal +y, of a polygon of radiance 1; what of it is below the horizon is dark."""
    return math.pi * skies.form_factor(corners, np.array([0.0, 1.0, 0.0]))


def from_points(points: Array) -> Array:
    """The cos / d^2 of point lights of intensity 1 at points (..., 3), at the origin with normal +y; 0 below."""
    return np.asarray(np.maximum(points[..., 1], 0) / np.linalg.norm(points, axis=-1) ** 3)


# The half-plane x < 0 at a height of 0.5, under a light at a height of 2.
BLOCKER = {"shape": "quad", "material": "black", "width": 40, "depth": 80} | {
    "transform": [{"translate": [-20, 0.5, 0]}]
}
TOP, EDGE = 2.0, 0.5
A, B = 0.6, 0.45
LAMP = {"type": "rectangle", "corner": [-A, TOP, -B], "edge_u": [2 * A, 0, 0]} | {
    "edge_v": [0, 0, 2 * B]
}
# Seen from (x, 0, 0) the edge covers what of the light has x below -x (TOP - EDGE) / EDGE = -3 x.
ACROSS = [-0.25, -0.12, -0.03, 0.06, 0.17, 0.25]


@each_form
@pytest.mark.parametrize("x", ACROSS)
def test_the_penumbra_of_a_half_plane_before_a_rectangle_by_radiance(
    make_scene: MakeScene, x: float
) -> None:
    mean, tolerance = estimate(at_point(make_scene, x, LAMP | {"radiance": 3}, BLOCKER))
    first = max(-A, -3 * x)
    corners = np.array([[first, TOP, -B], [A, TOP, -B], [A, TOP, B], [first, TOP, B]])
    # Where all of it is covered nothing is left.
    exact = 3 * lambert(corners - [x, 0, 0]) if first < A else 0.0
    whole = 3 * lambert(np.array([[-A, TOP, -B], [A, TOP, -B], [A, TOP, B], [-A, TOP, B]]))
    assert abs(mean - exact) <= tolerance + 1e-4 * whole
    assert tolerance < 0.02 * whole, "the estimate is worth something"


@fewer
@pytest.mark.parametrize("samples", ["point", "grid 12"])
@pytest.mark.parametrize("x", ACROSS)
def test_the_penumbra_of_a_half_plane_before_a_rectangle_by_intensity(
    make_scene: MakeScene, x: float, samples: str
) -> None:
    light = LAMP | {"intensity": 5, "samples": samples}
    mean, tolerance = estimate(at_point(make_scene, x, light, BLOCKER))
    first = max(-A, -3 * x) if samples == "point" else -A
    # The lit part of the lamp is divided into cells; a grid has its own.
    k = 300 if samples == "point" else 12
    s = (np.arange(k) + 0.5) / k
    xs, zs = first + s * (A - first), B * (2 * s - 1)
    points = np.stack(np.broadcast_arrays(xs[:, None], TOP, zs), axis=-1)
    lit = max(A - first, 0) / (2 * A)
    value = lit * from_points(points - [x, 0, 0])
    exact = 5 * (value * (points[..., 0] > -3 * x)).mean()
    assert abs(mean - exact) <= tolerance + 1e-4 * 5 * from_points(np.array([-x, TOP, 0]))


@each_form
@pytest.mark.parametrize("x", ACROSS)
def test_the_penumbra_of_a_half_plane_before_a_disk_is_a_segment_of_it(
    make_scene: MakeScene, x: float
) -> None:
    radius = 0.5
    light = {"type": "sphere", "center": [0, TOP, 0], "radius": radius, "intensity": 5}
    mean, tolerance = estimate(
        at_point(make_scene, x, light | {"samples": "facing disk"}, BLOCKER), 256
    )
    # The disk's own axes: one at right angles to the line of sight in the plane of x and y, one along z. The plane
    # through the point and the edge cuts it along z, at the chord where it meets the line from (x, 0) to the edge.
    centre = np.array([-x, TOP])
    length = np.linalg.norm(centre)
    axis = np.array([centre[1], -centre[0]]) / length
    edge = np.array([-x, EDGE])
    # centre + s axis parallel to edge
    chord = (centre[1] * edge[0] - centre[0] * edge[1]) / (axis[0] * edge[1] - axis[1] * edge[0])
    s = np.linspace(-1, 1, 4001)[1::2] * radius
    half = np.sqrt(radius**2 - s**2)
    across = (np.arange(200) + 0.5) / 200 * 2 - 1
    xy = centre + s[:, None] * axis
    points = np.empty((len(s), len(across), 3))
    points[..., 0], points[..., 1] = xy[:, :1], xy[:, 1:]
    points[..., 2] = half[:, None] * across
    weight = half / half.sum()
    value = from_points(points).mean(axis=1)
    exact = 5 * (value * weight * (s > chord)).sum()
    whole = 5 * (value * weight).sum()
    assert abs(mean - exact) <= tolerance + 2e-3 * whole
    # In closed form: the share of the disk's area beyond the chord, but for the change of cos / d^2 over it.
    t = min(max(chord / radius, -1), 1)
    share = 0.5 - (math.asin(t) + t * math.sqrt(1 - t * t)) / math.pi
    change = (value.max() - value.min()) / value.mean()
    assert abs(mean / whole - share) <= tolerance / whole + change * min(share, 1 - share) + 2e-3


RECTANGLES = pytest.mark.parametrize(
    ("corner", "u", "v"),
    [
        ([-0.7, 1.1, -0.4], [1.2, 0, 0.1], [0.2, 0.3, 0.9]),
        ([0.8, 0.2, -0.6], [0, 0, 1.1], [0.3, 1.0, 0]),
        # Half of it is below the floor's horizon.
        ([0.9, -0.5, -0.6], [0, 0, 1.1], [0.1, 1.3, 0]),
        # Large and near.
        ([-3.0, 0.4, -3.0], [6, 0, 0], [0, 0, 6]),
    ],
)


@fewer
@pytest.mark.parametrize("samples", ["point", "grid 40"])
@RECTANGLES
def test_an_unoccluded_rectangle_by_radiance_is_lamberts_polygon(
    make_scene: MakeScene, corner: list[float], u: list[float], v: list[float], samples: str
) -> None:
    p, a, b = (np.array(x, float) for x in (corner, u, v))
    if np.cross(a, b) @ -(p + a / 2 + b / 2) < 0:
        a, b = b, a
    light = {"type": "rectangle", "corner": p.tolist(), "radiance": 2, "samples": samples}
    edges, back = (
        {"edge_u": first.tolist(), "edge_v": second.tolist()} for first, second in ((a, b), (b, a))
    )
    many = 256 if samples == "point" else 1
    mean, tolerance = estimate(at_point(make_scene, 0, light | edges), many)
    exact = 2 * lambert(np.stack((p, p + a, p + a + b, p + b)))
    # The midpoint rule errs by the second derivative times the cell squared: under 1 % with 40 cells, and a row of
    # cells on the horizon is nearly dark.
    assert tolerance < 0.05 * exact, "the estimate is worth something"
    assert abs(mean - exact) <= tolerance + (1e-2 if samples != "point" else 1e-4) * exact
    assert not render(at_point(make_scene, 0, light | back), spp=1).linear.any(), "from behind"


@RECTANGLES
def test_an_unoccluded_rectangle_by_intensity_is_the_mean_of_its_point_lights(
    make_scene: MakeScene, corner: list[float], u: list[float], v: list[float]
) -> None:
    light = {"type": "rectangle", "corner": corner, "edge_u": u, "edge_v": v, "intensity": 2}
    mean, tolerance = estimate(at_point(make_scene, 0, light), 256)
    s = ((np.arange(400) + 0.5) / 400)[:, None]
    points = np.array(corner) + s[:, None] * np.array(u) + s * np.array(v)
    exact = 2 * from_points(points).mean()
    assert abs(mean - exact) <= tolerance + 2e-4 * exact


@fewer
@pytest.mark.parametrize(
    ("center", "radius"),
    [
        ([0.3, 1.2, -0.4], 0.5),
        ([1.5, 0.1, 0.2], 0.4),
        ([0.6, -0.05, 0.5], 0.3),
        ([0, 1.0, 0], 0.8),
        # Not larger than a float32 step of its centre.
        ([0.3, 1.2, -0.4], 1e-7),
    ],
)
@pytest.mark.parametrize("samples", ["sphere", "sphere by polar", "visible"])
def test_an_unoccluded_sphere_by_radiance_is_its_cone_of_directions(
    make_scene: MakeScene, center: list[float], radius: float, samples: str
) -> None:
    light = {"type": "sphere", "center": center, "radius": radius, "radiance": 2}
    light["samples"] = samples
    mean, tolerance = estimate(at_point(make_scene, 0, light), 1024)
    c = np.array(center)
    length = np.linalg.norm(c)
    sine = radius / length
    # The integral of max(cos, 0) over the cone; the axis has the height y, and pi sin^2 y is all of it above the floor.
    y = c[1] / length
    # Equal solid angles in rings and sectors.
    height_of_cap = -math.expm1(0.5 * math.log1p(-(sine**2)))
    cos = 1 - height_of_cap * (np.arange(1000) + 0.5) / 1000
    phi = 2 * np.pi * (np.arange(1000) + 0.5) / 1000
    height = cos[:, None] * y + np.sqrt(1 - cos[:, None] ** 2) * np.cos(phi) * math.sqrt(1 - y * y)
    exact = 2 * np.maximum(height, 0).mean() * 2 * np.pi * height_of_cap
    if y > sine:
        assert exact == pytest.approx(2 * np.pi * sine**2 * y, rel=1e-5)
    assert tolerance < 0.1 * exact, "the estimate is worth something"
    assert abs(mean - exact) <= tolerance + 1e-4 * exact


@pytest.mark.parametrize("blocked", [False, True])
def test_the_visible_part_of_a_sphere_says_the_same_as_all_of_it_with_less_noise(
    make_scene: MakeScene, blocked: bool
) -> None:
    """Far from a lamp its cone is narrow and the cosine at the surface all but even: without a blocker nothing varies.

    With one both estimate a visibility. Two means of 256 pixels are within 6 standard errors of their difference but
    for one in 1e8.
    """
    found = {}
    for samples in ("sphere", "visible"):
        light = {"type": "sphere", "center": [0.2, 2, 0], "radius": 0.4, "radiance": 3}
        scene = at_point(make_scene, 0.1, light | {"samples": samples}, *[BLOCKER] * blocked)
        pixels = render(scene, spp=16, sampler="random").linear[..., 0].astype(float)
        found[samples] = pixels.mean(), pixels.var(ddof=1)
    (a, a_variance), (b, b_variance) = found["sphere"], found["visible"]
    assert b > 0
    assert abs(a - b) < 6 * math.sqrt((a_variance + b_variance) / 256)
    assert b_variance < (0.9 if blocked else 0.01) * a_variance


def cloud(method: str, c: Array, radius: float) -> Array:
    """Points that stand for equal shares of a sphere light, (..., 3); on a disk 200 x 200 cells of equal area."""
    r = np.sqrt((np.arange(200) + 0.5) / 200)[:, None]
    phi = 2 * np.pi * (np.arange(200) + 0.5) / 200
    a, b = r * np.cos(phi), r * np.sin(phi)
    if method == "facing disk":
        w = c / np.linalg.norm(c)
        e1 = np.cross(w, [0.0, 1.0, 0.3])
        e1 /= np.linalg.norm(e1)
        e2 = np.cross(w, e1)
        return c + radius * (a[..., None] * e1 + b[..., None] * e2)
    # Archimedes: equal areas of the disk, 1 - 2 r^2 as height, are equal areas of the sphere.
    squared = a * a + b * b
    z = 1 - 2 * squared
    ring = 2 * np.sqrt(1 - squared)
    sphere = np.stack((a * ring, b * ring, z), axis=-1)
    if method.startswith("sphere"):
        return c + radius * sphere
    shells = np.cbrt((np.arange(16) + 0.5) / 16)
    return c + radius * shells[:, None, None, None] * sphere


@fewer
@pytest.mark.parametrize(
    "method",
    ["sphere", "ball", "facing disk", "sphere by polar", "ball by polar", "ball by rejection"],
)
@pytest.mark.parametrize(
    ("center", "radius"), [([0.3, 1.2, -0.4], 0.5), ([1.5, 0.6, 0.2], 0.5), ([0.5, 0.1, 0.4], 0.4)]
)
def test_a_sphere_by_intensity_is_the_mean_of_its_point_lights(
    make_scene: MakeScene, method: str, center: list[float], radius: float
) -> None:
    light = {"type": "sphere", "center": center, "radius": radius, "samples": method}
    mean, tolerance = estimate(at_point(make_scene, 0, light | {"intensity": 4}), 1024)
    exact = 4 * from_points(cloud(method, np.array(center), radius)).mean()
    assert tolerance < 0.05 * exact, "the estimate is worth something"
    assert abs(mean - exact) <= tolerance + 1e-3 * exact


@fewer
@pytest.mark.parametrize("method", ["sphere", "ball", "sphere by polar", "ball by polar"])
@pytest.mark.parametrize("x", ACROSS)
def test_the_penumbra_of_a_half_plane_before_a_ball_is_a_cap_of_it(
    make_scene: MakeScene, x: float, method: str
) -> None:
    radius = 0.5
    light = {"type": "sphere", "center": [0, TOP, 0], "radius": radius, "samples": method}
    mean, tolerance = estimate(at_point(make_scene, x, light | {"intensity": 5}, BLOCKER), 256)
    points = cloud(method, np.array([-x, TOP, 0]), radius)
    value = from_points(points)
    # The plane through the point and the edge cuts it along z; seen from (x, 0, 0) the edge is at (-x, EDGE).
    across = np.array([EDGE, x]) / math.hypot(EDGE, x)
    exact = 5 * (value * (points[..., :2] @ across > 0)).mean()
    whole = 5 * value.mean()
    # The plane cuts cells of the quadrature: of 200 around the axis two in each ring.
    assert abs(mean - exact) <= tolerance + 4e-3 * whole
    # In closed form, but for the change of cos / d^2: the plane is at h radii from the middle.
    h = -float(np.array([-x, TOP]) @ across) / radius
    t = min(max(h, -1), 1)
    share = (1 - t) / 2 if method.startswith("sphere") else (1 - t) ** 2 * (2 + t) / 4
    change = (value.max() - value.min()) / value.mean()
    assert abs(mean / whole - share) <= tolerance / whole + change * min(share, 1 - share) + 4e-3


def test_the_methods_of_a_sphere_differ() -> None:
    # Or else the test above could not tell them apart.
    center, radius = np.array([0.3, 1.2, -0.4]), 0.9
    values = [
        from_points(cloud(m, center, radius)).mean() for m in ("sphere", "ball", "facing disk")
    ]
    assert np.ptp(values) > 0.05 * min(values)


@each_form
@pytest.mark.parametrize("kind", ["intensity", "radiance"])
@pytest.mark.parametrize("k", [1, 2, 5])
def test_a_grid_is_the_sum_of_its_point_lights(
    make_scene: MakeScene, pixel_rays: PixelRays, k: int, kind: str
) -> None:
    corner, u, v = np.array([-1.0, 2, 0.3]), np.array([1.1, 0, 0.4]), np.array([-0.2, 0.3, 0.8])
    assert np.cross(u, v)[1] < 0, "it looks down"
    grid = {"type": "rectangle", "corner": corner.tolist(), "edge_u": u.tolist()} | {
        "edge_v": v.tolist(),
        "samples": f"grid {k}",
    }
    cells = [corner + u * (i + 0.5) / k + v * (j + 0.5) / k for i in range(k) for j in range(k)]
    ball = {"shape": "sphere", "material": "grey", "radius": 0.4} | {
        "transform": [{"translate": [0, 0.6, 0.3]}]
    }
    parts: dict[str, Any] = {
        "camera": {"eye": [0, 2, 4], "look_at": [0, 0.3, 0]},
        "film": {"width": 48, "height": 36},
        "sampler": {"type": "regular", "samples": 1},
        "objects": [FLOOR | {"material": "grey"}, ball],
        "materials": {"grey": {"specular": 0.4, "exponent": 20}},
    }
    if kind == "intensity":
        shown = render(make_scene(**parts, lights=[grid | {"intensity": [6, 3, 1]}])).linear
        points = [
            {"type": "point", "position": c.tolist(), "intensity": [6 / k**2, 3 / k**2, 1 / k**2]}
            for c in cells
        ]
        expected = render(make_scene(**parts, lights=points)).linear
        assert expected.max() > 0.1
        # Positions are rounded differently: a pixel on one of the k^2 shadows' edges may fall to its other side.
        different = (np.abs(shown - expected) > 1e-5 * expected.max()).any(axis=2)
        assert different.sum() <= k * k
        return
    # By radiance each cell is a Lambertian patch: radiance times area over k^2, times the cosine; without shadows.
    parts["objects"] = [FLOOR]
    parts["materials"] = {"white": {"color": 1}}
    parts["camera"] = {"eye": [0.4, 1.5, 1.5], "look_at": [0, 0, -0.2], "vertical_fov": 30}
    scene = make_scene(**parts, lights=[grid | {"radiance": 2}])
    shown = render(scene).linear[..., 0]
    eye, d = pixel_rays(scene)
    p = eye[:, None, None] - d * (eye[1] / d[1])
    normal = np.cross(u, v)
    total = np.zeros(p.shape[1:])
    for c in cells:
        to_light = c[:, None, None] - p
        d = np.linalg.norm(to_light, axis=0)
        emitted = np.maximum(-np.tensordot(normal, to_light, 1) / d, 0)
        total += 2 / k**2 * emitted * to_light[1] / d**3 / np.pi
    assert total.max() > 0.05
    assert np.allclose(shown, total, rtol=1e-4)
