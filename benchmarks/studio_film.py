"""The moving picture of the studio: ``python -m benchmarks.studio_film`` records `docs/_static/studio.webp` anew.

It takes a Chromium and what drives it (``pip install -e ".[browser]"``). A build of the site must not need them, so the
picture is kept beside the pages. A function of a student's folder is written wrong and then right.
"""

from __future__ import annotations

import os
import shutil
import tempfile
import textwrap
import time
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import click
from PIL import Image

from course.engine.functions.effects import PROJECT

FILM = PROJECT / "docs" / "_static" / "studio.webp"

WIDTH, QUALITY = 800, 62
"""Pixels across, and of WebP."""

SHORT, LONG = 350, 2600
"""Milliseconds of a frame on the way, and of one to be read."""


WRONG = """\
z = 1 - 2 * u[0]
phi = 2 * np.pi * u[1]
offset = radius * np.stack((np.cos(phi), np.sin(phi), z))
return (center[:, None] + offset).astype(u.dtype)
"""


def until(found: Callable[[], Any], seconds: float = 300) -> None:
    """Wait for something that is true."""
    end = time.monotonic() + seconds
    while not found():
        if time.monotonic() > end:
            raise TimeoutError
        time.sleep(0.05)


class Camera:
    """Takes frames of a page."""

    def __init__(self, page: Any) -> None:
        self.page = page
        self.frames: list[Image.Image] = []
        self.milliseconds: list[int] = []

    def take(self, milliseconds: int) -> None:
        """Take one that is shown for so long."""
        image = Image.open(BytesIO(self.page.screenshot())).convert("RGB")
        height = round(image.height * WIDTH / image.width)
        self.frames.append(image.resize((WIDTH, height), Image.Resampling.LANCZOS))
        self.milliseconds.append(milliseconds)

    def follow(self, done: Callable[[], bool]) -> None:
        """Take a frame at every pass of one's own picture, until something is true, and a long one then."""
        last = ""
        while not done():
            told = self.page.inner_text("#mine-told")
            if told != last:
                self.take(SHORT)
                last = told
            time.sleep(0.05)
        time.sleep(0.5)
        self.take(LONG)


@click.command()
def main() -> None:
    """Record the film."""
    from playwright.sync_api import sync_playwright

    from course.school.studio import checker
    from course.school.studio import studio as rules
    from course.school.studio.server import Server

    # Nobody waits for anything that the film doesn't show.
    rules.MOST, checker.NICE = 64, 0
    stub = (PROJECT / "assignments" / "soft_shadows.py").read_text(encoding="utf-8")
    head = stub.index("def point_on_sphere(")
    first = stub.index("raise NotImplementedError", head)
    wrong = stub[:first] + textwrap.indent(WRONG, "    ").strip() + stub[stub.index("\n", first) :]
    line = "np.stack((np.cos(phi), np.sin(phi), z))"
    right = wrong.replace(line, "np.stack((s * np.cos(phi), s * np.sin(phi), z))").replace(
        "    phi =", "    s = np.sqrt(np.maximum(0, 1 - z * z))\n    phi ="
    )
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
        os.chdir(folder)
        Path("assignments").mkdir()
        for name in ("supersampling", "soft_shadows"):
            shutil.copy(PROJECT / "assignments" / f"{name}.py", "assignments")
        file = Path("assignments", "soft_shadows.py")
        studio = rules.Studio(PROJECT / "scenes" / "soft_shadows.yaml", "mine", "soft_shadows")
        studio.values["sampler", "samples"] = 16
        studio.start()
        server = Server(studio)
        browser = driver.chromium.launch(
            executable_path=shutil.which("chromium") or shutil.which("chromium-browser"),
            args=["--no-sandbox"],
        )
        page = browser.new_page(viewport={"width": 1180, "height": 800})
        page.goto(server.address)
        camera = Camera(page)
        mine, course = studio.mine, studio.course
        assert mine is not None

        def is_(state: str) -> bool:
            selector = "[data-function='soft_shadows.point_on_sphere']"
            shown = page.get_attribute(selector, "data-state") == state
            return shown and all(side.reached >= 16 and not side.goal for side in (mine, course))

        try:
            until(lambda: is_("to do"))
            time.sleep(1)
            camera.take(LONG)
            for text, state in ((wrong, "wrong"), (right, "right")):
                file.write_text(text, encoding="utf-8")
                until(lambda: mine.reached == 0)
                camera.follow(lambda state=state: is_(state))
            page.locator("#mine").click(position={"x": 300, "y": 250})
            page.locator("#story .rays canvas").wait_for()
            page.evaluate("document.querySelector('.story').scrollIntoView()")
            time.sleep(1)
            camera.take(LONG)
        finally:
            browser.close()
            server.close()
            studio.close()
            os.chdir(PROJECT)
    first_frame, *rest = camera.frames
    first_frame.save(
        FILM,
        "WEBP",
        save_all=True,
        append_images=rest,
        duration=camera.milliseconds,
        loop=0,
        quality=QUALITY,
        method=3,
    )


if __name__ == "__main__":
    main()
