"""A function that a scene needs and that is not written yet is named, with the key of the scene that asks for it."""

import re
from pathlib import Path
from typing import Any

import pytest

from course import EffectError, load_scene, render
from course.engine.functions.effects import PROJECT
from tests.conftest import MakeScene
from tests.tables import put, rows

ASKED = rows("""
camera/lens -> {aperture_radius: 0.1, focus_distance: 2} | thin_lens.lens_rays: camera.lens.aperture_radius
objects/0/motion -> {velocity: [1, 0, 0]} | motion_blur.shutter_times: objects.0.motion
lights/0 -> {type: sphere, center: [0, 3, 0], radius: 1, intensity: 9} | soft_shadows.point_on_sphere: lights.0
materials/grey -> {mirror: 1, gloss: {lobe: plane, roughness: 0.1}} | glossy.jitter_on_plane: materials.grey.gloss
materials/grey -> {dielectric: {roughness: 0.1}} |
    blurred_transparency.jitter_refraction: materials.grey.dielectric.roughness
materials/grey -> {dielectric: {roughness: 0.1, distribution: ggx}} |
    microfacets.sample_visible_normal: materials.grey.dielectric.roughness
acceleration -> {type: hierarchy} | bounding_volumes.build: acceleration.type
environment -> {type: constant, radiance: 1, lights: true, sampling: cosine} |
    importance_sampling.cosine_hemisphere: environment.sampling
environment -> {type: constant, radiance: 1, lights: true, sampling: alias} |
    environment_light.draw_alias: environment.sampling
lights/0 -> {type: sphere, center: [0, 3, 0], radius: 1, intensity: 9, samples: ball by polar} |
    sampling.ball_by_polar: lights.0
film/subdivision -> {threshold: 0.1} | adaptive_sampling.needs_subdivision: film.subdivision
film/denoise -> {level: 0.1} | denoising.critical_value: film.denoise
integrator -> {type: path} | path_tracing.diffuse_bounce: integrator.type
sampler -> {type: halton, samples: 4} | quasi_monte_carlo.halton: sampler.type
sampler -> {type: blue_noise, samples: 4} | blue_noise.shuffled_z_order: sampler.type
""")


@pytest.mark.parametrize(("place", "value", "asked"), ASKED)
def test_a_function_that_is_not_written_is_named_with_the_key_that_asks(
    make_scene: MakeScene, tmp_path: Path, place: str, value: str, asked: str
) -> None:
    parts: dict[str, Any] = {
        "camera": {"eye": [0, 2, 1], "look_at": [0, 0, 0]},
        "film": {"width": 8, "height": 8},
        "environment": {"type": "constant", "radiance": 1},
        "lights": [{"type": "point", "position": [0, 3, 0], "intensity": 9}],
        "objects": [{"shape": "quad", "material": "grey"}],
        "materials": {"grey": {}},
    }
    put(parts, place, value)
    path = make_scene(**parts).path
    function, key = asked.split(": ")
    module, name = function.split(".")
    mine = tmp_path / "mine"
    mine.mkdir()
    for file in (PROJECT / "solutions").glob("*.py"):
        (mine / file.name).write_bytes(file.read_bytes())
    with (mine / f"{module}.py").open("a", encoding="utf-8") as file:
        file.write(
            f"\ndef {name}(*_):\n    raise NotImplementedError('{function}: not written yet')\n"
        )
    told = rf"{re.escape(function)}.*scene\.yaml:1: {re.escape(key)} asks for it"
    with pytest.raises(EffectError, match=told):
        render(load_scene(path, mine))
