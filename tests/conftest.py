"""Scenes said in a line, and the rays that a camera should cast, worked out apart from the engine in float64."""

import gc
import json
import os
import signal
import sys
from collections.abc import Callable, Generator
from contextlib import AbstractContextManager
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, settings
from numpy.typing import NDArray

from course import Scene, load_scene
from course.engine.render import which_loops
from course.engine.render.threads import default_threads
from tests.browser import browser
from tests.compiling import alone, take_turns
from tests.forms import FORMS
from tests.once import Once, made_once, shared_folder
from tests.reading import read_a_share

__all__ = ["browser"]

MakeScene = Callable[..., Scene]
Compiling = Callable[[], AbstractContextManager[None]]
PixelRays = Callable[[Scene], tuple[NDArray[np.float64], NDArray[np.float64]]]

# Without it jsonschema reads the grammar of all addresses, in two seconds; no schema here has one.
sys.modules["rfc3987_syntax"] = None  # type: ignore[assignment]

# What a test renders must not depend on those before it: loops are compiled where a test asks for them.
os.environ.setdefault("COURSE_NO_COMPILER", "1")

# How long it takes to make an example, or to try it, decides no test; `make stress` asks for another profile.
settings.register_profile("usual", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("stress", settings.get_profile("usual"), max_examples=2000)
settings.load_profile("usual")

# A shell's background jobs begin with Ctrl-C ignored, and so would every process that a test interrupts.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)


def pytest_xdist_auto_num_workers() -> int:
    """One process more than there are cores: many tests wait for processes that they have started."""
    return default_threads() + 1


@pytest.hookimpl(wrapper=True)
def pytest_collection(session: pytest.Session) -> Generator[None, object, object]:
    """Collect without Python's collector of garbage: it takes half of the time, and 14,000 tests are none."""
    gc.disable()
    try:
        read_a_share(session.config.args, session.config.rootpath)
        return (yield)
    finally:
        # They stay to the end, and are looked through no more.
        gc.freeze()
        gc.enable()


def pytest_configure(config: pytest.Config) -> None:
    """Say what marks mean."""
    config.addinivalue_line("markers", "fewer: see tests/lengths.py")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Leave out what only the long run tries. What alone was asked for is tried: it has what no other has."""
    # Hypothesis has its profile after this file has been read, and tests.lengths asks for it.
    from tests.lengths import LONG, without_combinations

    if not LONG:
        items[:] = without_combinations(items)


@pytest.fixture(scope="session")
def once(tmp_path_factory: pytest.TempPathFactory) -> Once:
    """Have something made by one process of this run for all of them."""
    return partial(made_once, shared_folder(tmp_path_factory))


@pytest.fixture(scope="session", autouse=True)
def compiled_in_turns(tmp_path_factory: pytest.TempPathFactory) -> Compiling:
    """While it is open no other process of this run compiles loops; this one waits for its turn, too."""
    folder = shared_folder(tmp_path_factory)
    # Where no test module has asked for it, nothing is compiled in this process.
    if "numba" in sys.modules:
        take_turns(folder)
    return partial(alone, folder)


@pytest.fixture
def make_scene(tmp_path: Path) -> MakeScene:
    """A scene from the values of its file; what isn't given is small and plain."""

    def make(**parts: Any) -> Scene:
        description: dict[str, Any] = {
            "camera": {"eye": [0, 0, 4], "look_at": [0, 0, 0]},
            "film": {"width": 32, "height": 32},
            "sampler": {"type": "sobol", "samples": 4},
            "materials": {"grey": {}},
            "objects": [],
            "lights": [],
        }
        description.update(parts)
        path = tmp_path / "scene.yaml"
        path.write_text(json.dumps(description), encoding="utf-8")
        return load_scene(path)

    return make


@pytest.fixture(params=FORMS)
def each_form(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> bool:
    """Run a test once with passes over arrays and once with compiled loops, whichever small renders would take.

    Without it that depends on which tests ran before: once Numba is imported it is used. So laws that a renderer must
    keep are tested with it, or one of the two forms is held against the other alone.
    """
    form = bool(request.param)

    def chosen(_settings: object, wanted: bool | None) -> bool:
        return form if wanted is None else wanted

    monkeypatch.setattr(which_loops, "wants_compiled", chosen)
    monkeypatch.setattr(which_loops, "may_change_over", lambda *_: False)
    return form


@pytest.fixture
def pixel_rays() -> PixelRays:
    """The eye (3,) and the unit directions (3, H, W) through the middles of the pixels, float64."""

    def rays(scene: Scene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        description = scene.loaded.description
        camera, film = description.camera, description.film
        eye = np.array(camera.eye)
        forward = np.array(camera.look_at) - eye
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, camera.up)
        right /= np.linalg.norm(right)
        up = np.cross(right, forward)
        half = np.tan(np.radians(camera.vertical_fov) / 2)
        y = half * (1 - 2 * (np.arange(film.height) + 0.5) / film.height)
        x = half * (2 * (np.arange(film.width) + 0.5) - film.width) / film.height
        direction = (
            forward[:, None, None]
            + right[:, None, None] * x[None, None, :]
            + up[:, None, None] * y[None, :, None]
        )
        return eye, direction / np.linalg.norm(direction, axis=0)

    return rays
