"""The checks that follow from a declaration: whatever breaks one fails that one."""

from typing import Any

import numpy as np
import pytest

from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Check, Failure
from course.school.grading.checks.conventions import conventions
from course.school.grading.checks.declare import Arguments, declaration
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.examples import call, where
from course.school.grading.checks.running import run_checks
from course.school.grading.errors import StudentError
from course.school.grading.modules.hierarchies import walkable
from course.school.grading.references import reference, references
from tests.school.grading.checks.declaring import SHIFTED, but, shifted, trial

LAWS = {law.name: law for law in conventions(SHIFTED)}


def _writes(center: Any, direction: Any, radius: Any) -> Any:
    value = shifted(center, direction, radius)
    direction *= 2
    return value


def _writes_double(center: Any, direction: Any, radius: Any) -> Any:
    value = shifted(center, direction, radius)
    # A copy of what is in single precision.
    same = np.asarray(direction, float)
    same *= 2
    return value


def _seeds(value: Any, _: Any) -> Any:
    np.random.seed(3)  # noqa: NPY002
    return value


def _unchecked(center: Any, direction: Any, radius: Any) -> Any:
    return np.reshape(center, (-1, 1))[:3] + np.abs(radius) * direction


COUNTER = iter(range(10**6))

BROKEN = {
    "float64": ("contract", but(lambda value, _: value.astype(np.float64))),
    "float32": ("contract", but(lambda value, _: value.astype(np.float32))),
    "the centre's dtype counts": (
        "contract",
        but(lambda value, a: value.astype(np.result_type(a.center, a.direction))),
    ),
    "turned": ("contract", but(lambda value, _: value.T)),
    "a list": ("contract", but(lambda value, _: value.tolist())),
    "a tuple of one": ("contract", but(lambda value, _: (value,))),
    "one column is flat": ("contract", but(lambda v, _: v[:, 0] if v.shape[1] == 1 else v)),
    "not finite far away": (
        "contract",
        but(lambda value, a: value / (0.0 if a.radius > 1e4 else 1.0)),
    ),
    "not finite along an axis": ("contract", but(lambda v, a: v / np.sign(np.abs(a.direction)))),
    "writes to its argument": ("untouched", _writes),
    "writes to its argument in double precision": ("untouched", _writes_double),
    "seeds NumPy": ("untouched", but(_seeds)),
    "takes any radius": ("refuses", _unchecked),
    "depends on its neighbours": ("columns", but(lambda v, _: v - v.mean(axis=1, keepdims=True))),
    "depends on the number of columns": ("columns", but(lambda v, _: v * (1 + v.shape[1] / 1e3))),
    "few columns are none": ("columns", but(lambda v, _: v * (v.shape[1] >= 100))),
    "some columns are none": ("columns", but(lambda v, _: v * (not 4 < v.shape[1] < 30))),
    "remembers": ("layouts", but(lambda v, _: v + next(COUNTER))),
    "reads the memory": (
        "layouts",
        but(lambda v, a: v if a.direction.flags.c_contiguous else v[::-1]),
    ),
}


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("name", BROKEN)
def test_each_convention_is_looked_at(name: str) -> None:
    law, function = BROKEN[name]
    with pytest.raises((Failure, StudentError)):
        LAWS[law].run(SHIFTED, trial(function))


def test_truth_values_can_be_computed_with() -> None:
    """A check had an error of its own where it subtracted them."""
    made = SHIFTED.make(Draw(np.random.default_rng(1), 4, np.float32))
    found = SHIFTED.seen(np.ones((3, 4), bool), made)
    assert np.array_equal(found - found, np.zeros((3, 4)))


def test_whole_numbers_that_came_as_floats_are_indices_of_a_check() -> None:
    """Checks of many_lights had an error of their own, on lamps from ``np.floor``."""
    power = declaration("many_lights", "power_choice")
    assert power
    made = power.make(Draw(np.random.default_rng(1), 4, np.float64))
    lamps, _ = power.seen((np.array([0.0, 1, 2, 0]), np.ones(4)), made)
    assert lamps.dtype.kind == "i"
    lamps, _ = power.seen((np.array([0.0, 1.5, 2, 0]), np.ones(4)), made)
    assert lamps.dtype.kind == "f"


def test_a_hierarchy_of_a_million_levels_is_refused_at_once() -> None:
    """The walk through it took hours."""
    nodes = 2_000_001
    corners = np.zeros((3, nodes), np.int8)
    first, count = np.zeros(nodes, np.int32), np.ones(nodes, np.int8)
    inner = np.arange(0, nodes - 1, 2)
    first[inner], count[inner] = inner + 1, 0
    with pytest.raises(Failure, match="at most 13 nodes for 7 boxes"):
        walkable((corners, corners, first, count, np.zeros(7, np.int8)), 7)


def test_a_broken_contract_is_shown_by_a_call_of_few_columns() -> None:
    with pytest.raises(Failure) as caught:
        LAWS["contract"].run(SHIFTED, trial(BROKEN["float64"][1]))
    assert caught.value.example.startswith("shifted(center = [")
    assert len(caught.value.example) < 300


def test_a_number_of_numpys_own_is_shown_as_one() -> None:
    """Pasted as a Python float, the call would be right."""
    given = Arguments(center=np.zeros(3), radius=np.float64(0.5), k=2)
    assert call("it", given) == "it(center = [0., 0., 0.], radius = np.float64(0.5), k = 2)"


def test_the_largest_number_below_1_and_small_ones_are_not_shown_as_1_and_0() -> None:
    u = np.array([0.5, 1 - 2.0**-24, 1e-15, -2, 1])
    assert call("it", Arguments(u=u)) == "it(u = [0.5, 1 - 6e-08, 1e-15, -2., 1.])"
    assert where(Arguments(u=u), (1,), (5,)) == "u = 1 - 6e-08"


def test_a_single_number_of_no_columns_is_shown() -> None:
    """A check had an error of its own on a NaN that came for a picture without samples."""
    assert where(Arguments(weights=np.zeros((0, 2))), (), ()) == "weights = ()"


def test_wrong_shapes_are_axes_less_more_and_turned_and_rows() -> None:
    refused: set[tuple[int, ...]] = set()

    def notes(center: Any, direction: Any, radius: Any) -> Any:
        refused.add(
            (*np.shape(center), -1, *np.shape(direction), -1, round(float(np.nan_to_num(radius))))
        )
        return shifted(center, direction, radius)

    LAWS["refuses"].run(SHIFTED, trial(notes))
    shapes = {row[row.index(-1) + 1 : -2] for row in refused if row[: row.index(-1)] == (3,)}
    assert {(3,), (4, 3), (2, 4), (4, 4), (1, 3, 4), (3, 4, 1)} <= shapes
    points = {row[: row.index(-1)] for row in refused}
    assert {(), (2,), (4,), (1, 3), (3, 1)} <= points


def test_an_error_by_chance_is_no_refusal_and_says_what_is_expected() -> None:
    def chance(center: Any, direction: Any, radius: Any) -> Any:
        if np.ndim(center) != 1:
            raise IndexError("too many indices")
        return shifted(center, direction, radius)

    with pytest.raises(StudentError, match="too many indices") as error:
        LAWS["refuses"].run(SHIFTED, trial(chance))
    assert error.value.expected.startswith("ValueError for center of shape ")
    assert "came with the stub" in error.value.remedy


class Watching:
    """A ``Caller`` that calls another, and keeps the largest u that came."""

    def __init__(self, module: str) -> None:
        self.module, self.right, self.largest = module, reference(module), 0.0

    def _look(self, function: str, arguments: tuple[Any, ...]) -> None:
        declared = declaration(self.module, function)
        for argument, value in zip(declared.arguments if declared else (), arguments, strict=False):
            if argument.name == "u" and np.size(value) and np.asarray(value).dtype.kind == "f":
                self.largest = max(self.largest, float(np.nanmax(value)))

    def call(self, function: str, *arguments: Any, **named: Any) -> Any:
        self._look(function, arguments)
        return self.right.call(function, *arguments, **named)

    def call_and_look(self, function: str, *arguments: Any) -> Any:
        self._look(function, arguments)
        return self.right.call_and_look(function, *arguments)


@pytest.mark.parametrize("module", ["microfacets", "soft_shadows", "glossy", "path_tracing"])
def test_u_is_never_1(module: str) -> None:
    watching = Watching(module)
    contracts = [*run_checks(module_checks(module), watching, references(), 0, _is_contract)]
    assert contracts
    assert 0.999 < watching.largest < 1


def _is_contract(check: Check) -> bool:
    return check.name == "contract"
