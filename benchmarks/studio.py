"""Seconds from the save of a function to its picture in the studio: ``python -m benchmarks.studio``.

Without a browser: until the studio has the pixels, which the page then asks for. The functions are the solutions' own
text, in a folder of one's own, so every scene calls them batch by batch through the guard, as it calls a student's.
"""

from __future__ import annotations

import json
import os
import queue
import shutil
import tempfile
from pathlib import Path
from statistics import median
from time import monotonic, sleep
from typing import Any

import click

from course.benchmarking.machine import machine
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE, MODULES
from course.school.studio import studio as whole
from course.school.studio.studio import GOOD, SOON, Studio

SAVES = 3
"""Of each scene; medians are told."""

SETTLED = 600.0


@click.command()
@click.argument("scenes", nargs=-1, type=click.Choice(tuple(COURSE)))
def main(scenes: tuple[str, ...]) -> None:
    """Measure the six core scenes, or those that are named, and print a table."""
    # A better reference only takes longer.
    whole.MOST = GOOD
    names = scenes or tuple(MODULES)
    print("| scene | first pixels [s] | 1 sample [s] | 16 samples [s] | click to rays [s] |")
    print("| --- | ---: | ---: | ---: | ---: |")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        Path("assignments").mkdir()
        for file in (PROJECT / "solutions").glob("*.py"):
            shutil.copy(file, "assignments")
        for name in names:
            times = measured(name)
            print(f"| {name} | {' | '.join(f'{one:.2f}' for one in times)} |", flush=True)
    told = ", ".join(map(str, machine().values()))
    print(f"\nMedians of {SAVES} saves; {told}")


def measured(name: str) -> list[float]:
    """Medians of one scene."""
    studio = Studio(PROJECT / "scenes" / f"{name}.yaml", "mine")
    # Checks would take their part of the processors.
    studio.verdicts = None
    studio.start()
    try:
        settle(studio)
        rows = []
        for _ in range(SAVES):
            rows.append(saved(studio, name))
            settle(studio)
        return [median(column) for column in zip(*rows, strict=True)]
    finally:
        studio.close()


def saved(studio: Studio, name: str) -> list[float]:
    """Save the module of the scene, and then ask for the pixel in the middle."""
    mine = studio.mine
    assert mine is not None
    file = Path("assignments") / f"{name}.py"
    job, began = mine.job, monotonic()
    file.write_text(file.read_text(encoding="utf-8") + "\n", encoding="utf-8")
    while mine.job == job:
        sleep(0.001)
    version = mine.version
    found = [0.0, 0.0, 0.0]
    while not found[2]:
        now = monotonic() - began
        for number, there in enumerate(
            (mine.version > version, mine.reached >= 1, mine.reached >= SOON)
        ):
            if there and not found[number]:
                found[number] = now
        assert not mine.trouble, mine.trouble
        sleep(0.002)
    settle(studio)
    events, before = studio.listen(), studio._story
    began = monotonic()
    width, height = studio._size()
    studio.ask("pixel", x=width // 2, y=height // 2)
    # Whoever begins to listen is told the last one.
    while (told := story(events)) is None or told is before:
        continue
    found.append(monotonic() - began)
    studio.forget(events)
    return found


def story(events: queue.Queue[tuple[str, Any]]) -> dict[str, Any] | None:
    """The next event, if it is the story of a pixel; written as JSON once, as the server does."""
    name, data = events.get(timeout=SETTLED)
    if name != "story":
        return None
    assert "failed" not in data, data
    json.dumps(data)
    told: dict[str, Any] = data
    return told


def settle(studio: Studio) -> None:
    """Wait until all is rendered, and the next process is ready."""
    assert studio.mine is not None
    quiet = 0
    while quiet < 10:
        sides = studio.sides
        idle = all(side.reached and not side.goal for side in sides)
        quiet = quiet + 1 if idle and studio.mine.spare_ready else 0
        sleep(0.1)


if __name__ == "__main__":
    main()
