"""`--effects mine`: the student's functions where they are written, and the solutions' where they aren't."""

import json
import shutil
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image

from course import EffectError, Scene, load_scene, pixel, render
from course.base.errors import CourseWarning
from course.cli.main import commands
from course.engine.core.types import Floats32
from course.engine.functions.effects import (
    PROJECT,
    Alone,
    Effects,
    NothingWritten,
    written_in,
)
from course.engine.functions.modules import COURSE
from course.engine.functions.signatures import CONTRACTS
from course.engine.functions.stand_ins import STAND_INS
from course.engine.render.sections import receipt_sections
from course.engine.scene.scene import load_variant
from tests.coarser import coarser
from tests.conftest import MakeScene

SCENE = PROJECT / "scenes" / "glossy.yaml"
SMALL: Any = {"size": (24, 16), "spp": 4}


def loaded(effects: str | Path | Effects, path: Path = SCENE) -> Scene:
    """A scene of the course, with fewer triangles."""
    return load_variant(path, coarser(path), effects)


MIRRORED = '''

def sample_phong_lobe(direction, exponent, u):
    """Without any jitter."""
    return direction.copy()
'''


@pytest.fixture
def mine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to work in, with one function written."""
    folder = tmp_path / "assignments"
    shutil.copytree(PROJECT / "assignments", folder)
    with (folder / "glossy.py").open("a") as file:
        file.write(MIRRORED)
    monkeypatch.chdir(tmp_path)
    return folder


@pytest.mark.usefixtures("mine")
def test_a_picture_has_the_functions_that_are_written() -> None:
    effects = Effects("mine")
    assert effects.mixed
    found = effects.function("glossy", "sample_phong_lobe")
    way = np.array([[0.0], [0.6], [0.8]], np.float32)
    assert np.array_equal(found(way, 9.0, np.full((2, 1), 0.3, np.float32)), way)
    solution = Effects("solutions").function("glossy", "keep_above")
    other = effects.function("glossy", "keep_above")
    assert other.__code__.co_filename == solution.__code__.co_filename
    pictures = [render(loaded(e), **SMALL) for e in ("mine", "solutions")]
    assert not np.array_equal(*(picture.linear for picture in pictures))
    told = pictures[0].receipt.to_dict()["effects"]
    assert told["yours"] == ["glossy.sample_phong_lobe"]
    assert "soft_shadows.point_on_sphere" in told["called"]
    assert "yours" not in pictures[1].receipt.to_dict()["effects"]


def test_without_a_written_function_it_is_the_solutions_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "assignments").mkdir()
    monkeypatch.chdir(tmp_path)
    scene = loaded("mine")
    found, wanted = (render(each, **SMALL) for each in (scene, loaded("solutions")))
    assert np.array_equal(found.linear, wanted.linear)
    assert found.receipt.to_dict()["effects"]["yours"] == []


def test_alone_a_folder_has_stand_ins_though_there_be_solutions(mine: Path) -> None:
    effects = Alone(mine)
    way = np.array([[0.0], [0.6], [0.8]], np.float32)
    assert np.array_equal(
        effects.function("glossy", "sample_phong_lobe")(way, 9.0, np.zeros((2, 1), np.float32)), way
    )
    assert effects.function("glossy", "keep_above") is STAND_INS["glossy.keep_above"][0]
    told = render(loaded(effects), **SMALL).receipt.to_dict()["effects"]
    assert told["yours"] == ["glossy.sample_phong_lobe"]


def test_where_nothing_is_written_all_functions_are_stand_ins(mine: Path) -> None:
    effects = NothingWritten(mine)
    for function, (stand_in, _) in STAND_INS.items():
        assert effects.function(*function.split(".")) is stand_in


@pytest.mark.usefixtures("mine")
def test_a_pixel_is_told_with_the_functions_that_are_written() -> None:
    story = pixel(SCENE, 12, 9, effects="mine", **SMALL)
    assert story.to_dict()["yours"] == ["glossy.sample_phong_lobe"]
    picture = render(load_scene(SCENE, "mine"), **SMALL)
    assert np.array_equal(story.recording.linear[:, 0, 0], picture.film.linear[:, 9, 12])


@pytest.mark.usefixtures("mine")
def test_the_command_says_which_are_yours() -> None:
    arguments = ["render", str(SCENE), "--effects", "mine", "--size", "24x16", "--spp", "4"]
    result = CliRunner().invoke(commands, [*arguments, "-o", "a.png", "--receipt", "a.json"])
    assert result.exit_code == 0
    assert ["yours", "glossy.sample_phong_lobe"] in [
        line.split()[-2:] for line in result.stdout.splitlines()
    ]
    assert json.loads(Path("a.json").read_text())["effects"]["yours"]
    refused = CliRunner().invoke(
        commands, [*arguments, "--engine", "dask", "--address", "tcp://127.0.0.1:1"]
    )
    assert refused.exit_code == 1
    assert '"mine" is for renders on this machine' in refused.stderr


def test_a_mistake_is_still_told_with_its_line(mine: Path) -> None:
    with (mine / "glossy.py").open("a") as file:
        file.write("\n\ndef keep_above(direction, normal):\n    return direction[0]\n")
    with pytest.raises(EffectError, match=r"glossy\.keep_above .*glossy\.py:\d+\) returned"):
        render(loaded("mine"), **SMALL)
    (mine / "glossy.py").write_text("def keep_above(:\n")
    with pytest.raises(EffectError, match="SyntaxError"):
        loaded("mine")


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("def f():\n    raise NotImplementedError('m.f: not written yet')", set()),
        ("def f():\n    check()\n    raise NotImplementedError", set()),
        ("def f():\n    return 1", {"f"}),
        ("def f():\n    if x:\n        raise NotImplementedError\n    return 1", {"f"}),
        ("def f():\n    raise NotImplementedError\ndef f():\n    return 1", {"f"}),
        ("def f():\n    return 1\ndef f():\n    raise NotImplementedError", set()),
        ("def f():\n    return 1\n    raise NotImplementedError", {"f"}),
        ("def f():\n    def g():\n        return 1\n    raise NotImplementedError", set()),
        (
            "def f():\n    def g():\n        return 1\n    return g()\n    raise NotImplementedError",
            {"f"},
        ),
        ("from own import g as f", {"f"}),
        ("f = lambda: 1", {"f"}),
    ],
)
def test_a_function_is_written_unless_it_ends_as_a_stub_does(text: str, written: set[str]) -> None:
    assert written_in(text, "m") == written


def test_every_stub_of_the_course_is_one() -> None:
    for file in sorted((PROJECT / "assignments").glob("*.py")):
        solved = (PROJECT / "solutions" / file.name).read_text()
        assert not written_in(file.read_text(), file.stem) & set(COURSE[file.stem])
        assert written_in(solved, file.stem) >= set(COURSE[file.stem])


def test_a_folder_of_that_name_is_meant_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "mine").mkdir()
    monkeypatch.chdir(tmp_path)
    assert not Effects("mine").mixed


def test_assignments_of_the_current_folder_are_called_unless_it_is_the_projects(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(PROJECT)
    assert Effects().folder == Path("solutions")
    (tmp_path / "assignments").mkdir()
    monkeypatch.chdir(tmp_path)
    assert Effects().mixed
    assert Effects().folder == Path("assignments")


@pytest.fixture
def unsolved(mine: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder to work in, where no solutions are."""
    monkeypatch.setattr("course.engine.functions.effects.PROJECT", mine.parent)
    return mine


def test_what_the_renderer_calls_has_a_stand_in() -> None:
    assert CONTRACTS.keys() == STAND_INS.keys()


@pytest.mark.usefixtures("unsolved")
@pytest.mark.parametrize("name", ["gallery/everything", "glossy", "photon_mapping"])
def test_without_solutions_unwritten_functions_have_no_effect(name: str) -> None:
    effects = Effects()
    assert effects.mixed
    picture = render(loaded(effects, PROJECT / "scenes" / f"{name}.yaml"), **SMALL)
    assert np.isfinite(picture.linear).all()
    assert picture.linear.mean() > 0.05
    told = picture.receipt.to_dict()["effects"]
    yours = {"glossy.sample_phong_lobe"} & set(told["called"])
    assert set(told["yours"]) == yours
    assert told["stand-ins"].keys() == set(told["called"]) - yours


@pytest.mark.usefixtures("unsolved")
def test_a_lamp_without_its_function_is_a_point(make_scene: MakeScene) -> None:
    def picture(**lamp: object) -> Floats32:
        place = {"eye": [0, 3, 6], "look_at": [0, 0, 0]}
        things = [
            {"shape": "quad", "material": "grey"},
            {"shape": "sphere", "material": "grey", "transform": [{"translate": [0, 1, 0]}]},
        ]
        scene = make_scene(camera=place, lights=[lamp], objects=things, materials={"grey": {}})
        return render(load_scene(scene.path, "mine"), **SMALL).linear

    ball = picture(type="sphere", center=[3, 5, 0], radius=1, intensity=30)
    point = picture(type="point", position=[3, 5, 0], intensity=30)
    np.testing.assert_allclose(ball, point, rtol=1e-5, atol=1e-7)


@pytest.mark.usefixtures("unsolved")
def test_without_a_hierarchy_of_ones_own_embree_finds_the_same_hits() -> None:
    file = PROJECT / "scenes" / "bounding_volumes.yaml"
    picture = render(load_scene(file, "mine"), **SMALL)
    embrees = load_variant(file, {("acceleration", "type"): "embree"}, "mine")
    np.testing.assert_allclose(picture.linear, render(embrees, **SMALL).linear, atol=1e-3)
    told = picture.receipt.to_dict()["effects"]["stand-ins"]
    assert told["bounding_volumes.traverse"] == "Embree answers the rays, without your boxes"


def test_one_box_of_all_triangles_is_a_hierarchy() -> None:
    build = STAND_INS["bounding_volumes.build"][0]
    lo = np.random.default_rng(3).random((3, 9))
    hierarchy = build(lo, lo + 0.25, 4)
    solved = Effects("solutions").function("bounding_volumes", "traverse")
    corners = lo, lo + np.array([[0.25], [0], [0]]), lo + np.array([[0], [0.25], [0.25]])
    origins = np.array([[0.5], [0.5], [-3]]) + np.zeros((3, 9))
    directions = np.mean(corners, axis=0) - origins
    asked = STAND_INS["bounding_volumes.traverse"][0]
    for a, b in zip(
        solved(hierarchy, *corners, origins, directions)[:2],
        asked(hierarchy, *corners, origins, directions)[:2],
        strict=True,
    ):
        np.testing.assert_allclose(a, b, rtol=1e-5)


@pytest.mark.usefixtures("unsolved")
@pytest.mark.parametrize("solver", ["gather", "shoot"])
def test_without_radiosity_only_lamps_are_bright(solver: str) -> None:
    options = f"--method {solver} --patches 60 --split .5 --size 64x64 -o light.npz -o l.png"
    scene = str(PROJECT / "scenes/radiosity.yaml")
    told = CliRunner().invoke(commands, ["radiosity", scene, *options.split()])
    assert told.exit_code == 0, told.output
    assert "not written yet: surfaces pass no light on, so only lamps are bright" in told.output
    codes = np.asarray(Image.open("l.png").convert("L"), int)
    assert codes.max() > 200
    assert 0 < (codes > 10).mean() < 0.1


@pytest.mark.parametrize("name", ["point_on_spehre", "helper"])
def test_a_name_that_is_spelt_wrongly_is_pointed_out(tmp_path: Path, name: str) -> None:
    (tmp_path / "soft_shadows.py").write_text(f"def {name}(center, radius, u): return u\n")
    effects = Effects(tmp_path, filled=True)
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        effects.function("soft_shadows", "point_on_sphere")
    assert bool(told) == (name != "helper")
    assert all("has no point_on_sphere, and a point_on_spehre" in str(one.message) for one in told)


@pytest.mark.parametrize(
    "name", ["Glossy.py", "glossy (copy).py", "glossy.py.txt", "week 3/glossy.py"]
)
def test_a_file_that_is_missing_is_told_with_the_one_that_may_be_meant(
    mine: Path, name: str
) -> None:
    (mine / name).parent.mkdir(exist_ok=True)
    (mine / "glossy.py").rename(mine / name)
    with pytest.warns(
        CourseWarning, match="missing, so its functions count as not written"
    ) as told:
        Effects("mine").function("glossy", "sample_phong_lobe")
    assert len(told) == 1
    assert str(told[0].message).endswith(f"is it {Path('assignments', name)}?")


def test_a_copy_beside_a_file_is_no_matter(mine: Path) -> None:
    shutil.copy(mine / "glossy.py", mine / "glossy_old.py")
    (mine / "film.py").unlink()
    with warnings.catch_warnings():
        warnings.simplefilter("error", CourseWarning)
        assert Effects("mine").written("glossy", "sample_phong_lobe")
        assert not Effects("mine").written("film", "reinhard")


def test_functions_that_a_scene_does_not_call_are_told(mine: Path) -> None:
    # A plug-in that returns nonsense, and a picture that stays as it is, without a word.
    (mine / "quasi_monte_carlo.py").write_text(
        "def radical_inverse(base, i):\n    return i * 0.5\n", encoding="utf-8"
    )
    (mine / "film.py").write_text("def expose(radiance, stops):\n    return radiance\n")
    with (mine / "glossy.py").open("a") as file:
        file.write("\n\ndef orthonormal_basis(w):\n    return w, w\n")
    small = {**SMALL, "sampler": "halton"}
    receipt = render(loaded("mine"), **small).receipt.to_dict()
    told = receipt["effects"]
    assert "quasi_monte_carlo.halton" in told["called"]
    assert told["not called"] == [
        "glossy.orthonormal_basis",
        "quasi_monte_carlo.radical_inverse",
        "film",
    ]
    assert (
        told_row(receipt)
        == "glossy.orthonormal_basis, quasi_monte_carlo.radical_inverse, all of film"
    )
    solutions = render(loaded("solutions"), **small).receipt.to_dict()["effects"]
    assert "not called" not in solutions


def told_row(receipt: dict[str, Any]) -> str:
    """What the command's table says of functions that were not called."""
    rows = dict(receipt_sections(receipt))["effects"]
    return next(value for label, value in rows if label == "not called")
