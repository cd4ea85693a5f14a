"""What submissions try, by accident or not, and the score that each gets: nobody earns more, nobody else loses.

Each attack sits in one function of a module whose other functions are right: it must cost that function's points, or
the named checks, and nothing else.
"""

from __future__ import annotations

import threading
from functools import cache

import numpy as np
import psutil
import pytest

from course.effects import PROJECT
from course.grading.catalog import module_checks
from course.grading.checks.check import Check
from course.grading.checks.running import References, Status
from course.grading.grading import grade
from course.grading.references import references
from course.grading.report import Report
from course.grading.worker.client import Limits, Worker
from course.grading.worker.sandbox import sandbox

MODULE = "motion_blur"
FUNCTION = "to_object_space"
SOLUTION = (PROJECT / "solutions" / f"{MODULE}.py").read_text(encoding="utf-8")
RIGHT = "    return origins - np.multiply.outer(np.asarray(velocity, time.dtype), time)\n"
ALL = "all"

SANDBOXES = [pytest.param(False, id="without bubblewrap")]
if any("bubblewrap: no network" in line for line in sandbox().protections):
    SANDBOXES.append(pytest.param(True, id="bubblewrap"))


def quick(check: Check) -> bool:
    return check.kind not in ("picture", "bias", "order", "speed")


def points(function: str | None = None) -> float:
    checks = [check for check in module_checks(MODULE).checks if quick(check)]
    return sum(check.points for check in checks if function in (None, check.function))


@cache
def arrays() -> References:
    return references()


def graded(source: str | bytes, bubblewrap: bool) -> Report:
    content = source if isinstance(source, bytes) else source.encode()
    report = grade(
        {MODULE: content},
        arrays(),
        modules=[MODULE],
        limits=Limits(call_seconds=1.5, memory=1 << 30),
        shut_in=sandbox(bubblewrap),
        only=quick,
    )
    assert report.of == points()
    assert report.count(Status.GRADER_ERROR) == 0
    return report


def with_body(body: str, before: str = "") -> str:
    checks = '    _check_batch("origins", origins, 3)\n    _check_single(velocity=velocity)\n'
    checks += '    _check_scalars("time", time, np.shape(origins)[1])\n'
    return f"{SOLUTION}\n{before}\ndef {FUNCTION}(origins, velocity, time):\n{checks}{body}"


# Each: the function's body, what stands before it, how the function's checks end, and which of them are lost.
ATTACKS: dict[str, tuple[str, str, Status, str | set[str]]] = {
    "sys.exit": ("    import sys\n    sys.exit(0)", "", Status.FAILED, ALL),
    "os._exit": ("    import os\n    os._exit(0)", "", Status.CRASHED, ALL),
    "endless loop": ("    while True: pass", "", Status.TIMEOUT, ALL),
    "endless recursion": (
        f"    return {FUNCTION}(origins, velocity, time)",
        "",
        Status.FAILED,
        ALL,
    ),
    "memory bomb": ("    return np.ones((3, 1 << 32))", "", Status.FAILED, ALL),
    "slow memory bomb": (
        "    kept = []\n    while True: kept.append(np.zeros(1 << 24))",
        "",
        Status.FAILED,
        ALL,
    ),
    "fork bomb": ("    import os\n    while True: os.fork()", "", Status.FAILED, ALL),
    "processes": (
        "    import subprocess\n    subprocess.run(['true'])\n" + RIGHT,
        "",
        Status.FAILED,
        ALL,
    ),
    "threads that never end": (
        "    import threading, time as t\n"
        "    if threading.active_count() < 3: threading.Thread(target=t.sleep, args=(1e6,)).start()\n"
        + RIGHT,
        "",
        Status.PASSED,
        set(),
    ),
    "flood of output": ("    while True: print('x' * 10000)", "", Status.TIMEOUT, ALL),
    "forged result on stdout": (
        '    print(\'{"score": 100, "tests": []}\', flush=True)\n    return np.zeros(3)',
        "",
        Status.FAILED,
        ALL,
    ),
    "chatty but right": ("    print('debugging', time.shape)\n" + RIGHT, "", Status.PASSED, set()),
    "forged result on every descriptor": (
        "    import os\n"
        "    for fd in range(64):\n"
        "        try: os.write(fd, b'00000010{\"score\": 100000}')\n"
        "        except OSError: pass\n" + RIGHT,
        "",
        Status.CRASHED,
        ALL,
    ),
    "closed descriptors": (
        "    import os\n    os.closerange(0, 64)\n" + RIGHT,
        "",
        Status.CRASHED,
        ALL,
    ),
    "an array that forges comparisons": (
        "    return np.zeros((3, len(time)), time.dtype).view(Forged)",
        (
            "class Forged(np.ndarray):\n"
            "    def __eq__(self, other): return np.ones(self.shape, bool)\n"
            "    def __array_ufunc__(self, *a, **k): return np.zeros(())\n"
        ),
        Status.FAILED,
        ALL,
    ),
    "object arrays": ("    return np.array([[object()]] * 3)", "", Status.FAILED, ALL),
    "pickles": (
        "    return Pickled()",
        "class Pickled:\n    def __reduce__(self): return (exit, ())\n",
        Status.FAILED,
        ALL,
    ),
    "a name of its own for None": ("    return None", "", Status.FAILED, ALL),
    "NaN": ("    return np.full((3, len(time)), np.nan, time.dtype)", "", Status.FAILED, ALL),
    "wrong shape": ("    return np.zeros((len(time), 3), time.dtype)", "", Status.FAILED, ALL),
    "wrong dtype": (
        "    return origins - np.asarray(velocity, float)[:, None] * time.astype(float)",
        "",
        Status.FAILED,
        {"contract"},
    ),
    "reads the solutions": (
        f"    exec(open({str(PROJECT / 'solutions' / (MODULE + '.py'))!r}).read(), globals())\n"
        + RIGHT,
        "",
        Status.FAILED,
        ALL,
    ),
    "imports the solutions": ("    import solutions.motion_blur\n" + RIGHT, "", Status.FAILED, ALL),
    "imports the course": ("    import course\n" + RIGHT, "", Status.FAILED, ALL),
    "lists the folder": (
        f"    import os\n    os.listdir({str(PROJECT)!r})\n" + RIGHT,
        "",
        Status.FAILED,
        ALL,
    ),
    "patches NumPy": (
        "    return np.zeros((3, len(time)), time.dtype)",
        "np.allclose = np.array_equal = lambda *a, **k: True\n",
        Status.FAILED,
        {"contract", "at-rest", "at-start", "travels-along", "own-time"},
    ),
    "signals its parent": (
        "    import os\n    os.kill(os.getppid(), 9)\n" + RIGHT,
        "",
        Status.FAILED,
        ALL,
    ),
    "C through ctypes": (
        "    import ctypes\n    ctypes.CDLL(None).fork()\n" + RIGHT,
        "",
        Status.FAILED,
        ALL,
    ),
    "opens a socket": ("    import socket\n    socket.socket()\n" + RIGHT, "", Status.FAILED, ALL),
    "writes a file": ("    open('/tmp/forged', 'w')\n" + RIGHT, "", Status.FAILED, ALL),
    "changes the random state": (
        "    np.random.seed(1)\n" + RIGHT,
        "",
        Status.FAILED,
        {"untouched"},
    ),
    "an exception without words": (
        "    raise Odd()",
        "class Odd(Exception):\n    def __str__(self): raise ValueError\n",
        Status.FAILED,
        ALL,
    ),
    "an exception that is no exception": ("    raise KeyboardInterrupt", "", Status.FAILED, ALL),
}


@pytest.mark.parametrize("bubblewrap", SANDBOXES)
@pytest.mark.parametrize("name", ATTACKS)
def test_an_attack_costs_its_own_function(name: str, bubblewrap: bool) -> None:
    body, before, status, lost = ATTACKS[name]
    report = graded(with_body(body, before), bubblewrap)
    found = {
        result.check: result.status for result in report.results if result.function == FUNCTION
    }
    wrong = {check for check, ended in found.items() if ended is not Status.PASSED}
    # What is refused for its arguments may be refused by the attack too, with another error.
    if lost == ALL:
        # The attack stands behind the checks of arguments, which are right, and may leave its inputs alone.
        assert wrong >= set(found) - {"refuses", "untouched"}
    else:
        assert wrong == lost
    if lost:
        assert status in {found[check] for check in wrong}
    # Whatever it cost, it cost this function.
    others = [result for result in report.results if result.function != FUNCTION]
    assert {result.status for result in others} == {Status.PASSED}
    earned = sum(
        result.of for result in report.results if result.check not in wrong or result in others
    )
    assert report.points == earned


def test_nothing_is_left_running() -> None:
    before = {child.pid for child in psutil.Process().children(recursive=True)}
    graded(
        with_body(
            "    import threading, time as t\n    threading.Thread(target=t.sleep, args=(1e6,)).start()\n"
            + RIGHT
        ),
        False,
    )
    graded(with_body("    while True: pass"), False)
    assert {child.pid for child in psutil.Process().children(recursive=True)} <= before


FILES: dict[str, tuple[bytes, Status, float]] = {
    "nothing": (b"", Status.NOT_ATTEMPTED, 0.0),
    "a stub": ((PROJECT / "assignments" / f"{MODULE}.py").read_bytes(), Status.NOT_ATTEMPTED, 0.0),
    "a syntax error": (b"def displacement(velocity, time:\n", Status.FAILED, 0.0),
    "an import error": (b"import torch\n" + SOLUTION.encode(), Status.FAILED, 0.0),
    "an exit at import": (b"raise SystemExit(0)\n", Status.FAILED, 0.0),
    "a loop at import": (b"while True: pass\n", Status.TIMEOUT, 0.0),
    "a binary file": (bytes(range(256)) * 40, Status.FAILED, 0.0),
    "10 MB of source": (SOLUTION.encode() + b"# filler\n" * 1_200_000, Status.FAILED, 0.0),
    "Windows line ends": (SOLUTION.replace("\n", "\r\n").encode(), Status.PASSED, 1.0),
    "tabs": (SOLUTION.replace("    ", "\t").encode(), Status.PASSED, 1.0),
    "a byte order mark": (b"\xef\xbb\xbf" + SOLUTION.encode(), Status.PASSED, 1.0),
    "Latin-1": (
        b"# -*- coding: latin-1 -*-\n# \xe9\n"
        + SOLUTION.replace("-", "-").encode("latin-1", "replace"),
        Status.PASSED,
        1.0,
    ),
}


@pytest.mark.parametrize("name", FILES)
def test_a_file_gets_its_score(name: str) -> None:
    content, status, score = FILES[name]
    report = graded(content, bubblewrap=True)
    assert {result.status for result in report.results} == {status}
    assert report.score == score


def test_what_is_printed_is_kept_and_cut() -> None:
    report = graded(with_body("    print('here', '!' * 100000)\n" + RIGHT), bubblewrap=True)
    assert report.printed[MODULE].startswith("here !!!")
    assert len(report.printed[MODULE]) < 5000
    assert report.score == 1


def test_a_hidden_seed_needs_no_new_code() -> None:
    source = SOLUTION.encode()
    for seed in (1, 20261121):
        assert (
            grade({MODULE: source}, references(seed), seed=seed, modules=[MODULE], only=quick).score
            == 1
        )


def test_checks_draw_the_same_numbers_whoever_is_graded() -> None:
    from course.grading.checks.running import generator

    check = module_checks(MODULE).checks[0]
    assert np.array_equal(
        generator(3, MODULE, check).random(4), generator(3, MODULE, check).random(4)
    )
    assert not np.array_equal(
        generator(3, MODULE, check).random(4), generator(4, MODULE, check).random(4)
    )


def test_a_function_pays_for_no_other_functions_mistake() -> None:
    body = "    return -np.multiply.outer(np.asarray(velocity, time.dtype), time)\n"
    wrong = f"{SOLUTION}\ndef displacement(velocity, time):\n{body}"
    report = graded(wrong, bubblewrap=True)
    lost = {result.function for result in report.results if result.status is not Status.PASSED}
    assert lost == {"displacement"}
    # Unwritten is as wrong.
    unwritten = f"{SOLUTION}\ndef displacement(velocity, time):\n    raise NotImplementedError\n"
    report = graded(unwritten, bubblewrap=True)
    assert {result.function for result in report.results if result.status is not Status.PASSED} == {
        "displacement"
    }


def test_nobody_passes_by_two_functions_that_call_each_other() -> None:
    circle = (
        "def displacement(velocity, time):\n"
        "    return -to_object_space(np.zeros((3, len(time)), time.dtype), velocity, time)\n"
        "def to_object_space(origins, velocity, time):\n    return origins - displacement(velocity, time)\n"
    )
    report = graded(f"{SOLUTION}\n{circle}", bubblewrap=True)
    lost = {result.function for result in report.results if result.status is not Status.PASSED}
    assert "displacement" in lost


def test_what_is_borrowed_can_only_be_what_was_lent() -> None:
    forged = (
        "    import os, json\n"
        "    head = json.dumps({'borrowed': 'displacement', 'names': [], 'values': [], 'arrays': 0}).encode()\n"
        "    for fd in range(3, 64):\n"
        "        try: os.write(fd, b'%08x' % len(head) + head)\n"
        "        except OSError: pass\n" + RIGHT
    )
    report = graded(with_body(forged), bubblewrap=False)
    ended = {result.status for result in report.results if result.function == FUNCTION}
    assert Status.CRASHED in ended or Status.FAILED in ended


def test_a_worker_outlives_the_thread_that_called_it_first() -> None:
    source = b"COUNT = []\ndef f():\n    COUNT.append(1)\n    return len(COUNT)\n"
    with Worker("m", source) as worker:
        for number in (1, 2, 3):
            found: list[int] = []
            thread = threading.Thread(target=lambda: found.append(worker.call("f")))  # noqa: B023 - joined at once
            thread.start()
            thread.join()
            assert found == [number]
