"""The METU scene that comes with the course: everything in it is known, and it renders."""

from pathlib import Path

import numpy as np

from course import load_scene, render
from course.engine.formats.metu.converting import convert

SHOWROOM = Path(__file__).parents[4] / "scenes" / "metu" / "showroom.xml"


def test_the_showroom_has_two_pictures_and_nothing_is_left_out(tmp_path: Path) -> None:
    converted, warnings = convert(SHOWROOM, tmp_path / "showroom.yaml")
    assert warnings == []
    assert [one.image for one in converted] == ["showroom.png", "showroom_above.png"]
    for one in converted:
        scene = load_scene(one.path)
        receipt = render(scene, size=(32, 24), spp=4).receipt.to_dict()
        called = set(receipt["effects"]["called"])
        assert "soft_shadows.point_on_rectangle" in called
        # Rough mirrors have a square of METU's own.
        assert not {name for name in called if name.startswith("glossy")}
        assert {"motion_blur.displacement", "supersampling.jittered"} <= called
        assert ("thin_lens.lens_rays" in called) == (one.camera == "1")
        assert receipt["rays"]["refraction"] > 0


def test_the_background_is_exactly_its_colour(tmp_path: Path) -> None:
    (first, _), _ = convert(SHOWROOM, tmp_path / "showroom.yaml")
    picture = render(load_scene(first.path), size=(48, 27), spp=9)
    np.testing.assert_array_equal(
        picture.settings.display.codes(picture.film.linear)[0, 0], [32, 40, 56]
    )
