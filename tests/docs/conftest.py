"""The site, built once for all tests of it."""

import subprocess
import sys
from pathlib import Path

import pytest

from course.engine.functions.effects import PROJECT
from tests.once import Once

# For what builds the site, which Sphinx finds in the same way.
sys.path.append(str(PROJECT / "docs"))


SIZE, SMALL = "WIDTH = 360, HEIGHT = 270", "WIDTH = 72, HEIGHT = 54"
"""Of pictures that pages compute: a 25th of the pixels, for there may be no graphics card."""


@pytest.fixture(scope="session")
def site(once: Once) -> Path:
    """The folder of the built site, with grey and with small pictures; a warning is an error."""
    for needed in ("sphinx", "myst_parser", "furo", "latex2mathml"):
        pytest.importorskip(needed, reason='the site needs: pip install -e ".[docs]"')
    return once("site", _build)


def _build(out: Path) -> None:
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    trees = out.with_name("doctrees")
    options = ["-D", "pictures=blank", "-d", str(trees), str(PROJECT / "docs"), str(out)]
    built = subprocess.run([*command, *options], check=False, capture_output=True, text=True)
    assert built.returncode == 0, built.stderr
    live = out / "_static" / "live.js"
    script = live.read_text(encoding="utf-8")
    assert SIZE in script
    live.write_text(script.replace(SIZE, SMALL), encoding="utf-8")
