"""A folder of a student's, and a studio that follows it."""

from __future__ import annotations

import shutil
import textwrap
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

import pytest

from course.engine.functions.effects import PROJECT
from course.school.studio import checker, verdicts
from course.school.studio.studio import Studio

SCENE = """\
# A ball under a lamp.
title: A ball
camera: {eye: [0, 1.2, 4], look_at: [0, 0.4, 0], vertical_fov: 34}   # from the front
film: {width: 72, height: 48}
sampler: {samples: 16}
integrator: {max_depth: 0}
materials:
  grey: {color: 0.7}
lights:
  # The lamp.
  - {type: sphere, center: [-2, 3, 2], radius: 0.8, intensity: 30}
  - {type: ambient, radiance: 0.1}
objects:
  - {shape: quad, material: grey, width: 12, depth: 12}
  - {shape: sphere, material: grey, radius: 0.5, transform: [{translate: [0, 0.5, 0]}]}
"""

RIGHT = """\
z = 1 - 2 * u[0]
s = np.sqrt(np.maximum(0, 1 - z * z))
phi = 2 * np.pi * u[1]
offset = radius * np.stack((s * np.cos(phi), s * np.sin(phi), z))
return (center[:, None] + offset).astype(u.dtype)
"""

WRONG = RIGHT.replace("radius *", "0.1 * radius *")


def write(folder: Path, body: str, function: str = "point_on_sphere") -> None:
    """Write the body of a function into the stub of soft_shadows, as an editor saves a file."""
    stub = (PROJECT / "assignments" / "soft_shadows.py").read_text(encoding="utf-8")
    head = stub.index(f"def {function}(")
    last = stub.index("raise NotImplementedError", head)
    rest = stub.index("\n", last)
    file = folder / "assignments" / "soft_shadows.py"
    other = file.with_suffix(".new")
    text = stub[:last] + textwrap.indent(body, "    ").strip() + stub[rest:]
    other.write_text(text, encoding="utf-8")
    other.replace(file)


def until(found: Callable[[], Any], seconds: float = 280.0) -> Any:
    """Wait for something that is true; how long decides no test."""
    end = time.monotonic() + seconds
    while not (value := found()):
        assert time.monotonic() < end, "it didn't happen"
        time.sleep(0.02)
    return value


@pytest.fixture
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with stubs and a scene, which is the current one."""
    (tmp_path / "assignments").mkdir()
    for name in ("soft_shadows", "supersampling"):
        shutil.copy(PROJECT / "assignments" / f"{name}.py", tmp_path / "assignments")
    (tmp_path / "ball.yaml").write_text(SCENE, encoding="utf-8")
    # Beside other tests, which take all processors, checks that are nice would wait for minutes.
    monkeypatch.setattr(checker, "NICE", 0)
    monkeypatch.chdir(tmp_path)
    return tmp_path


class Unchecked:
    """Stands for the process that checks: of each module it says at once that it knows nothing of its functions."""

    def __init__(self, _folder: Path, event: Callable[[dict[str, Any]], None]) -> None:
        self._event = event
        self.run = 0

    def check(self, modules: Sequence[str], _first: Sequence[str], nice: bool) -> None:
        """See ``Checker``."""
        self.run += 1
        for module in modules:
            self._event({"module": module, "functions": [], "run": self.run})
        self._event({"done": True, "run": self.run})

    def prepare(self) -> None:
        """See ``Checker``."""

    def stop(self) -> None:
        """See ``Checker``."""
        self.run += 1

    def close(self) -> None:
        """See ``Checker``."""


@pytest.fixture
def checked() -> None:
    """Asked for by tests whose studio checks functions; half of the time of the others would be that of checks."""


@pytest.fixture
def studio(
    work: Path, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Studio]:
    """A studio of the ball."""
    if "checked" not in request.fixturenames:
        monkeypatch.setattr(verdicts, "Checker", Unchecked)
    made = Studio(work / "ball.yaml", "mine")
    made.start()
    yield made
    made.close()


@pytest.fixture
def viewer(work: Path) -> Iterator[Studio]:
    """The same without a student's functions."""
    made = Studio(work / "ball.yaml", None)
    made.start()
    yield made
    made.close()
