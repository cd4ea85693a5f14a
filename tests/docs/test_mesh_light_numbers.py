"""What the page of path tracing says of a lamp that is an object: measured again.

Two pictures of different seeds differ by sqrt(2) times the error of each, so no reference is needed; of 30,000 pixels
the estimate is good to a few in a hundred, and the seeds are fixed.
"""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from course import load_scene, render
from course.engine.functions.effects import PROJECT

PAGE = PROJECT / "docs" / "modules" / "path_tracing.md"
SCENE = PROJECT / "scenes" / "mesh_light.yaml"
LISTED = "  - {type: object, object: tube}\n"


@pytest.mark.parametrize(("row", "listed"), [("is a light", True), ("only glows", False)])
def test_the_noise_of_a_lamp_that_is_an_object(tmp_path: Path, row: str, listed: bool) -> None:
    said = re.search(rf"\| {row} \| ([\d.]+) \| ([\d.]+) \|", PAGE.read_text(encoding="utf-8"))
    assert said is not None
    error, rays = map(float, said.groups())
    text = SCENE.read_text(encoding="utf-8")
    assert text.count(LISTED) == 1
    path = tmp_path / "scene.yaml"
    path.write_text(text if listed else text.replace(f"lights:\n{LISTED}", "lights: []\n"))
    pictures = [render(load_scene(path), size=(200, 150), spp=16, seed=seed) for seed in (0, 1)]
    one, two = (np.minimum(picture.linear.astype(np.float64), 1) for picture in pictures)
    assert math.sqrt(((one - two) ** 2).mean() / 2) == pytest.approx(error, rel=0.06)
    receipt = pictures[0].receipt
    assert sum(receipt.rays.values()) / receipt.rays["camera"] == pytest.approx(rays, abs=0.06)
