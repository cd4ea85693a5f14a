"""A side of the studio: a process that renders, another one that waits to take its place, and the latest picture."""

from __future__ import annotations

from dataclasses import dataclass, field
from time import monotonic
from typing import Any

from course.engine.render.background_compile import LAST
from course.school.studio.differing import Shot
from course.school.studio.engine import ENGINE
from course.school.studio.worker import Event, RenderWorker

SILENT = 2.0
"""Seconds without a sign of life from which on it is told."""

ANSWER_WITHIN = 10.0
"""Seconds that one call may last, or a process may be silent, before it is ended."""


@dataclass
class Side:
    """One of the pictures of the page.

    Attributes
    ----------
    name : "mine" or "course"
    effects : as `Effects` takes it
    late : whether functions are loaded after the scene
    worker, spare : the process that renders, and one that is to take its place
    spare_knows, spare_ready : the scene that the latter was sent, and whether it has compiled it
    job : number of what it renders; what is told of earlier ones is out of date
    goal : samples that it renders towards; 0 if it doesn't
    reached : samples that the latest picture has
    shot, shots : the latest picture, and those of complete passes
    shown : number of the job that the latest picture belongs to
    old : whether that picture, or a part of it, is of a scene or of functions that have changed since
    small : whether it is the small one that follows a view that is being changed
    trouble : why it can't go on, until something changes; empty if it can
    note : what is going on, for the page
    ready : whether it has its functions, or has been told to read them; before, it may be silent while it reads files
    awaiting : whether it builds the scene, and reads its functions only then: saves until then need no other process
    """

    name: str
    effects: str | None
    late: bool
    event: Event
    worker: RenderWorker | None = None
    spare: RenderWorker | None = None
    spare_knows: Any = None
    spare_ready: bool = False
    job: int = 0
    goal: int = 0
    reached: int = 0
    shot: Shot | None = None
    shots: list[Shot] = field(default_factory=list)
    shown: int = 0
    old: bool = False
    small: bool = False
    before: Shot | None = None
    trouble: str = ""
    function: str = ""
    note: str = ""
    printed: str = ""
    heard: float = field(default_factory=monotonic)
    version: int = 0
    ready: bool = False
    awaiting: bool = False
    called: list[str] = field(default_factory=list)

    def command(self, file: str, values: list[Any]) -> dict[str, Any]:
        """The command that brings a scene to a worker."""
        return {"file": file, "values": values, "effects": self.effects, "late": self.late}

    def start(self, file: str, values: list[Any], fresh: bool) -> None:
        """Have a worker with the scene; with the functions as they are now if ``fresh``."""
        knows = file, values
        self.ready = self.ready and self.worker is not None and not fresh
        waits = fresh and self.awaiting
        if fresh and self.worker is not None and not waits:
            self.worker.end("closed")
            self.worker = None
        if self.worker is None:
            # Where the engine's loops have to be compiled, one's own picture comes first.
            nice = LAST if self.effects == ENGINE else 0
            self.worker, self.spare = self.spare or RenderWorker(self.event, nice), None
            built = self.spare_ready and self.spare_knows == knows
            if self.spare_knows != knows:
                self.worker.send(do="scene", **self.command(file, values))
            self.spare_knows, self.spare_ready = None, False
            self.awaiting = self.late
            if built:
                self.load()
            else:
                # Whatever is sent says that somebody waits.
                self.worker.send(do="pause")
        elif not waits:
            self.worker.send(do="scene", **self.command(file, values))
        self.heard = monotonic()
        self.trouble = self.function = self.note = self.printed = ""

    def load(self) -> None:
        """Have the functions read that the worker has waited for; the scene is there."""
        if self.awaiting and self.worker is not None:
            self.awaiting = False
            self.ready = True
            self.heard = monotonic()
            self.worker.send(do="load")

    def keep_spare(self, file: str, values: list[Any]) -> None:
        """Have a process ready to take the worker's place."""
        knows = file, values
        if not self.late or self.spare_knows == knows:
            return
        if self.spare is None:
            self.spare = RenderWorker(self.event)
        self.spare.send(do="scene", **self.command(file, values))
        self.spare_knows, self.spare_ready = knows, False

    def render(self, goal: int, most: int) -> None:
        """Go on to so many samples, of the most that there will be."""
        assert self.worker is not None
        self.goal = goal
        self.worker.send(do="render", job=self.job, upto=goal, most=most)

    def preview(self) -> None:
        """Show a small picture at once."""
        assert self.worker is not None
        self.worker.send(do="preview", job=self.job)

    def anew(self, job: int) -> None:
        """Forget what was reached: something has changed."""
        self.job, self.reached, self.goal = job, 0, 0
        self.shots = []
        self.old = self.shot is not None

    def fail(self, why: str, function: str = "") -> None:
        """It can't go on as it is."""
        self.trouble, self.function, self.note, self.goal = why, function, "", 0
        self.awaiting = False

    def close(self) -> None:
        """End its processes."""
        for worker in (self.worker, self.spare):
            if worker is not None:
                worker.close()
        self.worker = self.spare = self.spare_knows = None
        self.awaiting = self.spare_ready = False
