"""Nothing that a submission tries gets it anything, or does anything outside its worker, behind any wall."""

import os
import sys
from collections.abc import Iterator
from dataclasses import replace

import pytest

from benchmarks.attacks.forging import FORGING
from benchmarks.attacks.reaching import REACHING
from benchmarks.attacks.running import NOT_HELD, Outcome, forged, outcomes
from benchmarks.attacks.stage import Stage
from benchmarks.attacks.walls import OPEN, WALLS
from course.grading.worker.sandbox import sandbox

pytestmark = pytest.mark.skipif(
    sys.platform != "linux" or os.uname().machine != "x86_64",
    reason="the attacks are written for Linux on x86-64",
)


WHOLE = {("root", "bubblewrap"), ("root", "user"), ("another", "bubblewrap")}
"""Who is attacked with all there is; others with each fifth, and `python -m benchmarks.attacks` leaves none out."""


def tried(user: str, wall: str, every: int = 1) -> list[Outcome]:
    try:
        return outcomes(user, wall, reaching=True, every=every)
    except LookupError as error:
        pytest.skip(str(error))


@pytest.mark.parametrize("wall", WALLS)
@pytest.mark.parametrize("user", ["root", "another"])
def test_a_wall_holds(user: str, wall: str) -> None:
    every = 1 if (user, wall) in WHOLE else 5
    found = tried(user, wall, every)
    assert {one.name: (one.gain, one.effects) for one in found if not one.held} == {}
    left_out = {name for other, name in NOT_HELD if other == wall}
    assert {one.name for one in found} == {*[*REACHING][::every]} - left_out


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
