"""What holds up the grader or fills it up has an end, and what somebody else does to a worker costs nothing."""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from time import monotonic, sleep

import numpy as np
import psutil
import pytest

from course.school.grading.checks.result import Status
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.errors import StudentError
from course.school.grading.grading import grade
from course.school.grading.looked import EARLIER_RESULT
from course.school.grading.worker import client
from course.school.grading.worker.client import Worker
from course.school.grading.worker.limits import NOT_RUN, Limits, WorkerBudget
from course.school.grading.worker.process import MOST_PRINTED, Process
from tests.school.grading.worker.graded import arrays, quick, solution

LONG = 60.0
"""Seconds that none of the calls here may take; each is given one or two."""


@pytest.fixture
def quickly() -> Iterator[None]:
    started = monotonic()
    yield
    assert monotonic() - started < LONG


def raised(source: str, *arguments: object, limits: Limits | None = None) -> StudentError:
    """What a call of f gives."""
    worker = Worker("m", source.encode(), limits or Limits(call_seconds=1.0))
    with worker, pytest.raises(StudentError) as error:
        worker.call("f", *arguments)
    return error.value


TRICKLE = """
import os, time

def f():
    for fd in range(3, 64):
        try: os.write(fd, b"00000bb8")
        except OSError: pass
    while True:
        time.sleep(0.02)
        for fd in range(3, 64):
            try: os.write(fd, b" ")
            except OSError: pass
"""


@pytest.mark.usefixtures("quickly")
def test_a_reply_that_trickles_ends_at_its_deadline() -> None:
    # All of it would take a minute.
    assert raised(TRICKLE).kind == "timeout"


@pytest.mark.usefixtures("quickly")
def test_a_reply_of_which_there_is_always_a_little_more_ends_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "reply").write_bytes(b"00100000" + b" " * (1 << 20))
    usual = os.readv

    def a_byte(fd: int, buffers: list[memoryview]) -> int:
        sleep(0.001)
        return usual(fd, [buffers[0][:1]])

    with Worker("m", b"def f(): pass\n") as worker, (tmp_path / "reply").open("rb") as reply:
        worker.load()
        process = worker._process
        os.dup2(reply.fileno(), process._replies)
        monkeypatch.setattr(os, "readv", a_byte)
        with pytest.raises(StudentError) as error:
            process.read(monotonic() + 0.5)
        assert error.value.kind == "timeout"


@pytest.mark.usefixtures("quickly")
def test_a_message_that_is_taken_in_drops_ends_at_its_deadline(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def a_byte(_: int, data: memoryview) -> int:
        sleep(0.001)
        return min(len(data), 1)

    with Worker("m", b"def f(): pass\n") as worker:
        worker.load()
        monkeypatch.setattr(os, "write", a_byte)
        with pytest.raises(StudentError) as error:
            worker._process.write(bytes(1 << 20), monotonic() + 0.5)
        assert error.value.kind == "timeout"


@pytest.mark.usefixtures("quickly")
def test_who_prints_without_end_is_ended() -> None:
    error = raised("def f():\n    while True: print('x' * 1_000_000)\n", limits=Limits(10))
    assert error.kind == "crashed"
    assert f"it printed more than {MOST_PRINTED >> 20} MB" in str(error)


def kill(process: Process) -> None:
    """As the system does where memory is short."""
    assert process._process is not None
    for child in psutil.Process(process._process.pid).children(recursive=True):
        # It may have ended with another of them.
        with contextlib.suppress(psutil.NoSuchProcess):
            child.kill()
    process._process.kill()
    process._process.wait()


def test_a_call_whose_process_is_killed_from_outside_is_made_again(
    starts: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    usual = Process.write

    def write(process: Process, message: bytes, deadline: float) -> None:
        usual(process, message, deadline)
        if b'"function"' in message and len(starts) == 1:
            kill(process)

    monkeypatch.setattr(Process, "write", write)
    with Worker("m", b"import time\ndef f(x):\n    time.sleep(1)\n    return x\n") as worker:
        assert worker.call("f", 7) == 7
    assert starts == ["m", "m"]


def test_an_import_that_is_killed_from_outside_is_made_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    usual = Worker._start
    started = []

    def start(worker: Worker) -> None:
        usual(worker)
        started.append(1)
        if len(started) == 1:
            kill(worker._process)

    monkeypatch.setattr(Worker, "_start", start)
    with Worker("m", b"import time\ntime.sleep(1)\ndef f(): return 7\n") as worker:
        assert worker.call("f") == 7


def test_a_right_submission_that_is_killed_again_and_again_keeps_all_its_points(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    usual = Process.write
    killed: set[object] = set()

    def write(process: Process, message: bytes, deadline: float) -> None:
        head = message[8 : 8 + int(message[:8], 16)]
        function = head.partition(b'"function": "')[2].partition(b'"')[0]
        # Once for each function, in its first call.
        if function and function not in killed:
            killed.add(function)
            kill(process)
        usual(process, message, deadline)

    monkeypatch.setattr(Process, "write", write)
    module = "motion_blur"
    report = grade({module: solution(module).encode()}, arrays(), modules=[module], only=quick)
    assert len(killed) == 3
    assert report.score == 1


def test_who_ends_its_own_process_does_so_four_times_at_most(starts: list[str]) -> None:
    source = b"import os\ndef f(): os._exit(3)\ndef g(): return 1\n"
    with Worker("m", source) as worker:
        for _ in range(6):
            with pytest.raises(StudentError) as error:
                worker.call("f")
            assert error.value.kind == "crashed"
        assert len(starts) == worker.limits.deaths
        assert worker.call("g") == 1


def borrowing(module: str, lent: str, body: str, limits: Limits) -> tuple[Worker, Worker]:
    """A worker whose f calls a function of the module that it is lent, and whoever lends it."""
    budget = WorkerBudget(limits)
    right = Worker(module, solution(module).encode(), limits, budget=budget)
    source = f"import numpy as np\ndef f(*given):\n    return {body}\n".encode()
    return Worker(module, source, limits, substitute=right, lent=[lent], budget=budget), right


@pytest.fixture
def nothing_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """No function of the course is called in this process."""

    def never(*_: object, **__: object) -> object:
        raise AssertionError

    monkeypatch.setattr(TrustedModule, "call", never)


@pytest.mark.usefixtures("quickly", "nothing_here")
def test_what_is_lent_has_the_time_of_who_asks() -> None:
    worker, right = borrowing(
        "quasi_monte_carlo", "halton", "halton(np.arange(1), 24000)", Limits(call_seconds=1.0)
    )
    with worker:
        with pytest.raises(StudentError) as error:
            worker.call("f")
        assert error.value.kind == "timeout"
    assert not right._process.running


@pytest.mark.usefixtures("quickly", "nothing_here")
def test_what_is_lent_has_the_memory_of_a_submission() -> None:
    limits = Limits(call_seconds=60, memory=1 << 30)
    worker, _ = borrowing("supersampling", "regular", "regular(8000, 1)", limits)
    before = psutil.Process().memory_info().rss
    with worker:
        with pytest.raises(StudentError) as error:
            worker.call("f")
        assert error.value.kind == "raised"
    assert psutil.Process().memory_info().rss - before < 200 << 20


@pytest.mark.usefixtures("nothing_here")
def test_what_is_lent_is_right_and_takes_generators() -> None:
    worker, _ = borrowing("supersampling", "random", "random(2, n=3, rng=given[0])", Limits())
    with worker:
        found = worker.call("f", np.random.default_rng(4))
    assert np.array_equal(found, np.random.default_rng(4).random((2, 3, 4), np.float32))


@pytest.mark.usefixtures("nothing_here")
def test_what_is_lent_may_refuse_or_end_and_who_asks_goes_on() -> None:
    body = "[halton(np.arange(1), -1)]"
    worker, right = borrowing("quasi_monte_carlo", "halton", body, Limits())
    with worker:
        with pytest.raises(StudentError) as error:
            worker.call("f")
        assert (error.value.kind, error.value.type) == ("raised", "ValueError")
        kill(right._process)
        with pytest.raises(StudentError) as error:
            worker.call("f")
        assert error.value.kind == "raised"


@pytest.mark.parametrize("name", ["self", "function", "deadline", "call"])
@pytest.mark.usefixtures("nothing_here")
def test_the_names_of_lent_arguments_are_the_students(name: str) -> None:
    """A name that means something to the grader had been an error of its own."""
    worker, _ = borrowing("quasi_monte_carlo", "halton", f"halton({name}=1)", Limits())
    with worker:
        with pytest.raises(StudentError) as error:
            worker.call("f")
        assert error.value.kind == "raised"


def test_a_file_that_takes_long_is_not_imported_again_and_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Functions that end their process had it imported anew each time: two hours for 9.5 s and 103 functions."""
    monkeypatch.setattr(client, "SHORT", 0.0)
    names = [f"f{number}" for number in range(20)]
    source = "import os, time\ntime.sleep(0.5)\ndef f0(): os._exit(1)\n" + "".join(
        f"{name} = f0\n" for name in names[1:]
    )
    limits = Limits(call_seconds=2.0)
    found = []
    with Worker("motion_blur", source.encode(), limits) as worker:
        for name in names:
            with pytest.raises(StudentError) as error:
                worker.call(name)
            found.append(error.value.kind)
    # Each call is made twice, and each time the file is imported: until 3 s are over.
    assert found[0] == "crashed"
    assert found[-1] == "timeout"
    assert found.count("crashed") <= 5


HOLDS = b"""
import time
import numpy as np
HELD = []

def f(megabytes):
    HELD.append(np.ones(megabytes << 17))
    return len(HELD)

def g(megabytes):
    f(megabytes)
    time.sleep(10)
"""


def test_all_workers_of_a_submission_hold_no_more_than_one_may() -> None:
    limits = Limits(call_seconds=60)
    budget = WorkerBudget(Limits(memory=400 << 20))
    with (
        Worker("m", HOLDS, limits, budget=budget) as one,
        Worker("n", HOLDS, limits, budget=budget) as other,
        Worker("o", HOLDS, limits) as stranger,
    ):
        assert stranger.call("f", 150) == 1
        assert one.call("f", 80) == 1
        # By itself it may.
        assert other.call("f", 100) == 1
        with pytest.raises(StudentError) as error:
            other.call("g", 250)
        assert error.value.kind == "crashed"
        assert "together held more than 400 MB" in str(error.value)
        # The one that held most was ended, and no other.
        assert [worker.call("f", 1) for worker in (stranger, one, other)] == [2, 2, 1]


def test_a_worker_is_closed_when_its_module_is_done() -> None:
    modules = ("motion_blur", "cube_map")
    running: list[int] = []

    def each(_: object) -> None:
        running.append(len(psutil.Process().children()))

    report = grade(
        {module: solution(module).encode() for module in modules},
        arrays(),
        modules=modules,
        only=quick,
        each=each,
    )
    assert report.score == 1
    # Never more than the module's own process.
    assert max(running) == min(running)


def test_the_seconds_of_a_submission_are_limited_where_somebody_says_so() -> None:
    module = "motion_blur"
    sources = {module: solution(module).encode()}
    # Less than two looks at the clock take, so nothing can have begun on any machine.
    late = grade(
        sources, arrays(), modules=[module], only=quick, limits=Limits(submission_seconds=1e-9)
    )
    assert {result.status for result in late.results} == {Status.TIMEOUT}
    assert {result.found for result in late.results} == {
        f"{NOT_RUN}: the submission's 1e-09 s are over"
    }
    in_time = grade(
        sources, arrays(), modules=[module], only=quick, limits=Limits(submission_seconds=600)
    )
    assert in_time.score == 1
    assert Limits().submission_seconds is None


@pytest.mark.usefixtures("quickly")
def test_calls_end_with_the_seconds_of_a_submission() -> None:
    # A call alone may take longer than the submission: it is the submission that ends it.
    limits = Limits(call_seconds=60, submission_seconds=4)
    with Worker("m", b"def f():\n    while True: pass\n", limits) as worker:
        worker.load()
        with pytest.raises(StudentError) as error:
            worker.call("f")
        assert error.value.kind == "timeout"
        assert str(error.value) == "no answer yet, and the submission's 4 s are over"
        with pytest.raises(StudentError, match=f"{NOT_RUN}: the submission's 4 s are over"):
            worker.call("f")


@pytest.mark.usefixtures("quickly")
def test_an_import_ends_with_the_seconds_of_a_submission() -> None:
    over = "the submission's 3 s are over"
    with Worker("m", b"while True: pass\n", Limits(submission_seconds=3)) as worker:
        with pytest.raises(StudentError) as error:
            worker.load()
        assert str(error.value) == f"the import of m.py hadn't ended yet, and {over}"
        assert (error.value.kind, error.value.module_wide) == ("timeout", True)


def test_a_generator_that_was_sent_is_looked_at_after_the_call() -> None:
    source = b"def f(n, rng):\n    rng.random(n)\n    return n\n"
    with Worker("m", source) as worker:
        _, (n, rng), changed = worker.call_and_look("f", 3, np.random.default_rng(1))
    expected = np.random.default_rng(1)
    expected.random(3)
    assert (n, changed) == (3, frozenset())
    assert rng.bit_generator.state == expected.bit_generator.state


def test_memory_that_is_handed_out_again_is_seen() -> None:
    source = b"""
import numpy as np
kept = np.zeros(3)
def same(x):
    kept[:] = x
    return kept
def equal(x):
    return kept
def new(x):
    return 1.0 * x
"""
    with Worker("m", source) as worker:
        for function, changed in (("same", {EARLIER_RESULT}), ("equal", set()), ("new", set())):
            first, second = np.ones(3), 2 * np.ones(3)
            assert worker.call_and_look(function, first)[2] == frozenset()
            assert worker.call_and_look(function, second)[2] == changed
