"""A scene that uses the whole format, and ways to load a changed copy of it."""

from collections.abc import Callable
from pathlib import Path

import pytest

from course.base.errors import SceneError
from course.engine.formats.yaml.loading import Loaded, load_description

GOOD = """\
title: everything
seed: 7
camera:
  eye: [0, 1, 5]
  look_at: [0, 0.5, 0]
  up: [0, 1, 0]
  vertical_fov: 35
film: {width: 64, height: 48, filter: gaussian, sigma: 0.2}
sampler: {type: jittered, samples: 9}
integrator: {max_depth: 3, cutoff: 1e-3}
environment: {type: constant, radiance: [0.1, 0.2, 0.3]}
materials:
  red: {color: [1, 0, 0], ambient: 0.1, diffuse: 0.9, specular: 0.5, exponent: 64}
  mirror: {mirror: 0.9}
  glass:
    dielectric: {refraction_index: 1.5, absorption: [0.1, 0, 0.2]}
lights:
  - {type: ambient, radiance: 0.1}
  - {type: point, position: [1, 2, 3], intensity: [10, 20, 30]}
  - {type: directional, direction: [0, -1, 0], irradiance: 1}
  - {type: rectangle, corner: [0, 3, 0], edge_u: [1, 0, 0], edge_v: [0, 0, 1], radiance: 5}
  - {type: sphere, center: [0, 4, 0], radius: 0, intensity: 3}
objects:
  - {shape: quad, material: red, width: 10, depth: 10}
  - shape: box
    name: the box
    material: mirror
    size: [1, 2, 3]
    transform:
      - translate: [0, 1, 0]
      - scale: -2
      - rotate: {axis: [0, 1, 0], degrees: 30}
  - {shape: sphere, material: glass, radius: 0.5, segments: 32, shading: flat}
  - {shape: disk, material: red}
  - {shape: cylinder, material: red}
  - {shape: cone, material: red}
  - {shape: torus, material: red}
  - {shape: torus_knot, material: red, p: 3, q: 4}
  - {shape: displaced_sphere, material: red}
  - {shape: height_field, material: red, size: [2, 3], transform: [{scale: [1, 2, 1]}]}
  - {shape: mesh, material: red, file: bunny.ply}
"""


@pytest.fixture(scope="session")
def good() -> str:
    return GOOD


@pytest.fixture
def load(tmp_path: Path) -> Callable[[str | bytes], Loaded]:
    """Write a scene file and load it."""

    def _load(content: str | bytes) -> Loaded:
        path = tmp_path / "scene.yaml"
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return load_description(path)

    return _load


@pytest.fixture
def refusal(load: Callable[[str | bytes], Loaded], tmp_path: Path) -> Callable[[str | bytes], str]:
    """Message with which a scene file is refused, without its folder."""

    def _refusal(content: str | bytes) -> str:
        with pytest.raises(SceneError) as caught:
            load(content)
        message = str(caught.value)
        assert "\n" not in message
        return message.replace(str(tmp_path / "scene.yaml"), "scene.yaml")

    return _refusal


@pytest.fixture
def refusal_of(good: str, refusal: Callable[[str | bytes], str]) -> Callable[[str, str], str]:
    """Message after one change to the good scene; the text to replace occurs exactly once."""

    def _refusal_of(old: str, new: str) -> str:
        assert good.count(old) == 1, old
        return refusal(good.replace(old, new))

    return _refusal_of
