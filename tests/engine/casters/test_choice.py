"""Which caster a process has, and that pictures are the same whichever it is."""

import json
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
folder, scenes = sys.argv[2:]
rendered = {}
for name in scenes.split(","):
    scene = load_scene(f"scenes/{name}.yaml")
    rendered[name] = receipts = []
    for compiled in (False, True) if "numba" not in sys.argv[1].split(",") else (False,):
        picture = render(scene, spp=4, size=(60, 40), sampler="sobol", threads=1, compiled=compiled)
        np.save(f"{folder}/{name}-{compiled}.npy", picture.linear)
        receipts.append(picture.receipt.to_dict())
print(json.dumps(rendered))
"""
SCENES = ("soft_shadows", "glossy", "motion_blur", "path_tracing")
"""Among them one with movers, whose packets have several hierarchies."""


def seen(scene: str) -> Any:
    """The picture (H, W, 3) with Embree."""
    mine = render(load_scene(ROOT / f"scenes/{scene}.yaml"), spp=4, size=(60, 40), threads=1)
    assert mine.receipt.caster == "embree"
    return mine.linear


def rendered(folder: Path, hidden: str, *scenes: str) -> dict[str, list[Any]]:
    """Receipts of a process that doesn't find some libraries, by scene, in each form that it has; pictures in files."""
    done = python("-c", HIDE + RENDER, hidden, folder, ",".join(scenes))
    return dict(json.loads(done.stdout))


def assert_alike(picture: Any, expected: Any) -> None:
    # A ray that grazes an edge may go the other way; all others differ by the rounding of where they begin.
    differs = np.abs(picture - expected).max(axis=2) > 1e-3 * expected.max()
    assert differs.mean() < 0.01
    assert abs(picture.mean() / expected.mean() - 1) < 1e-3


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


def test_without_embreex_and_numba_the_picture_is_the_same(tmp_path: Path) -> None:
    for scene, (receipt,) in rendered(tmp_path, "embreex,numba", *SCENES[::2]).items():
        assert receipt["caster"] == "numpy"
        assert receipt["embree_seconds"] > 0
        assert_alike(np.load(tmp_path / f"{scene}-False.npy"), seen(scene))


@needs_numba
def test_without_embreex_the_picture_is_the_same_and_packets_of_16_rays_make_that_of_single_ones(
    tmp_path: Path, compiled_in_turns: Compiling
) -> None:
    with compiled_in_turns():
        found = rendered(tmp_path, "embreex", *SCENES)
    for scene, receipts in found.items():
        single, packets = receipts
        for receipt in receipts:
            assert receipt["caster"] == "numba"
            assert receipt["embree_seconds"] > 0
        assert packets["rays"] == single["rays"]
        alone, together = (
            np.load(tmp_path / f"{scene}-{compiled}.npy") for compiled in (False, True)
        )
        assert np.array_equal(alone, together)
        assert_alike(together, seen(scene))
