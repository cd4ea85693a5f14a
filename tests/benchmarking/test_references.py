"""References: made once, kept by what decides them, resumed after an interruption, honest about their error."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import Picture, load_scene, render
from course.base.errors import CourseError, OutputError, SceneError
from course.benchmarking import references
from course.benchmarking.references import HALVES, reference
from course.engine.formats.pictures.files import save
from tests.benchmarking.conftest import SCENE


class Renders:
    """Counts the renders, and can interrupt one of them."""

    def __init__(self) -> None:
        self.seeds: list[int] = []
        self.interrupt_at = 0

    def __call__(self, *arguments: Any, **options: Any) -> Picture:
        self.seeds.append(options["seed"])
        picture = render(*arguments, **options)
        return replace(picture, interrupted=len(self.seeds) == self.interrupt_at)


@pytest.fixture
def renders(monkeypatch: pytest.MonkeyPatch) -> Renders:
    counter = Renders()
    monkeypatch.setattr(references, "render", counter)
    return counter


Make = Callable[..., references.Reference]


@pytest.fixture
def make(penumbra: Path, tmp_path: Path) -> Make:
    def make(**options: Any) -> references.Reference:
        return reference(penumbra, **{"samples": 16, "folder": tmp_path / "kept", **options})

    return make


def test_it_is_the_mean_of_two_halves_and_half_their_difference(make: Make, penumbra: Path) -> None:
    found = make(samples=64)
    scene = load_scene(penumbra)
    a, b = (render(scene, spp=32, seed=seed).linear.astype(np.float64) for seed in HALVES)
    assert found.linear.dtype == np.float32
    assert np.array_equal(found.linear, ((a + b) / 2).astype(np.float32))
    assert found.error == pytest.approx(np.sqrt(np.mean((a - b) ** 2)) / 2)
    assert found.samples == 64


def test_the_error_it_states_is_its_error(make: Make, penumbra: Path) -> None:
    # With e = (a + b) / 2 - truth, E (a - b)^2 / 4 = E e^2 in each pixel whose a and b are independent and unbiased.
    # The mean over pixels of the difference is 0 within 5 standard errors, but for 6 in 10^7 seeds. The truth has 64
    # times the samples, and less than 1/64 of the squared error.
    found = make(samples=64, size=(48, 32))
    truth = make(samples=4096, size=(48, 32)).linear.astype(np.float64)
    scene = load_scene(penumbra)
    a, b = (
        render(scene, spp=32, size=(48, 32), seed=seed).linear.astype(np.float64) for seed in HALVES
    )
    difference = ((a - b) ** 2 / 4 - (found.linear - truth) ** 2).mean(axis=2)
    error = difference.std() / np.sqrt(difference.size)
    assert abs(difference.mean()) < 5 * error + found.error**2 / 64
    assert found.error > 0


def test_the_second_time_nothing_is_rendered(make: Make, renders: Renders) -> None:
    first = make()
    assert renders.seeds == list(HALVES)
    again = make()
    assert len(renders.seeds) == 2
    assert np.array_equal(first.linear, again.linear)
    assert (first.error, first.samples, first.key) == (again.error, again.samples, again.key)


def test_one_file_remains(make: Make, tmp_path: Path) -> None:
    found = make()
    assert [path.name for path in (tmp_path / "kept").iterdir()] == [f"{found.key[:32]}.npz"]


@pytest.mark.parametrize(
    "options",
    [
        {"samples": 32},
        {"size": (25, 16)},
        {"overrides": {("lights", 0, "samples"): "ball"}},
        {"overrides": {("film",): {"width": 24, "height": 16, "filter": "gaussian"}}},
        {"overrides": {("camera", "eye"): [0, 3, 3.001]}},
    ],
)
def test_what_decides_the_picture_decides_the_key(make: Make, options: dict[str, Any]) -> None:
    assert make(**options).key != make().key


@pytest.mark.parametrize(
    "change", [{"title": "another"}, {"seed": 5}, {"sampler": {"type": "random", "samples": 100}}]
)
def test_what_it_does_not_depend_on_does_not(
    make: Make, renders: Renders, penumbra: Path, change: dict[str, Any]
) -> None:
    first = make()
    penumbra.write_text(json.dumps(SCENE | change), encoding="utf-8")
    assert make().key == first.key
    assert len(renders.seeds) == 2


def test_the_content_of_a_mesh_file_counts(make: Make, penumbra: Path) -> None:
    mesh = penumbra.with_name("mesh.obj")
    objects = [{"shape": "mesh", "file": "mesh.obj", "material": "matt"}]
    penumbra.write_text(json.dumps(SCENE | {"objects": objects}), encoding="utf-8")
    mesh.write_text("v 0 0 0\nv 1 0 0\nv 0 0 -1\nf 1 2 3\n", encoding="utf-8")
    first = make()
    mesh.write_text("v 0 0 0\nv 2 0 0\nv 0 0 -1\nf 1 2 3\n", encoding="utf-8")
    second = make()
    assert first.key != second.key
    assert not np.array_equal(first.linear, second.linear)
    mesh.unlink()
    with pytest.raises(SceneError, match=r"mesh\.obj: can't be read"):
        make()


def test_the_content_of_a_texture_counts(make: Make, penumbra: Path) -> None:
    keys = set()
    painted = {"matt": {"texture": {"image": "paint.png"}}}
    penumbra.write_text(json.dumps(SCENE | {"materials": painted}), encoding="utf-8")
    for grey in (0.2, 0.8):
        save(penumbra.with_name("paint.png"), np.full((3, 2, 2), grey, np.float32))
        keys.add(make().key)
    assert len(keys) == 2


def test_the_functions_of_the_effects_count(make: Make, tmp_path: Path) -> None:
    keys = set()
    for text in ("", "\n"):
        folder = tmp_path / "effects"
        folder.mkdir(exist_ok=True)
        for module in ("supersampling", "soft_shadows"):
            source = Path(references.__file__).parents[2] / "solutions" / f"{module}.py"
            (folder / f"{module}.py").write_text(source.read_text(encoding="utf-8") + text)
        # Hashes are remembered for as long as a process runs; a process doesn't change its own sources.
        references.scene_hash.__globals__["engine_hash"].cache_clear()
        keys.add(make(effects=folder).key)
    assert len(keys) == 2


def test_all_pixels_of_a_reference_have_all_samples(make: Make, penumbra: Path) -> None:
    plain = make()
    film = {**SCENE["film"], "error": 0.5}
    penumbra.write_text(json.dumps(SCENE | {"film": film}), encoding="utf-8")
    assert np.array_equal(make().linear, plain.linear)


def test_after_an_interruption_the_first_half_is_there(
    make: Make, renders: Renders, tmp_path: Path
) -> None:
    renders.interrupt_at = 2
    with pytest.raises(KeyboardInterrupt):
        make()
    assert [path.name.endswith(".half0.npz") for path in (tmp_path / "kept").iterdir()] == [True]
    resumed = make()
    assert renders.seeds == [*HALVES, HALVES[1]]
    assert np.array_equal(resumed.linear, make(folder=tmp_path / "afresh").linear)


@pytest.mark.parametrize("damage", [b"", b"PK\x03\x04 not a zip", None])
def test_a_damaged_file_is_made_anew(
    make: Make, renders: Renders, tmp_path: Path, damage: bytes | None
) -> None:
    first = make()
    (path,) = (tmp_path / "kept").iterdir()
    path.write_bytes(path.read_bytes()[:-400] if damage is None else damage)
    assert np.array_equal(make().linear, first.linear)
    assert len(renders.seeds) == 4
    make()
    assert len(renders.seeds) == 4


def test_a_file_of_something_else_is_not_believed(
    make: Make, renders: Renders, tmp_path: Path
) -> None:
    first = make()
    make(samples=8)
    names = {path.name: path for path in (tmp_path / "kept").iterdir()}
    path = names.pop(f"{first.key[:32]}.npz")
    path.write_bytes(next(iter(names.values())).read_bytes())
    assert np.array_equal(make().linear, first.linear)
    assert len(renders.seeds) == 6


@pytest.mark.parametrize("samples", [0, 1, 7])
def test_a_number_without_two_halves_is_refused(make: Make, samples: int) -> None:
    with pytest.raises(CourseError, match="no two equal halves"):
        make(samples=samples)


def test_a_folder_that_can_not_be_made_is_told(make: Make, penumbra: Path) -> None:
    with pytest.raises(OutputError, match="can't be made"):
        make(folder=penumbra / "below a file")
