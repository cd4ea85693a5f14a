"""The page "Add a light, a material or an option" is true: its light is built from it, and its files are there."""

import json
import re
import shutil
from pathlib import Path

import numpy as np

from course.engine.functions.effects import PROJECT
from tests.processes import python

PAGE = PROJECT / "docs" / "guides" / "extend.md"
BLOCK = re.compile(r"^`([\w/]+\.py)`(?:, before `([^`]+)`)?:\n\n```python\n(.*?)^```$", re.M | re.S)

FLOOR = {"shape": "quad", "width": 20, "depth": 20, "material": "grey"}
SIZE, FIELD = 41, 45.0

RENDER = """
import json, sys
from course import load_scene, render
found = [render(load_scene(path), compiled=False).linear[..., 1] for path in sys.argv[1:]]
print(json.dumps([picture.tolist() for picture in found]))
"""


def test_the_light_of_the_page_fades_from_its_axis_as_it_says(tmp_path: Path) -> None:
    for name in ("course", "solutions"):
        shutil.copytree(
            PROJECT / name, tmp_path / name, ignore=shutil.ignore_patterns("__pycache__")
        )
    # By it the package knows that it is a checkout.
    shutil.copy(PROJECT / "pyproject.toml", tmp_path)
    blocks = BLOCK.findall(PAGE.read_text(encoding="utf-8"))
    for file, anchor, code in blocks:
        path = tmp_path / file
        if anchor:
            before = path.read_text(encoding="utf-8")
            assert before.count(anchor + "\n") == 1, anchor
            code = before.replace(anchor + "\n", code + anchor + "\n")
        path.write_text(code, encoding="utf-8")
    assert len({file for file, _, _ in blocks}) == 3

    # A floor seen from above; the light is at a height of 2.
    light = {"type": "point", "position": [0, 2, 0], "intensity": 10}
    cone = light | {"type": "reflector", "direction": [0, -3, 0], "exponent": 3}
    names = []
    for name, lights in {"point": light, "reflector": cone}.items():
        scene = {
            "camera": {
                "eye": [0, 8, 0],
                "look_at": [0, 0, 0],
                "up": [0, 0, 1],
                "vertical_fov": FIELD,
            },
            "film": {"width": SIZE, "height": SIZE},
            "sampler": {"type": "regular", "samples": 1},
            "materials": {"grey": {}},
            "objects": [FLOOR],
            "lights": [lights],
        }
        names.append(tmp_path / f"{name}.yaml")
        names[-1].write_text(json.dumps(scene), encoding="utf-8")
    done = python("-c", RENDER, *names, folder=tmp_path, path=tmp_path)
    point, reflector = map(np.array, json.loads(done.stdout))
    half = 8 * np.tan(np.radians(FIELD / 2))
    x = half * (2 * (np.arange(SIZE) + 0.5) / SIZE - 1)
    radius = np.hypot(x, x[:, None])
    assert point.min() > 0
    cosine = 2 / np.hypot(2, radius)
    assert np.allclose(reflector, point * cosine**3, rtol=1e-4)


def test_every_file_that_the_page_names_is_there_or_shown() -> None:
    text = PAGE.read_text(encoding="utf-8")
    shown = {file for file, anchor, _ in BLOCK.findall(text) if not anchor}
    for file in set(re.findall(r"`(course/[\w/]+(?:\.py|/))`", text)) - shown:
        assert (PROJECT / file).exists(), file
