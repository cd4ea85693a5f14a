"""The compiled walk down a light tree chooses the same lamps as the course's function, with the same bits."""

from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from course import render
from course.engine.core.types import Functions
from course.engine.functions.effects import PROJECT, Effects
from course.engine.loops import embree_device
from course.engine.terms.lights.light_tree import Tree, TreeChoice, walk_of
from tests.conftest import MakeScene
from tests.engine.terms.lights.test_light_choice import POINTS, SUNS, WITH_A_SIZE, seen

if not embree_device.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

from course.engine.loops.light_tree import compiled_choice

SOLUTIONS = Effects(PROJECT / "solutions")
MANY_LIGHTS = Functions(
    **{name: SOLUTIONS.function("many_lights", name) for name in ("light_tree", "tree_choice")}
)
KINDS = ("points", "boxes", "one side", "at one place", "dark")


def tree_of(lamps: int, kind: str, dtype: Any = np.float32) -> Tree:
    rng = np.random.default_rng(lamps)
    lo = rng.uniform(-1, 1, (3, lamps))
    size = rng.uniform(0, 0.3, (3, lamps)) * (kind in ("boxes", "one side"))
    axis, angle = rng.normal(size=(3, lamps)), np.full(lamps, np.pi)
    power = rng.uniform(0, 1, lamps)
    if kind == "one side":
        angle = rng.choice([0, 0.3, 1.5, 2.9], lamps)
    if kind == "at one place":
        lo[:] = lo[:, :1]
    if kind == "dark":
        power[lamps // 2 :] = 0
    arrays = lo, lo + size, axis / np.linalg.norm(axis, axis=0), angle, power
    # In float32 pi is rounded up.
    found: Tree = MANY_LIGHTS.light_tree(
        *(np.minimum(array, np.pi).astype(dtype) for array in arrays)
    )
    return found


def choice_of(tree: Tree, functions: Functions = MANY_LIGHTS) -> TreeChoice:
    inside, nothing = np.arange(len(tree[5])), np.empty(0, np.intp)
    return TreeChoice(
        (),
        many_lights=functions,
        tree=tree,
        inside=inside,
        outside=nothing,
        powers=np.ones(1, np.float32),
        walk=walk_of(tree, functions),
    )


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("lamps", [1, 2, 3, 7, 64, 1000])
def test_the_same_lamps(lamps: int, kind: str) -> None:
    choice = choice_of(tree_of(lamps, kind))
    loop = compiled_choice(choice)
    assert isinstance(loop, TreeChoice)
    assert loop is not choice
    rng, n = np.random.default_rng(1), 5003
    p, normal = rng.uniform(-1.5, 1.5, (3, n)), rng.normal(size=(3, n))
    normal /= np.linalg.norm(normal, axis=0)
    # On lamps and on corners of boxes, and normals along axes.
    assert choice.tree is not None
    corners = choice.tree[0][:, :200]
    p[:, : corners.shape[1]] = corners
    normal[:, 100:400] = np.eye(3)[:, rng.integers(0, 3, 300)]
    u = rng.random(n, np.float32)
    u[400:600] = rng.choice(np.array([0, 0.5, 1 - 2.0**-24], np.float32), 200)
    for columns in (slice(None), slice(0, 0), slice(None, None, 3)):
        hits: Any = SimpleNamespace(
            near_origin=p[:, columns].astype(np.float32), ns=normal[:, columns].astype(np.float32)
        )
        for mine, theirs in zip(
            choice.choose(hits, u[columns]), loop.choose(hits, u[columns]), strict=True
        ):
            assert (mine.shape, mine.dtype) == (theirs.shape, theirs.dtype)
            assert mine.tobytes() == theirs.tobytes()


def test_a_student_s_walk_and_a_tree_in_double_precision_are_left_alone() -> None:
    own = Functions(tree_choice=partial(MANY_LIGHTS.tree_choice))
    for choice in (choice_of(tree_of(7, "boxes"), own), choice_of(tree_of(7, "boxes", np.float64))):
        assert compiled_choice(choice) is choice
    assert compiled_choice(None) is None


def test_renders_of_a_scene_share_what_is_known_of_its_lights() -> None:
    choice = choice_of(tree_of(7, "boxes"))
    assert compiled_choice(choice) is compiled_choice(choice)


def test_pictures_keep_their_bits(make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch) -> None:
    """Beside the same passes with the walk in NumPy."""
    for lights in (POINTS, POINTS + WITH_A_SIZE + SUNS):
        scene = seen(make_scene, lights, "tree")
        picture = render(scene, spp=16, compiled=True).linear
        with monkeypatch.context() as patch:
            patch.setattr("course.engine.loops.engine.compiled_choice", lambda choice: choice)
            known = render(scene, spp=16, compiled=True).linear
        assert known.any()
        assert picture.tobytes() == known.tobytes()
