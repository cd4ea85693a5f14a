"""Right functions keep all points by whatever habit they are written.

`make stress` asks more modules, and the kill matrix's `--habits` more seeds.
"""

from itertools import islice

import numpy as np
import pytest

from benchmarks.mutants.habits import HABITS, lost_by, written
from course.engine.functions.modules import COURSE
from course.school.grading.checks.declare import declared_function
from course.school.grading.checks.drawing import Draw
from tests.lengths import LONG

MODULES = [*COURSE]

DEAR = ("one column at a time", "bounding_volumes")
"""Not tried here: it takes as long as all the others, and ``loops`` of test_mutants.py is written so."""


@pytest.mark.filterwarnings("ignore::RuntimeWarning")
@pytest.mark.parametrize("habit", HABITS)
def test_a_right_function_by_another_habit_loses_nothing(habit: str) -> None:
    first = [*HABITS].index(habit)
    # Habits beside each other in the list meet modules beside each other.
    for number in range(3 if LONG else 1):
        module = MODULES[(first + 5 * number) % len(MODULES)]
        if (habit, module) != DEAR:
            assert lost_by(module, habit, first) == [], module


def test_habits_are_habits() -> None:
    """Each changes something of some call: its layout, its type, the number of calls or where numbers are used."""
    calls: list[int] = []

    def point_on_disk(u: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
        calls.append(u.dtype.itemsize * 100 + u.shape[1])
        return np.stack((u[0], 2 * u[1])).astype(u.dtype)

    a = declared_function("thin_lens", "point_on_disk").make(Draw(np.random.default_rng(0), 9))

    def seen(habit: str) -> object:
        calls.clear()
        found = written("thin_lens", {"point_on_disk": point_on_disk}, habit).call(
            "point_on_disk", *a.values()
        )
        order = found.strides, found.flags.writeable, found.flags.owndata
        return order, tuple(calls), found.tobytes()

    plain = seen("as it is")
    # These concern functions with several results, or with a generator; and copies are as they were.
    others = {
        "a generator of its own",
        "several results as one array",
        "several results as a list",
        "results copied",
        "work on copies, in place",
    }
    for habit in islice(HABITS, 1, None):
        assert (seen(habit) == plain) == (habit in others), habit
