"""What a function must not return: found at once, told with its place, and never rendered with."""

import pickle
import re
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from course import EffectError, load_scene, render
from course.base.errors import CourseWarning, FunctionError
from course.cli.main import commands
from course.engine.functions.contracts import contract
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.guard import Guard
from course.engine.functions.signatures import CONTRACTS
from tests.engine.functions.test_contracts import arguments

SOLUTIONS = Effects(PROJECT / "solutions")
SCENE = """
camera: {eye: [0, 1, 4], look_at: [0, 1, 0], vertical_fov: 40}
film: {width: 8, height: 8}
sampler: {samples: 4}
materials:
  brushed:
    mirror: 0.9
    gloss: {lobe: plane, roughness: 0.2}
objects:
  - {shape: sphere, radius: 2, material: brushed, transform: [{translate: [0, 1, 0]}]}
environment: {type: constant, radiance: 1}
"""
ASKED = r"scene\.yaml:8: materials\.brushed\.gloss asks for it"


def spoiled(path: str, spoil: Callable[[Any], Any], number: int) -> Callable[[], Any]:
    """A call of a guarded function, one of whose results is spoiled."""
    module, name = path.split(".")
    original = SOLUTIONS.function(module, name)

    def function(*given: Any) -> Any:
        value = original(*given)
        if not isinstance(value, tuple | list):
            return spoil(value)
        return tuple(spoil(part) if i == number else part for i, part in enumerate(value))

    guarded = Guard(path, function, Path("mine") / f"{module}.py")
    return lambda: guarded(*arguments(path, 1, 7))


RESULTS = [
    (path, number, result.kind)
    for path in CONTRACTS
    for number, result in enumerate(contract(path).results)
]
NUMBERS = [case for case in RESULTS if case[2] in ("", "unit", "infinite", "unbounded")]


def put(number: float) -> Callable[[Any], Any]:
    """Put a number in the last place of an array."""

    def spoil(array: Any) -> Any:
        changed = array.copy()
        changed[(-1,) * array.ndim] = number
        return changed

    return spoil


@pytest.mark.parametrize(("path", "number", "kind"), NUMBERS)
def test_not_a_number_is_refused(path: str, number: int, kind: str) -> None:
    """Wherever it is; the index and the function's name are told."""
    del kind
    with pytest.raises(FunctionError, match=f"{path} .*(with nan at index|of length nan)"):
        spoiled(path, put(np.nan), number)()


@pytest.mark.parametrize(("path", "number", "kind"), NUMBERS)
def test_infinity_is_refused(path: str, number: int, kind: str) -> None:
    """But for a distance at which nothing is met, and for statistics of samples that don't differ."""
    call = spoiled(path, put(np.inf), number)
    if kind in ("infinite", "unbounded"):
        call()
        call = spoiled(path, put(-np.inf), number)
    if kind == "unbounded":
        call()
        return
    with pytest.raises(FunctionError, match=r"expected (finite numbers|length 1)"):
        call()


@pytest.mark.parametrize(("path", "number"), [case[:2] for case in NUMBERS if case[2] == ""])
def test_large_numbers_are_taken_and_those_whose_products_overflow_are_not(
    path: str, number: int
) -> None:
    """Their sum is looked at first, and each only if that is large; infinities of both signs are no way past it.

    Weights of 3e38 had given a picture without a number in it.
    """
    taken = spoiled(path, lambda a: np.full_like(a, 9e17), number)()
    assert taken is not None
    for large in (1e18, -3e38):
        with pytest.raises(FunctionError, match=r"expected numbers below 1e\+18"):
            spoiled(path, put(large), number)()

    def spoil(array: Any) -> Any:
        changed = np.zeros((*array.shape[:-1], max(array.shape[-1], 2)), array.dtype)
        changed[..., 0], changed[..., 1] = np.inf, -np.inf
        return changed[..., : array.shape[-1]]

    with pytest.raises(FunctionError, match="expected finite numbers"):
        spoiled(path, spoil, number)()


OTHER_KINDS: dict[str, Callable[[Any], Any]] = {
    "shorter": lambda a: a[..., :-1],
    "one column": lambda a: a[..., :1],
    "an axis more": lambda a: a[None],
    "list": lambda a: a.tolist(),
    "complex": lambda a: a.astype(complex),
    "object": lambda a: a.astype(object),
    "None": lambda _: None,
    "number": lambda _: 1.0,
}


@pytest.mark.parametrize(("path", "number", "kind"), RESULTS)
def test_other_kinds_of_values_are_refused(path: str, number: int, kind: str) -> None:
    """Nothing is broadcast, and nothing that isn't an array of numbers goes on."""
    del kind
    told = dict.fromkeys(OTHER_KINDS, "")
    for name, spoil in OTHER_KINDS.items():
        try:
            spoiled(path, spoil, number)()
        except FunctionError as error:
            told[name] = str(error)
    refused = rf"{re.escape(path)} \(.*; expected"
    assert {name: text for name, text in told.items() if not re.search(refused, text)} == {}


@pytest.mark.parametrize(
    "path", [path for path in CONTRACTS if any(r.kind == "unit" for r in contract(path).results)]
)
def test_directions_have_length_one(path: str) -> None:
    """A little longer is refused; float32's rounding isn't."""
    number = [r.kind for r in contract(path).results].index("unit")
    with pytest.raises(FunctionError, match=r"of length 1\.01; expected length 1"):
        spoiled(path, lambda a: np.float32(1.01) * a, number)()
    spoiled(path, lambda a: np.float32(1 + 1e-5) * a, number)()


def test_float64_is_converted_with_one_warning() -> None:
    """However often the function is called."""
    path = "glossy.jitter_on_plane"
    call = spoiled(path, lambda a: a.astype(np.float64), 0)
    with pytest.warns(CourseWarning, match="returned float64, which is converted") as told:
        values = [call(), call()]
    assert len(told) == 1
    assert all(value.dtype == np.float32 for value in values)


@pytest.mark.parametrize(
    "spoil",
    [
        np.asfortranarray,
        lambda a: a[:, ::-1][:, ::-1],
        lambda a: np.broadcast_to(a[:, :1], a.shape),
        np.ma.masked_array,
    ],
    ids=["Fortran", "view", "one column for all", "masked"],
)
def test_any_memory_layout_is_taken(spoil: Callable[[Any], Any]) -> None:
    """The renderer gets an array of its own that it may write into."""
    value = spoiled("glossy.jitter_on_plane", spoil, 0)()
    assert type(value) is np.ndarray
    assert value.flags.c_contiguous
    value[:] = 0


def test_an_argument_that_is_returned_is_copied() -> None:
    """The renderer may write into what it gets, and goes on with what it gave."""
    given = np.eye(3, dtype=np.float32)
    guarded = Guard("glossy.keep_above", lambda direction, _: direction, Path("glossy.py"))
    guarded(given, given)[:] = 0
    np.testing.assert_array_equal(given, np.eye(3))


def test_errors_can_be_sent() -> None:
    """A cluster's worker sends what it raised."""
    sent = pickle.loads(
        pickle.dumps(FunctionError("glossy.keep_above returned 1", "glossy.keep_above"))
    )
    assert (str(sent), sent.function) == ("glossy.keep_above returned 1", "glossy.keep_above")


def written(folder: Path, body: str) -> Path:
    """A scene with a brushed mirror, and a folder ``mine`` whose jitter_on_plane has that body."""
    mine = folder / "mine"
    mine.mkdir()
    for file in (PROJECT / "solutions").glob("*.py"):
        (mine / file.name).write_text(file.read_text())
    with (mine / "glossy.py").open("a") as out:
        out.write(f"\n\ndef jitter_on_plane(direction, roughness, u):\n    {body}\n")
    scene = folder / "scene.yaml"
    scene.write_text(SCENE)
    return scene


@pytest.mark.parametrize(
    ("body", "told"),
    [
        (
            "return direction + np.nan",
            r"returned float32 \(3, 256\) whose column 0 is \(nan, nan, nan\)",
        ),
        ("return direction[:, :1]", r"returned float32 \(3, 1\); expected float32 unit directions"),
        ("return 1.5 * direction", r".* of length 1\.5; expected length 1"),
        ("return direction,", r"returned a tuple of \(float32 \(3, 256\)\); expected"),
        (
            "raise SystemExit(0)",
            r"raised SystemExit: 0 in line \d+ of glossy\.py: raise SystemExit\(0\)",
        ),
        ("exit()", r"raised SystemExit: None in line \d+ of glossy\.py: exit\(\)"),
        (
            "return direction @ u",
            r"raised ValueError: matmul.* in line \d+ of glossy\.py: return direction @ u",
        ),
        ("return jitter_on_plane(direction, roughness, u)", r"raised RecursionError"),
        (
            "direction += 0; return direction",
            r"raised ValueError: output array is read-only in line \d+ of glossy\.py: direction \+= 0",
        ),
    ],
)
def test_the_message_has_all_places(tmp_path: Path, body: str, told: str) -> None:
    """Of the function, of what came, and of the line of the scene that asks for it; nothing is written, status 1."""
    scene = written(tmp_path, body)
    out = tmp_path / "out.png"
    run = CliRunner().invoke(
        commands, ["render", str(scene), "--effects", str(tmp_path / "mine"), "-o", str(out)]
    )
    assert run.exit_code == 1
    line = 1 + (tmp_path / "mine" / "glossy.py").read_text().splitlines().index(f"    {body}") - 1
    assert re.search(rf"glossy\.jitter_on_plane \(.*mine/glossy\.py:{line}\) {told}", run.output)
    assert re.search(
        r"called with direction float32 \(3, 256\), roughness 0\.2, u float32 \(2, 256\)",
        run.output,
    )
    assert re.search(ASKED, run.output)
    assert "Traceback" not in run.output
    assert not out.exists()


def test_the_message_has_the_line_where_the_folder_is_given_from_here(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Python knows the file by its whole name."""
    scene = written(tmp_path, "return _helper(u)\n\n\ndef _helper(u):\n    return u[7]")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(
        FunctionError, match=r"raised IndexError: .* in line \d+ of glossy\.py: return u\[7\]"
    ):
        render(load_scene(scene, "mine"))


def test_an_exception_without_a_message_that_can_be_read_is_told(tmp_path: Path) -> None:
    """Its class is a student's, and has a mistake in turn."""
    body = (
        "class Wrong(Exception):\n        def __str__(self):\n            return u\n    raise Wrong"
    )
    scene = written(tmp_path, body)
    with pytest.raises(
        FunctionError, match=r"raised Wrong, whose message can't be read in line \d+"
    ):
        render(load_scene(scene, tmp_path / "mine"))


def test_a_module_that_goes_to_another_folder_changes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Further modules and outputs are named from where the command was given."""
    scene = written(tmp_path, "return direction")
    with (tmp_path / "mine" / "glossy.py").open("a") as out:
        out.write("\nimport os\nos.chdir('/')\n")
    monkeypatch.chdir(tmp_path)
    load_scene(scene, "mine")
    assert Path.cwd() == tmp_path


def test_leaving_at_import_is_told(tmp_path: Path) -> None:
    """A file that ends Python when it is imported, as scripts do at their end."""
    scene = written(tmp_path, "return direction")
    with (tmp_path / "mine" / "glossy.py").open("a") as out:
        out.write("\nraise SystemExit(0)\n")
    with pytest.raises(EffectError, match=r"glossy\.py can't be imported: SystemExit: 0"):
        load_scene(scene, tmp_path / "mine")


def test_pictures_are_the_same(tmp_path: Path) -> None:
    """To the bit, whether functions are looked at or not."""
    scene = written(tmp_path, "return direction")
    (tmp_path / "mine" / "glossy.py").write_text((PROJECT / "solutions" / "glossy.py").read_text())
    looked_at = render(load_scene(scene, tmp_path / "mine")).linear
    np.testing.assert_array_equal(looked_at, render(load_scene(scene, "solutions")).linear)


def test_a_function_that_a_scene_calls_when_it_is_loaded_has_its_line(tmp_path: Path) -> None:
    """The grid of a lamp is made once, before anything is rendered."""
    scene = written(tmp_path, "return direction")
    light = (
        "lights:\n  - {type: rectangle, corner: [-1, 4, -1], edge_u: [2, 0, 0], edge_v: [0, 0, 2],"
        " intensity: 9, samples: grid 4}\n"
    )
    scene.write_text(SCENE + light)
    with (tmp_path / "mine" / "soft_shadows.py").open("a") as out:
        out.write("\n\ndef light_grid(corner, edge_u, edge_v, k):\n    return edge_u\n")
    with pytest.raises(
        FunctionError, match=r"returned float32 \(3,\); .*scene\.yaml:13: lights\.0 asks"
    ):
        load_scene(scene, tmp_path / "mine")


@pytest.mark.parametrize(
    ("path", "number"),
    [(path, n) for path in CONTRACTS for n, r in enumerate(contract(path).results) if r.below],
)
def test_whole_numbers_out_of_their_range_are_refused(path: str, number: int) -> None:
    """They had been numbers of other lamps, or codes modulo 256."""
    spoiled(path, lambda a: a, number)()
    for off in (-1, 100_000):
        with pytest.raises(FunctionError, match=r"expected whole numbers from 0 to \d+ \("):
            spoiled(path, lambda a, off=off: put(off)(a.astype(np.int64)), number)()


def test_what_a_function_tells_numpy_and_python_to_do_is_its_own_business() -> None:
    """Overflows had then been errors of the renderer, and so had its warning of another dtype."""

    def throughput(color: Any, *_: Any) -> Any:
        np.seterr(all="raise")
        warnings.simplefilter("error")
        return np.zeros(color.shape)

    before = np.geterr()
    with warnings.catch_warnings(record=True) as told:
        guarded = Guard("path_tracing.throughput", throughput, Path("mine") / "path_tracing.py")
        guarded(*arguments("path_tracing.throughput", 1, 7))
    assert np.geterr() == before
    assert len(told) == 1
    assert "returned float64" in str(told[0].message)


def test_a_file_of_functions_that_is_too_large_is_not_read(tmp_path: Path) -> None:
    with (tmp_path / "glossy.py").open("wb") as file:
        file.truncate(20 << 30)
    with pytest.raises(EffectError, match=r"glossy\.py: more than 2,000,000 bytes: too large"):
        Effects(tmp_path).function("glossy", "keep_above")
