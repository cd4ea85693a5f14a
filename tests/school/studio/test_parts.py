"""What the studio is made of: the orbit, the sliders, noise, and passes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from course import load_scene, render
from course.base.errors import CourseError
from course.engine.core.film import Film
from course.engine.formats.yaml.loading import load_description
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.modules import COURSE
from course.engine.render.which_loops import NO_COMPILER
from course.school.studio.differing import Shot, coloured, deviations, share_differing
from course.school.studio.engine import EngineEffects, engines_picture
from course.school.studio.keys import ABOUT, sliders
from course.school.studio.orbit import CLOSEST, FARTHEST, STEEPEST, orbited, within_limits
from course.school.studio.passes import Progressive, even_tiles, picture_of
from course.school.studio.prepared import PIXELS, changed, fitting, prepared, settings_of
from tests.school.studio.conftest import RIGHT, SCENE, write

SCENES = PROJECT / "scenes"

# ---------------------------------------------------------------- orbit


@pytest.fixture
def ball(tmp_path: Path) -> Path:
    file = tmp_path / "ball.yaml"
    file.write_text(SCENE, encoding="utf-8")
    return file


def test_a_whole_turn_ends_where_it_began(ball: Path) -> None:
    camera = load_description(ball).description.camera
    np.testing.assert_allclose(orbited(camera, 0, 0, 1), camera.eye, atol=1e-5)
    np.testing.assert_allclose(orbited(camera, 2 * np.pi, 0, 1), camera.eye, atol=1e-4)
    half = orbited(camera, np.pi, 0, 1)
    np.testing.assert_allclose(half, (0, 1.2, -4), atol=1e-4)
    np.testing.assert_allclose(orbited(camera, 0, 0, 2), (0, 2.0, 8), atol=1e-4)


def test_no_tilt_turns_the_camera_over(ball: Path) -> None:
    camera = load_description(ball).description.camera
    for tilt in (-9, 9):
        eye = np.array(orbited(camera, 0, tilt, 1)) - camera.look_at
        level = np.hypot(eye[0], eye[2]) / np.linalg.norm(eye)
        assert 0.05 < level < 0.1


def test_a_camera_that_can_go_no_further_turns_back_at_once(ball: Path) -> None:
    """Sixty presses of a key had been added up, and had to be taken back one by one."""
    camera = load_description(ball).description.camera
    for tilt, zoom in ((9.0, 1e6), (-9.0, 1e-6)):
        _, tilted, zoomed = within_limits(camera, 0.5, tilt, zoom)
        there = orbited(camera, 0.5, tilt, zoom)
        assert orbited(camera, 0.5, tilted, zoomed) == pytest.approx(there, rel=1e-5, abs=1e-5)
        back = orbited(camera, 0.5, tilted - np.sign(tilt) * 0.1, zoomed)
        distance = np.linalg.norm(np.array(there) - camera.look_at)
        assert np.linalg.norm(np.array(back) - there) > 0.05 * distance
        assert CLOSEST <= zoomed <= FARTHEST
        assert abs(tilted) <= 2 * STEEPEST
    assert within_limits(camera, 7.0, 0.1, 2.0) == (7.0, 0.1, 2.0)


# ---------------------------------------------------------------- sliders


@pytest.mark.parametrize("module", sorted(ABOUT))
def test_every_module_has_sliders_for_what_it_is_about(module: str) -> None:
    loaded = load_description(SCENES / f"{module}.yaml")
    found = sliders(loaded, [module])
    # Of a scene that doesn't have these keys there is but the number of samples.
    for each in found:
        assert each.low <= each.value <= each.high
        assert each.description
        # Both ends are values that the format takes.
        for value in (each.low, each.high):
            number = int(value) if isinstance(each.value, int) else float(value)
            load_description(loaded.path, {each.path: number})
    assert set(ABOUT) <= set(COURSE)


@pytest.mark.parametrize(
    ("module", "key"),
    [
        ("soft_shadows", "lights[0].radius"),
        ("thin_lens", "camera.lens.aperture_radius"),
        ("glossy", "materials.copper.gloss.exponent"),
        ("glossy", "materials.steel.gloss.roughness"),
        ("motion_blur", "camera.shutter.close"),
        ("supersampling", "sampler.samples"),
        ("film", "film.exposure"),
        ("multiple_importance", "materials.satin.gloss.exponent"),
        ("microfacets", "materials.gold.conductor.roughness"),
        ("microfacets", "materials.glass.dielectric.roughness"),
        ("cube_map", "environment.scale"),
        ("quasi_monte_carlo", "lights[0].radius"),
        ("blue_noise", "lights[0].radius"),
        ("film", "film.tone.key"),
    ],
)
def test_the_keys_that_a_module_is_about_have_sliders(module: str, key: str) -> None:
    loaded = load_description(SCENES / f"{module}.yaml")
    assert key in [each.label for each in sliders(loaded, [module])]


def test_a_filter_that_is_not_used_has_no_slider(ball: Path) -> None:
    for name, used in (("box", False), ("gaussian", True)):
        loaded = load_description(ball, {("film", "filter"): name})
        labels = [each.label for each in sliders(loaded, ["supersampling"])]
        assert ("film.sigma" in labels) == used


# ---------------------------------------------------------------- noise


def shot(linear: NDArray[np.float64], samples: int, variance: float) -> Shot:
    single = linear.astype(np.float32)
    there = np.ones(linear.shape[1:], bool)
    return Shot(single, there, samples, 1.0, np.full(linear.shape[1:], variance, np.float32))


def test_noise_alone_is_no_difference_and_a_patch_is_one() -> None:
    # With a threshold of 4 deviations noise alone colours 6e-5 of a picture of 60,000 pixels; windows overlap, so a
    # share above 1e-3 is seen less often than once in a million times.
    numbers = np.random.default_rng(7)
    a, b = (0.5 + numbers.normal(scale=0.1, size=(3, 200, 300)) for _ in range(2))
    # The mean of three channels has a third of their variance; each picture is a mean of 4 samples.
    variance = 4 * 0.1**2 / 3
    same = deviations(shot(a, 4, variance), shot(b, 4, variance))
    assert share_differing(same) < 1e-3
    assert float(same.std()) == pytest.approx(1, abs=0.1)
    a[:, 50:100, 50:100] += 0.2
    z = deviations(shot(a, 4, variance), shot(b, 4, variance))
    assert z[75, 75] > 10
    assert share_differing(z) == pytest.approx(50 * 50 / 60000, rel=0.3)
    codes = coloured(z).astype(int)
    assert codes[75, 75, 0] > codes[75, 75, 2] + 50
    assert (codes[150, 150] == codes[150, 151]).all()


def test_where_a_picture_ends_that_is_not_whole_yet_is_no_difference() -> None:
    light = 0.5 + np.random.default_rng(8).normal(scale=0.01, size=(3, 60, 60))
    a = shot(light, 4, 0.0004)
    part = np.arange(60)[:, None] < 30
    b = replace(a, linear=a.linear * part, there=part & np.ones((60, 60), bool))
    assert share_differing(deviations(a, b)) == 0
    brighter = replace(b, linear=b.linear * np.float32(1.5))
    assert share_differing(deviations(a, brighter)) == pytest.approx(0.5, abs=0.06)


def test_the_same_light_that_is_shown_otherwise_is_a_difference() -> None:
    linear = np.random.default_rng(3).random((3, 40, 60))
    codes = (255 * np.moveaxis(linear, 0, -1)).astype(np.uint8) // 2
    a = replace(shot(linear, 4, 0.01), codes=codes)
    b = replace(a, codes=codes.copy())
    assert share_differing(deviations(a, b)) == 0
    b.codes[:20] += 3
    z = deviations(a, b)
    assert share_differing(z) == pytest.approx(0.5, abs=0.1)
    assert z[5, 5] < 0
    # Other light has noise, by which alone it is judged.
    c = replace(b, linear=b.linear + np.float32(0.01))
    assert share_differing(deviations(a, c)) == 0


def test_the_variance_of_a_sample_is_estimated_from_passes(ball: Path) -> None:
    scene = load_scene(ball, effects="solutions")
    settings = replace(scene.settings, width=48, height=32, samples=256, sampler="random")
    picture = picture_of(scene, settings)
    picture.render(256, lambda *_: None)
    assert picture.variance is not None
    # Of 64 pictures of one sample each, whose variance it is.
    many = [render(scene, spp=1, size=(48, 32), sampler="random", seed=n).linear for n in range(64)]
    expected = np.stack(many).mean(axis=3).var(axis=0, ddof=1).mean()
    assert float(picture.variance.mean()) == pytest.approx(expected, rel=0.15)


# ---------------------------------------------------------------- passes


@pytest.mark.parametrize("sampler", ["sobol", "jittered", "halton", "random", "hammersley"])
def test_passes_add_up_to_the_picture(ball: Path, sampler: str) -> None:
    scene = load_scene(ball, effects="solutions")
    settings = replace(scene.settings, width=48, height=32, samples=36, sampler=sampler)
    picture = picture_of(scene, settings)
    counts: list[int] = []

    def tell(_film: Film, samples: int, complete: bool) -> None:
        if complete:
            counts.append(samples)

    picture.render(16, tell)
    assert picture.samples in (16, 1)
    picture.render(36, tell)
    assert counts[-1] == 36
    assert counts == sorted(set(counts))
    whole = render(scene, spp=36, size=(48, 32), sampler=sampler)
    if sampler == "random":
        # Its numbers depend on the passes, so only the mean is the same: 3 deviations would be 0.6%.
        assert picture.film.linear.mean() == pytest.approx(whole.linear.mean(), rel=0.006)
    else:
        np.testing.assert_allclose(picture.film.linear, whole.film.linear, atol=2e-6)


class StopError(Exception):
    """Ends a render."""


def test_a_pass_that_was_interrupted_leaves_nothing_behind(ball: Path) -> None:
    scene = load_scene(ball, effects="solutions")
    settings = replace(scene.settings, width=48, height=32)
    picture, other = Progressive(scene, settings), Progressive(scene, settings)

    def stop(_film: Film, samples: int, complete: bool) -> None:
        if samples >= 2 and not complete:
            raise StopError

    with pytest.raises(StopError):
        picture.render(16, stop)
    assert picture.samples < 16
    for each in (picture, other):
        each.render(16, lambda *_: None)
    np.testing.assert_array_equal(picture.film.linear, other.film.linear)


def test_tiles_are_equally_large_and_equally_many_for_each_thread() -> None:
    for samples in (1, 2, 4, 8, 16):
        tiles = even_tiles(480, 317, samples, 2)
        assert sum(tile.size for tile in tiles) == 480 * 317
        covered = np.zeros((317, 480), int)
        for tile in tiles:
            covered[tile.rows, tile.columns] += 1
        assert (covered == 1).all()
        assert len({tile.number for tile in tiles}) == len(tiles)
        assert max(tile.size for tile in tiles) * samples <= 65536
    assert [tile.size for tile in even_tiles(480, 320, 1, 2)] == [480 * 80] * 4
    assert len(even_tiles(5, 1, 16, 8)) == 1


def test_compiled_stages_call_a_students_functions_and_give_the_same_bits(
    work: Path, ball: Path
) -> None:
    pytest.importorskip("numba")
    write(work, RIGHT)
    scene = prepared(ball, {}, Effects("mine"))
    settings = replace(scene.settings, width=48, height=32)
    pictures = []
    for compiled in (False, True):
        picture = Progressive(scene, settings, compiled)
        picture.render(16, lambda *_: None)
        pictures.append(picture.film.linear)
    np.testing.assert_array_equal(*pictures)


# ---------------------------------------------------------------- the reference without solutions


@pytest.mark.parametrize("name", ["soft_shadows", "supersampling", "thin_lens"])
def test_compiled_loops_are_the_reference_where_no_solutions_are(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("numba")
    monkeypatch.delenv(NO_COMPILER, raising=False)
    effects = EngineEffects()
    scene = prepared(SCENES / f"{name}.yaml", {}, effects)
    settings = replace(settings_of(scene), width=48, height=32, samples=16)
    reference = engines_picture(scene, settings)
    reference.render(16, lambda *_: None)
    solved = load_scene(SCENES / f"{name}.yaml", effects="solutions")
    picture = render(solved, spp=16, size=(48, 32), sampler="sobol")
    np.testing.assert_allclose(reference.film.linear, picture.film.linear, atol=1e-5)
    # What the loops don't call can't be called.
    with pytest.raises(CourseError, match="no solution"):
        effects.function("soft_shadows", "point_on_sphere")(1, 2, 3)


@pytest.mark.parametrize("name", ["path_tracing", "adaptive_sampling", "textures"])
def test_a_scene_that_the_loops_do_not_know_has_no_reference(name: str) -> None:
    def reference() -> None:
        scene = prepared(SCENES / f"{name}.yaml", {}, EngineEffects())
        engines_picture(scene, settings_of(scene))

    # Of a function that building calls, or of the loops.
    with pytest.raises(CourseError, match="no solution"):
        reference()


def test_a_camera_that_moves_needs_no_new_world(ball: Path) -> None:
    scene = load_scene(ball, effects="solutions")
    values = {("camera", "eye"): [1.0, 2.0, 3.0], ("sampler", "samples"): 9}
    moved = changed(scene, {}, values)
    assert moved is not None
    assert moved.compiled.world.surface is scene.compiled.world.surface
    anew = prepared(ball, values, scene.effects)
    pictures = [render(each, spp=4).linear for each in (moved, anew)]
    np.testing.assert_array_equal(*pictures)
    assert changed(scene, {}, {("lights", 0, "radius"): 0.2}) is None


def test_pictures_keep_the_shape_of_the_film(ball: Path) -> None:
    assert fitting(72, 48) == (72, 48)
    assert fitting(720, 480) == (480, 320)
    width, height = fitting(1000, 4000)
    assert width * height <= 1.01 * PIXELS
    assert height / width == pytest.approx(4, rel=0.02)
    assert settings_of(load_scene(ball)).width == 72
