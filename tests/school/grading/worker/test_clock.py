"""How long a worker is waited for: by the processor time that it gets."""

import os
import subprocess
import sys
from dataclasses import dataclass

import psutil
import pytest

from course.school.grading.errors import StudentError
from course.school.grading.worker import clock
from course.school.grading.worker.client import LOOPS, MOST_SECONDS, Worker, _Call
from course.school.grading.worker.clock import ASLEEP, BUSIEST, LOOK, Clock
from course.school.grading.worker.limits import Limits


@dataclass
class Fake:
    """A process that gets a share of the processor, on a machine whose clock is set by hand."""

    share: float = 1.0
    awake: bool = True
    begun: float = 0.0
    now: float = 0.0

    @property
    def seconds(self) -> float:
        return self.share * self.now


def waited(fake: Fake, monkeypatch: pytest.MonkeyPatch, usual: float = 0.0) -> float:
    """Seconds by the clock after which a wait for 10 s is over."""
    monkeypatch.setattr(clock, "monotonic", lambda: fake.now)
    one = Clock(10.0, fake, lambda: usual)  # type: ignore[arg-type]
    while not one.over():
        fake.now += max(one.left(), 1e-3)
    return fake.now


def test_who_has_the_processor_has_its_time_and_no_more(monkeypatch: pytest.MonkeyPatch) -> None:
    assert waited(Fake(), monkeypatch) == pytest.approx(10, abs=2 * LOOK)


def test_who_gets_a_quarter_of_the_processor_has_four_times_as_long(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert waited(Fake(share=0.25), monkeypatch) == pytest.approx(40, abs=2 * LOOK)


def test_who_gets_nothing_is_not_waited_for_without_end(monkeypatch: pytest.MonkeyPatch) -> None:
    assert waited(Fake(share=0), monkeypatch) == pytest.approx(10 * BUSIEST, abs=2 * LOOK)


def test_who_sleeps_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    slept = waited(Fake(share=0, awake=False), monkeypatch)
    assert slept == pytest.approx(10 + ASLEEP * LOOK, abs=2 * LOOK)


def test_what_takes_a_right_function_long_may_take_longer(monkeypatch: pytest.MonkeyPatch) -> None:
    assert waited(Fake(), monkeypatch, usual=25.0) == pytest.approx(25, abs=2 * LOOK)


def crowd(worker: Worker) -> list[subprocess.Popen[bytes]]:
    """One processor for a worker, and five others that never rest on it."""
    worker.load()
    mine = worker._process._process
    assert mine is not None
    others = [subprocess.Popen([sys.executable, "-S", "-c", "while True: pass"]) for _ in range(5)]
    tree = [psutil.Process(mine.pid), *psutil.Process(mine.pid).children(recursive=True)]
    for process in (*tree, *(psutil.Process(each.pid) for each in others)):
        process.cpu_affinity([min(os.sched_getaffinity(0))])
    return others


BURNS = b"""
import time
def f(seconds):
    begun = time.process_time()
    while time.process_time() < begun + seconds:
        pass
    return seconds
"""


@pytest.mark.skipif(sys.platform != "linux", reason="other systems choose processors themselves")
def test_a_busy_machine_costs_nobody_an_answer() -> None:
    with Worker("m", BURNS, Limits(call_seconds=1.0)) as worker:
        others = crowd(worker)
        try:
            assert worker.call("f", 0.01) == 0.01
            # By the clock that is about four seconds there.
            assert worker.call("f", 0.6) == 0.6
        finally:
            for each in others:
                each.kill()
                each.wait()


def test_who_takes_more_than_its_time_is_ended() -> None:
    with Worker("m", BURNS, Limits(call_seconds=0.5)) as worker:
        with pytest.raises(StudentError) as error:
            worker.call("f", 30.0)
        assert error.value.kind == "timeout"


SLEEPS = b"""
import time
def f(seconds):
    time.sleep(seconds)
    return seconds
"""


def test_a_late_call_may_take_a_multiple_of_what_the_reference_takes() -> None:
    with Worker("m", SLEEPS) as reference_caller, Worker("m", SLEEPS) as worker:
        worker.reference_caller = reference_caller
        taken = worker._usual(_Call("f", (0.02,), {}))
        assert 0.02 * LOOPS <= taken <= MOST_SECONDS
        assert worker._usual(_Call("f", (0.2,), {})) == MOST_SECONDS
        assert worker._usual(_Call("g", (0.2,), {})) == 0
