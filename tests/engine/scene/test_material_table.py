"""What a material is made of when the file says little."""

from collections.abc import Callable
from typing import Any

import msgspec
import numpy as np
import pytest

from course import Scene, render
from course.engine.formats.yaml.description import MaterialDescription
from course.engine.scene.building.materials import base_color, returned_share
from tests.conftest import MakeScene

GREY = [0.8, 0.8, 0.8]


def material(**keys: Any) -> MaterialDescription:
    return msgspec.convert(keys, MaterialDescription)


@pytest.mark.parametrize(
    ("keys", "color"),
    [
        ({}, GREY),
        ({"color": None}, GREY),
        ({"mirror": 0}, GREY),
        ({"mirror": 0.9}, [0.08, 0.08, 0.08]),
        ({"mirror": [1, 0.5, 0]}, [0, 0.4, 0.8]),
        ({"color": 0.8, "mirror": 0.9}, GREY),
        ({"color": [0.1, 0.2, 0.3], "mirror": 0.9}, [0.1, 0.2, 0.3]),
    ],
)
def test_a_colour_is_as_given_or_a_share_of_what_the_mirror_leaves(
    make_scene: Callable[..., Scene], keys: dict[str, Any], color: list[float]
) -> None:
    np.testing.assert_allclose(base_color(material(**keys)), color, rtol=1e-15)
    factors = {"ambient": 0.5, "diffuse": 0.25}
    scene = make_scene(
        materials={"m": keys | factors}, objects=[{"shape": "quad", "material": "m"}]
    )
    table = scene.compiled.world.materials
    np.testing.assert_allclose(table.ambient[:, 0], np.multiply(color, 0.5), rtol=1e-6)
    np.testing.assert_allclose(table.diffuse[:, 0], np.multiply(color, 0.25), rtol=1e-6)


@pytest.mark.parametrize("mirror", [0, 0.3, 0.9, 1, [0, 0.5, 1]])
def test_a_material_without_a_colour_never_makes_light(mirror: Any) -> None:
    assert (returned_share(material(mirror=mirror)) <= 1.0).all()


@pytest.mark.parametrize(
    ("keys", "share"),
    [
        ({}, GREY),
        ({"color": 0.8, "mirror": 0.9}, [1.7, 1.7, 1.7]),
        ({"color": 0.8, "mirror": 0.9, "diffuse": 0}, [0.9, 0.9, 0.9]),
        ({"color": [1, 0, 0], "mirror": [0, 0, 0.5], "diffuse": 0.5}, [0.5, 0, 0.5]),
        # Glass returns all light by itself, and has no use for a colour.
        ({"color": 1, "dielectric": {}}, [1, 1, 1]),
        ({"color": 0, "mirror": 0.1, "dielectric": {}}, [1.1, 1.1, 1.1]),
    ],
)
def test_the_returned_share_counts_diffuse_reflection_mirror_and_glass(
    keys: dict[str, Any], share: list[float]
) -> None:
    np.testing.assert_allclose(returned_share(material(**keys)), share, rtol=1e-15)


@pytest.mark.parametrize("way", ["balance", "power", "lamp"])
def test_a_scene_without_objects_has_no_material_that_shines(
    make_scene: MakeScene, way: str
) -> None:
    """A column that stands in where there is no material was taken for a lamp, and the scene ended in a ValueError."""
    lights = [{"type": "ambient", "radiance": 1}]
    scene = make_scene(materials={}, lights=lights, integrator={"gloss_sampling": way})
    assert not render(scene, spp=1, size=(4, 4)).linear.any()
