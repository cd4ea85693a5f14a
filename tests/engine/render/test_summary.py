"""What a scene says of itself before it is rendered."""

from typing import Any

import pytest

from course import render
from course.engine.render.summary import summarize
from course.engine.scene.darkness import why_black
from tests.conftest import MakeScene

QUAD = {"shape": "quad", "material": "grey"}
POINT = {"type": "point", "position": [0, 5, 0], "intensity": 9}
MIRROR = {"color": 0, "mirror": 0.9}
SKY = {"type": "constant", "radiance": 0.5}


def test_each_object_is_listed_with_where_it_lies_in_the_files_units(make_scene: MakeScene) -> None:
    stand = [{"rotate": {"axis": [1, 0, 0], "degrees": 90}}, {"translate": [0, 1, 0]}]
    scene = make_scene(
        materials={"grey": {}, "red clay": {"color": [1, 0, 0]}},
        objects=[
            QUAD | {"name": "floor", "width": 2000, "depth": 0.5},
            {"shape": "box", "material": "red clay", "transform": [{"translate": [100, 0.5, -7]}]},
            QUAD | {"name": "floor", "width": 2, "depth": 2, "transform": stand},
        ],
    )
    bounds = summarize(scene)["bounds"]
    assert list(bounds) == ["0 floor", "1 box", "2 floor"]
    rows = [" ".join(str(row).split()) for row in bounds.values()]
    assert rows == [
        "grey 2 triangles x -1000..1000 y 0..0 z -0.25..0.25",
        "red clay 12 triangles x 99.5..100.5 y 0..1 z -7.5..-6.5",
        # Not y -2.2e-16 and not z -6e-17.
        "grey 2 triangles x -1..1 y 0..2 z 0..0",
    ]
    assert len({str(row).index("z ") for row in bounds.values()}) == 1, "in columns"


@pytest.mark.parametrize(
    ("number", "listed", "last"), [(20, 20, "19 quad"), (23, 21, "and 3 more")]
)
def test_a_long_list_of_objects_is_cut(
    make_scene: MakeScene, number: int, listed: int, last: str
) -> None:
    labels = list(summarize(make_scene(objects=[QUAD] * number))["bounds"])
    assert (len(labels), labels[-1]) == (listed, last)


def test_a_material_that_returns_more_light_than_it_gets_is_hinted_at(
    make_scene: MakeScene,
) -> None:
    scene = make_scene(
        materials={
            "default": {"mirror": 0.9},
            "all of it": {"color": 0.3, "mirror": 0.7},
            "bright": {"color": [0.8, 0, 0], "mirror": 0.9},
            "ice": {"dielectric": {}, "mirror": 0.25},
            "glass": {"dielectric": {}},
        },
        environment=SKY,
    )
    where = f"{scene.path}:1"
    more = "returns more light than it gets"
    assert summarize(scene)["hints"] == {
        "materials.bright": f"{where}: {more}: color * diffuse + mirror is [1.7, 0.9, 0.9]",
        "materials.ice": (
            f"{where}: {more}: 1 (reflected and refracted) + mirror is [1.25, 1.25, 1.25]"
        ),
    }


@pytest.mark.parametrize(
    ("parts", "told"),
    [
        ({"lights": []}, "no lights"),
        ({"lights": [POINT | {"intensity": 0}]}, "(light 0: it has no power)"),
        ({"lights": [{"type": "ambient", "radiance": 0}]}, "(light 0: it has no power)"),
        (
            {"lights": [POINT], "materials": {"grey": MIRROR}},
            "(light 0: no material has a diffuse or specular term)",
        ),
        (
            {"lights": [{"type": "ambient", "radiance": 1}], "materials": {"grey": {"ambient": 0}}},
            "(light 0: no material has an ambient term)",
        ),
        ({"lights": [POINT | {"intensity": 0}] * 5}, "light 2: it has no power; ...)"),
    ],
)
def test_a_scene_that_must_come_out_black_says_why(
    make_scene: MakeScene, parts: dict[str, Any], told: str
) -> None:
    scene = make_scene(objects=[QUAD], camera={"eye": [0, 3, 1], "look_at": [0, 0, 0]}, **parts)
    reason = summarize(scene)["hints"]["lights"]
    assert str(reason).startswith("the picture will be black: ")
    assert told in str(reason)
    assert "\n" not in str(reason)
    assert not render(scene).linear.any()


@pytest.mark.parametrize(
    "parts",
    [
        {"lights": [POINT]},
        {"lights": [{"type": "ambient", "radiance": 1}]},
        {"environment": SKY},
        {
            "materials": {"grey": MIRROR},
            "lights": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.2, "radiance": 1}],
        },
    ],
)
def test_a_scene_in_which_something_shines_has_no_hint(
    make_scene: MakeScene, parts: dict[str, Any]
) -> None:
    scene = make_scene(objects=[QUAD], camera={"eye": [0, 3, 1], "look_at": [0, 0, 0]}, **parts)
    assert why_black(scene) == ""
    assert summarize(scene)["hints"] == {}
    assert render(scene).linear.any()


def test_no_mesh_is_made_a_second_time(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch
) -> None:
    moving = QUAD | {"motion": {"velocity": [1, 0, 0]}}
    camera = {"eye": [0, 3, 1], "look_at": [0, 0, 0], "shutter": {"open": 2, "close": 4}}
    scene = make_scene(objects=[moving], camera=camera)
    monkeypatch.setattr("course.engine.scene.building.objects.shapes.quad", None)
    # Where the file puts it; while the shutter is open, and in the compiled scene, it is elsewhere.
    (row,) = summarize(scene)["bounds"].values()
    assert " ".join(str(row).split()) == "grey 2 triangles x -0.5..0.5 y 0..0 z -0.5..0.5"
    assert scene.compiled.frame.center.tolist() == [3, 0, 0]
    assert scene.compiled.frame.scale == 1.5
