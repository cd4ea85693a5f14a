"""Meshes of glass that have no inside, or are inside out, are told; others aren't."""

from pathlib import Path

import pytest

from course.base.errors import CourseWarning
from course.engine.functions.effects import PROJECT
from tests.conftest import MakeScene

CORNERS = "".join(f"v {x} {y} {z}\n" for x in (0, 3) for y in (0, 3) for z in (-3, 0))
FACES = ["1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"]
"""Of a cube, wound so that they look outwards."""


def turned(face: str) -> str:
    return " ".join(reversed(face.split()))


def cube(faces: list[str]) -> str:
    return CORNERS + "".join(f"f {face}\n" for face in faces)


def parted(faces: list[str]) -> str:
    """With vertices of its own for each face, as at a seam of normals."""
    rows = CORNERS.splitlines()
    listed = [[rows[int(k) - 1] for k in face.split()] for face in faces]
    return "".join("\n".join([*four, "f -4 -3 -2 -1", ""]) for four in listed)


WRONG = {
    "inside out": (cube([turned(face) for face in FACES]), "it is inside out"),
    "a side is missing": (cube(FACES[:5]), "it is open at 4 edges"),
    "a side is turned": (cube([*FACES[:5], turned(FACES[5])]), "triangles at 4 edges are wound"),
    "parted, a side is missing": (parted(FACES[:5]), "it is open at 4 edges"),
}


def load(make_scene: MakeScene, folder: Path, text: str, material: str = "glass") -> None:
    (folder / "cube.obj").write_text(text, encoding="utf-8")
    materials = {"glass": {"color": 0, "dielectric": {"refraction_index": 1.5}}, "paint": {}}
    thing = {"shape": "mesh", "file": "cube.obj", "material": material}
    make_scene(materials=materials, objects=[thing])


@pytest.mark.parametrize(("text", "told"), WRONG.values(), ids=WRONG.keys())
def test_glass_without_an_inside_is_told(
    make_scene: MakeScene, tmp_path: Path, text: str, told: str
) -> None:
    with pytest.warns(CourseWarning, match=rf":\d+: cube.obj is of glass, glass, but .*{told}"):
        load(make_scene, tmp_path, text)
    load(make_scene, tmp_path, text, "paint")


@pytest.mark.parametrize("text", [cube(FACES), parted(FACES), cube(FACES[:1])])
def test_closed_glass_and_one_flat_side_are_not_told(
    make_scene: MakeScene, tmp_path: Path, text: str
) -> None:
    load(make_scene, tmp_path, text)


TUMBLER = {"glass": None, "water_in_glass": "glass", "water": None}
"""Of ``scenes/tumbler``: what lies around each."""


def load_tumbler(make_scene: MakeScene, **speeds: float) -> None:
    def clear(around: str | None) -> dict[str, object]:
        return {"color": 0, "dielectric": {"refraction_index": 1.4, "surrounded_by": around}}

    folder = PROJECT / "scenes" / "tumbler"
    things = [
        {
            "shape": "mesh",
            "file": str(folder / f"{name}.ply"),
            "material": name,
            "motion": {"velocity": [speed, 0, 0]},
        }
        for name, speed in speeds.items()
    ]
    make_scene(materials={name: clear(around) for name, around in TUMBLER.items()}, objects=things)


def test_meshes_that_close_each_other_are_not_told(make_scene: MakeScene) -> None:
    load_tumbler(make_scene, **dict.fromkeys(TUMBLER, 1.0))


@pytest.mark.parametrize("left", [*TUMBLER])
def test_a_mesh_that_moves_by_itself_is_told(make_scene: MakeScene, left: str) -> None:
    with pytest.warns(CourseWarning, match="it is open at 96 edges") as told:
        load_tumbler(make_scene, **dict.fromkeys(TUMBLER, 1.0) | {left: 0.5})
    # A flat side alone is taken for where glass begins.
    named = {name for name in TUMBLER if any(f"/{name}.ply" in str(one.message) for one in told)}
    assert named == {"glass", "water_in_glass"}
