"""The film's functions make a PNG's codes; radiance and EXR stay as they were, and nothing is called unasked."""

from pathlib import Path

import numpy as np
import pytest
import yaml
from PIL import Image

from course import load_scene, render
from course.base.errors import CourseError
from course.engine.formats.pictures.reading import read_picture
from course.engine.render.picture import Picture

SCENES = Path(__file__).parents[3] / "scenes" / "before"


def _picture(tmp_path: Path, film: dict[str, object], effects: str | Path = "solutions") -> Picture:
    scene = yaml.safe_load((SCENES / "film.yaml").read_text(encoding="utf-8"))
    scene["film"] = {"width": 24, "height": 12, **film}
    path = tmp_path / "scene.yaml"
    path.write_text(yaml.safe_dump(scene), encoding="utf-8")
    return render(load_scene(path, effects), spp=2)


def _codes(tmp_path: Path, picture: Picture) -> np.ndarray:
    picture.save(tmp_path / "picture.png")
    return np.asarray(Image.open(tmp_path / "picture.png")).astype(int)


def _called(picture: Picture) -> set[str]:
    return {name for name in picture.receipt.effects["called"] if name.startswith("film.")}


def test_a_film_that_asks_for_nothing_calls_nothing(tmp_path: Path) -> None:
    plain = _picture(tmp_path, {})
    assert _called(plain) == set()
    assert "film" in plain.receipt.effects["skipped"]


def test_a_stop_is_half_a_white(tmp_path: Path) -> None:
    exposed, halved = _picture(tmp_path, {"exposure": 1}), _picture(tmp_path, {"white": 0.5})
    assert _called(exposed) == {"film.expose", "film.encode_srgb"}
    assert (exposed.linear == halved.linear).all()
    assert np.abs(_codes(tmp_path, exposed) - _codes(tmp_path, halved)).max() <= 1


def test_tone_mapping_leaves_an_exr_as_it_was(tmp_path: Path) -> None:
    plain, toned = _picture(tmp_path, {}), _picture(tmp_path, {"tone": {"key": 0.4}})
    assert (_codes(tmp_path, plain) != _codes(tmp_path, toned)).any()
    toned.save(tmp_path / "picture.exr")
    assert (read_picture(tmp_path / "picture.exr") == plain.linear).all()


def test_a_gamma_takes_the_place_of_the_curve(tmp_path: Path) -> None:
    toned = _picture(tmp_path, {"tone": {"gamma": 2.2}})
    assert _called(toned) == {"film.photographic"}
    assert _codes(tmp_path, toned).max() == 255
    # The least of all leaves black and white alone.
    least = _picture(tmp_path, {"tone": {"gamma": 1e-150}})
    assert set(np.unique(_codes(tmp_path, least))) <= {0, 255}


def test_dithering_is_off_by_less_than_a_code_and_the_same_each_time(tmp_path: Path) -> None:
    plain, dithered = _picture(tmp_path, {}), _picture(tmp_path, {"dither": True})
    codes = _codes(tmp_path, dithered)
    assert (codes == _codes(tmp_path, dithered)).all()
    off = np.abs(codes - _codes(tmp_path, plain))
    assert off.max() == 1


def test_a_function_that_is_not_written_is_told_before_the_render(tmp_path: Path) -> None:
    with pytest.raises(CourseError, match=r"film\.tone.*") as caught:
        _picture(tmp_path, {"tone": {}}, "assignments")
    assert "film" in str(caught.value)


def test_a_mistyped_key_is_told_with_the_nearest(tmp_path: Path) -> None:
    with pytest.raises(CourseError, match="saturation"):
        _picture(tmp_path, {"tone": {"saturaton": 1}})
