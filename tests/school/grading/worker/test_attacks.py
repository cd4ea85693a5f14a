"""Nothing that a submission tries gets it anything, or does anything outside its worker, behind any wall."""

import os
import sys
from collections.abc import Iterator
from dataclasses import replace
from itertools import chain

import pytest

from benchmarks.attacks.forging import FORGING
from benchmarks.attacks.running import NOT_HELD, Outcome, chosen, forged, outcomes
from benchmarks.attacks.stage import Stage
from benchmarks.attacks.walls import OPEN, WALLS
from course.school.grading.worker.sandbox import sandbox

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or os.uname().machine != "x86_64",
    reason="the attacks are written for Linux on x86-64",
)


GRADERS = [(user, wall) for user in ("root", "another") for wall in WALLS]
WHOLE = [("root", "bubblewrap")]
"""What stands before most graders. What needs a worker of its own is tried there in full, and by fifths behind the
others, at least once; all else is tried everywhere. `python -m benchmarks.attacks` leaves nothing out."""
PARTLY = [one for one in GRADERS if one not in WHOLE]


def tried(user: str, wall: str, every: int = 1, first: int = 0) -> list[Outcome]:
    try:
        return outcomes(user, wall, reaching=True, every=every, first=first)
    except LookupError as error:
        pytest.skip(str(error))


@pytest.mark.parametrize(("user", "wall"), GRADERS)
def test_a_wall_holds(user: str, wall: str) -> None:
    part = (1, 0) if (user, wall) in WHOLE else (5, PARTLY.index((user, wall)) % 5)
    found = tried(user, wall, *part)
    assert {one.name: (one.gain, one.effects) for one in found if not one.held} == {}
    left_out = {name for other, name in NOT_HELD if other == wall}
    assert {one.name for one in found} == {*chain(*chosen(wall, *part))} - left_out


@pytest.mark.skipif(os.name == "nt" or os.geteuid() != 0, reason="would attack one's own account")
def test_the_attacks_do_harm_where_there_is_no_wall() -> None:
    harmful = [one.name for one in tried("another", OPEN, 3) if not one.held]
    # The others need root, or are there to use a worker up.
    assert len(harmful) >= 20


@pytest.fixture(scope="module")
def stage() -> Iterator[Stage]:
    with Stage() as one:
        yield one


@pytest.mark.parametrize("name", FORGING)
def test_a_wrong_function_earns_no_more_by_attacking(name: str, stage: Stage) -> None:
    outcome = forged(name, replace(sandbox(), hooked=False), stage)
    assert (outcome.gain, outcome.effects) == ("", ())
