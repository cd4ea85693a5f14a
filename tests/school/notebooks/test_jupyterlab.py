"""A module's notebook in a real JupyterLab, in a real browser: run from its first cell to its last, and untrusted."""

import json
import os
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from typing import Any
from urllib.request import urlopen

import pytest

from course import load_scene, pixel, render
from course.engine.functions.effects import PROJECT
from course.school.notebooks.making import notebook_of

pytest.importorskip("jupyterlab", reason='JupyterLab is installed by: pip install -e ".[notebook]"')

WAIT = 300_000
"""Milliseconds for all cells of a notebook, however busy the machine is."""


def small(text: str) -> str:
    """A notebook whose pictures are small."""
    return text.replace("size=(400, 267)", "size=(60, 40)").replace(
        "effects=mine))", "effects=mine), seconds=0.2)"
    )


def foreign() -> str:
    """A notebook that somebody else has run: a comparison, and the rays of a pixel."""
    scene = load_scene("soft_shadows")
    hard, soft = (
        render(load_scene(name), spp=1, size=(60, 40))
        for name in ("before/soft_shadows", "soft_shadows")
    )
    story = pixel(scene, 30, 30, spp=1, size=(60, 40))
    outputs = [
        {"output_type": "display_data", "metadata": {}, "data": {"text/html": html}}
        for html in (hard.compare(soft)._repr_html_(), story._repr_html_())
    ]
    cell = {"cell_type": "code", "execution_count": 1, "metadata": {}, "source": "", "id": "a"}
    return json.dumps(
        {"cells": [cell | {"outputs": outputs}], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    )


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a server of its own, with a notebook of solutions in its folder, and one of somebody else."""
    tmp_path = tmp_path_factory.mktemp("lab")
    (tmp_path / "foreign.ipynb").write_text(foreign(), encoding="utf-8")
    solved = (PROJECT / "solutions" / "motion_blur.py").read_text(encoding="utf-8")
    notebook = notebook_of("motion_blur", solved, PROJECT).decode()
    (tmp_path / "motion_blur.ipynb").write_text(small(notebook), encoding="utf-8")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    home = {f"JUPYTER_{name}_DIR": str(tmp_path / name) for name in ("CONFIG", "DATA", "RUNTIME")}
    # All cells are there, not only those in the window.
    (tmp_path / "settings").mkdir()
    (tmp_path / "settings" / "overrides.json").write_text(
        '{"@jupyterlab/notebook-extension:tracker": {"windowingMode": "none"}}', encoding="utf-8"
    )
    options = [
        f"--LabApp.app_settings_dir={tmp_path / 'settings'}",
        f"--ServerApp.port={port}",
        "--ServerApp.port_retries=0",
        "--IdentityProvider.token=",
        f"--ServerApp.root_dir={tmp_path}",
        "--ServerApp.open_browser=False",
        "--ServerApp.allow_root=True",
        "--LabApp.news_url=None",
        "--LabApp.check_for_updates_class=jupyterlab.NeverCheckForUpdate",
    ]
    with subprocess.Popen(
        [sys.executable, "-m", "jupyterlab", *options],
        env=os.environ | home,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as server:
        address = f"http://127.0.0.1:{port}"
        try:
            for _ in range(1500):
                try:
                    urlopen(f"{address}/api", timeout=5).close()
                    break
                except OSError:
                    assert server.poll() is None, "JupyterLab has ended"
                    time.sleep(0.2)
            yield address
        finally:
            server.terminate()
            server.wait(20)


def test_a_notebook_of_solutions_is_right_and_shows_what_it_is_about(
    browser: Any, lab: str
) -> None:
    page = browser.new_context(viewport={"width": 1200, "height": 900}).new_page()
    page.set_default_timeout(WAIT)
    try:
        page.goto(f"{lab}/lab/tree/motion_blur.ipynb?reset")
        page.locator(".jp-Notebook .jp-Cell").first.wait_for(timeout=WAIT)
        # Where the kernel isn't there yet, it is asked for.
        select = page.get_by_role("button", name="Select", exact=True)
        page.add_locator_handler(select, select.click)
        page.locator("#jp-main-statusbar").get_by_text("Idle").wait_for(timeout=WAIT)
        page.get_by_role("menuitem", name="Run", exact=True).click()
        page.get_by_text("Run All Cells", exact=True).click()
        plot = page.locator(".jp-OutputArea-output img[src^='data:image/png']").last
        page.wait_for_function(
            "document.querySelectorAll('.jp-Notebook iframe[title=\"Rays of a pixel\"]').length > 0",
            timeout=WAIT,
        )
        plot.wait_for(timeout=WAIT)
        shown = page.locator(".jp-Notebook")
        assert shown.inner_text().count("10 of 10 points") == 3
        assert shown.locator("[data-mime-type='application/vnd.jupyter.error']").count() == 0
        # The slider moves the edge between both pictures.
        slider = shown.locator("input[type=range]").first
        slider.evaluate("(it) => { it.value = 20; it.dispatchEvent(new Event('input')); }")
        cut = slider.evaluate("(it) => it.parentNode.style.getPropertyValue('--cut')")
        assert cut == "20%"
        # The receipt is folded until it is asked for.
        table = shown.locator("details table").first
        assert not table.is_visible()
        shown.locator("summary").first.click()
        assert table.is_visible()
        # The rays are drawn, and turn.
        page.locator("iframe[title='Rays of a pixel']").scroll_into_view_if_needed()
        frame = page.frame_locator("iframe[title='Rays of a pixel']")
        canvas = frame.locator(".rays canvas")
        canvas.scroll_into_view_if_needed()
        page.wait_for_timeout(500)
        seen = {canvas.screenshot()}
        canvas.focus()
        for _ in range(50):
            page.keyboard.press("ArrowRight")
            page.wait_for_timeout(100)
            seen.add(canvas.screenshot())
            if len(seen) > 3:
                break
        assert len(seen) > 3
    finally:
        page.context.close()


def test_a_notebook_that_is_not_trusted_shows_stills(browser: Any, lab: str) -> None:
    page = browser.new_context(viewport={"width": 1200, "height": 1400}).new_page()
    page.set_default_timeout(WAIT)
    try:
        page.goto(f"{lab}/lab/tree/foreign.ipynb?reset")
        shown = page.locator(".jp-OutputArea-output img")
        shown.nth(2).wait_for()
        assert page.locator(".jp-OutputArea-output iframe").count() == 0
        boxes = [one.bounding_box() for one in shown.all()]
        # No picture covers another, and none is blank; a slider that moves nothing isn't there.
        tops = [box["y"] for box in boxes]
        ends = [box["y"] + box["height"] for box in boxes]
        assert all(box["height"] >= 40 and box["width"] >= 60 for box in boxes)
        assert all(end <= top for end, top in zip(ends, tops[1:], strict=False))
        assert not page.locator(".jp-OutputArea-output input").first.is_visible()
        compared, rays = page.locator(".jp-OutputArea-output").all_inner_texts()
        assert "A, left or above: 1 samples" in compared
        assert "In a trusted notebook the rays can be turned." in rays
    finally:
        page.context.close()
