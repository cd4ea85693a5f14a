"""The list of what is measured: every entry can be loaded, and says of itself what is true."""

import math

import numpy as np
import pytest

from course.benchmarking.estimators import BENCHED, Estimator, Module
from course.engine.core.types import Floats64
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.loading import load_description
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.modules import MODULES

ALL = [(module, estimator) for module in BENCHED.values() for estimator in module.estimators]
IDS = [f"{module.name}: {estimator.name}" for module, estimator in ALL]


def test_every_module_is_measured() -> None:
    assert list(BENCHED) == list(MODULES)


@pytest.mark.parametrize("module", BENCHED.values(), ids=list(BENCHED))
def test_names_are_unique_and_every_comparison_compares(module: Module) -> None:
    names = [estimator.name for estimator in module.estimators]
    assert len(set(names)) == len(names)
    for group in module.groups:
        labels = [e.label(group) for e in module.estimators if group in e.groups]
        assert len(labels) >= 3
        assert len(set(labels)) == len(labels)
    assert {group for e in module.estimators for group in e.groups} == set(module.groups)


@pytest.mark.parametrize(("module", "estimator"), ALL, ids=IDS)
def test_its_scenes_can_be_read(module: Module, estimator: Estimator) -> None:
    load_description(module.scene, estimator.overrides)
    load_description(module.scene, estimator.reference)


@pytest.mark.parametrize("module", BENCHED.values(), ids=list(BENCHED))
def test_an_integral_is_one_scene(module: Module) -> None:
    scenes: dict[str, d.SceneDescription] = {}
    for estimator in module.estimators:
        scene = load_description(module.scene, estimator.reference).description
        assert scenes.setdefault(estimator.integral, scene) == scene
    # And another integral is another scene.
    values = list(scenes.values())
    assert all(a != b for i, a in enumerate(values) for b in values[:i])


def test_an_estimator_that_is_not_biased_renders_its_reference_s_scene() -> None:
    for module, estimator in ALL:
        if estimator.biased:
            continue
        scene = load_description(module.scene, estimator.overrides).description
        assert scene == load_description(module.scene, estimator.reference).description


def test_points_on_the_light_are_those_of_the_grid() -> None:
    for module, estimator in ALL:
        scene = load_description(module.scene, estimator.overrides).description
        light = scene.lights[0] if scene.lights else None
        if isinstance(light, d.RectangleLight) and light.samples != "point":
            assert estimator.points == int(light.samples.removeprefix("grid ")) ** 2
            assert estimator.biased
        else:
            assert estimator.points == 1


def test_the_square_stands_where_the_ball_is_and_is_as_large_as_the_ball_looks() -> None:
    path = PROJECT / "scenes" / "soft_shadows.yaml"
    ball = load_description(path).description.lights[0]
    camera = load_description(path).description.camera
    square = next(e for e in BENCHED["soft_shadows"].estimators if e.variant == "square")
    light = load_description(path, square.overrides).description.lights[0]
    assert isinstance(ball, d.SphereLight)
    assert isinstance(light, d.RectangleLight)
    corner, u, v = (np.array(x) for x in (light.corner, light.edge_u, light.edge_v))
    view = np.array(camera.look_at) - np.array(ball.center)
    view /= np.linalg.norm(view)
    # To the three decimals that the numbers have.
    assert np.linalg.norm(u) * np.linalg.norm(v) == pytest.approx(
        math.pi * ball.radius**2, rel=0.01
    )
    assert corner + (u + v) / 2 == pytest.approx(np.array(ball.center), abs=0.001)
    assert [u @ v, u @ view, v @ view] == pytest.approx([0, 0, 0], abs=0.002)
    assert light.intensity == ball.intensity


@pytest.mark.parametrize("lobe", ["plane", "ball", "phong"])
def test_lobes_are_equally_wide(lobe: str) -> None:
    estimator = next(e for e in BENCHED["glossy"].estimators if e.variant == lobe)
    scene = load_description(BENCHED["glossy"].scene, estimator.overrides).description
    variance = {"floor": 1 / 900, "steel": 1 / 60, "gold": 1 / 60, "copper": 1 / 60}
    for name, expected in variance.items():
        directions = _reflected(scene.materials[name].gloss)
        # Lobes differ beyond the first order of small angles: by as much as the variance itself, a few times.
        found = (directions[:2] ** 2).mean()
        assert found == pytest.approx(expected, rel=0.01 + 4 * expected)


def _reflected(gloss: object) -> Floats64:
    """(3, N) unit directions about +z, at regular places of the lobe's numbers."""
    n = 60
    line = (np.arange(n) + 0.5) / n
    u2 = np.array(np.meshgrid(line, line)).reshape(2, -1)
    glossy = Effects("solutions").function
    match gloss:
        case d.PlaneLobe(roughness=edge):
            mirrored = np.repeat([[0.0], [0.0], [1.0]], u2.shape[1], axis=1)
            found = glossy("glossy", "jitter_on_plane")(mirrored, edge, u2)
        case d.BallLobe(glossiness=radius):
            u3 = np.array(np.meshgrid(line, line, line)).reshape(3, -1)
            mirrored = np.repeat([[0.0], [0.0], [1.0]], u3.shape[1], axis=1)
            found = glossy("glossy", "jitter_in_ball")(mirrored, radius, u3)
        case d.PhongLobe(exponent=exponent):
            mirrored = np.repeat([[0.0], [0.0], [1.0]], u2.shape[1], axis=1)
            found = glossy("glossy", "sample_phong_lobe")(mirrored, exponent, u2)
    return np.asarray(found, np.float64)
