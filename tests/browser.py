"""A browser to open pages with: one for all tests of a process, since a second one can't be driven beside it."""

import json
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


_LEFT: dict[str, tuple[Any, list[str]]] = {}
"""By their options: pages that nobody has open now, and what goes wrong in them."""


@contextmanager
def untroubled(browser: Any, alone: bool = False, **options: Any) -> Iterator[Any]:
    """A page without a network, for which nothing may fail, be asked of another host or be told as an error.

    It may be one that another test has had, as good as new: to make one takes longer than to open most pages.

    Parameters
    ----------
    alone : for a test that changes what a page can do, or opens others
    """
    place = json.dumps(options, sort_keys=True)
    if alone or place not in _LEFT:
        page = browser.new_context(offline=True, **options).new_page()
        trouble = troubles(page)
    else:
        page, trouble = _LEFT.pop(place)
    try:
        yield page
        _renew(page, options)
    except BaseException:
        page.context.close()
        raise
    if alone or trouble or place in _LEFT:
        page.context.close()
    else:
        _LEFT[place] = page, trouble
    assert trouble == [], "\n".join(trouble)


def _renew(page: Any, options: dict[str, Any]) -> None:
    """Leave nothing of what a test has done: no storage, no size or colours of its own, no pointer over anything."""
    if page.url.startswith("file:"):
        page.evaluate("localStorage.clear(), sessionStorage.clear()")
    page.mouse.move(0, 0)
    page.goto("about:blank")
    page.set_viewport_size(options.get("viewport", {"width": 1280, "height": 720}))
    page.emulate_media(media="null", color_scheme=options.get("color_scheme", "light"))


def troubles(page: Any) -> list[str]:
    """What goes wrong in a page, as it comes in."""
    found: list[str] = []
    page.on("pageerror", lambda error: found.append(str(error)))
    page.on("console", lambda said: found.append(said.text) if said.type == "error" else None)

    def failed(request: Any) -> None:
        # Whoever goes on before all pictures are there gives up those that are on the way.
        if request.failure != "net::ERR_ABORTED":
            found.append(f"failed: {request.url}")

    def asked(request: Any) -> None:
        if not request.url.startswith(("file:", "data:")):
            found.append(f"asked: {request.url}")

    page.on("requestfailed", failed)
    page.on("request", asked)
    return found


CUT_OFF = "[...document.querySelectorAll('.formula')].some((f) => f.scrollWidth > f.clientWidth)"


def assert_fits(page: Any, width: int) -> None:
    """Nothing is wider than the window, in the light and in the dark, which may be chosen while a page is open."""
    for chosen in ("light", "dark"):
        page.emulate_media(color_scheme=chosen)
        wide = page.evaluate("document.documentElement.scrollWidth")
        assert wide <= width, f"{page.url}: {wide} pixels"
        assert width < 1280 or not page.evaluate(CUT_OFF), f"{page.url}: a formula scrolls"
        behind = page.evaluate("getComputedStyle(document.body).backgroundColor")
        assert (sum(map(int, behind.strip("rgb()").split(","))) < 300) == (chosen == "dark")


def tab_to(page: Any, selector: str, presses: int = 150) -> None:
    """Press the Tab key until what has the focus is what was asked for."""
    for _ in range(presses):
        page.keyboard.press("Tab")
        if page.evaluate(f"document.activeElement.matches({selector!r})"):
            return
    raise AssertionError(f"the Tab key does not reach {selector}")
