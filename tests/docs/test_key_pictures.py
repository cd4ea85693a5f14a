"""Pictures of the values of keys: of keys that there are, of scenes that render, and no two of a key alike."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from course.engine.formats.yaml.schema import json_schema

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')

from sitebuild import key_pictures, scene_keys
from sitebuild.key_variants import HEAT_MAPS, VARIANTS
from sitebuild.key_words import ELSEWHERE, FLAT, WORDS
from sitebuild.place import Place

from tests.lengths import share

SMALL = (60, 40)
BLOCK = 2
"""Pictures are compared by the means of blocks, of so many pixels each way."""

APART = 4
"""Levels of 255 between two blocks that can be told apart side by side. The seed is fixed: one scene differs by 0."""


def _blocks(image: Image.Image) -> np.ndarray:
    values = np.asarray(image.resize(SMALL, Image.Resampling.BOX), np.float64)
    return values.reshape(SMALL[1] // BLOCK, BLOCK, SMALL[0] // BLOCK, BLOCK, 3).mean((1, 3))


def test_every_key_is_one_of_the_format() -> None:
    definitions = json_schema()["$defs"]
    for definition, key in (*VARIANTS, *WORDS, *ELSEWHERE, *HEAT_MAPS):
        assert key in definitions[definition]["properties"], f"{definition}.{key}"


@pytest.mark.parametrize("definition", share(sorted({definition for definition, _ in VARIANTS}), 3))
def test_values_show_a_difference(definition: str) -> None:
    for (of, key), variants in VARIANTS.items():
        if of != definition:
            continue
        seen = []
        for said, changes in variants:
            size = None if "film.width" in changes else SMALL
            seen.append((said, _blocks(key_pictures.image(changes, size))))
        for (one, first), (other, second) in pairwise(seen):
            assert np.abs(first - second).max() > APART, f"{definition}.{key}: {one}, {other}"


def test_a_plain_highlight_ends_where_the_light_does() -> None:
    """With the cosine it has faded away by then: the upper left of the ball shines much less."""
    said, shown = _shown("MaterialDescription", "highlight")
    assert said[:2] == ["highlight: cosine", "highlight: plain"]
    shining = [picture[5:10, 11:17].mean() for picture in shown]
    assert shining[1] > 1.4 * shining[0]


def test_the_other_side_of_a_light_is_dark_unless_it_has_two() -> None:
    """The box stands behind it: in the left third of the picture, level with the ball."""
    said, shown = _shown("RectangleLight", "two_sided")
    assert said == ["two_sided: false", "two_sided: true"]
    box = [picture[11:16, 3:8].mean() for picture in shown]
    assert box[1] > 3 * box[0]
    # What stands before it stays as it is.
    ball = [picture[8:16, 13:18].mean() for picture in shown]
    assert abs(ball[1] - ball[0]) < 0.1 * ball[0]


def _shown(definition: str, key: str) -> tuple[list[str], list[np.ndarray]]:
    """What is said of a key's values, and the means of the blocks of their pictures."""
    said, changes = zip(*VARIANTS[definition, key], strict=True)
    return list(said), [_blocks(key_pictures.image(each, SMALL)) for each in changes]


def test_a_value_is_named_as_it_is_written() -> None:
    said = [said for said, _ in VARIANTS["RectangleLight", "visible"]]
    assert said == ["visible: true", "visible: false"]
    for (_, key), variants in VARIANTS.items():
        names = [name for name, _ in variants]
        assert len(set(names)) == len(names), key


def test_changes_are_put_into_a_copy() -> None:
    before = key_pictures.described({})
    changed = key_pictures.described({"objects.1.radius": 0.2, "camera.lens.blades": 5})
    assert changed["objects"][1]["radius"] == 0.2
    assert changed["camera"]["lens"] == {"blades": 5}
    assert key_pictures.described({}) == before


def test_a_picture_is_rendered_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    changes = {"sampler.samples": 1}
    path = key_pictures.picture(changes, tmp_path)
    with Image.open(path) as image:
        assert image.size == key_pictures.SIZE
    monkeypatch.setattr(key_pictures, "image", None)
    assert key_pictures.picture(changes, tmp_path) == path
    with pytest.raises(TypeError):
        key_pictures.picture({"sampler.samples": 2}, tmp_path)


def test_pictures_stand_beside_the_key(tmp_path: Path) -> None:
    place = Place("../", blank=True, made=tmp_path, files={})
    html = key_pictures.key_pictures(place, "CameraDescription", "vertical_fov")
    assert html.count("<img") == html.count('loading="lazy"') == 3
    assert 'alt="Camera with vertical_fov: 15"' in html
    assert key_pictures.key_pictures(place, "SceneDescription", "materials") == ""


def test_words_stand_where_there_are_no_pictures() -> None:
    assert not (WORDS.keys() | ELSEWHERE.keys()) & VARIANTS.keys()
    assert not WORDS.keys() & ELSEWHERE.keys()
    assert ELSEWHERE
    assert set(ELSEWHERE.values()) <= VARIANTS.keys()


@pytest.mark.parametrize("shape", FLAT)
def test_what_shows_nothing_changes_nothing(shape: str) -> None:
    scene: dict[str, Any] = {
        "objects.1": {
            "shape": shape.lower(),
            "material": "ball",
            "transform": [
                {"rotate": {"axis": [1, 0.3, 0], "degrees": 40}},
                {"translate": [0, 0.9, 0]},
            ],
        }
    }
    smooth, flat = (
        np.asarray(key_pictures.image({**scene, "objects.1.shading": shading}, SMALL, 4), int)
        for shading in ("smooth", "flat")
    )
    # One level: normals are rounded in another order.
    assert np.abs(smooth - flat).max() <= 1


def test_words_lead_to_pictures(tmp_path: Path) -> None:
    place = Place("../", blank=True, made=tmp_path, files={})
    reference = scene_keys.scene_keys(place)
    assert key_pictures.key_pictures(place, "SceneDescription", "title") in reference
    for definition, key in ELSEWHERE:
        said = key_pictures.key_pictures(place, definition, key)
        assert said in reference
        title = said.partition("[")[2].partition("]")[0]
        assert f"\n## {title}\n" in reference, said
        assert said.endswith(f"(#{title.lower().replace(' ', '-')}).")


def test_rays_are_shown_beside_what_is_sampled_adaptively(tmp_path: Path) -> None:
    place = Place("../", blank=True, made=tmp_path, files={})
    for where in HEAT_MAPS:
        html = key_pictures.key_pictures(place, *where)
        rays = sum(key_pictures.adaptive(changes) for _, changes in VARIANTS[where])
        assert html.count(f"<figcaption>{key_pictures.RAYS}") == rays > 0
        assert html.count("<img") == len(VARIANTS[where]) + rays
        assert html.count('class="key-pictures"') == len(VARIANTS[where])
    # Without subdivision every pixel takes the same.
    assert not key_pictures.adaptive({"film.subdivision": None})


def test_a_heat_map_is_kept_beside_its_picture(tmp_path: Path) -> None:
    changes = VARIANTS["FilmDescription", "subdivision"][1][1]
    shown, rays = (key_pictures.picture(changes, tmp_path, heat=heat) for heat in (False, True))
    assert shown != rays
    with Image.open(shown) as picture, Image.open(rays) as heat:
        assert picture.size == heat.size == key_pictures.SIZE
        seen = _blocks(heat.convert("RGB"))
        assert np.abs(seen - _blocks(picture.convert("RGB"))).max() > APART
    # Sky alone takes the fewest rays, and edges take many.
    assert seen[2, 2].max() < 20
    assert seen.max() > 80
