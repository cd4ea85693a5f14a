"""What a process in the sandbox can see and do, asked by Python itself and so without the audit hook's help.

``test_attacks.py`` tries more, behind each wall; here is what a wall consists of, and what is said where one is
missing.
"""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks.attacks.walls import WALLS, python_for
from course.engine.functions.effects import PROJECT
from course.school.grading.worker import sandbox as walls
from course.school.grading.worker.client import Worker
from course.school.grading.worker.confine import landlock_version
from course.school.grading.worker.sandbox import (
    COULD,
    NotProtected,
    plain,
    protected,
    sandbox,
    worker_user,
)
from course.school.grading.worker.syscalls import filter_program

SHUT_IN = sandbox()

LINUX = sys.platform == "linux"
needs_landlock = pytest.mark.skipif(not landlock_version(), reason="the kernel has no Landlock")
needs_filter = pytest.mark.skipif(not LINUX or not filter_program(), reason="no libseccomp here")

needs_bubblewrap = pytest.mark.skipif(
    not any("no network" in line for line in SHUT_IN.protections),
    reason="bubblewrap isn't installed, or user namespaces are not allowed here",
)


def inside(code: str) -> str:
    """What Python code prints in there, its last line."""
    run = subprocess.run(
        [*SHUT_IN.command, "-c", code], check=False, capture_output=True, text=True, timeout=30
    )
    assert run.returncode == 0, run.stderr
    return run.stdout.strip()


@needs_bubblewrap
@pytest.mark.parametrize(
    "path",
    [PROJECT, PROJECT / "solutions", Path("/home"), Path("/etc/passwd"), Path("/tmp")],
    ids=str,
)
def test_it_sees_no_file_of_ours(path: Path) -> None:
    assert inside(f"import os; print(os.path.exists({str(path)!r}))") == "False"


@needs_bubblewrap
def test_it_sees_nothing_at_home_but_the_way_to_python() -> None:
    home = str(Path.home())
    if Path(sys.base_prefix).is_relative_to(home):
        assert inside(f"import os; print(len(os.listdir({home!r})))") == "1"
    else:
        assert inside(f"import os; print([n for _, _, n in os.walk({home!r})])") == "[]"


@needs_bubblewrap
@pytest.mark.parametrize(
    "folder", ["/", "/dev", "/dev/shm", "/proc", "/worker", "/site", "/usr/lib"]
)
def test_it_can_write_nowhere(folder: str) -> None:
    code = f"""
try:
    open({folder + "/forged"!r}, "w")
    print("written")
except OSError:
    print("refused")
"""
    assert inside(code) == "refused"


@needs_bubblewrap
def test_it_has_no_network() -> None:
    code = """
import socket
s = socket.socket()
s.settimeout(2)
try:
    s.connect(("127.0.0.1", 9))
except OSError as error:
    print(type(error).__name__, [name for _, name in socket.if_nameindex()])
"""
    assert "['lo']" in inside(code)


@needs_bubblewrap
def test_it_sees_no_other_process() -> None:
    numbers = inside("import os; print(sorted(int(n) for n in os.listdir('/proc') if n.isdigit()))")
    assert len(numbers.split(",")) <= 3


@needs_bubblewrap
def test_it_keeps_no_variable_of_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PENUMBRA_SECRET", "solution")
    assert inside("import os; print(os.environ.get('PENUMBRA_SECRET'))") == "None"


@needs_bubblewrap
def test_it_has_no_capabilities_and_can_get_none() -> None:
    status = inside("print(*open('/proc/self/status').read().splitlines(), sep=';')").split(";")
    found = dict(line.split(":\t") for line in status if line.startswith(("Cap", "NoNewPrivs")))
    assert found.pop("NoNewPrivs") == "1"
    assert {*found.values()} == {"0" * 16}


def test_the_report_says_what_was_on() -> None:
    lines = sandbox(bubblewrap=False).protections
    assert any("limits on" in line for line in lines)
    assert any("not on: bubblewrap" in line for line in lines)


@pytest.mark.skipif(not LINUX, reason="the walls are Linux's")
def test_the_probe_sees_every_guarantee_that_a_plain_process_lacks() -> None:
    assert walls._found(plain(), (PROJECT / "solutions",)) == [*COULD, "threads"]


@needs_filter
def test_the_probe_sees_that_landlock_is_missing() -> None:
    assert sandbox(bubblewrap=False, user=False, landlock=False).lacks == ("read",)


@needs_landlock
def test_the_probe_sees_that_the_filter_of_calls_is_missing() -> None:
    lacks = sandbox(bubblewrap=False, user=False, seccomp=False).lacks
    assert set(lacks) >= {"network", "processes"}


@needs_landlock
@needs_filter
def test_landlock_and_the_filter_keep_all_guarantees_without_root_or_bubblewrap() -> None:
    shut_in = sandbox(bubblewrap=False, user=False)
    assert shut_in.lacks == ()
    source = b"import json, fractions, numpy.polynomial\ndef f(): return 1.0\n"
    with Worker("m", source, shut_in=shut_in) as worker:
        assert worker.call("f") == 1.0


def test_where_no_wall_holds_other_peoples_code_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    sandbox.cache_clear()
    monkeypatch.setattr(walls, "_ways", lambda *_: iter([plain()]))
    monkeypatch.setattr(walls, "_found", lambda *_: ["read", "network", "threads"])
    with pytest.raises(NotProtected) as refused:
        protected()
    sandbox.cache_clear()
    for said in (COULD["read"], COULD["network"], "bubblewrap", "root", "--trust-submissions"):
        assert said in str(refused.value)
    assert COULD["write"] not in str(refused.value)


@needs_filter
def test_what_lies_where_the_code_can_read_it_is_found_before_grading(tmp_path: Path) -> None:
    # Python's own library is readable behind every wall.
    assert sandbox(secrets=(Path(json.__file__).parent,)).lacks == ("read",)
    assert sandbox(secrets=(tmp_path,)).lacks == ()


@needs_filter
@pytest.mark.parametrize("wall", ["bubblewrap", "bubblewrap alone", "Landlock"])
def test_what_is_installed_into_python_itself_is_closed(wall: str) -> None:
    # There the course with its solutions lies in a container, in conda, or without a virtual environment.
    installed = Path(json.__file__).parents[2] / "site-packages"
    secrets = tuple(installed.glob("*/*.py"))
    if not secrets:
        pytest.skip("nothing is installed there")
    shut_in = sandbox(**WALLS[wall], secrets=secrets)
    if wall != "Landlock" and not shut_in.own_world:
        pytest.skip("bubblewrap doesn't work here")
    if wall == "Landlock" and not shut_in.landlock:
        pytest.skip("the kernel has no Landlock")
    assert "read" not in shut_in.lacks


@pytest.mark.skipif(not LINUX, reason="the walls are Linux's")
@pytest.mark.parametrize("user", ["root", "another"])
@pytest.mark.parametrize("wall", WALLS)
def test_threads_are_limited_wherever_the_kernel_counts_them(user: str, wall: str) -> None:
    source = (
        "import threading, time\ndef f():\n    for n in range(99):\n        try:\n"
        "            threading.Thread(target=time.sleep, args=(99,), daemon=True).start()\n"
        "        except RuntimeError:\n            break\n    return n\n"
    )
    code = (
        "from benchmarks.attacks.walls import behind\n"
        "from course.school.grading.worker.client import Worker\n"
        f"shut_in = behind({wall!r}, 'x')\n"
        f"with Worker('m', {source!r}.encode(), shut_in=shut_in) as worker:\n"
        "    print(shut_in.users, bool(shut_in.becomes), shut_in.own_world, shut_in.threads, worker.call('f'))\n"
    )
    try:
        with python_for(user) as python:
            run = subprocess.run(
                [*python, "-c", code], check=False, capture_output=True, text=True, cwd=PROJECT
            )
    except LookupError as error:
        pytest.skip(str(error))
    if "LookupError" in run.stderr:
        pytest.skip(run.stderr.splitlines()[-1])
    *counted, threads, started = run.stdout.split()
    if "True" not in counted:
        pytest.skip("root without a user of the worker's own, or no namespaces of users here")
    assert threads == "64"
    assert 60 <= int(started) < 64


def test_each_worker_has_a_user_of_its_own() -> None:
    users = {worker_user(number) for number in range(64)}
    assert len(users) == 64
    assert all(user > 60_000 for user in users)
