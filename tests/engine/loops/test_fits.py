"""Which scenes the fused loop takes, and that numbers and camera rays as arrays give the same pictures."""

import pkgutil
from dataclasses import fields, is_dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT, Effects
from course.engine.loops import embree_device, numpy_loops
from course.engine.loops.fits import (
    KNOWN,
    OF_KEYS,
    fits,
    known_part,
    lists_all_fields,
    makes_camera_rays,
    placed_before,
)
from course.engine.render.binding import bind
from course.engine.render.render import render
from course.engine.scene.scene import Scene, load_scene
from course.engine.terms.samplers import FUNCTIONS
from tests.conftest import MakeScene
from tests.forms import needs_numba
from tests.lengths import fewer

SCENES = PROJECT / "scenes"
OTHERS = [name for name in FUNCTIONS if name != "sobol"]


@cache
def scene_of(name: str) -> Scene:
    return load_scene(SCENES / f"{name}.yaml")


def bound(scene: Scene, **changed: Any) -> Any:
    from dataclasses import replace

    return bind(scene, replace(scene.settings, **changed))


ALL = [*KNOWN, *(pkgutil.resolve_name(name) for name in OF_KEYS)]


@pytest.mark.parametrize("kind", ALL, ids=lambda kind: kind.__name__)
def test_all_fields_of_a_part_that_fits_are_listed(kind: type) -> None:
    """Who adds a field says in the list what the loop does with it; until then no scene with the part fits."""
    assert lists_all_fields(kind)
    if is_dataclass(kind):
        known = known_part(kind)
        assert known is not None
        listed = f"{known.parts} {known.values} {known.absent}".split()
        assert set(listed) <= {each.name for each in fields(kind)} | {"limit", "color"}


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("soft_shadows", True),
        ("motion_blur", True),
        ("path_tracing", True),
        ("textures", True),
        ("gallery/stage", True),
        ("many_lights", False),
        ("microfacets", False),
        ("bounding_volumes", False),
    ],
)
def test_scenes_of_the_course(name: str, expected: bool) -> None:
    assert fits(bound(scene_of(name), sampler="sobol")) == expected


def test_a_part_of_an_unknown_type_does_not_fit() -> None:
    tracer = bound(load_scene(SCENES / "soft_shadows.yaml"), sampler="sobol")
    assert fits(tracer)
    light = tracer.integrator.direct.lights[0]
    # A subclass may do anything else; so it is another type.
    other = type("Other", (type(light),), {})(
        **{each.name: getattr(light, each.name) for each in fields(light)}
    )
    object.__setattr__(tracer.integrator.direct, "lights", (other,))
    assert not fits(tracer)


@fewer
@needs_numba
@pytest.mark.parametrize("sampler", OTHERS)
@pytest.mark.parametrize("name", ["glossy", "thin_lens", "motion_blur"])
def test_other_samplers_are_drawn_as_arrays(name: str, sampler: str) -> None:
    scene = scene_of(name)
    size = (32, 24) if FUNCTIONS[sampler][0][0] == "blue_noise" else (30, 20)
    options: dict[str, Any] = {"spp": 16, "size": size, "sampler": sampler, "seed": 3}
    tracer = bound(scene, sampler=sampler, samples=16)
    assert fits(tracer)
    assert not makes_camera_rays(tracer)
    loop = render(scene, compiled=True, threads=2, **options)
    batches = render(scene, compiled=False, threads=1, **options)
    assert np.array_equal(loop.linear, batches.linear)
    assert loop.receipt.rays == batches.receipt.rays
    assert loop.receipt.numbers == batches.receipt.numbers


class Swapped(Effects):
    """The solutions, some of them in a form that is nobody's own: as a student's would be."""

    def __init__(self, *names: str) -> None:
        super().__init__("solutions")
        self._names = names

    def function(self, module: str, name: str) -> Any:
        """See ``Effects``."""
        function = super().function(module, name)
        return partial(function) if f"{module}.{name}" in self._names else function


OWN = {
    "thin_lens": ("thin_lens.point_on_disk", "thin_lens.lens_rays"),
    "motion_blur": ("motion_blur.shutter_times",),
    "supersampling": ("supersampling.jittered", "supersampling.resolve"),
}


@needs_numba
@pytest.mark.parametrize("module", OWN)
def test_a_students_lens_shutter_and_pixel_functions_make_rays_for_the_loop(module: str) -> None:
    scene = load_scene(SCENES / f"{module}.yaml", Swapped(*OWN[module]))
    sampler = "jittered" if module == "supersampling" else "sobol"
    tracer = bound(scene, sampler=sampler)
    assert fits(tracer)
    assert not makes_camera_rays(tracer)
    options: dict[str, Any] = {"spp": 16, "size": (30, 20), "sampler": sampler}
    loop = render(scene, compiled=True, threads=1, **options)
    assert loop.linear.any()
    assert np.array_equal(loop.linear, render(scene, compiled=False, **options).linear)


class Elsewhere(Effects):
    """The solutions, but points on lights lie a little beside them: nothing that a loop of ours could make up."""

    def function(self, module: str, name: str) -> Any:
        """See ``Effects``."""
        function = super().function(module, name)
        if not name.startswith("point_"):
            return function
        return lambda *arguments: function(*arguments) + np.float32(0.05)


LAMPS: dict[str, dict[str, Any]] = {
    "sphere": {"type": "sphere", "radius": 0.4, "intensity": 9},
    "ball": {"type": "sphere", "radius": 0.4, "intensity": 9, "samples": "ball"},
    "emitter": {"type": "sphere", "radius": 0.4, "radiance": 9, "samples": "sphere"},
    "moving": {"type": "sphere", "radius": 0.4, "intensity": 9, "motion": {"velocity": [1, 0, 0]}},
}
LAMPS = {name: lamp | {"center": [0.3, 2, 0.2]} for name, lamp in LAMPS.items()} | {
    "rectangle": {"type": "rectangle", "corner": [-0.5, 2, 0], "radiance": 9}
    | {"edge_u": [1, 0, 0], "edge_v": [0, 0, 1]},
}


@needs_numba
@pytest.mark.parametrize("sampler", ["sobol", "jittered"])
@pytest.mark.parametrize("lamp", LAMPS)
def test_a_students_points_on_lights_are_placed_for_the_loop(
    make_scene: MakeScene, tmp_path: Path, lamp: str, sampler: str
) -> None:
    """Two lamps, one behind the other in the arrays, over a floor that mirrors and a ball that throws a shadow."""
    parts: dict[str, Any] = {
        "camera": {"eye": [0, 1, 4], "look_at": [0, 0.5, 0], "shutter": {"open": 0, "close": 1}},
        "materials": {"grey": {}, "floor": {"mirror": 0.3}},
        "objects": [
            {"shape": "quad", "material": "floor", "width": 9, "depth": 9},
            {"shape": "sphere", "material": "grey", "radius": 0.5}
            | {"transform": [{"translate": [0, 0.5, 0]}]},
        ],
        "lights": [LAMPS[lamp], LAMPS["sphere"] | {"center": [-1, 3, 1]}],
        "integrator": {"max_depth": 2},
    }
    plain = make_scene(**parts)
    scene = load_scene(tmp_path / "scene.yaml", Elsewhere("solutions"))
    tracer = bound(scene, sampler=sampler, samples=16)
    assert fits(tracer)
    assert len(placed_before(tracer.integrator)) == 2
    options: dict[str, Any] = {"spp": 16, "size": (30, 20), "sampler": sampler}
    loop = render(scene, compiled=True, threads=1, **options)
    batches = render(scene, compiled=False, threads=1, **options)
    assert np.array_equal(loop.linear, batches.linear)
    assert loop.receipt.rays == batches.receipt.rays
    assert not np.array_equal(loop.linear, render(plain, **options).linear)


def test_points_of_many_depths_are_not_placed_for_paths_that_end_before(
    make_scene: MakeScene, tmp_path: Path
) -> None:
    for depth, few in ((5, True), (6, False)):
        make_scene(
            materials={"grey": {"mirror": 0.3}},
            objects=[{"shape": "quad", "material": "grey", "width": 9, "depth": 9}],
            lights=[LAMPS["sphere"]],
            integrator={"max_depth": depth},
        )
        scene = load_scene(tmp_path / "scene.yaml", Elsewhere("solutions"))
        assert fits(bound(scene, sampler="sobol")) == few


def test_a_students_other_functions_are_called_by_batches() -> None:
    for name, function in (
        ("motion_blur", "motion_blur.to_object_space"),
        ("glossy", "glossy.keep_above"),
        ("textures", "textures.rectangle_uv"),
        ("textures", "textures.sphere_uv"),
        ("textures", "textures.triangle_uv"),
        ("textures", "textures.texture_lookup"),
    ):
        scene = load_scene(SCENES / f"{name}.yaml", Swapped(function))
        assert not fits(bound(scene, sampler="sobol")), function


@pytest.mark.skipif(not embree_device.available(), reason="Numba is not installed")
def test_the_answer_reads_no_loop() -> None:
    """Numba takes half a second to be read: a scene that doesn't fit doesn't wait for it."""
    import subprocess
    import sys

    program = (
        "import sys; from course import load_scene; from course.engine.loops.fits import fits;"
        "from course.engine.render.binding import bind;"
        f"scene = load_scene({str(SCENES / 'microfacets.yaml')!r});"
        "assert not fits(bind(scene, scene.settings)); assert 'numba' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", program], check=True)


def test_without_numpys_own_loops_batches_render(monkeypatch: pytest.MonkeyPatch) -> None:
    """A NumPy that keeps them elsewhere: nothing is compiled that would call what isn't there."""
    monkeypatch.setattr(numpy_loops, "_FUNCTIONS", numpy_loops._DATA)
    for cached in (embree_device.available, numpy_loops.loops):
        cached.cache_clear()
    try:
        assert numpy_loops.loops() is None
        assert not embree_device.available()
        assert render(scene_of("soft_shadows"), spp=1, size=(8, 6)).linear.any()
        with pytest.raises(CourseError, match="a NumPy whose own loops are found"):
            render(scene_of("soft_shadows"), spp=1, size=(8, 6), compiled=True)
    finally:
        for cached in (embree_device.available, numpy_loops.loops):
            cached.cache_clear()
