"""A browser to open pages with: one for all tests of a process, since a second one can't be driven beside it."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")


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
