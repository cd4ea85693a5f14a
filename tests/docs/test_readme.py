"""The README's picture is what its scene renders to, large enough to be printed, and the first of the site, too."""

import re

import numpy as np
from PIL import Image

from course import load_scene, render
from course.engine.functions.effects import PROJECT

SIZE = 64, 36


def test_the_picture_is_the_scene() -> None:
    text = (PROJECT / "README.md").read_text(encoding="utf-8")
    words, name = re.findall(r"!\[(.+?)\]\(scenes/([\w/]+)\.webp\)", text)[0]
    assert len(words) > 40
    scene = PROJECT / "scenes" / f"{name}.yaml"
    file = scene.with_suffix(".webp")
    assert file.stat().st_size < 300_000
    with Image.open(file) as picture:
        assert picture.width >= 1200
        kept = np.asarray(picture.convert("RGB").resize(SIZE, Image.Resampling.BOX), float)
    made = render(load_scene(scene), size=SIZE, spp=32)
    fresh = made.settings.display.codes(made.shown).astype(float)
    # Codes of 0 to 255; the edges of things are as wide as pixels here.
    assert np.abs(kept - fresh).mean() < 6
    # Another picture would be much farther off: this one upside down, for instance.
    assert np.abs(kept[::-1] - fresh).mean() > 20
    front = (PROJECT / "docs" / "index.md").read_text(encoding="utf-8")
    assert re.findall(r"<!-- site: picture ([\w/]+) ", front)[0] == name
