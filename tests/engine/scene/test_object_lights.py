"""Lights of type object in a scene file: what they may name, and what becomes of the materials."""

from typing import Any

import numpy as np
import pytest

from course.base.errors import CourseWarning, SceneError
from course.engine.render.summary import summarize
from course.engine.scene.scene import Scene
from tests.conftest import MakeScene
from tests.tables import put, rows

LAMP = {"shape": "box", "name": "lamp", "material": "glow"}
FLOOR = {"shape": "quad", "material": "floor", "width": 9, "depth": 9}


def description() -> dict[str, Any]:
    return {
        "materials": {"floor": {}, "glow": {"color": 0, "emission": [1, 2, 3]}},
        "objects": [{**FLOOR}, {**LAMP}],
        "lights": [{"type": "object", "object": "lamp"}],
    }


def scene(make_scene: MakeScene, **parts: Any) -> Scene:
    return make_scene(**(description() | parts))


MISTAKES = rows("""
lights/0/object -> lump | lights[0].object is "lump": expected the name of one of the objects; did you mean lamp?
lights/0/object -> "" | lights[0].object is "": expected a text that is not empty
lights/0/object -> | lights[0]: object is missing
lights/0/radiance -> 3 | lights[0].radiance: unknown key
lights/0/motion -> {} | lights[0].motion: unknown key
lights/1 -> {type: object, object: lamp} | expected another object than that of lights[0]
objects/2 -> {shape: box, name: lamp, material: glow} | objects[2].name is "lamp": expected another name
objects/1 -> | there are none
objects/1/material -> floor | give its material an emission
materials/glow/emission -> 0 | give its material an emission
objects/1/material -> glob | objects[1].material is "glob": expected the name of one of the materials
objects/1/transform -> [{scale: 1.0e-90}] | lights[0].object: the object "lamp" has no area
""")


@pytest.mark.parametrize(("place", "value", "told"), MISTAKES)
def test_mistakes_are_told_with_the_remedy(
    make_scene: MakeScene, place: str, value: str, told: str
) -> None:
    parts = description()
    put(parts, place, value)
    with pytest.raises(SceneError) as caught:
        make_scene(**parts)
    assert told in str(caught.value)


def test_two_objects_without_a_light_may_share_a_name(make_scene: MakeScene) -> None:
    other = {"shape": "quad", "name": "floor", "material": "floor"}
    assert scene(make_scene, objects=[other, other, LAMP]).compiled.world.lights


def test_the_object_has_a_copy_of_its_material(make_scene: MakeScene) -> None:
    """Others of the same material are no lights; where there are none, it has the only copy."""
    alone = scene(make_scene).compiled.world
    assert alone.materials.emission.shape[1] == 2
    other = LAMP | {"name": "other", "transform": [{"translate": [0, 9, 0]}]}
    shared = scene(make_scene, objects=[LAMP, FLOOR, other]).compiled.world
    assert shared.materials.emission.T.tolist() == [[0, 0, 0], [1, 2, 3], [1, 2, 3]]
    # Twelve triangles of the lamp, two of the floor, twelve of the other.
    assert shared.surface.triangles.material.tolist() == [2] * 12 + [0] * 2 + [1] * 12


def test_its_power_is_emission_times_area(make_scene: MakeScene) -> None:
    compiled = scene(make_scene, objects=[FLOOR, LAMP | {"size": [1, 2, 3]}]).compiled
    # In units of half the longest extent.
    area = 2 * (1 * 2 + 2 * 3 + 3 * 1) / compiled.frame.scale**2
    assert compiled.world.lights[0].color == pytest.approx(np.array([1, 2, 3]) * area / np.pi)


def test_it_is_skipped_where_nothing_shows_its_light(make_scene: MakeScene) -> None:
    world = scene(make_scene, objects=[LAMP]).compiled.world
    assert world.skipped_lights == {"light 0": "no material has a diffuse or specular term"}


def test_triangles_without_area_are_left_out(make_scene: MakeScene) -> None:
    """A flattened box has two sides left of six, which lie in one place and shine from it once."""
    flat = LAMP | {"transform": [{"scale": [1, 1e-60, 1]}, {"translate": [0, 1, 0]}]}
    with pytest.warns(CourseWarning, match="2 of 4 triangles"):
        world = scene(make_scene, objects=[FLOOR, flat]).compiled.world
    (light,) = world.lights
    assert len(light.planes) == 2  # type: ignore[union-attr]
    assert len(light.shares) == 1  # type: ignore[union-attr]


def test_what_is_said_of_it(make_scene: MakeScene) -> None:
    told = summarize(scene(make_scene))
    assert told["lights"] == {"object": 1}
    assert told["sampled"]["light 0"] == "3 numbers a sample and bounce"
