"""Where compiled loops are kept, and which of them are made anew."""

import atexit
import os
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from tests.forms import needs_numba

pytestmark = needs_numba


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A source of loops, which are kept in another folder."""
    from numba import config

    path = tmp_path / "sources" / "some_kernels.py"
    path.parent.mkdir()
    path.write_text("", encoding="utf-8")
    monkeypatch.setattr(config, "CACHE_DIR", str(tmp_path / "kept"))
    return path


def test_older_loops_are_forgotten_wherever_they_are_kept(source: Path) -> None:
    from course.engine.casters.older_loops import _place, forget_older_loops

    old, new = (_place(source) / f"{name}.nbi" for name in ("old", "new"))
    assert source.parent not in old.parents
    for index, age in ((old, -1), (new, 1)):
        index.touch()
        os.utime(index, (source.stat().st_mtime + age,) * 2)
    forget_older_loops(source.parent)
    assert not old.exists()
    assert new.exists()


def test_loops_are_compiled_where_none_can_be_kept(
    source: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    from numba.core import caching

    from course.engine.casters.older_loops import _place, forget_older_loops

    # A home and a course that can't be written, as of a container's user of another number.
    classes = caching.CacheImpl._locator_classes
    named = [each for each in classes if "UserProvided" in each.__name__]
    monkeypatch.setattr(caching.CacheImpl, "_locator_classes", named)
    monkeypatch.setattr(caching.config, "CACHE_DIR", "")
    monkeypatch.setenv("NUMBA_CACHE_DIR", "")
    ended: list[Callable[[], None]] = []
    monkeypatch.setattr(
        atexit, "register", lambda *work, **how: ended.append(partial(*work, **how))
    )
    forget_older_loops(source.parent)
    assert "set NUMBA_CACHE_DIR" in caplog.text
    kept = Path(os.environ["NUMBA_CACHE_DIR"])
    assert kept in _place(source).parents
    for done in ended:
        done()
    assert not kept.exists()
