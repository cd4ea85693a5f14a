"""`python -m benchmarks.pictures`: the referee of changes that are to change no picture.

Every scene is rendered in NumPy and in compiled loops, on 1 and 3 threads, with every sampler, and once to an error.
``--record`` writes the SHA-256 of each picture's float32 radiances; ``--compare`` renders again, names the
pictures that are others, and ends with 1 where there are any. Threads must never make a difference, and with neither
option that alone is looked at.

Two kinds of processors may round differently in NumPy's or Embree's vector code, so a record names its machine and is
compared on none else: record the state before a change first, then compare the state after it.
"""

import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

import click
import numpy as np

from course.base.atomic import write_text
from course.base.errors import CourseError
from course.benchmarking.machine import machine
from course.engine.functions.effects import PROJECT
from course.engine.loops.embree_device import available
from course.engine.render.render import render
from course.engine.scene.scene import Scene, load_scene
from course.engine.terms.samplers import FUNCTIONS

SAMPLES = 4
WIDTH = 120
"""Pixels; several tiles, and a batch that isn't full."""

THREADS = (1, 3)
ADAPTIVE = "to an error"
ERROR, MOST = 0.02, 64


@dataclass(frozen=True)
class Picture:
    """One way to render a scene.

    Attributes
    ----------
    scene : the file, from the project's folder
    way : a sampler, or ADAPTIVE
    """

    scene: str
    way: str
    compiled: bool

    def __str__(self) -> str:
        return f"{self.scene}, {self.way}, {'compiled' if self.compiled else 'NumPy'}"

    def fingerprint(self, scene: Scene, threads: int) -> str:
        """SHA-256 of the picture; what the renderer says where these don't go together."""
        film = scene.loaded.description.film
        options: dict[str, Any] = {"spp": SAMPLES, "sampler": self.way}
        if self.way == ADAPTIVE:
            options = {"spp": MOST, "sampler": "sobol", "error": ERROR}
        size = (WIDTH, max(1, round(WIDTH * film.height / film.width)))
        try:
            picture = render(scene, size=size, threads=threads, compiled=self.compiled, **options)
        except CourseError as error:
            return f"refused: {str(error).rpartition('.yaml:')[2]}"
        return sha256(np.ascontiguousarray(picture.linear, np.float32).tobytes()).hexdigest()


def scenes(names: tuple[str, ...]) -> list[Path]:
    """Scene files whose path holds one of these names; all where there are none."""
    files = sorted((PROJECT / "scenes").rglob("*.yaml"))
    return [file for file in files if not names or any(name in str(file) for name in names)]


def pictures(file: Path) -> Iterator[Picture]:
    """All ways to render a scene."""
    for compiled in (False, True) if available() else (False,):
        for way in (*FUNCTIONS, ADAPTIVE):
            yield Picture(str(file.relative_to(PROJECT)), way, compiled)


@click.command(help=__doc__)
@click.argument("names", nargs=-1, metavar="[SCENE]...")
@click.option("--record", type=click.Path(path_type=Path), help="Write the pictures' hashes.")
@click.option("--compare", type=click.Path(path_type=Path, exists=True), help="With such a file.")
def main(names: tuple[str, ...], record: Path | None, compare: Path | None) -> None:
    """Render all pictures."""
    here = machine()
    before = json.loads(compare.read_text(encoding="utf-8")) if compare else None
    if before and before["machine"] != here:
        raise click.ClickException(
            f"{compare} was recorded on another machine ({before['machine']}), whose last bits may differ: "
            "record the state before on this one"
        )
    found: dict[str, str] = {}
    changed = 0
    for file in scenes(names):
        scene = load_scene(file)
        for picture in pictures(file):
            name = str(picture)
            first, *others = (picture.fingerprint(scene, threads) for threads in THREADS)
            found[name] = first
            if any(other != first for other in others):
                print(f"{name}: other threads make another picture", flush=True)
                changed += 1
            elif before and before["pictures"].get(name) != first:
                print(f"{name}: {'changed' if name in before['pictures'] else 'new'}", flush=True)
                changed += 1
        print(f"{file.relative_to(PROJECT)}: {len(found)} pictures so far", file=sys.stderr)
    if before and not names:
        for name in before["pictures"].keys() - found.keys():
            print(f"{name}: gone")
            changed += 1
    if record:
        write_text(record, json.dumps({"machine": here, "pictures": found}, indent=1) + "\n")
    print(f"{len(found)} pictures on {' and '.join(map(str, THREADS))} threads, {changed} others")
    sys.exit(1 if changed else 0)


if __name__ == "__main__":
    main()
