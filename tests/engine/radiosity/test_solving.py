"""Radiosities against closed forms: parallel plates, a sphere's inside, and the bound of what is left."""

import math
from collections.abc import Callable
from typing import Literal

import numpy as np
import pytest

from course.base.errors import FunctionError, SceneError
from course.engine.core.types import Floats32
from course.engine.functions.effects import PROJECT, Effects
from course.engine.radiosity.corners import at_corners
from course.engine.radiosity.hemicubes import Views, make_hemicube
from course.engine.radiosity.patches import Patches, RadiosityFunctions, make_patches
from course.engine.radiosity.radiosity import chosen_patches, solve, solve_patches
from course.engine.radiosity.solving import Shooting, Solved, form_factors, gathered, with_ambient
from course.engine.scene.scene import load_scene
from tests.conftest import MakeScene
from tests.engine.radiosity.rooms import FUNCTIONS, between_plates, hollow_sphere, plates

BOX = PROJECT / "scenes" / "radiosity.yaml"


def mean(values: np.ndarray, areas: np.ndarray) -> float:
    return float((values * areas).sum() / areas.sum())


def solved_by(method: str, patches: Patches) -> Solved:
    if method == "gather":
        return gathered(patches, FUNCTIONS, 1e-4, None, rays=8_000_000)
    shooting = Shooting(patches, FUNCTIONS, lamp_rays=5_000_000)
    shooting.run(1e-4)
    return shooting.solved


# ---------------------------------------------------------------- form factors


def test_the_catalogue_knows_two_squares() -> None:
    assert between_plates(1.0) == pytest.approx(0.199825, abs=1e-6)
    assert between_plates(1e-4) == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize("distance", [0.5, 1.0, 2.0])
def test_hemicubes_see_a_plate_by_its_form_factor(make_scene: MakeScene, distance: float) -> None:
    patches = make_patches(make_scene(**plates(0.5, distance=distance)), 200)
    views, lamps, areas = Views(patches), patches.lamps, patches.triangles.areas()
    factors = form_factors(views, make_hemicube(96, FUNCTIONS), 2 * patches.size)
    fronts = factors[: patches.size, : patches.size]
    for here, there in ((lamps, ~lamps), (~lamps, lamps)):
        shares = fronts[np.ix_(here, there)].sum(axis=1)
        assert mean(shares, areas[here]) == pytest.approx(between_plates(distance), rel=0.02)
    # Fronts see fronts only, and the backs see nothing of each other.
    assert factors[: patches.size, patches.size :].sum() == 0
    assert factors[patches.size :].sum() == 0


def test_in_a_sphere_every_patch_sees_the_others_by_their_areas() -> None:
    """F[i, j] = A_j / (4 pi R^2), wherever i and j are."""
    sphere = hollow_sphere(48, 1, 0.5)
    views, areas = Views(sphere), sphere.triangles.areas()
    hemicube = make_hemicube(128, FUNCTIONS)
    for i in (0, 700, 1333):
        row = views.row(views.look(np.array([i]), hemicube)[0], hemicube)
        assert row.sum() == pytest.approx(1, abs=1e-6)
        assert row[sphere.size :].sum() == 0
        # In eight parts of the sphere, for a patch alone has few cells.
        centre = sphere.triangles.vertices[sphere.triangles.corners].mean(axis=1)
        part = (centre > 0) @ np.array([1, 2, 4])
        seen = np.bincount(part, row[: sphere.size], 8)
        assert np.allclose(seen, np.bincount(part, areas, 8) / areas.sum(), rtol=0.05)


def test_the_same_from_behind() -> None:
    """A sphere whose fronts look outwards has all its light on its backs."""
    sphere = hollow_sphere(16, 1, 0.5)
    corners = np.ascontiguousarray(sphere.triangles.corners[:, ::-1])
    turned = Patches(
        type(sphere.triangles)(sphere.triangles.vertices, corners, sphere.triangles.origin),
        sphere.reflectance,
        sphere.emission,
        sphere.surface,
    )
    views, hemicube = Views(turned), make_hemicube(32, FUNCTIONS)
    row = views.row(views.look(np.array([turned.size + 5]), hemicube)[0], hemicube)
    assert row[turned.size :].sum() == pytest.approx(1, abs=1e-6)
    assert row[turned.size + 5] == 0
    outside = views.row(views.look(np.array([5]), hemicube)[0], hemicube)
    assert outside.sum() == 0


# ---------------------------------------------------------------- solutions


@pytest.mark.parametrize("method", ["gather", "shoot"])
def test_a_plate_under_a_lamp_is_as_bright_as_its_form_factor_says(
    make_scene: MakeScene, method: str
) -> None:
    """B = rho F pi L on average, for nothing comes back from the lamp."""
    patches = make_patches(make_scene(**plates(0.6, radiance=2.0)), 300)
    solved = solved_by(method, patches)
    plate, areas = ~patches.lamps, patches.triangles.areas()
    found = mean(solved.radiosity[0, : patches.size][plate], areas[plate])
    assert found == pytest.approx(0.6 * between_plates(1.0) * math.pi * 2, rel=0.01)


@pytest.mark.parametrize("method", ["gather", "shoot"])
def test_a_plate_that_glows_lights_another_as_a_lamp_does(
    make_scene: MakeScene, method: str
) -> None:
    """Down with its back, and up with its front, where nothing is."""
    room = plates(0.6)
    panel = {"shape": "quad", "material": "panel", "transform": [{"translate": [0, 1, 0]}]}
    scene = make_scene(
        camera=room["camera"],
        materials=room["materials"] | {"panel": {"color": 0, "emission": 2}},
        objects=[*room["objects"], panel],
    )
    patches = make_patches(scene, 300)
    solved = solved_by(method, patches)
    plate, areas = ~patches.lamps, patches.triangles.areas()
    fronts, backs = solved.radiosity[0, : patches.size], solved.radiosity[0, patches.size :]
    found = mean(fronts[plate], areas[plate])
    assert found == pytest.approx(0.6 * between_plates(1.0) * math.pi * 2, rel=0.01)
    assert np.allclose(fronts[~plate], 2 * math.pi, rtol=1e-6)
    assert np.allclose(backs[~plate], 2 * math.pi, rtol=1e-6)


def test_a_glowing_room_is_a_furnace(make_scene: MakeScene) -> None:
    """Inside a box B = pi L / (1 - rho) everywhere, as its backs see nothing but each other; outside pi L."""
    scene = make_scene(
        camera={"eye": [0.1, 0.1, 0], "look_at": [1, 0, 0]},
        materials={"m": {"color": 0.5, "emission": [1, 2, 0]}},
        objects=[{"shape": "box", "material": "m", "size": [2, 2, 2]}],
    )
    patches = make_patches(scene, 100)
    solved = gathered(patches, FUNCTIONS, 1e-5, None, rays=2_000_000)
    light = math.pi * np.array([[1], [2], [0]])
    assert np.allclose(solved.radiosity[:, : patches.size], light, rtol=1e-5)
    assert np.allclose(solved.radiosity[:, patches.size :], light / (1 - 0.5), rtol=1e-4)


@pytest.mark.parametrize("reflectance", [0.0, 0.5, 0.8])
def test_the_inside_of_a_sphere_is_evenly_bright(reflectance: float) -> None:
    """B = E / (1 - rho)."""
    sphere = hollow_sphere(16, 2.0, reflectance)
    solved = gathered(sphere, FUNCTIONS, 1e-5, None, rays=2_000_000)
    inside = solved.radiosity[:, : sphere.size]
    assert np.allclose(inside, 2 / (1 - reflectance), rtol=2e-5)
    assert (solved.radiosity[:, sphere.size :] == 0).all()
    shooting = Shooting(sphere, FUNCTIONS, lamp_rays=3_000_000)
    shooting.run(1e-3)
    bright = shooting.radiosity[0, : sphere.size]
    # What one patch loses to the others by its hemicubes' grids, the others have.
    areas = sphere.triangles.areas()
    assert mean(bright, areas) == pytest.approx(2 / (1 - reflectance), rel=1e-3)
    assert bright.std() <= 0.05 * bright.mean()


def test_shooting_and_gathering_agree() -> None:
    """Their hemicubes are different ones, so they do to the hemicubes' accuracy."""
    patches = make_patches(load_scene(BOX), 500)
    a = gathered(patches, FUNCTIONS, 1e-3, None, rays=8_000_000).radiosity[:, : patches.size]
    shooting = Shooting(patches, FUNCTIONS, lamp_rays=5_000_000)
    shooting.run(1e-3)
    b = shooting.radiosity[:, : patches.size]
    areas = np.where(patches.lamps, 0, patches.triangles.areas())
    for channel in range(3):
        off = np.abs(a[channel] - b[channel])
        assert mean(off, areas) <= 0.08 * mean(a[channel], areas)
        assert mean(a[channel], areas) == pytest.approx(mean(b[channel], areas), rel=0.02)


def test_what_is_left_bounds_the_distance_to_the_limit() -> None:
    """The box of 10,000 patches to 1% in small: bound after bound, against a solution a hundred times nearer."""
    patches = make_patches(load_scene(BOX), 400)
    areas = np.concatenate([patches.triangles.areas()] * 2)
    final = Shooting(patches, FUNCTIONS, lamp_rays=5_000_000)
    final.run(1e-4)
    shooting = Shooting(patches, FUNCTIONS, lamp_rays=5_000_000)
    for tolerance in (0.3, 0.1, 0.03, 0.01):
        shooting.run(tolerance)
        assert shooting.left <= tolerance
        missing = (final.radiosity - shooting.radiosity) @ areas
        # Whatever is shot later is added; 1e-5 is for single precision.
        assert (missing >= -1e-5).all()
        assert (missing <= shooting.left * (shooting.radiosity @ areas) + 1e-5).all()
    assert (missing >= 0.02 * tolerance * (shooting.radiosity @ areas)).any()


def test_no_light_is_made_or_lost_in_a_closed_room() -> None:
    """What lamps emit is what surfaces absorb."""
    sphere = hollow_sphere(16, 1.0, 0.6)
    shooting = Shooting(sphere, FUNCTIONS, lamp_rays=3_000_000)
    shooting.run(1e-4)
    areas = np.concatenate([sphere.triangles.areas()] * 2)
    emitted = areas[: sphere.size].sum()
    arrived = (shooting.radiosity[0] - sphere.both(sphere.emission, 0 * sphere.emission)[0]) / 0.6
    assert (0.4 * arrived) @ areas == pytest.approx(emitted, rel=1e-3)


def test_shots_end_when_asked_and_the_brightest_comes_first() -> None:
    patches = make_patches(load_scene(BOX), 600)
    shooting = Shooting(patches, FUNCTIONS, lamp_rays=5_000_000)
    lamps = int(patches.lamps.sum())
    shooting.run(0, most=lamps)
    assert shooting.steps == lamps
    assert (shooting.unshot[:, : patches.size][:, patches.lamps] == 0).all()
    areas = np.concatenate([patches.triangles.areas()] * 2)
    power = (shooting.unshot * areas).sum()
    brightest = int((shooting.unshot * areas).sum(axis=0).argmax())
    shooting.run(0, most=lamps + 1)
    assert shooting.steps == lamps + 1
    assert (shooting.unshot[:, brightest] == 0).all()
    after = (shooting.unshot * areas).sum()
    assert after < power


def test_the_ambient_term_tells_what_the_limit_will_be() -> None:
    """In a sphere it is exact: what is unshot comes to all patches alike."""
    sphere = hollow_sphere(16, 1.0, 0.5)
    shooting = Shooting(sphere, FUNCTIONS, lamp_rays=3_000_000)
    front, areas = slice(0, sphere.size), sphere.triangles.areas()
    for shots in (0, 200):
        shooting.run(0, most=shots)
        light = with_ambient(sphere, shooting.radiosity, shooting.unshot)
        assert mean(light[0, front], areas) == pytest.approx(2, rel=1e-3)
        assert (light[:, sphere.size :] == 0).all()
    some = np.arange(2 * sphere.size) < 100
    light = with_ambient(sphere, shooting.radiosity, shooting.unshot, some)
    assert (light[:, 100:] == shooting.radiosity[:, 100:]).all()
    assert (light[:, :100] > shooting.radiosity[:, :100]).all()


def test_subdivision_goes_where_the_light_changes() -> None:
    scene = load_scene(BOX)
    even = solve(scene, patches=1600, tolerance=0.2, method="shoot")
    uneven = solve(scene, patches=1600, tolerance=0.2, method="shoot", split=0.1)
    assert 400 < len(uneven.triangles) <= 1700

    def sizes(solution) -> np.ndarray:  # type: ignore[no-untyped-def]
        p = solution.vertices[solution.triangles].astype(float)
        return np.linalg.norm(np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1)

    assert sizes(uneven).min() < sizes(even).min() / 1.9
    assert sizes(uneven).max() > sizes(even).max() * 1.9


def test_only_patches_with_contrast_are_divided() -> None:
    patches = make_patches(load_scene(BOX), 300)
    shooting = Shooting(patches, FUNCTIONS, lamp_rays=1_000_000)
    shooting.run(0.3)
    corners = at_corners(patches, shooting.radiosity)
    for threshold in (0.2, 0.6):
        found = chosen_patches(patches, shooting.solved, FUNCTIONS, threshold, room=10**6)
        uneven = FUNCTIONS.needs_split(corners, threshold).reshape(2, -1).any(axis=0)
        assert (found == (uneven & ~patches.lamps)).all()
        assert 0 < found.sum() < patches.size
    # Where not all can be divided, those with the most contrast are.
    few = chosen_patches(patches, shooting.solved, FUNCTIONS, 0.2, room=20)
    assert 0 < few.sum() <= 20
    contrast = (corners.max(1) - corners.min(1)).max(0) / np.maximum(corners.max((0, 1)), 1e-9)
    contrast = np.where(patches.lamps, 0, contrast.reshape(2, -1).max(axis=0))
    assert contrast[few].min() >= contrast[~few].max() - 2e-3


def test_a_white_room_has_no_limit_to_go_to(make_scene: MakeScene) -> None:
    scene = make_scene(**plates(1.0))
    with pytest.raises(SceneError, match=r"materials\.grey: reflects all light"):
        solve(scene, patches=20)
    # Gathering has nothing new to gather in its second or third iteration, as sums are rounded; shooting goes on.
    assert solve(scene, patches=20, iterations=1, method="gather").steps.tolist() == [1]
    assert solve(scene, patches=20, iterations=3, method="shoot").steps.tolist() == [3]


class _Endless(RadiosityFunctions):
    """Functions that never come to an end."""

    def gather(self, radiosity: Floats32, *_: Floats32) -> Floats32:
        """Radiosities that double."""
        return np.asarray(2 * radiosity + 1, np.float32)

    def shoot(
        self, radiosity: Floats32, unshot: Floats32, *_: Floats32 | int
    ) -> tuple[Floats32, Floats32]:
        """A step that does nothing."""
        return radiosity, unshot


@pytest.mark.parametrize(
    ("method", "told"),
    [
        ("gather", r"gather returned a radiosity of .* W/m\^2 in iteration 1: expected at most "),
        ("shoot", "left the shooter's unshot"),
    ],
)
def test_what_would_never_end_is_told(
    make_scene: MakeScene, method: Literal["gather", "shoot"], told: str
) -> None:
    patches = make_patches(make_scene(**plates(0.5)), 60)
    endless = _Endless(Effects(PROJECT / "solutions"))
    with pytest.raises(
        FunctionError, match=rf"radiosity\.{method} {told.removeprefix(method + ' ')}"
    ):
        solve_patches(patches, endless, 1e-3, None, method)


@pytest.mark.parametrize(
    ("gathers", "told"),
    [
        (lambda b, e, r, f: -(e + r * (b @ f.T)), r"of -\d.* for a patch that emits \d"),
        (lambda b, e, r, f: e - r * (b @ f.T), r"of -\d.* for a patch that emits 0: "),
        (lambda b, *_: 0.5 * b, r"for a patch that emits \d.*: expected no less"),
        (lambda b, e, *_: b + e, r"expected at most \d.*, for no patch reflects more"),
        (lambda b, e, *_: e + 1.5 * (b - e) + 0.01 * e, r"changed a radiosity by .* never end"),
    ],
)
@pytest.mark.filterwarnings("error")
def test_light_that_there_cannot_be_ends_gathering_at_once(
    make_scene: MakeScene, gathers: Callable[..., Floats32], told: str
) -> None:
    """Of negated radiosities NumPy had warned that none was left to take the mean of."""

    class Wrong(RadiosityFunctions):
        calls = 0

        def gather(self, *arguments: Floats32) -> Floats32:
            self.calls += 1
            return np.asarray(gathers(*arguments), np.float32)

    wrong = Wrong(Effects(PROJECT / "solutions"))
    with pytest.raises(FunctionError, match=rf"^radiosity\.gather .*{told}.*`course check"):
        gathered(make_patches(make_scene(**plates(0.7)), 60), wrong, 1e-3, None, rays=1_000_000)
    assert wrong.calls < 8
