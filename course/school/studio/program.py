"""The program of a process that renders for the studio: ``python -m course.school.studio.program``.

It gets commands as messages on its standard input, and answers on what was its standard output; what functions print
goes to its standard error. A command that comes while a picture is rendered interrupts it. Commands, by ``do``:

    scene    file, values, effects, late: compile it; if late, its functions are loaded afterwards
    load     take the functions as they are in their files now
    render   job, upto, most: add passes up to so many samples of the most that there will be; a new job begins again
    preview  job: a small picture of one sample a pixel, unless another one is asked for already
    pixel    x, y, job: tell what became of the samples of a pixel
    rays     x, y: tell the same as bare rays, to be put beside somebody else's
    pair     x, y, rays: tell the last pixel's story once more, beside the course's rays of the same samples
"""

from __future__ import annotations

import math
import os
import queue
import sys
import threading
import traceback
import warnings
from dataclasses import replace
from pathlib import Path
from time import monotonic, sleep
from typing import Any

from course.base.errors import CourseError, CourseWarning
from course.engine.core.film import Film
from course.engine.formats.pictures.display import SRGB, Display
from course.engine.functions.effects import Bound, Effects, NothingWritten
from course.engine.recording.pair import departing, pair_data, told, unexplained
from course.engine.recording.recording import record, recordable
from course.engine.recording.story import Line, Story
from course.engine.recording.view import rays_data, view_data
from course.engine.render.background_compile import (
    LITTLE,
    NotCompiledError,
    compile_for_a_student,
    compiling_nothing,
)
from course.engine.render.binding import developed_by, needs_of
from course.engine.render.developing import developing
from course.engine.render.not_written import lines_named
from course.engine.scene.scene import Scene, SceneSettings
from course.school.studio.engine import ENGINE, NO_REFERENCE, EngineEffects, engines_picture
from course.school.studio.late import StudioEffects
from course.school.studio.messages import Channel, messages
from course.school.studio.passes import Progressive, Whole, may_compile, picture_of
from course.school.studio.prepared import Values, changed, prepared, settings_of

BEAT = 0.25
"""Seconds between two signs of life."""

LONG = 0.8
"""Seconds of a call from which on it is told that it goes on."""

SHOW_FIRST, SHOW = 0.08, 0.5
"""Seconds between two looks at a picture before and after every pixel has a sample."""

PREVIEW = 0.1
"""Seconds that a picture may take that follows the mouse: its size is chosen so."""

LEAST, FIRST, LARGEST = 60 * 40, 120 * 80, 240 * 160
"""Pixels of such a picture: the fewest, of the first one, and the most."""

STORY_SAMPLES = 64
"""The most samples of a pixel that are told."""


COMPILING = "preparing the renderer's compiled loops, which takes a minute or two when this machine has none yet"


class InterruptedRenderError(Exception):
    """Another command has come."""


class Program:
    """What the process knows: a scene, and a picture of it."""

    def __init__(self, channel: Channel) -> None:
        self.channel = channel
        self.commands: queue.Queue[dict[str, Any] | None] = queue.Queue()
        self.effects: StudioEffects | None = None
        self._folder: str | None = None
        self._scene: Scene | None = None
        self._values: Values = {}
        self._early: set[str] = set()
        self._picture: Progressive | Whole | None = None
        self._recordable: Scene | None = None
        self._story: Story | None = None
        self._told: dict[str, Any] = {}
        self._job = 0
        self._display = SRGB
        self._compiled = False
        self._little = float(FIRST)
        self.note = ""

    def run(self) -> None:
        """Do what is asked for, until nobody asks any more."""
        while (command := self.commands.get()) is not None:
            kind = command.pop("do")
            try:
                self._do(kind, command)
            except InterruptedRenderError:
                self.channel.send({"interrupted": self._job})
            except (CourseError, NotImplementedError, MemoryError) as error:
                told = str(error) or type(error).__name__
                function = getattr(error, "function", "")
                self.channel.send({"failed": told, "function": function, "of": kind})
            except Exception as error:  # noqa: BLE001 - told on the page
                told = f"{type(error).__name__}: {error}"
                where = traceback.format_exc(limit=-4)
                self.channel.send({"failed": told, "trace": where, "of": kind})

    def _do(self, kind: str, command: dict[str, Any]) -> None:
        if kind == "scene":
            self._compile(**command)
        elif kind == "load":
            self._load()
        elif kind == "render":
            self._render(**command)
        elif kind == "preview":
            self._preview(**command)
        elif kind == "pixel":
            self._tell(**command)
        elif kind == "rays":
            x, y = command["x"], command["y"]
            self.channel.send({"rays": rays_data(self._recorded(x, y)), "of": [x, y]})
        elif kind == "pair":
            self._tell_both(**command)

    # ---------------------------------------------------------------- commands

    def _compile(self, file: str, values: list[Any], effects: str | None, late: bool) -> None:
        known = {tuple(path): value for path, value in values}
        scene, self._folder = self._scene, effects
        self._picture = self._recordable = None
        if scene is not None and str(scene.path) == file:
            self._scene = changed(scene, self._values, known)
        else:
            self._scene = None
        self._values = known
        if self._scene is None:
            self._compiled = False
            self._scene = self._built(Path(file), late)
            self._warm(self._scene)
        needs = [need.function for need in needs_of(self._scene, settings_of(self._scene))]
        self.channel.send({"scene": file, "needs": needs, "early": sorted(self._early)})

    def _built(self, file: Path, late: bool) -> Scene:
        if self._folder == ENGINE:
            try:
                return prepared(file, self._values, EngineEffects())
            except CourseError as error:
                raise CourseError(NO_REFERENCE) from error
        source = Effects(self._folder)
        if not late:
            return prepared(file, self._values, source)
        if self.effects is None:
            # Until functions are loaded, whatever can be made ready with the course's own is.
            ready = Effects("solutions") if source.on_solutions else NothingWritten()
            self.effects = StudioEffects(ready)
        self.effects.late.called.clear()
        with self.effects.building():
            scene = prepared(file, self._values, self.effects)
        self._early = set(self.effects.late.called)
        return scene

    def _warm(self, scene: Scene) -> None:
        """Render a few pixels, for much is made when the first ray is cast; never with functions of a student.

        A student's functions make arrays for compiled loops, too, if those were ready before they were loaded.
        """
        source = (
            scene.effects.late.source if isinstance(scene.effects, StudioEffects) else scene.effects
        )
        if not source.trusted or self._folder == ENGINE:
            return
        width, height = LITTLE
        little = replace(settings_of(scene), width=width, height=height, samples=4)
        little = replace(little, subdivision=None)

        def render(compiled: bool) -> None:
            Progressive(scene, little, compiled).render(2, lambda *_: None)

        render(compiled=False)
        # Who waits for a picture doesn't wait for this, too.
        if scene.effects is not source and may_compile() and self.commands.empty():
            try:
                with compiling_nothing():
                    render(compiled=True)
                self._compiled = True
            except NotCompiledError:
                compile_for_a_student(scene, little)

    def _load(self) -> None:
        assert self.effects is not None
        assert self._scene is not None
        scene = self._scene
        needs = [need.function for need in needs_of(scene, settings_of(scene))]
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always", CourseWarning)
            self.effects.load(Effects(self._folder), needs)
        for each in told:
            # A function whose name is spelt wrongly is not called; the page shows it beside what functions print.
            sys.stderr.write(f"{each.message}\n")
        if self._early:
            # What was worked out before belongs to other functions.
            with self.effects.building():
                self._scene = prepared(scene.path, self._values, self.effects)
        self._picture = None
        self.channel.send(
            {"loaded": [name for name in needs if self.effects.written(*name.split("."))]}
        )

    def _render(self, job: int, upto: int, most: int) -> None:
        if self._picture is None or job != self._job:
            settings = replace(settings_of(self.scene), samples=most)
            self._display = self._developing(settings)
            if self._folder == ENGINE:
                self.note = COMPILING
                try:
                    self._picture = engines_picture(self.scene, settings)
                finally:
                    self.note = ""
            else:
                self._picture = picture_of(self.scene, settings, self._compiled)
        self._job = job
        picture, develop = self._picture, self._display.develop
        last = 0.0

        def tell(film: Film, samples: int, complete: bool) -> None:
            nonlocal last
            now = monotonic()
            if complete or now - last > (SHOW if samples else SHOW_FIRST):
                last = now
                more: dict[str, Any] = {}
                if complete and picture.variance is not None:
                    more["variance"] = picture.variance
                if develop is not None:
                    more["codes"] = develop(film.linear)
                told: dict[str, Any] = {
                    "picture": job,
                    "samples": samples,
                    "seconds": picture.seconds,
                }
                told |= {"complete": complete, "more": list(more)}
                self.channel.send(told, film.linear, film.samples > 0, *more.values())
            if not self.commands.empty():
                raise InterruptedRenderError

        picture.render(upto, tell)
        self.channel.send({"rendered": job, "samples": picture.samples})

    def _preview(self, job: int) -> None:
        with self.commands.mutex:
            if any(each is not None and each["do"] == "preview" for each in self.commands.queue):
                return
        began = monotonic()
        settings = settings_of(self.scene)
        share = min(1.0, math.sqrt(self._little / (settings.width * settings.height)))
        width, height = (max(1, round(share * each)) for each in (settings.width, settings.height))
        settings = replace(settings, width=width, height=height, samples=1)
        settings = replace(settings, subdivision=None)
        develop = self._developing(settings).develop
        picture = Progressive(self.scene, settings, self._compiled)
        picture.render(1, lambda *_: None)
        film = picture.film
        codes = [] if develop is None else [develop(film.linear)]
        told = {"preview": job, "seconds": picture.seconds, "more": ["codes"] if codes else []}
        self.channel.send(told, film.linear, film.samples > 0, *codes)
        taken = max(monotonic() - began, 1e-3)
        pixels = self._little * min(max(PREVIEW / taken, 0.5), 2.0)
        self._little = min(max(pixels, LEAST), LARGEST)

    def _developing(self, settings: SceneSettings) -> Display:
        """How the picture is shown, by functions of `film` where the scene asks for them."""
        if self._folder == ENGINE and developed_by(self.scene):
            raise CourseError(NO_REFERENCE)
        bound = Bound(self.scene.effects, self.scene.compiled.needs)
        with lines_named(self.scene, bound):
            return developing(self.scene, settings, bound)

    def _recorded(self, x: int, y: int) -> Story:
        if self._recordable is None:
            self._recordable = recordable(self.scene)
        settings = settings_of(self.scene)
        size = settings.width, settings.height
        spp = min(settings.samples, STORY_SAMPLES)
        return Story(record(self._recordable, x, y, spp=spp, size=size, quick=True))

    def _tell(self, x: int, y: int, job: int) -> None:
        began = monotonic()
        self._story = story = self._recorded(x, y)
        self._told = {
            "story": [x, y],
            "job": job,
            "title": story.tree.text,
            "reason": story.reason,
            "tree": [_as_data(line) for line in story.tree.below[1:]],
        }
        rays = {"rays": view_data(story), "seconds": monotonic() - began}
        self.channel.send(self._told | rays)

    def _tell_both(self, x: int, y: int, rays: dict[str, Any]) -> None:
        if self._story is None or self._told["story"] != [x, y]:
            return
        # Some are asked before there is a ray.
        needed = [need.function for need in self.scene.compiled.needs]
        asked = dict.fromkeys([*self._story.recording.asked, *needed])
        written = [f for f in asked if self.scene.effects.written(*f.split("."))]
        departs = departing(self._story, rays, written)
        data = pair_data(self._story, rays, departs or "")
        # What is said before the lines, where no function can be named.
        lead = unexplained(data, written) if departs is None else ""
        if lead is None:
            self.channel.send(self._told | {"rays": view_data(self._story), "beside": []})
            return
        lines = told(data, "the course's is", "the course's functions")
        self.channel.send(self._told | {"rays": data, "beside": lines, "lead": lead})

    @property
    def scene(self) -> Scene:
        """The compiled scene; CourseError if there is none."""
        if self._scene is None:
            raise CourseError("the scene can't be rendered as it is")
        return self._scene


def _as_data(line: Line) -> list[Any]:
    return [line.text, [_as_data(below) for below in line.below]]


def _beat(program: Program) -> None:
    """Tell again and again that the process lives, and which call goes on and on."""
    while True:
        sleep(BEAT)
        told: dict[str, Any] = {"alive": True, "note": program.note}
        call = program.effects.late.longest() if program.effects is not None else None
        if call is not None and call[1] > LONG:
            told |= {"busy": call[0], "for": call[1], "line": call[2]}
        try:
            program.channel.send(told)
        except OSError:
            return


def main() -> None:
    """Answer commands until the standard input ends."""
    sys.dont_write_bytecode = True
    warnings.simplefilter("ignore", CourseWarning)
    # What was the standard output is for answers; whatever else is written goes where errors go.
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    # So are commands: a function that asks for input gets none, and takes none of them.
    asked = os.fdopen(os.dup(0), "rb")
    with open(os.devnull, "rb") as nothing:  # noqa: PTH123
        os.dup2(nothing.fileno(), 0)
    program = Program(Channel(answers))
    program.channel.send({"ready": True})

    def listen() -> None:
        for command, _ in messages(asked):
            program.commands.put(command)
        # Nobody asks any more, whatever a function does.
        os._exit(0)

    for work in (listen, lambda: _beat(program)):
        threading.Thread(target=work, daemon=True).start()
    program.run()


if __name__ == "__main__":
    main()
