"""The site, built once for all tests of it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from course.effects import PROJECT


@pytest.fixture(scope="session")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the built site, with grey pictures; a warning is an error."""
    for needed in ("sphinx", "myst_parser", "furo", "latex2mathml"):
        pytest.importorskip(needed, reason='the site needs: pip install -e ".[docs]"')
    folder = tmp_path_factory.mktemp("site")
    out = folder / "html"
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    options = ["-D", "pictures=blank", "-d", str(folder / "doctrees"), str(PROJECT / "docs")]
    built = subprocess.run(
        [*command, *options, str(out)], check=False, capture_output=True, text=True
    )
    assert built.returncode == 0, built.stderr
    return out
