"""Functions that are given themselves, as a notebook's cells have them."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import load_scene, render
from course.base.errors import EffectError, FunctionError
from course.engine.functions.effects import PROJECT
from tests.lengths import fewer

SCENE = PROJECT / "scenes" / "soft_shadows.yaml"
SIZE = (30, 20)


def north(center: Any, radius: float, u: Any) -> Any:
    """The lamp's highest point, for every sample."""
    top = np.array(center) + radius * np.array([0, 1, 0])
    return np.repeat(top[:, None], u.shape[1], axis=1).astype(u.dtype)


@fewer
@pytest.mark.parametrize("name", ["point_on_sphere", "soft_shadows.point_on_sphere"])
@pytest.mark.parametrize("compiled", [False, None])
def test_a_given_function_makes_the_picture_that_its_file_makes(
    tmp_path: Path, name: str, compiled: bool | None
) -> None:
    body = "    top = np.array(center) + radius * np.array([0, 1, 0])\n"
    body += "    return np.repeat(top[:, None], u.shape[1], axis=1).astype(u.dtype)\n"
    source = f"import numpy as np\ndef point_on_sphere(center, radius, u):\n{body}"
    for file in (PROJECT / "solutions").glob("*.py"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    (tmp_path / "soft_shadows.py").write_text(source, encoding="utf-8")
    given = render(load_scene(SCENE, effects={name: north}), size=SIZE, spp=4, compiled=compiled)
    filed = render(load_scene(SCENE, effects=tmp_path), size=SIZE, spp=4, compiled=False)
    np.testing.assert_array_equal(given.linear, filed.linear)
    usual = render(load_scene(SCENE), size=SIZE, spp=4, compiled=False)
    assert (given.linear != usual.linear).any()


def test_a_wrong_result_is_told_by_the_functions_name() -> None:
    def short(_center: Any, _radius: float, u: Any) -> Any:
        return u

    scene = load_scene(SCENE, effects={"point_on_sphere": short})
    with pytest.raises(FunctionError, match=r"point_on_sphere") as caught:
        render(scene, size=SIZE, spp=1)
    assert "test_given.py" in str(caught.value)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"point_on_spere": north}, "no function point_on_spere; do you mean point_on_sphere?"),
        ({"glossy.point_on_sphere": north}, "no function glossy.point_on_sphere"),
        ({"point_on_sphere": 3}, "soft_shadows.point_on_sphere is 3; expected a function"),
        ([north], "effects is list; expected a folder, or functions by their names"),
    ],
)
def test_what_is_no_function_of_the_course_is_refused(
    given: dict[str, Callable[..., Any]], told: str
) -> None:
    with pytest.raises(EffectError) as caught:
        load_scene(SCENE, effects=given)
    assert told in str(caught.value)
