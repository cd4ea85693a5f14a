"""What is said of an exception: which arguments came, and what to do where many meet it."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from course.school.grading.checks.check import Check
from course.school.grading.checks.result import troubled
from course.school.grading.errors import StudentError
from course.school.grading.worker.client import Worker
from course.school.grading.worker.framing import pack
from course.school.grading.worker.wording import remedy, replied, said, told

U = np.ones((2, 17))
V = np.ones((3, 17))
P = np.ones(3)


MISTAKES: dict[str, tuple[Callable[[], object], str]] = {
    "a point and a batch": (lambda: P + V, "point[:, None]"),
    "a batch and a point": (lambda: V * P, "point[:, None]"),
    "a point and numbers": (lambda: P * np.ones(17), "point[:, None] * numbers"),
    "turned over": (lambda: U.T + U, "(17, 2) is (2, 17) turned over"),
    "three turned over": (lambda: V + V.T, "turned over"),
    "other shapes": (lambda: U + V, "each pair of sizes has to be equal"),
    "lengths of rows": (lambda: V / np.linalg.norm(V, axis=1), "np.linalg.norm with axis=0"),
    "a norm without axis": (lambda: np.linalg.norm(V)[0], "np.linalg.norm, sum, min and max"),
    "a norm without axis, two indices": (lambda: np.linalg.norm(V)[:, None], "np.linalg.norm"),
    "np.dot": (lambda: np.dot(V, V), "(a * b).sum(axis=0)"),
    "@": (lambda: V @ V, "(a * b).sum(axis=0)"),
    "@ of a point": (lambda: np.ones(4) @ V, "(a * b).sum(axis=0)"),
    "if": (lambda: 1 if U > 0 else 2, "np.where"),
    "max of batches": (lambda: max(U, 2 * U), "np.where"),
    "math.sqrt": (lambda: math.sqrt(U), "those of NumPy"),  # type: ignore[arg-type]
    "float": (lambda: float(U), "those of NumPy"),  # type: ignore[arg-type]
    "a row too many": (lambda: U[2], "The first axis has the coordinates"),
    "columns for rows": (lambda: [x + y for x, y in [U.T]], "The first axis has the coordinates"),
    "three of two": (lambda: [x for x, _, _ in [U]], "The first axis has the coordinates"),
    "an axis too many": (lambda: P[:, 0], "The first axis has the coordinates"),
    "a second column": (lambda: U[:, :1][:, 1], "N may be 0 or 1"),
    "a column too many": (lambda: U[:, 17], "indices go from 0 to one less"),
    "no columns": (U[:, :0].max, "N = 0 is a batch"),
    "in place": (lambda: np.ones(3, np.int64).__imul__(0.5), "keeps its array's dtype"),
    "stack": (lambda: np.stack([U[0], np.float64(1)]), "rows of one shape"),
    "array": (lambda: np.array([U[0], 1.0]), "rows of one shape"),
    "concatenate": (lambda: np.concatenate([U, V], axis=1), "rows of one shape"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_what_everybody_does_once_has_a_remedy(name: str) -> None:
    mistake, says = MISTAKES[name]
    with pytest.raises((ValueError, TypeError, IndexError, np.exceptions.AxisError)) as error:
        mistake()
    assert says in remedy(str(error.value))


@pytest.mark.parametrize(
    "text", ["", "division by zero", "could not be broadcast", "name 'np' is not defined", "(" * 50]
)
def test_what_nobody_knows_has_none_or_a_general_one(text: str) -> None:
    assert remedy(text) == "" or text == "could not be broadcast"


def test_a_masked_array_is_told_how_to_become_an_array() -> None:
    with pytest.raises(TypeError) as error:
        pack({}, [np.ma.masked_array(U)])
    told_as = replied("bad value", {"message": f"it returned {error.value}"})
    assert "becomes an array by np.array(...)" in told_as.remedy


def test_forged_texts_make_no_trouble() -> None:
    huge = "9" * 5000
    for text in (
        f"operands could not be broadcast together with shapes ({huge},) ({huge},3)",
        "could not be broadcast (,,,) (, )",
        "could not be broadcast together with shapes (1 2) (3)",
        "could not be broadcast " + "(1,2) " * 1000,
    ):
        assert isinstance(remedy(text), str)


def test_a_long_forged_text_is_cut_before_it_is_looked_through() -> None:
    """The time grows with the square of its length: this one would take minutes."""
    error = replied("raised", {"type": "shape " * 166_000, "message": "shape " * 166_000})
    assert len(error.type) < 100
    assert len(str(error)) < 400


def test_arguments_are_told_by_name_shape_and_dtype() -> None:
    arguments = (np.zeros(3, np.float32), 0.5, np.zeros((2, 17), np.float32))
    assert said("soft_shadows.point_on_sphere", arguments, {}) == (
        "center (3,) float32, radius 0.5, u (2, 17) float32"
    )
    rng = np.random.default_rng()
    assert said("supersampling.random", (2, 5), {"rng": rng}) == "k 2, n 5, rng a generator"
    assert said("m.unknown", (None, "x", (1, U)), {}) == (
        "argument 1 None, argument 2 a str, argument 3 a tuple of 2 (1, (2, 17) float64)"
    )
    assert len(said("m.unknown", (tuple(range(10**4)),) * 99, {})) < 400


@pytest.mark.parametrize(
    "value", [2**70, -(2**70), float("nan"), np.str_("x"), np.True_, 1j, (), [[]], object()]
)
def test_of_any_value_something_short_can_be_told(value: object) -> None:
    assert 0 < len(told(value)) < 100
    assert len(told([[value] * 1000] * 1000)) < 200


def test_an_exception_comes_with_arguments_and_remedy() -> None:
    source = b"def point_on_sphere(center, radius, u):\n    return center + radius * u\n"
    u = np.zeros((3, 5), np.float32)
    with Worker("soft_shadows", source) as worker, pytest.raises(StudentError) as error:
        worker.call("point_on_sphere", np.zeros(3), 0.5, u)
    check = Check("point_on_sphere", "contract", "", lambda _: None)
    result = troubled("soft_shadows", check, error.value)
    assert result.where.endswith("arguments: center (3,) float64, radius 0.5, u (3, 5) float32")
    assert 'File "soft_shadows.py", line 2' in result.where
    assert "point[:, None]" in result.hint


def test_one_cause_is_one_for_every_number_of_columns() -> None:
    source = b"def f(u):\n    if len(u) > 2: return u[3]\n    return 1 / 0\n"
    causes = []
    with Worker("m", source) as worker:
        for n in (3, 3, 2, 1):
            with pytest.raises(StudentError) as error:
                worker.call("f", np.zeros(n))
            causes.append(error.value.cause)
    assert causes[0] == causes[1] != causes[2] == causes[3]


def test_a_recursion_without_end_is_one_cause_however_deep_it_went() -> None:
    frames = '  File "m.py", line 2, in f\n    f()\n  [Previous line repeated {} more times]\n'
    one, other = (
        StudentError("raised", "too deep", "RecursionError", frames.format(depth))
        for depth in (982, 977)
    )
    assert one.cause == other.cause


def test_a_module_beside_it_is_not_there() -> None:
    assert "copy the helper into this file" in remedy("No module named 'glossy'")
    assert "NumPy and Python's own library" in remedy("No module named 'pandas'")
    assert "copy helpers into this file" in remedy(
        "attempted relative import with no known parent package"
    )


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("from sampling import sphere_by_polar", "copy the helper into this file"),
        ("from assignments.sampling import sphere_by_polar", "copy the helper into this file"),
        ("import matplotlib.pyplot", "NumPy and Python's own library"),
        ("from course import render", "NumPy and Python's own library"),
        ("open('points.txt')", "all that they need comes with their arguments"),
        ("input()", "Nobody can type"),
        ("breakpoint()", "Nobody can type"),
        ("__import__('sys').exit()", "a function ends with return"),
        ("math.sqrt(2)", "imported at the top of the file"),
    ],
)
@pytest.mark.parametrize("inside", [False, True])
def test_what_no_function_may_ask_for_has_a_remedy_wherever_it_stands(
    line: str, says: str, inside: bool
) -> None:
    source = f"def f():\n    {line}\n" if inside else f"{line}\ndef f():\n    return 1\n"
    with Worker("m", source.encode()) as worker, pytest.raises(StudentError) as error:
        worker.call("f")
    assert error.value.module_wide != inside
    assert says in error.value.remedy


@pytest.mark.parametrize("encoding", ["latin-1", "utf-16"])
def test_a_file_of_another_encoding_is_told_which_to_choose(encoding: str) -> None:
    source = "def f():\n    return 'ü'\n".encode(encoding)
    with Worker("m", source) as worker, pytest.raises(StudentError) as error:
        worker.call("f")
    assert error.value.module_wide
    assert "save it anew" in error.value.remedy


def test_the_line_that_is_shown_is_the_one_that_raised_whatever_stands_above() -> None:
    source = "# a\u2028b\x0bc\u0085d\r\n\r\ndef f():\r\n    return 1 / 0\r\n"
    with Worker("m", source.encode()) as worker, pytest.raises(StudentError) as error:
        worker.call("f")
    assert "line 4" in error.value.traceback
    assert "return 1 / 0" in error.value.traceback
