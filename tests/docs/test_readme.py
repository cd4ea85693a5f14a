"""The README's picture is the one that the site's build makes of its scene."""

import re

import numpy as np
from PIL import Image

from course import load_scene, render
from course.engine.formats.pictures.display import linear_to_srgb8
from course.engine.functions.effects import PROJECT

SIZE = 60, 38


def test_the_picture_is_the_scene() -> None:
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    words, name = re.findall(r"!\[(.+?)\]\(scenes/(\w+)\.webp\)", text)[0]
    assert len(words) > 40
    with Image.open(PROJECT / "scenes" / f"{name}.webp") as picture:
        kept = np.asarray(picture.convert("RGB").resize(SIZE, Image.Resampling.BOX), float)
    linear = render(load_scene(PROJECT / "scenes" / f"{name}.yaml"), size=SIZE, spp=32).linear
    fresh = linear_to_srgb8(np.moveaxis(linear, -1, 0)).astype(float)
    # Codes of 0 to 255; the edges of things are as wide as pixels here.
    assert np.abs(kept - fresh).mean() < 6
    # Another picture would be much farther off: this one upside down, for instance.
    assert np.abs(kept[::-1] - fresh).mean() > 20
