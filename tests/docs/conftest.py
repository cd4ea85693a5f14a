"""The site, built once for all tests of it, and a browser to open it with."""

import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from course.effects import PROJECT
from tests.once import Once

# For what builds the site, which Sphinx finds in the same way.
sys.path.append(str(PROJECT / "docs"))

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


@pytest.fixture(scope="session")
def site(once: Once) -> Path:
    """The folder of the built site, with grey pictures; a warning is an error."""
    for needed in ("sphinx", "myst_parser", "furo", "latex2mathml"):
        pytest.importorskip(needed, reason='the site needs: pip install -e ".[docs]"')
    return once("site", _build)


def _build(out: Path) -> None:
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html"]
    trees = out.with_name("doctrees")
    options = ["-D", "pictures=blank", "-d", str(trees), str(PROJECT / "docs"), str(out)]
    built = subprocess.run([*command, *options], check=False, capture_output=True, text=True)
    assert built.returncode == 0, built.stderr


@pytest.fixture(scope="session")
def browser() -> Iterator[Any]:
    """A Chromium, where there is one and something that drives it."""
    playwright = pytest.importorskip(
        "playwright.sync_api", reason='the browser is driven by: pip install -e ".[browser]"'
    )
    if CHROMIUM is None:
        pytest.skip("there is no chromium on this machine")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


@contextmanager
def untroubled(browser: Any, **options: Any) -> Iterator[Any]:
    """A page without a network, for which nothing may fail, be asked of another host or be told as an error."""
    context = browser.new_context(offline=True, **options)
    page = context.new_page()
    trouble: list[str] = []
    page.on("pageerror", lambda error: trouble.append(str(error)))
    page.on("console", lambda said: trouble.append(said.text) if said.type == "error" else None)

    def failed(request: Any) -> None:
        # Whoever goes on before all pictures are there gives up those that are on the way.
        if request.failure != "net::ERR_ABORTED":
            trouble.append(f"failed: {request.url}")

    def asked(request: Any) -> None:
        if not request.url.startswith(("file:", "data:")):
            trouble.append(f"asked: {request.url}")

    page.on("requestfailed", failed)
    page.on("request", asked)
    yield page
    context.close()
    assert trouble == []


def tab_to(page: Any, selector: str, presses: int = 150) -> None:
    """Press the Tab key until what has the focus is what was asked for."""
    for _ in range(presses):
        page.keyboard.press("Tab")
        if page.evaluate(f"document.activeElement.matches({selector!r})"):
            return
    raise AssertionError(f"the Tab key does not reach {selector}")
