"""The thin lens: how a knife edge at five depths is spread, and that the plane in focus is sharp.

An edge at depth d casts the aperture's own shape on the plane in focus, scaled by 1 - f / d: a pixel shows the share
of the aperture from which the edge leaves it free. That share is the area of a disk or a polygon on one side of a
line, in closed form; for edges in several directions it gives away shape, size (the diameter of the circle of
confusion), orientation and uniformity. With n independent samples a pixel is binomial; 5 standard deviations of that
and 10 / n (Bernstein's term for rare events) are exceeded with less than 1e-6 by each of the about 25,000 pixels, and
far less by Sobol points, which are what most pixels use; seeds are fixed.
"""

import dataclasses
import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from course import Scene, render
from course.engine.render.binding import bind
from course.engine.scene.building.cameras import compile_camera
from tests.conftest import MakeScene
from tests.lengths import fewer

Array = NDArray[np.float64]
SIZE = 24
FOCUS = 4.0
RADIUS = 0.3
DEPTHS = [1.5, 2.5, 3.7, 6.0, 12.0]
"""In the plane in focus the circles of confusion are 1, 0.36, 0.05, 0.2 and 0.4 wide; the picture is 1 wide."""


def knife(
    make_scene: MakeScene, depth: float, angle: float, lens: dict[str, Any] | None, sampler: str
) -> Scene:
    """White where x cos(angle) + y sin(angle) < 0 at a depth; the plane in focus shows -1/2 .. 1/2."""
    plate = {"shape": "quad", "material": "white", "width": 40, "depth": 40}
    plate |= {
        "transform": [
            {"rotate": {"axis": [1, 0, 0], "degrees": 90}},
            {"translate": [-20, 0, -depth]},
            {"rotate": {"axis": [0, 0, 1], "degrees": math.degrees(angle)}},
        ]
    }
    return make_scene(
        camera={"eye": [0, 0, 0], "look_at": [0, 0, -1], "lens": lens}
        | {"vertical_fov": math.degrees(2 * math.atan(0.5 / FOCUS))},
        film={"width": SIZE, "height": SIZE},
        sampler={"type": sampler, "samples": 256},
        materials={"white": {"color": 1, "diffuse": 0}},
        objects=[plate],
        lights=[{"type": "ambient", "radiance": 1}],
    )


def outline(shape: str, blades: int) -> Array:
    """(n, 2) corners of an aperture of radius 1, for a disk those of a polygon close to it."""
    if shape == "square":
        return np.array([[1.0, 1], [-1, 1], [-1, -1], [1, -1]])
    n = blades if shape == "polygon" else 1000
    angle = 2 * np.pi * np.arange(n) / n
    return np.stack((np.cos(angle), np.sin(angle)), axis=1)


def share_below(corners: Array, normal: Array, level: Array) -> Array:
    """The share of a convex polygon's area where normal . p < level: each triangle of its fan in closed form."""
    along = corners @ normal
    area, total = np.zeros_like(level), 0.0
    for i in range(1, len(corners) - 1):
        p, q, r = sorted((along[0], along[i], along[i + 1]))
        a, b, c = corners[0], corners[i], corners[i + 1]
        size = abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2
        total += size
        lower = np.clip(level - p, 0, None) ** 2 / max((q - p) * (r - p), 1e-15)
        upper = 1 - np.clip(r - level, 0, None) ** 2 / max((r - q) * (r - p), 1e-15)
        area += size * np.where(level <= q, lower if q > p else 0.0, upper if r > q else 1.0)
    return area / total


def segment(level: Array) -> Array:
    """The same share of a disk of radius 1."""
    s = np.clip(level, -1, 1)
    return np.asarray(0.5 + (np.arcsin(s) + s * np.sqrt(1 - s * s)) / np.pi)


def test_both_closed_forms_agree_on_a_disk() -> None:
    t = np.linspace(-1.2, 1.2, 97)
    polygon = share_below(outline("disk", 0), np.array([0.6, 0.8]), t)
    assert np.allclose(polygon, segment(t), atol=1e-5)


def expected(depth: float, angle: float, shape: str, blades: int) -> Array:
    normal = np.array([math.cos(angle), math.sin(angle)])
    fine = (np.arange(8) + 0.5) / 8
    x = ((np.arange(SIZE)[:, None] + fine) / SIZE - 0.5).ravel()
    on_focus = normal[0] * x[None, :] - normal[1] * x[:, None]
    # From lens point l through the focus plane's P to depth d: l (1 - d / f) + P d / f.
    spread = RADIUS * (1 - depth / FOCUS)
    level = -on_focus * depth / FOCUS / abs(spread)
    if shape == "disk":
        share = segment(level)
    else:
        share = share_below(outline(shape, blades), math.copysign(1, spread) * normal, level)
    return np.asarray(share.reshape(SIZE, 8, SIZE, 8).mean(axis=(1, 3)))


SHAPES = [("disk", 6), ("square", 6), ("polygon", 3), ("polygon", 5), ("polygon", 6)]


@fewer
@pytest.mark.parametrize("depth", DEPTHS)
@pytest.mark.parametrize(("shape", "blades"), SHAPES)
def test_an_edge_is_spread_by_the_aperture(
    make_scene: MakeScene, shape: str, blades: int, depth: float
) -> None:
    lens = {"aperture_radius": RADIUS, "focus_distance": FOCUS, "shape": shape, "blades": blades}
    for number, angle in enumerate((0.0, 0.9, 2.2, 4.1)):
        sampler = "random" if number == 1 else "sobol"
        shown = render(knife(make_scene, depth, angle, lens, sampler)).linear[..., 0]
        p = expected(depth, angle, shape, blades)
        # 8 x 8 points stand for the pixel's own width: where the edge itself is sharp they err by some 1 / 16.
        n, rough = 256, 0.02 if abs(depth - FOCUS) > 1 else 0.07
        assert (
            np.abs(shown - p) < 5 * np.sqrt(p * (1 - p) / n) + 10 / n + rough * (p * (1 - p) > 0)
        ).all()
        # The mean over the blurred pixels is far better known than each: p differs by a thousandth from it.
        soft = (p > 0.02) & (p < 0.98)
        allowed = 5 * 0.5 / math.sqrt(n * soft.sum()) + 1e-3
        assert abs((shown - p)[soft].mean()) < allowed
        # ... and so is what too wide or too narrow an aperture would add on one side and take on the other.
        assert abs(((shown - p) * np.sign(p - 0.5))[soft].mean()) < allowed


@pytest.mark.parametrize("depth", DEPTHS)
def test_the_circle_of_confusion_has_its_diameter(make_scene: MakeScene, depth: float) -> None:
    # A thin white line: where the picture isn't black, the line's own width and a pixel's apart.
    lens = {"aperture_radius": RADIUS, "focus_distance": FOCUS}
    width = 0.002
    line = {"shape": "quad", "material": "white", "width": width, "depth": 40}
    line |= {"transform": [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}]}
    line["transform"].append({"translate": [0, 0, -depth]})
    scene = make_scene(
        camera={"eye": [0, 0, 0], "look_at": [0, 0, -1], "lens": lens}
        | {"vertical_fov": math.degrees(2 * math.atan(0.5 / FOCUS))},
        film={"width": 120, "height": 120},
        sampler={"type": "sobol", "samples": 64},
        materials={"white": {"color": 1, "diffuse": 0}},
        objects=[line],
        lights=[{"type": "ambient", "radiance": 1}],
    )
    lit = np.flatnonzero(render(scene).linear[..., 0].any(axis=0))
    diameter = scene.effects.function("thin_lens", "circle_of_confusion")(
        np.array([depth]), RADIUS, FOCUS
    )[0]
    assert diameter == pytest.approx(2 * RADIUS * abs(FOCUS - depth) / depth)
    across = (lit[-1] + 1 - lit[0]) / 120
    assert across <= diameter + width * FOCUS / depth + 2 / 120
    # 7680 samples a column; the outermost 4 % of the diameter hold 1.3 % of a disk, in which a sample sees the line
    # with a chance of about its width over the column's.
    assert across >= 0.96 * diameter - 2 / 120


@pytest.mark.parametrize("sampler", ["sobol", "random"])
@pytest.mark.parametrize(("shape", "blades"), SHAPES)
def test_rays_leave_all_of_the_aperture_alike(
    make_scene: MakeScene, shape: str, blades: int, sampler: str
) -> None:
    # 16 x 16 cells of the square around the aperture; those wholly inside it hold equal counts. Chi-squared over up to
    # 256 cells is over 450 in 2e-12 of all cases, and Sobol points stay far below.
    lens = {"aperture_radius": RADIUS, "focus_distance": FOCUS, "shape": shape, "blades": blades}
    scene = knife(make_scene, 4, 0.0, lens, sampler)
    settings = scene.settings
    n = 2**16
    u = np.random.default_rng(3).random((2, n), np.float32)
    if sampler == "sobol":
        from course.engine.core.samplers import Block
        from course.engine.terms.samplers import make_sampler

        u = make_sampler("sobol", 3).draw(Block(np.arange(4, dtype=np.uint32), 0, n // 4, 0), 2, 2)
    camera = compile_camera(scene.loaded, scene.compiled.frame, settings.width, settings.height)
    optics = scene.compiled.world.lens
    assert optics is not None
    x, y = np.full((2, n), [[settings.width / 2], [settings.height / 2]], np.float32)
    origins, _ = dataclasses.replace(camera, lens=optics).rays(x, y, u, None)
    frame = scene.compiled.frame
    offset = (origins - camera.origin[:, None]).astype(np.float64) * frame.scale / RADIUS
    x, y = camera.right @ offset, camera.up @ offset
    assert np.abs(camera.forward @ offset).max() < 1e-5
    corners = outline(shape, blades)
    edges = np.roll(corners, -1, axis=0) - corners
    normals = np.stack((edges[:, 1], -edges[:, 0]), axis=1)
    bounds = (normals * corners).sum(axis=1)
    reach = 1e-5 if shape == "polygon" or shape == "square" else 1e-2
    for normal, bound in zip(normals, bounds, strict=True):
        assert (normal[0] * x + normal[1] * y).max() <= bound + reach * np.hypot(*normal)
    count, _, _ = np.histogram2d(x, y, bins=16, range=[[-1, 1], [-1, 1]])
    edge = np.linspace(-1, 1, 17)
    cell = np.stack(np.meshgrid(edge, edge, indexing="ij"))
    at_corner = (np.tensordot(normals, cell, 1) <= bounds[:, None, None] + 1e-9).all(axis=0)
    inside = at_corner[1:, 1:] & at_corner[:-1, 1:] & at_corner[1:, :-1] & at_corner[:-1, :-1]
    a, b = corners, np.roll(corners, -1, axis=0)
    area = np.abs((a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()) / 2
    share = n * (2 / 16) ** 2 / area
    assert inside.sum() >= 32
    assert ((count[inside] - share) ** 2 / share).sum() < 450


@pytest.mark.parametrize(("shape", "blades"), SHAPES)
def test_the_plane_in_focus_is_sharp_to_float32_at_its_corners(
    make_scene: MakeScene, shape: str, blades: int
) -> None:
    lens = {"aperture_radius": 1.5, "focus_distance": 4, "shape": shape, "blades": blades}
    camera_file = {"eye": [0.3, 1, 2], "look_at": [0.1, -0.2, -1], "vertical_fov": 80, "lens": lens}
    scene = make_scene(
        camera=camera_file,
        film={"width": 60, "height": 40},
        objects=[{"shape": "box", "material": "grey", "size": [8, 8, 8]}],
    )
    world, frame = scene.compiled.world, scene.compiled.frame
    assert world.lens is not None
    camera = compile_camera(scene.loaded, frame, 60, 40)
    with_lens = dataclasses.replace(camera, lens=world.lens)
    u = np.random.default_rng(1).random((2, 1000), np.float32)
    forward = camera.forward.astype(np.float64)
    focus = 4 / frame.scale
    for x, y in ((0, 0), (60, 0), (0, 40), (60, 40), (30, 20)):
        place = np.full(1000, x, np.float32), np.full(1000, y, np.float32)
        pinhole = camera.directions(*place)
        origin, direction = with_lens.rays(*place, u, None)
        origin, direction = origin.astype(np.float64), direction.astype(np.float64)
        start = forward @ (origin - camera.origin.astype(np.float64)[:, None])
        met = origin + direction * ((focus - start) / (forward @ direction))
        exact = pinhole[:, :1].astype(np.float64)
        exact = camera.origin.astype(np.float64)[:, None] + exact * focus / (forward @ exact)
        # A unit direction in float32 errs by 6e-8 in each component, over a way of up to 3 here.
        assert np.abs(met - exact).max() < 1e-6
        assert np.ptp(origin, axis=1).max() > 0.3, "from all over the lens"


def test_a_picture_of_the_plane_in_focus_is_that_of_the_pinhole(make_scene: MakeScene) -> None:
    # Stripes that lie in the plane in focus, out to the corners. The pixel's numbers are the same with and without the
    # lens; only samples within rounding of a stripe's edge may see the other side.
    stripe = {"shape": "quad", "material": "white", "width": 0.11, "depth": 30}
    stripes = [
        stripe
        | {
            "transform": [
                {"rotate": {"axis": [1, 0, 0], "degrees": 90}},
                {"translate": [0.231 * k, 0, -FOCUS]},
                {"rotate": {"axis": [0, 0, 1], "degrees": 20}},
            ]
        }
        for k in range(-30, 31)
    ]
    parts: dict[str, Any] = {
        "film": {"width": 64, "height": 48},
        "sampler": {"type": "sobol", "samples": 16},
        "materials": {"white": {"color": 1, "diffuse": 0}},
        "objects": stripes,
        "lights": [{"type": "ambient", "radiance": 1}],
    }
    camera = {"eye": [0, 0, 0], "look_at": [0, 0, -1], "vertical_fov": 70}
    sharp = render(make_scene(**parts, camera=camera)).linear
    for focus in ({"focus_distance": FOCUS}, {"focus_point": [1.3, -0.4, -FOCUS]}):
        lens = {"aperture_radius": 0.8, **focus}
        seen = render(make_scene(**parts, camera=camera | {"lens": lens})).linear
        # Of 49152 samples, some 2e-5 of the picture's width lies that near an edge.
        assert (seen != sharp).any(axis=2).sum() <= 5
        assert np.abs(seen - sharp).max() < 0.1
    out = {"lens": {"aperture_radius": 0.8, "focus_distance": 3}}
    assert (render(make_scene(**parts, camera=camera | out)).linear != sharp).mean() > 0.5


@pytest.mark.parametrize("sideways", [0.0, 1.5, -7.0])
def test_a_focus_point_is_the_distance_of_its_plane(make_scene: MakeScene, sideways: float) -> None:
    ball = {"shape": "sphere", "material": "grey"}
    lamp = {"type": "point", "position": [3, 4, 5], "intensity": 40}
    pictures = []
    for focus in ({"focus_distance": 2.5}, {"focus_point": [sideways, 2 * sideways, 1.5]}):
        camera = {"eye": [0, 0, 4], "look_at": [0, 0, 0]}
        scene = make_scene(
            camera=camera | {"lens": {"aperture_radius": 0.4, **focus}},
            objects=[ball],
            lights=[lamp],
        )
        pictures.append(render(scene).linear)
    assert np.array_equal(*pictures)
    assert pictures[0].any()


def test_the_camera_rays_are_those_of_the_lens(make_scene: MakeScene) -> None:
    # Nobody draws numbers for it twice, and no other ray is cast for it.
    lens = {"aperture_radius": RADIUS, "focus_distance": FOCUS}
    scene = knife(make_scene, 2, 0.0, lens, "sobol")
    receipt = render(scene).receipt
    paths = SIZE * SIZE * 256
    assert receipt.numbers == {"pixel": 2 * paths, "lens": 2 * paths}
    assert receipt.rays == {"camera": paths, "shadow": 0, "reflection": 0, "refraction": 0}
    assert bind(scene, scene.settings).dimensions.first("lens", 0) == 2
