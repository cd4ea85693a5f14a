"""Denoised previews: what they keep, what they change, what they say of it, and who never gets one."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from course import CourseError, Scene, render
from course.cli.main import commands
from course.engine.core.tiles import Tile
from course.engine.formats.pictures.files import encode_png
from course.engine.functions.effects import PROJECT, Bound, Effects
from course.engine.scene.scene import load_variant
from course.engine.terms.denoising import MomentsFilm, functions
from tests.conftest import MakeScene

SCENE = PROJECT / "scenes" / "denoising.yaml"
SMALL = (40, 40)


@pytest.fixture(scope="module")
def scene() -> Scene:
    return load_variant(SCENE)


def filmed(samples: np.ndarray, split: int | None = None) -> MomentsFilm:
    """A film with samples (3, H, W, n), added in two passes if they are split."""
    _, height, width, n = samples.shape
    film = MomentsFilm(width, height)
    tile, done = Tile(0, 0, 0, width, height), 0
    for part in np.split(samples, [] if split is None else [split], axis=3):
        done += part.shape[3]
        film.add(tile, part.reshape(3, -1).astype(np.float32), 1.0, done, True)
    assert (film.samples == n).all()
    return film


def denoised(film: MomentsFilm, level: float = 0.01, sigma: float = 2.0) -> np.ndarray:
    film.denoise(functions(Bound(Effects())), level, sigma)
    assert film.preview is not None
    return film.preview


@pytest.mark.parametrize("split", [None, 1, 5, 16])
def test_the_film_has_mean_and_variance_of_all_samples(split: int | None) -> None:
    samples = np.random.default_rng(0).normal(3, 1, (3, 5, 7, 21)).astype(np.float32)
    film = filmed(samples, split)
    assert film.mean == pytest.approx(samples.mean(axis=3, dtype=float), rel=1e-12)
    known = samples.astype(float).var(axis=3, ddof=1)
    assert film.variance == pytest.approx(known, rel=1e-12)
    assert film.linear == pytest.approx(film.mean, rel=1e-6)


def test_a_constant_picture_stays_as_it_is() -> None:
    samples = np.tile(np.array([0.2, 0.5, 1.5]).reshape(3, 1, 1, 1), (1, 9, 12, 4))
    assert denoised(filmed(samples)) == pytest.approx(samples[..., 0], rel=1e-6)


def test_noise_is_averaged_and_a_far_edge_is_not() -> None:
    # Steps of 20 standard errors: none is taken for noise at 8 samples; 4,000 pairs beside the edge.
    truth = np.where(np.arange(40) < 20, 0.2, 0.9)
    rng = np.random.default_rng(1)
    samples = truth[:, None] + rng.normal(0, 0.1, (3, 30, 40, 8))
    preview, before = denoised(filmed(samples), level=1e-3), samples.mean(axis=3)
    assert np.abs(preview - truth).max() < 0.1
    assert np.sqrt(np.mean((preview - truth) ** 2)) < 0.35 * np.sqrt(np.mean((before - truth) ** 2))


def test_there_are_no_neighbours_beyond_the_border() -> None:
    film = filmed(np.full((3, 3, 3, 4), 0.5))
    told = film.denoise(functions(Bound(Effects())), 0.05, 2.0)
    assert told == pytest.approx({"neighbours": 8, "noise": 0, "left": 0, "bias": 0}, abs=1e-6)


def test_pixels_of_one_sample_are_left_alone() -> None:
    samples = np.random.default_rng(2).random((3, 6, 6, 1))
    film = filmed(samples)
    assert denoised(film) == pytest.approx(film.linear, rel=1e-6)


def test_the_picture_beside_the_preview_is_that_of_the_same_samples(scene: Scene) -> None:
    plain, preview = (render(scene, size=SMALL, denoise=each) for each in (False, True))
    assert preview.film.linear == pytest.approx(plain.film.linear, rel=1e-5, abs=1e-6)
    assert plain.shown is plain.film.linear
    assert np.abs(preview.shown - preview.film.linear).max() > 0.01
    assert (preview.linear == np.moveaxis(preview.film.linear, 0, 2)).all()
    assert preview._repr_png_() == encode_png(preview.shown, preview.settings.display)


def test_threads_and_compiled_loops_change_no_bit(scene: Scene) -> None:
    one = render(scene, size=SMALL, threads=1, compiled=False)
    two = render(scene, size=SMALL, threads=2, compiled=False)
    assert one.shown.tobytes() == two.shown.tobytes()
    pytest.importorskip("numba", reason='loops are compiled by: pip install -e ".[fast]"')
    compiled = render(scene, size=SMALL, threads=2, compiled=True)
    assert one.shown.tobytes() == compiled.shown.tobytes()


def test_every_sampler_has_a_preview(scene: Scene) -> None:
    for sampler in ("random", "jittered", "regular", "halton", "hammersley", "xorshift"):
        picture = render(scene, size=(16, 16), sampler=sampler, spp=9)
        assert np.isfinite(picture.shown).all()
        assert picture.receipt.denoising is not None


def test_an_exr_has_the_picture_and_a_png_the_preview(scene: Scene, tmp_path: Path) -> None:
    from course.engine.formats.pictures.reading import read_picture

    picture = render(scene, size=SMALL)
    picture.save(tmp_path / "a.exr")
    assert (read_picture(tmp_path / "a.exr") == picture.linear).all()
    picture.save(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == encode_png(picture.shown, picture.settings.display)


def test_a_scene_that_does_not_ask_pays_nothing(make_scene: MakeScene) -> None:
    scene = make_scene()
    picture = render(scene, size=(8, 8), spp=4)
    assert picture.receipt.denoising is None
    assert "denoising" not in picture.receipt.to_dict()
    assert "denoised" in picture.receipt.effects["skipped"]["denoising"]
    assert "denoising" not in scene.effects.imported


REFUSED: dict[str, tuple[dict[tuple[str | int, ...], Any], dict[str, Any]]] = {
    "2 samples": ({}, {"spp": 1}),
    "uniform": ({}, {"error": 0.01}),
    "film.subdivision": ({("film", "subdivision"): {"threshold": 0.1}}, {}),
    "--spp": ({}, {"time_limit": 1.0}),
    "has to be box": ({("film", "filter"): "gaussian"}, {}),
}


@pytest.mark.parametrize("says", REFUSED)
def test_what_does_not_go_with_it_is_refused(says: str) -> None:
    changes, options = REFUSED[says]
    with pytest.raises(CourseError, match=f"^denoise .*{says}"):
        render(load_variant(SCENE, changes), size=(8, 8), **options)


def test_a_preview_is_not_continued(scene: Scene) -> None:
    start = render(scene, size=(8, 8))
    with pytest.raises(CourseError, match="denoised preview can't be continued"):
        render(scene, size=(8, 8), spp=32, start=start)


def test_the_terminal_says_that_it_is_biased(tmp_path: Path) -> None:
    out = tmp_path / "a.png"
    result = CliRunner().invoke(commands, ["render", str(SCENE), "--size", "24x24", "-o", str(out)])
    assert result.exit_code == 0
    assert "biased" in result.output
    assert "by its own estimate" in result.output


def test_the_option_refuses_an_exr(tmp_path: Path) -> None:
    out = tmp_path / "a.exr"
    result = CliRunner().invoke(commands, ["render", str(SCENE), "--denoise", "-o", str(out)])
    assert result.exit_code != 0
    assert "write a .png" in " ".join(result.output.split())
    assert not out.exists()
