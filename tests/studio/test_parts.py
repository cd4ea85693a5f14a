"""What the studio is made of: the orbit, the sliders, noise, and passes."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from course import load_scene, render
from course.core.film import Film
from course.effects import PROJECT
from course.formats.yaml.loading import load_description
from course.modules import COURSE
from course.studio.differing import Shot, coloured, deviations, share_differing
from course.studio.keys import ABOUT, sliders
from course.studio.orbit import orbited
from course.studio.passes import Progressive, picture_of
from course.studio.prepared import PIXELS, changed, fitting, prepared, settings_of
from tests.studio.conftest import SCENE

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
