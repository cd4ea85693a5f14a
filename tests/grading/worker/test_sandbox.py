"""What a process in the sandbox can see and do, asked by Python itself and so without the audit hook's help."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from course.effects import PROJECT
from course.grading.worker.sandbox import sandbox

SHUT_IN = sandbox()

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


def test_the_report_says_what_was_on() -> None:
    plain = sandbox(bubblewrap=False).protections
    assert any("limits on" in line for line in plain)
    assert any("not on: bubblewrap" in line for line in plain)
