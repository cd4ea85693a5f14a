"""Which caster a process has, and that pictures are the same whichever it is."""

import json
import os
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import load_scene, render
from course.base.errors import CourseError
from course.engine.casters import choice
from tests.conftest import Compiling
from tests.forms import needs_numba
from tests.processes import python

ROOT = Path(__file__).parents[3]

HIDE = """
import importlib.util, sys
found = importlib.util.find_spec
hidden = sys.argv[1].split(",")
importlib.util.find_spec = lambda name, *rest: None if name in hidden else found(name, *rest)
sys.modules.update(dict.fromkeys(hidden))
"""
"""An import of what is hidden fails, and nobody finds it."""

RENDER = """
import json
import numpy as np
from course import load_scene, render
path, compiled, file = sys.argv[2:]
picture = render(load_scene(path), spp=4, size=(90, 60), threads=1, compiled=json.loads(compiled))
np.save(file, picture.linear)
print(json.dumps(picture.receipt.to_dict()))
"""


def rendered(folder: Path, hidden: str, scene: str, compiled: bool, **environment: str) -> Any:
    """The picture (H, W, 3) and the receipt of a process that doesn't find some libraries."""
    file = folder / "picture.npy"
    arguments = hidden, f"scenes/{scene}.yaml", json.dumps(compiled), file
    done = python("-c", HIDE + RENDER, *arguments, environment=os.environ | environment)
    return np.load(file), json.loads(done.stdout)


@pytest.fixture
def fresh() -> Any:
    """Chooses anew; afterwards, too."""
    choice.chosen.cache_clear()
    yield
    choice.chosen.cache_clear()


@pytest.mark.usefixtures("fresh")
@pytest.mark.parametrize("name", ["embree", "numpy", pytest.param("numba", marks=needs_numba)])
def test_a_caster_is_chosen_by_its_name(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(choice.VARIABLE, name)
    assert choice.chosen() == name
    assert choice.software().startswith(choice.PACKAGES[choice.chosen()])


@pytest.mark.usefixtures("fresh")
def test_by_itself_the_first_that_is_installed_is_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(choice.VARIABLE, raising=False)
    for missing, chosen in (
        (set(), "embree"),
        ({"embreex"}, "numba"),
        ({"embreex", "numba"}, "numpy"),
    ):
        monkeypatch.setattr(choice, "find_spec", lambda name, m=missing: None if name in m else 1)
        choice.chosen.cache_clear()
        assert choice.chosen() == chosen


@pytest.mark.usefixtures("fresh")
def test_a_caster_that_is_unknown_or_missing_is_told_with_the_remedy(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(choice.VARIABLE, "optix")
    with pytest.raises(CourseError, match="expected one of embree, numba, numpy"):
        choice.chosen()
    monkeypatch.setenv(choice.VARIABLE, "embree")
    monkeypatch.setattr(choice, "find_spec", lambda name: None if name == "embreex" else 1)
    with pytest.raises(CourseError, match="embreex is not installed: install it, or unset"):
        choice.chosen()


# Both forms, and among the scenes one with movers, whose packets have several hierarchies.
@pytest.mark.parametrize(
    ("hidden", "scene", "compiled", "caster"),
    [
        ("embreex,numba", "soft_shadows", False, "numpy"),
        ("embreex,numba", "motion_blur", False, "numpy"),
        pytest.param("embreex", "soft_shadows", False, "numba", marks=needs_numba),
        pytest.param("embreex", "glossy", True, "numba", marks=needs_numba),
        pytest.param("embreex", "motion_blur", True, "numba", marks=needs_numba),
        pytest.param("embreex", "path_tracing", True, "numba", marks=needs_numba),
    ],
)
def test_without_embreex_the_picture_is_the_same(
    tmp_path: Path,
    compiled_in_turns: Compiling,
    hidden: str,
    scene: str,
    compiled: bool,
    caster: str,
) -> None:
    with compiled_in_turns() if caster == "numba" else nullcontext():
        picture, receipt = rendered(tmp_path, hidden, scene, compiled)
    assert receipt["caster"] == caster
    assert receipt["embree_seconds"] > 0
    mine = render(load_scene(ROOT / f"scenes/{scene}.yaml"), spp=4, size=(90, 60), threads=1)
    assert mine.receipt.caster == "embree"
    expected = mine.linear
    # A ray that grazes an edge may go the other way; all others differ by the rounding of where they begin.
    differs = np.abs(picture - expected).max(axis=2) > 1e-3 * expected.max()
    assert differs.mean() < 0.01
    assert abs(picture.mean() / expected.mean() - 1) < 1e-3
