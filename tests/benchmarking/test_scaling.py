"""Cost as work grows: the scenes have as much of it as they say, and the exponent is a power law's."""

from pathlib import Path

import pytest
import yaml

from benchmarks.scaling import AXES, exponent
from course import load_scene


def test_the_exponent_is_that_of_the_last_steps() -> None:
    counts = [1, 10, 100, 1000, 10000]
    assert exponent(counts, [5.0, *(3 * n**1.5 for n in counts[1:])]) == pytest.approx(1.5)


@pytest.mark.parametrize("name", AXES)
def test_a_scene_has_as_much_as_its_count_says(name: str, tmp_path: Path) -> None:
    path = tmp_path / "scene.yaml"
    count = AXES[name].counts[1]
    path.write_text(yaml.safe_dump(AXES[name].scene(count)), encoding="utf-8")
    compiled = load_scene(path).compiled
    world = compiled.world
    if name == "triangles":
        assert sum(compiled.triangles) == pytest.approx(count, rel=0.05)
    elif name == "lights":
        assert len(world.lights) == count
    elif name == "movers":
        assert len(world.surface.accelerator.movers) == count
