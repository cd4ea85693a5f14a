"""Division by contrast: rays and areas by closed forms, each corner once, and what doesn't go with it."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import CourseError, EffectError, Picture, Scene, load_scene, render
from course.engine.core.tiles import Work
from course.engine.functions.effects import PROJECT, Bound, Effects
from course.engine.render.adaptive.corners import CornerFilm
from course.engine.render.adaptive.subdivision import SubdivisionFunctions, SubdivisionSchedule
from course.engine.render.summary import summarize
from course.engine.render.threads import Pool
from course.engine.scene.scene import Subdivision
from tests.conftest import MakeScene

HEIGHT = 4.0
HALF = math.tan(math.radians(25)) * HEIGHT
"""World units from the middle of the picture to its upper edge, seen from HEIGHT above the ground."""

BEHIND = 0.25
"""Radiance where there is no ground, exact in single precision."""

GLOW = 0.75


def ground(make_scene: MakeScene, size: tuple[int, int], turn: float = 0.0, **parts: Any) -> Scene:
    """A ground of radiance GLOW that begins right of a line through the picture; the rest is BEHIND.

    The line goes through the point 0.3 pixels right of column 2's left side in the middle of the picture, turned by
    some degrees from upright.
    """
    width, height = size
    x = edge_column(size) - width / 2
    far = 100.0
    place = [
        {"translate": [far / 2, 0, 0]},
        {"rotate": {"axis": [0, 1, 0], "degrees": turn}},
        {"translate": [x * 2 * HALF / height, 0, 0]},
    ]
    scene: dict[str, Any] = {
        "camera": {
            "eye": [0, HEIGHT, 0],
            "look_at": [0, 0, 0],
            "up": [0, 0, -1],
            "vertical_fov": 50,
        },
        "film": {"width": width, "height": height, "subdivision": {"threshold": 0.1, "depth": 3}},
        "sampler": {"samples": 1},
        "environment": {"type": "constant", "radiance": BEHIND},
        "materials": {"grey": {"color": 1.0}},
        "lights": [{"type": "ambient", "radiance": GLOW}],
        "objects": [
            {"shape": "quad", "material": "grey", "width": far, "depth": far, "transform": place}
        ],
    }
    return make_scene(**(scene | parts))


def edge_column(_size: tuple[int, int]) -> float:
    """Where the edge crosses the middle row [pixels from the left]."""
    return 2.3


def division(picture: Picture) -> dict[str, float]:
    told = picture.receipt.subdivision
    assert told is not None
    return told


def film(depth: int, threshold: float = 0.1, size: tuple[int, int] = (6, 4)) -> dict[str, Any]:
    return {
        "width": size[0],
        "height": size[1],
        "subdivision": {"threshold": threshold, "depth": depth},
    }


def test_a_flat_picture_takes_the_corners_of_its_pixels_alone(make_scene: MakeScene) -> None:
    picture = render(ground(make_scene, (7, 5), objects=[]))
    assert picture.receipt.rays["camera"] == 8 * 6
    assert division(picture) == {
        "corners": 48,
        "shared": 4 * 35 - 48,
        "lattice": 57 * 41,
        "saved": 1 - 48 / (57 * 41),
    }
    assert (picture.linear == np.float32(BEHIND)).all()
    assert picture.complete


@pytest.mark.parametrize("threshold", [1.0, 1e38, 1e60])
def test_no_contrast_is_over_a_threshold_beyond_all_light(
    make_scene: MakeScene, threshold: float
) -> None:
    """Nor is one that single precision doesn't hold any trouble; of what is as bright as that a contrast is found."""
    picture = render(ground(make_scene, (6, 4), film=film(3, threshold)))
    assert picture.receipt.rays["camera"] == 7 * 5
    bright = np.float32(3e38) * np.array([0, 1, 0, 0], np.float32)
    functions = SubdivisionFunctions(
        Bound(Effects(PROJECT / "solutions")), Subdivision(threshold=threshold, depth=0)
    )
    assert functions.divides(np.tile(bright[:, None], (3, 1, 1))) == (threshold < 3e38)


@pytest.mark.usefixtures("each_form")
@pytest.mark.parametrize("depth", [0, 1, 2, 3, 4, 5])
def test_an_upright_edge_takes_as_many_rays_as_can_be_counted(
    make_scene: MakeScene, depth: int
) -> None:
    # On each level k one column of h 2^(k-1) cells is divided: h 2^k + 1 new corners in its middle, and h 2^(k-1) on
    # each side, for neighbours have the same.
    width, height = 6, 4
    picture = render(ground(make_scene, (width, height), film=film(depth)))
    expected = (width + 1) * (height + 1)
    expected += sum(height * 2 ** (level + 1) + 1 for level in range(1, depth + 1))
    assert picture.receipt.rays["camera"] == expected
    assert division(picture)["corners"] == expected
    assert picture.film.samples.sum() == expected
    # Corners asked for: four of each cell of every level.
    cells = width * height + 4 * sum(height * 2 ** (level - 1) for level in range(1, depth + 1))
    assert division(picture)["shared"] == 4 * cells - expected


@pytest.mark.parametrize("depth", [0, 1, 3, 5])
def test_an_upright_edge_covers_its_area_to_half_a_smallest_cell(
    make_scene: MakeScene, depth: int
) -> None:
    picture = render(ground(make_scene, (6, 4), film=film(depth)))
    share = (picture.linear[:, :, 0] - BEHIND) / (GLOW - BEHIND)
    assert (share[:, :2] == 0).all()
    assert (share[:, 3:] == 1).all()
    assert share[:, 2] == pytest.approx(np.full(4, 0.7), abs=0.5**depth / 2 + 1e-6)
    # The trapezoid's value itself: the cell with the edge counts half.
    steps = 2**depth
    inside = steps - 1 - math.floor(0.3 * steps)
    assert share[:, 2] == pytest.approx(np.full(4, (inside + 0.5) / steps), abs=1e-6)


@pytest.mark.parametrize("turn", [20.0, -35.0])
def test_a_slanted_edge_covers_its_area(make_scene: MakeScene, turn: float) -> None:
    width, height, depth = 6, 4, 5
    picture = render(ground(make_scene, (width, height), turn, film=film(depth)))
    share = (picture.linear[:, :, 0] - BEHIND) / (GLOW - BEHIND)
    # The edge in the picture, y downwards: x = 2.3 + tan(turn) (y - height / 2).
    y = (np.arange(4096 * height) + 0.5) / 4096
    edge = edge_column((width, height)) + math.tan(math.radians(turn)) * (y - height / 2)
    columns = np.arange(width)[:, None]
    covered = np.clip(columns + 1 - edge, 0, 1).reshape(width, height, 4096).mean(axis=2).T
    # An edge crosses fewer than 3 cells for each step along its steeper side; each is off by half its area at most.
    assert np.abs(share - covered).max() < 3 * 2**depth * 0.5 * 4.0**-depth
    # And what a picture without the edge, or a mirrored one, would show is further off.
    assert np.abs(share[::-1] - covered).max() > 0.1


def lit(make_scene: MakeScene, **parts: Any) -> Scene:
    """A ground whose radiance differs from point to point."""
    lamp = {"type": "point", "position": [0.37, 0.9, 0.53], "intensity": 2.0}
    return ground(make_scene, (5, 4), -90.0, lights=[lamp], **parts)


def test_threshold_0_is_the_trapezoidal_rule_on_the_whole_lattice(make_scene: MakeScene) -> None:
    depth = 2
    wide = {"objects": [{"shape": "quad", "material": "grey", "width": 6, "depth": 6}]}
    divided = render(lit(make_scene, film=film(depth, 0.0, (5, 4)), **wide))
    assert division(divided)["corners"] == division(divided)["lattice"] == 21 * 17
    assert division(divided)["saved"] == 0
    # Radiance in closed form, I color / pi cos / r^2 as the renderer has it up to a factor, that of the middle.
    fine = 2**depth
    column, row = np.meshgrid(np.arange(5 * fine + 1) / fine, np.arange(4 * fine + 1) / fine)
    x, z = (column - 2.5) * 2 * HALF / 4, (row - 2.0) * 2 * HALF / 4
    squared = (x - 0.37) ** 2 + 0.9**2 + (z - 0.53) ** 2
    radiance = 0.9 / squared**1.5
    cells = (radiance[:-1, :-1] + radiance[1:, :-1] + radiance[:-1, 1:] + radiance[1:, 1:]) / 4
    expected = cells.reshape(4, fine, 5, fine).mean(axis=(1, 3))
    found = divided.linear[:, :, 0]
    assert found / found.mean() == pytest.approx(expected / expected.mean(), rel=2e-5)


def test_each_corner_is_asked_for_once() -> None:
    # Two pixels side by side, then their like half a pixel further on.
    corners = CornerFilm(3, 1, 1, 1)
    x = np.array([0, 1, 0, 1, 1, 2, 1, 2], np.float32)
    y = np.array([0, 0, 1, 1, 0, 0, 1, 1], np.float32)
    numbers = corners.numbers(x, y)
    first = corners.begin_round(numbers)
    assert sum(item.tile.size for item in first) == 6
    for item in first:
        corners.add(item.tile, np.zeros((3, item.tile.size), np.float32), 1.0, 1, True)
    corners.end_round()
    assert corners.begin_round(numbers) == []
    more = corners.begin_round(corners.numbers(x + np.float32(0.5), y))
    found = np.concatenate([item.tile.corners() for item in more], axis=1)
    assert sorted(map(tuple, found.T.tolist())) == [(a, b) for a in (0.5, 1.5, 2.5) for b in (0, 1)]


def test_the_same_bits_for_any_number_of_threads_and_another_seed_where_light_is_random(
    every_stage: Callable[..., Scene],
) -> None:
    film_of = {"width": 40, "height": 30, "subdivision": {"threshold": 0.05, "depth": 2}}
    scene = every_stage(film=film_of)
    one, three = (render(scene, spp=2, threads=threads, seed=5) for threads in (1, 3))
    assert (one.linear == three.linear).all()
    assert one.receipt.rays == three.receipt.rays
    assert division(one) == division(three)
    assert one.receipt.rays["camera"] == 2 * division(one)["corners"]
    assert "pixel" not in one.receipt.numbers
    assert (render(scene, spp=2, seed=6).linear != one.linear).any()


def test_lens_and_motion_are_sampled_at_each_corner(make_scene: MakeScene) -> None:
    # Many rays through each corner come to what many samples in a pixel come to, since a blurred edge is smooth.
    quad = {"shape": "quad", "material": "grey", "width": 4, "depth": 4}
    thing = quad | {"motion": {"velocity": [1.0, 0, 0]}}
    camera = {
        "eye": [0, HEIGHT, 0],
        "look_at": [0, 0, 0],
        "up": [0, 0, -1],
        "vertical_fov": 50,
        "lens": {"aperture_radius": 0.3, "focus_distance": 6},
        "shutter": {"open": 0, "close": 1},
    }
    parts: dict[str, Any] = {"objects": [thing], "camera": camera}
    divided = render(ground(make_scene, (6, 4), film=film(3, 0.0), **parts), spp=1024)
    plain = render(ground(make_scene, (6, 4), film={"width": 6, "height": 4}, **parts), spp=4096)
    # The quad is upright in the picture, so rows are alike but for noise, of 0.003 in a mean of four or less.
    assert divided.linear.mean(axis=0) == pytest.approx(plain.linear.mean(axis=0), abs=0.008)
    still = render(ground(make_scene, (6, 4), film=film(3, 0.0), objects=[quad]), spp=1)
    assert np.abs(still.linear - divided.linear).max() > 0.1
    assert {"lens", "time"} <= set(divided.receipt.numbers)


@pytest.mark.parametrize(
    ("parts", "options", "told"),
    [
        ({}, {"error": 0.01}, "give one of the two"),
        ({}, {"time_limit": 5.0}, "a lower depth takes less time"),
        ({}, {"sampler": "random"}, "use sobol"),
        ({"sampler": {"type": "jittered", "samples": 4}}, {}, "use sobol"),
        ({"film": film(2) | {"filter": "gaussian"}}, {}, "film.filter must be box"),
    ],
)
def test_what_does_not_go_with_it_is_told_by_line(
    make_scene: MakeScene, parts: dict[str, Any], options: dict[str, Any], told: str
) -> None:
    scene = ground(make_scene, (6, 4), **parts)
    with pytest.raises(CourseError, match=rf"scene.yaml:\d+.*film\.subdivision.*{told}"):
        render(scene, **options)


def test_the_summary_says_where_rays_go(make_scene: MakeScene) -> None:
    told = summarize(ground(make_scene, (6, 4)))
    assert told["scene"]["samples"] == (
        "1 through each corner of a pixel, and of its parts down to 1/8 where corners differ by more than 0.1"
    )
    assert "pixel" not in told["sampled"]
    assert "calls adaptive_sampling.subdivide" in told["effects"]


def test_it_can_not_be_continued(make_scene: MakeScene) -> None:
    scene = ground(make_scene, (6, 4))
    with pytest.raises(CourseError, match="subdivision can't be continued"):
        render(scene, spp=32, start=render(scene, spp=16))


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("needs_subdivision = lambda c, t: c[0, 0] > t", None),
        ("needs_subdivision = lambda c, t: True", "needs_subdivision .* returned"),
        (
            "needs_subdivision = lambda c, t: (c.max((0, 1)) > t) * 1.0",
            "needs_subdivision .* returned",
        ),
        ("subdivide = lambda *sides: sides", "expected 4 arrays|expected float32"),
        (
            "subdivide = lambda x0, y0, x1, y1: tuple(np.tile(s + 0.25, (4, 1)) for s in (x0, y0, x1, y1))",
            "expected an end of the cell or its middle",
        ),
    ],
)
def test_what_functions_return_is_looked_at(
    make_scene: MakeScene, tmp_path: Path, source: str, told: str | None
) -> None:
    folder = tmp_path / "mine"
    folder.mkdir()
    right = (PROJECT / "solutions" / "adaptive_sampling.py").read_text(encoding="utf-8")
    (folder / "adaptive_sampling.py").write_text(f"{right}\n{source}\n", encoding="utf-8")
    scene = ground(make_scene, (6, 4))
    scene = load_scene(scene.path, effects=folder)
    if told is None:
        assert render(scene).complete
        return
    with pytest.raises(EffectError, match=told):
        render(scene)


def test_a_level_that_is_interrupted_leaves_the_one_before() -> None:
    # The first round brings a step between columns, the second is broken off.
    corners = CornerFilm(2, 1, 3, 1)
    functions = SubdivisionFunctions(
        Bound(Effects(PROJECT / "solutions")), Subdivision(threshold=0.1, depth=3)
    )
    rounds = []

    def run(work: list[Work], done: float, after: float) -> bool:
        rounds.append((done, after))
        if len(rounds) > 1:
            return False
        for item in work:
            x, _ = item.tile.corners()
            corners.add(item.tile, np.tile((x > 1).astype(np.float32), (3, 1)), 1.0, 1, True)
        return True

    schedule = SubdivisionSchedule(corners, functions, 3)
    assert not schedule.render(run, Pool(None, 1))  # type: ignore[arg-type]
    assert len(rounds) == 2
    assert corners.linear[0].tolist() == [[0.0, 0.5]]
    assert schedule.receipt()["subdivision"]["corners"] == 6
