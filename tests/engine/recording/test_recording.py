"""What is recorded is what was rendered: the same bits, all of the light, every ray and every call."""

import shutil
import subprocess
import sys
from collections import Counter
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from course import CourseError, EffectError, Picture, Scene, load_scene, render
from course.engine.core.types import Floats64
from course.engine.functions.effects import PROJECT, Effects
from course.engine.recording import recording as rooms
from course.engine.recording.recording import Recording, record
from course.engine.recording.segments import Names, Segment
from course.engine.recording.stages import RecordedEffects
from course.engine.scene.scene import load_variant
from tests.conftest import MakeScene
from tests.lengths import share

SCENES = sorted(path.stem for path in (PROJECT / "scenes").glob("*.yaml"))
SIZE, SPP = (16, 12), 17
"""Two passes, the second a short one."""

SMALL = (8, 6)
"""Where every pixel is recorded."""

OF_ITS_OWN = {"adaptive_sampling"}
"""Scenes whose pixels have no samples of their own."""


@cache
def scene_of(name: str, sampler: str | None = "sobol") -> Scene:
    overrides = {} if sampler is None else {("sampler", "type"): sampler, ("film", "filter"): "box"}
    effects = RecordedEffects(Effects())
    return load_variant(PROJECT / "scenes" / f"{name}.yaml", overrides, effects)


def picture_and_recording(
    scene: Scene,
    x: int = 6,
    y: int = 4,
    width: int = 5,
    height: int = 4,
    size: tuple[int, int] = SIZE,
) -> tuple[Picture, Recording]:
    # A preview adds its samples up in other steps, for it needs their variance.
    picture = render(scene, size=size, spp=SPP, denoise=False)
    return picture, record(scene, x, y, width, height, size=size, spp=SPP)


def sums(recording: Recording) -> Floats64:
    """(3, pixels, samples) of what all segments brought."""
    area, total = recording.area, np.zeros(recording.radiance.shape)
    for one in recording.segments:
        x, y = one.pixel
        total[:, (y - area.y) * area.width + x - area.x, one.sample] += one.radiance
    return total


def check(picture: Picture, recording: Recording) -> None:
    area = recording.area
    assert np.array_equal(recording.linear, picture.film.linear[:, area.rows, area.columns])
    off = np.abs(sums(recording) - recording.radiance)
    assert off.max() <= 1e-6 * np.abs(recording.radiance).max()
    assert recording.segments


@pytest.mark.parametrize("name", share([name for name in SCENES if name not in OF_ITS_OWN], 3))
def test_a_recording_has_the_bits_of_the_picture_and_all_of_its_light(name: str) -> None:
    check(*picture_and_recording(scene_of(name)))


@pytest.mark.parametrize("name", ["importance_sampling", "quasi_monte_carlo", "sampling"])
def test_so_it_does_where_pixels_are_rendered_together(name: str) -> None:
    picture, recording = picture_and_recording(scene_of(name, None))
    check(picture, recording)
    assert not recording.alone


def test_so_it_does_where_a_hit_chooses_one_of_several_lights(make_scene: MakeScene) -> None:
    lamp = {"type": "sphere", "radius": 0.2, "intensity": 2}
    scene = make_scene(
        camera={"eye": [0, 2, 3], "look_at": [0, 0, 0]},
        materials={"grey": {"color": 0.5, "specular": 0.2}},
        integrator={"light_sampling": "power"},
        objects=[{"shape": "quad", "material": "grey", "width": 6, "depth": 6}],
        lights=[lamp | {"center": [x, 1, 0]} for x in (-1, 0.2, 1)],
    )
    picture, recording = picture_and_recording(scene)
    check(picture, recording)
    lit = [one for one in recording.segments if one.kind == "shadow"]
    assert {one.light for one in lit} == {"light 0", "light 1", "light 2"}
    assert len(lit) == sum(one.kind == "camera" for one in recording.segments)


WITH_ALL_KINDS = [
    "blurred_transparency",
    "glossy",
    "importance_sampling",
    "path_tracing",
    "soft_shadows",
]


@pytest.mark.parametrize("name", WITH_ALL_KINDS)
def test_every_ray_of_the_receipt_is_recorded(name: str) -> None:
    # The shadow ray of a round mesh may have another one, from its facet up to where it begins.
    facets = {("sampler", "type"): "sobol", ("integrator", "terminator"): "facets"}
    scene = load_variant(PROJECT / "scenes" / f"{name}.yaml", facets, RecordedEffects(Effects()))
    picture, recording = picture_and_recording(scene, 0, 0, *SMALL, size=SMALL)
    receipt = picture.receipt.to_dict()
    kinds = Counter(one.kind for one in recording.segments)
    rays = receipt["rays"]
    assert kinds["camera"] == rays["camera"] == SMALL[0] * SMALL[1] * SPP
    assert kinds["shadow"] + kinds["environment"] == rays["shadow"]
    assert kinds["mirrored"] + kinds["refracted"] + kinds["bounce"] == sum(
        rays.get(kind, 0) for kind in ("reflection", "refraction", "path")
    )
    drawn = Counter(
        {
            number: sum(len(o.numbers.get(number, ())) for o in recording.segments)
            for number in receipt["numbers"]
        }
    )
    # A ray that is mirrored and refracted at rough glass draws the same numbers for both.
    twice = {"refraction"}
    for number, count in receipt["numbers"].items():
        assert drawn[number] == count or (number in twice and drawn[number] < count)
    assert dict(recording.counters.rays) == rays


def by_function(segments: list[Segment]) -> Counter[str]:
    return Counter(call.function for one in segments for call in one.calls)


@pytest.mark.parametrize("name", WITH_ALL_KINDS)
def test_every_call_that_was_asked_for_a_ray_is_told_with_one(name: str) -> None:
    _, recording = picture_and_recording(scene_of(name))
    told = by_function(recording.segments)
    assert told
    for function, count in told.items():
        assert count == recording.asked[function]


def test_functions_return_for_what_is_recorded_what_is_recorded() -> None:
    """A column of the arguments gives the column of the result: what is told of a ray is its own."""
    effects = Effects()
    for name, function, names in (
        ("soft_shadows", "soft_shadows.point_on_sphere", ("center", "radius", "u")),
        ("glossy", "glossy.sample_phong_lobe", ("direction", "exponent", "u")),
        ("path_tracing", "path_tracing.diffuse_bounce", ("normal", "u")),
        ("thin_lens", "thin_lens.point_on_disk", ("u",)),
    ):
        _, recording = picture_and_recording(scene_of(name), 4, 4, 8, 4)
        calls = [c for o in recording.segments for c in o.calls if c.function == function]
        assert calls
        for call in calls[:40]:
            arguments = [
                np.array(call.arguments[n], np.float32).reshape(-1, *[1] * (n != "center"))
                if isinstance(call.arguments[n], list)
                else call.arguments[n]
                for n in names
            ]
            (told,) = call.results.values()
            found = effects.function(*function.split("."))(*arguments)[:, 0]
            # On a disk two in one place: what the camera does with it is done in place.
            np.testing.assert_allclose(found, told, rtol=2e-5, atol=1e-6)


def test_a_ray_is_told_with_the_functions_that_chose_it() -> None:
    _, recording = picture_and_recording(scene_of("glossy"))
    for one in recording.segments:
        functions = {call.function.partition(".")[0] for call in one.calls}
        assert (
            functions
            <= {
                "camera": {"soft_shadows"},
                "shadow": {"soft_shadows"},
                "mirrored": {"glossy", "soft_shadows"},
            }[one.kind]
        )
        for call in one.calls:
            if one.kind == "shadow" and not one.blocked:
                frame = recording.scene.compiled.frame
                point = np.array(call.results["the points"]) * frame.scale + frame.center
                np.testing.assert_allclose(one.end, point, atol=1e-4 * frame.scale)


def test_segments_hang_together() -> None:
    _, recording = picture_and_recording(scene_of("path_tracing"))
    segments = recording.segments
    assert [one.number for one in segments] == list(range(len(segments)))
    for one in segments:
        if one.parent is None:
            assert one.kind == "camera"
            continue
        parent = segments[one.parent]
        assert parent.number < one.number
        assert (parent.pixel, parent.sample) == (one.pixel, one.sample)
        assert one.depth == parent.depth + (one.light is None)
        assert one.before == parent.after
        np.testing.assert_allclose(one.start, parent.end, atol=1e-3)


def test_blocked_rays_end_at_what_blocks_them() -> None:
    _, recording = picture_and_recording(scene_of("soft_shadows"), 0, 0, *SIZE)
    scene = recording.scene
    names = Names(scene).parts
    blocked = [one for one in recording.segments if one.blocked]
    assert len({one.met for one in blocked}) > 1
    for one in blocked:
        low, high = scene.compiled.bounds[names.index(one.met)]
        assert ((low - 1e-3 <= one.end) & (np.array(one.end) <= high + 1e-3)).all()
        assert one.radiance == (0, 0, 0)


MIXING = "return _own(center, radius, np.roll(u, 7, axis=1))"
COUNTING = "_calls.append(1); return _own(center, radius, u / len(_calls))"


def of_a_student(folder: Path, body: str) -> Scene:
    """A scene with functions of one's own: the solutions, but for `point_on_sphere`."""
    for path in (PROJECT / "solutions").glob("*.py"):
        shutil.copy(path, folder)
    with (folder / "soft_shadows.py").open("a") as file:
        file.write(
            "\n\n_own = point_on_sphere\n_calls = []\n\n\n"
            f"def point_on_sphere(center, radius, u):\n    {body}\n"
        )
    return load_scene(PROJECT / "scenes" / "soft_shadows.yaml", folder)


def test_students_functions_are_asked_for_the_whole_tile(tmp_path: Path) -> None:
    """A function that mixes columns gives other pictures for other batches: the picture is to be told."""
    picture, recording = picture_and_recording(of_a_student(tmp_path, MIXING))
    check(picture, recording)
    assert not recording.alone


@pytest.mark.parametrize(
    ("body", "pixel", "alone"),
    [
        ("return _own(center, radius, u)", (9, 7), True),
        ("return _own(center, radius, u)", (0, 0), False),
        (MIXING, (9, 7), False),
        (COUNTING, (9, 7), False),
        ("return _own(center, radius, np.repeat(u[:, :1], u.shape[1], axis=1))", (9, 7), False),
    ],
)
def test_in_haste_a_pixel_is_rendered_alone_where_others_make_no_difference(
    tmp_path: Path, body: str, pixel: tuple[int, int], alone: bool
) -> None:
    scene = of_a_student(tmp_path, body)
    quick = record(scene, *pixel, size=SIZE, spp=SPP, quick=True)
    assert quick.alone == alone
    if body != COUNTING:
        whole = record(scene, *pixel, size=SIZE, spp=SPP)
        assert np.array_equal(quick.radiance, whole.radiance)
        assert len(quick.segments) == len(whole.segments)


def test_a_scene_that_was_recorded_costs_nothing_afterwards(make_scene: MakeScene) -> None:
    light = {"type": "sphere", "center": [0, 3, 0], "radius": 1, "intensity": 9}
    scene = make_scene(lights=[light], objects=[{"shape": "sphere", "material": "grey"}])
    record(scene, 16, 16)
    assert not isinstance(scene.effects, RecordedEffects)
    noted = rooms.recordable(scene)
    assert rooms.recordable(noted) is noted
    assert isinstance(noted.effects, RecordedEffects)
    record(noted, 16, 16)
    assert noted.effects.recorder is None


def test_a_render_knows_nothing_of_recorders() -> None:
    code = (
        "import sys; from course import load_scene, render; "
        f"render(load_scene({str(PROJECT / 'scenes' / 'soft_shadows.yaml')!r}), spp=1, size=(8, 8)); "
        "assert not [name for name in sys.modules if name.startswith('course.engine.recording')]"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_what_cannot_be_recorded_is_told(make_scene: MakeScene) -> None:
    scene = make_scene()
    for x, y in ((32, 0), (0, 32), (-1, 0)):
        with pytest.raises(CourseError, match=r"outside the picture: expected x from 0 to 31"):
            record(scene, x, y)
    with pytest.raises(CourseError, match=r"pixel 1\.5,2: 1\.5 is no whole number"):
        record(scene, 1.5, 2)  # type: ignore[arg-type]
    with pytest.raises(CourseError, match=r"65,536 samples are too many.*--spp"):
        record(scene, 0, 0, 32, 32, spp=64)
    with pytest.raises(CourseError, match=r"film\.subdivision"):
        record(scene_of("adaptive_sampling", None), 0, 0)
    scene = load_scene(PROJECT / "scenes" / "soft_shadows.yaml", "assignments")
    with pytest.raises(EffectError, match=r"not written yet.*lights\.\d"):
        record(scene, 0, 0)
