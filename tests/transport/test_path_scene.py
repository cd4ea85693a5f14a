"""The scene of path tracing and its twin: they differ in the integrator alone, and only one calls the module."""

from __future__ import annotations

import numpy as np
import pytest
import yaml

from course import load_scene, render
from course.effects import PROJECT
from course.modules import COURSE

SCENES = PROJECT / "scenes"


@pytest.mark.parametrize(("folder", "calls"), [("", True), ("before", False)])
def test_only_the_scene_calls_the_module(folder: str, calls: bool) -> None:
    scene = load_scene(SCENES / folder / "path_tracing.yaml")
    receipt = render(scene, size=(16, 16), spp=4).receipt
    called = {name for name in receipt.effects["called"] if name.startswith("path_tracing.")}
    expected = {f"path_tracing.{function}" for function in COURSE["path_tracing"]}
    assert called == (expected if calls else set())
    assert ("path_tracing" in scene.effects.imported) == calls


def test_the_twins_differ_in_the_integrator_alone() -> None:
    after, before = (
        yaml.safe_load((SCENES / folder / "path_tracing.yaml").read_text(encoding="utf-8"))
        for folder in ("", "before")
    )
    assert after.pop("integrator") == {"type": "path", "max_depth": 40}
    assert before.pop("integrator") == {"type": "distribution", "max_depth": 40}
    assert after == before


def test_light_reaches_the_ceiling_and_gathers_below_the_glass() -> None:
    shown = [
        render(load_scene(SCENES / folder / "path_tracing.yaml"), size=(50, 50), spp=64).linear
        for folder in ("", "before")
    ]
    # Left of the lamp; and where the ball's shadow was, beneath the ball.
    ceiling, caustic = [
        [float(np.mean(picture[rows, columns])) for picture in shown]
        for rows, columns in ((slice(1, 3), slice(10, 16)), (slice(45, 47), slice(33, 38)))
    ]
    assert ceiling[1] == 0
    assert ceiling[0] > 0.05
    assert caustic[0] > 2 * caustic[1]
