"""The studio: what is rendered next, what has changed, and what the page is told.

One thread owns all of it. Whatever happens, a message of a process, a file that is saved, a wish of the page, comes to
it through a queue.
"""

from __future__ import annotations

import itertools
import queue
import threading
import traceback
from collections.abc import Iterable
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.base.errors import CourseError
from course.engine.formats.pictures.display import Display
from course.engine.formats.yaml.document import KeyPath
from course.engine.formats.yaml.loading import load_description
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.modules import COURSE
from course.engine.functions.sources import saved_files
from course.school.studio.differing import Shot, coloured, deviations, rms, share_differing
from course.school.studio.engine import ENGINE, NO_RAYS
from course.school.studio.keys import Slider, sliders
from course.school.studio.late import IMPORTING
from course.school.studio.orbit import orbited, within_limits
from course.school.studio.prepared import fitting
from course.school.studio.sides import ANSWER_WITHIN, SILENT, Side
from course.school.studio.verdicts import Verdicts
from course.school.studio.worker import RenderWorker

POLL = 0.04
"""Seconds between two looks at the files."""

SOON, GOOD = 16, 64
"""Samples of one's own picture before the reference is rendered, and of the reference before one's own goes on."""

REFERENCE = 4
"""Times the samples of the picture that the reference gets, and at most ``MOST``."""

MOST = 256

TRIED_AGAIN = ("orbit", "value", "reset", "again")
"""Wishes of the page after which the studio's own failure is told no longer, unless it fails again."""

NO_PICTURE = "there is no picture that it could be told of"

GONE = 1.0
"""Seconds after which a file that isn't there is gone: editors that save take it away for a moment."""

STILL = 0.3
"""Seconds without a change of the view after which it is no longer followed by small pictures."""


class Studio:
    """A scene, one's own picture of it beside the course's, and how far one's functions are.

    Parameters
    ----------
    scene : its file
    folder : of one's own functions, as `Effects` takes it; None for the course's pictures alone
    module : whose functions come first; None for those that the scene calls

    Attributes
    ----------
    values : key path -> what stands there instead of what the file says
    """

    def __init__(self, scene: Path, folder: str | None, module: str | None = None) -> None:
        self.scene, self.module = scene, module
        self.loaded = load_description(scene)
        self._queue: queue.Queue[tuple[Any, ...]] = queue.Queue()
        self._jobs = itertools.count(1)
        self.values: dict[KeyPath, Any] = {}
        self._orbit = (0.0, 0.0, 1.0)
        self._listeners: list[queue.Queue[tuple[str, Any]]] = []
        self._guard = threading.Lock()
        self._needs: list[str] = []
        self._wanted_pixel: tuple[int, int] | None = None
        self._asked: Side | None = None
        self._asked_early: dict[str, Any] | None = None
        self._told_again: dict[str, Any] | None = None
        self._story: dict[str, Any] | None = None
        self._shown_story: dict[str, Any] | None = None
        self._beside: dict[str, Any] | None = None
        self._moved: float | None = None
        self._waited = False
        self._curve: list[tuple[float, int, float]] = []
        self._curve_before: list[tuple[float, int, float]] = []
        self._differing: float | None = None
        self._changed: float | None = None
        self._compared: list[int] = []
        self._scene_trouble = self._own_trouble = ""
        self.verdicts: Verdicts | None = None
        self.mine: Side | None = None
        if folder is not None:
            self.mine = Side("mine", folder, True, self._event)
            self.folder = Effects(folder).folder
            self.verdicts = Verdicts(
                self.folder,
                module,
                lambda told: self._queue.put(("check", told)),
                lambda: self._say("functions", self.functions()),
            )
        self.course = Side("course", self._courses(), False, self._event)
        self._seen: dict[Path, tuple[int, int]] = {}
        self._missing: dict[Path, float] = {}
        self._thread = threading.Thread(target=self._run, name="studio", daemon=True)
        self._stopped = False

    def _courses(self) -> str | None:
        """The course's functions; in a copy without them, what the compiled loops have instead.

        Who only looks around sees what `course render` would show.
        """
        if (PROJECT / "solutions").is_dir():
            return "solutions"
        return None if self.mine is None else ENGINE

    @property
    def sides(self) -> list[Side]:
        """One's own picture, if there is one, and the course's."""
        return [side for side in (self.mine, self.course) if side is not None]

    # ---------------------------------------------------------------- from other threads

    def start(self) -> None:
        """Begin to render."""
        self._thread.start()

    def close(self) -> None:
        """End everything; waits for that."""
        self._stopped = True
        self._say("gone", None)
        self._queue.put(("stop",))
        self._thread.join()
        for side in self.sides:
            side.close()
        if self.verdicts is not None:
            self.verdicts.close()

    def ask(self, kind: str, **told: Any) -> None:
        """A wish of the page."""
        self._queue.put((kind, told))

    def listen(self) -> queue.Queue[tuple[str, Any]]:
        """What the page is told from now on, as names and data; it begins with all there is."""
        events: queue.Queue[tuple[str, Any]] = queue.Queue()
        with self._guard:
            self._listeners.append(events)
        self._queue.put(("hello", events))
        return events

    def forget(self, events: queue.Queue[tuple[str, Any]]) -> None:
        """A page has gone."""
        with self._guard:
            self._listeners.remove(events)

    def picture(self, name: str) -> NDArray[np.uint8] | None:
        """(H, W, 4) uint8, red, green, blue and whether it is there: "mine", "course", "difference" or "change"."""
        mine = self.mine.shot if self.mine is not None else None
        before = self.mine.before if self.mine is not None else None
        course = self.course.shot
        pairs = {"difference": (mine, course), "change": (mine, before)}
        if name in pairs:
            a, b = pairs[name]
            # Pictures of two views, or of a view and a small one, have no difference.
            compared = self.sides if name == "difference" else self.sides[:1]
            if any(side.old or side.small for side in compared):
                return None
            b = self._alike(a, b)
            if a is None or b is None or a.linear.shape != b.linear.shape:
                return None
            codes, there = coloured(deviations(a, b)), a.there & b.there
        else:
            shot = {"mine": mine, "course": course}.get(name)
            if shot is None:
                return None
            if shot.codes is not None:
                return np.dstack((shot.codes, np.where(shot.there, 255, 0).astype(np.uint8)))
            film = self.loaded.description.film
            codes, there = Display(film.white, film.encoding).codes(shot.linear), shot.there
        alpha = np.where(there, 255, 0).astype(np.uint8)
        return np.dstack((codes, alpha))

    def _alike(self, mine: Shot | None, other: Shot | None) -> Shot | None:
        """The course's picture of as many samples, where it matters how the same light is shown; else the other."""
        if mine is None or other is None or mine.codes is None or other is not self.course.shot:
            return other
        same = (shot for shot in self.course.shots if shot.samples == mine.samples)
        return next(same, other)

    # ---------------------------------------------------------------- the thread

    def _event(self, worker: RenderWorker, told: dict[str, Any], arrays: list[Any]) -> None:
        self._queue.put(("worker", worker, told, arrays))

    def _run(self) -> None:
        self._seen = self._times()
        self._begin()
        looked = monotonic()
        while not self._stopped:
            try:
                what, *more = self._queue.get(timeout=POLL)
            except queue.Empty:
                what, more = "", []
            try:
                if what in TRIED_AGAIN:
                    self._own_trouble = ""
                if what:
                    getattr(self, f"_on_{what}", lambda *_: None)(*more)
                if (away := monotonic() - looked) >= POLL:
                    looked = monotonic()
                    if away > SILENT:
                        # The studio was stopped, or the machine slept: it is nobody else who was silent.
                        for side in self.sides:
                            side.heard = looked
                    self._look()
            except Exception:  # noqa: BLE001 - the page goes on, and tells
                self._own_trouble = traceback.format_exc(limit=-3)
                self._say_state()

    def _say(self, name: str, data: Any) -> None:
        with self._guard:
            for events in self._listeners:
                events.put((name, data))

    def _say_state(self) -> None:
        self._say("state", self.state())

    def _on_hello(self, events: queue.Queue[tuple[str, Any]]) -> None:
        events.put(("state", self.state()))
        events.put(("functions", self.functions()))
        if self._shown_story is not None:
            events.put(("story", self._shown_story))

    def _say_story(self, story: dict[str, Any]) -> None:
        self._shown_story = story
        self._say("story", story)

    # ---------------------------------------------------------------- what is rendered

    def _begin(self, fresh: bool = False) -> None:
        """Render everything again: the scene has changed."""
        self._forget("The scene has changed")
        for side in self.sides:
            self._bring_scene(side, fresh)
        self._go()

    def _bring_scene(self, side: Side, fresh: bool = False) -> None:
        if fresh or side.worker is not None or not side.trouble:
            values = [[list(path), value] for path, value in self.values.items()]
            side.start(str(self.scene), values, False)

    def _forget(self, why: str) -> None:
        """Nothing that was rendered or told belongs to the scene any more."""
        job = next(self._jobs)
        for side in self.sides:
            side.anew(job)
        self._curve, self._curve_before = [], []
        self._differing = self._changed = None
        if self.mine is not None:
            self.mine.before = None
        self._outdate(why, *self.sides)
        self._moved = None

    def _outdate(self, why: str, *sides: Side) -> None:
        """What is told of a pixel, or was asked for, is told again once there is another picture."""
        story, names = self._shown_story, [side.name for side in sides]
        if self._asked in sides and self._wanted_pixel is not None and self._asked is not None:
            (x, y), side = self._wanted_pixel, self._asked.name
            self._wanted_pixel = self._asked = None
        elif story is not None and story["side"] in names:
            (x, y), side = story["story"], story["side"]
        else:
            return
        self._told_again, self._story = {"x": x, "y": y, "side": side}, None
        if story is None or "old" not in story:
            self._say_story((story or {}) | {"story": [x, y], "side": side, "old": why})

    def _follow(self) -> None:
        """The view is being changed: small pictures follow it, and all is rendered once it stays."""
        main = self.mine or self.course
        if self.course.goal and self.course.worker is not None:
            self.course.worker.send(do="pause")
        self._forget("The view has changed")
        self._moved = monotonic()
        self._bring_scene(main)
        if main.worker is not None and not main.awaiting and not main.trouble:
            main.preview()

    def _stay(self) -> None:
        """The view has stayed for a while."""
        self._moved = None
        if self.course is not (self.mine or self.course):
            self._bring_scene(self.course)
        self._go()

    def _save(self) -> None:
        """One's functions have changed: render one's own picture again, with a process that has none of the old."""
        assert self.mine is not None
        mine = self.mine
        values = [[list(path), value] for path, value in self.values.items()]
        if mine.shots:
            mine.before = mine.shots[-1]
        # The story follows a save, as the picture does; whoever was telling one is ended.
        self._outdate("You have saved a file", mine)
        mine.anew(next(self._jobs))
        mine.start(str(self.scene), values, True)
        self._curve_before, self._curve = self._curve or self._curve_before, []
        self._differing = self._changed = None
        self._go()

    def _goals(self) -> list[tuple[Side, int]]:
        """What is to be reached now, in this order."""
        goals = self._plan()
        if self.verdicts is not None and self.verdicts.first:
            # A first look finds what ends a function, and leaves the processors to the checks.
            side, goal = goals[0]
            return [(side, goal if self.loaded.description.film.subdivision else 1)]
        return goals

    def _plan(self) -> list[tuple[Side, int]]:
        """What has to be reached."""
        samples = self._samples()
        reference = min(REFERENCE * samples, max(MOST, samples))
        if self.mine is None:
            asked = ("sampler", "samples") in self.values
            return [(self.course, SOON), (self.course, samples if asked else max(samples, GOOD))]
        return [
            (self.mine, min(SOON, samples)),
            (self.course, min(GOOD, reference)),
            (self.mine, samples),
            (self.course, reference),
        ]

    def _samples(self) -> int:
        return int(self.values.get(("sampler", "samples"), self.loaded.description.sampler.samples))

    def _go(self) -> None:
        """Have the next thing rendered; nobody waits for a side that is busy with something else."""
        if self._wanted_pixel is not None or self._moved is not None:
            return
        goals = self._goals()
        for number, (side, goal) in enumerate(goals):
            if number and self.mine is not None and not self.mine.note:
                self._prepare_spare()
            if side.trouble or side.note or side.reached >= goal:
                continue
            if not side.goal:
                for other in self.sides:
                    if other.goal and other.worker is not None and not other.note:
                        other.worker.send(do="pause")
            if not side.goal and not side.awaiting:
                side.render(goal, self._most(side))
            return

    def _most(self, side: Side) -> int:
        """Samples that its picture will have."""
        return max(goal for other, goal in self._plan() if other is side)

    def _prepare_spare(self) -> None:
        """Once one's own picture shows something, a process is made ready for the next save."""
        assert self.mine is not None
        values = [[list(path), value] for path, value in self.values.items()]
        self.mine.keep_spare(str(self.scene), values)

    def _on_worker(self, worker: RenderWorker, told: dict[str, Any], arrays: list[Any]) -> None:
        side = next((s for s in self.sides if worker in (s.worker, s.spare)), None)
        if side is None:
            return
        if worker is side.spare:
            side.spare_ready = side.spare_ready or "scene" in told
            if "ended" in told or "failed" in told:
                side.spare = side.spare_knows = None
            return
        side.heard = monotonic()
        if "alive" in told:
            self._on_alive(side, told)
            return
        if "picture" in told and told["picture"] == side.job:
            self._on_picture(side, told, arrays)
        elif "preview" in told and told["preview"] == side.job:
            self._on_preview(side, told, arrays)
        elif "rendered" in told and told["rendered"] == side.job:
            # Some samplers stop before.
            side.reached, side.goal = max(side.reached, side.goal), 0
            self._soon()
            if self._told_again is not None and self._told_again["side"] == side.name:
                self._on_pixel(self._told_again)
            self._go()
        elif "interrupted" in told and told["interrupted"] == side.job:
            side.goal = 0
        elif "scene" in told:
            self._needs = told["needs"]
            if self.verdicts is not None:
                self.verdicts.know(self._needs)
            self._say("functions", self.functions())
            if side.awaiting:
                side.load()
                if self._asked_early is not None and side is self.mine:
                    self._on_pixel(self._asked_early)
                self._go()
        elif "loaded" in told:
            side.called, side.ready = told["loaded"], True
        elif "story" in told:
            # One of a picture before comes too late.
            if told["job"] == side.job:
                self._wanted_pixel = self._asked = None
                self._story = told | {"side": side.name, "is_right": self._is_right(told)}
                self._say_story(self._story)
                self._put_beside()
            self._go()
        elif "rays" in told:
            self._beside = told
            self._put_beside()
            self._go()
        elif "failed" in told:
            self._on_failed(side, told)
        elif "printed" in told:
            side.printed = told["printed"]
        elif "ended" in told and told["ended"] != "closed":
            side.worker = None
            where = f" in {side.function}" if side.function else ""
            side.fail(f"{told['ended']}{where}", side.function)
            self._lost_pixel()
            self._soon()
            self._go()
        again = self._told_again
        if side.trouble and again is not None and again["side"] == side.name:
            self._cannot_tell(again["x"], again["y"], side, NO_PICTURE)
        self._say_state()

    def _on_failed(self, side: Side, told: dict[str, Any]) -> None:
        if told.get("of") == "pixel":
            self._lost_pixel(told["failed"])
        elif told.get("of") in ("rays", "pair"):
            # The story has been told without them.
            self._beside = None
        elif not side.trouble:
            # What follows from the first is no news.
            trace = told.get("trace", "")
            side.fail(told["failed"] + (f"\n{trace}" if trace else ""), told.get("function", ""))
        self._soon()
        self._go()

    def _soon(self) -> None:
        if self.verdicts is not None:
            self.verdicts.soon()

    def _lost_pixel(self, why: str = "") -> None:
        if self._wanted_pixel is not None and self._asked is not None:
            x, y = self._wanted_pixel
            self._cannot_tell(x, y, self._asked, why or "the process has ended")

    def _cannot_tell(self, x: int, y: int, side: Side, why: str) -> None:
        self._wanted_pixel = self._asked = self._told_again = self._story = None
        self._say_story({"story": [x, y], "side": side.name, "failed": why})

    def _on_alive(self, side: Side, told: dict[str, Any]) -> None:
        before = side.note
        side.note = told["note"]
        if "busy" in told:
            name, seconds, line = told["busy"], told["for"], told["line"]
            side.function = "" if name == IMPORTING else name
            at = f", line {line}" if line else ""
            doing = (
                "importing your files takes"
                if name == IMPORTING
                else f"{name} has been running for"
            )
            side.note = f"{doing} {seconds:.0f} s{at}"
            if seconds > ANSWER_WITHIN and side.worker is not None:
                side.worker.end(f"no answer within {ANSWER_WITHIN:.0f} s{at}")
        if side.note != before:
            if bool(side.note) != bool(before):
                self._go()
            self._say_state()

    def _on_picture(self, side: Side, told: dict[str, Any], arrays: list[Any]) -> None:
        linear, there, *rest = arrays
        more = dict(zip(told["more"], rest, strict=True))
        if not np.isfinite(linear).all():
            y, x = np.argwhere(~np.isfinite(linear).all(axis=0))[0]
            side.fail(f"the picture isn't finite at pixel {x},{y}")
            return
        side.note = ""
        side.version += 1
        side.shot = Shot(linear, there, told["samples"], told["seconds"], **more)
        side.shown, side.small = side.job, False
        if told["complete"]:
            side.reached, side.old = told["samples"], False
            side.shots.append(side.shot)
            self._compare()

    def _on_preview(self, side: Side, told: dict[str, Any], arrays: list[Any]) -> None:
        linear, there, *rest = arrays
        more = dict(zip(told["more"], rest, strict=True))
        side.version += 1
        side.shot = Shot(linear, there, 1, told["seconds"], **more)
        side.shown, side.small, side.old = side.job, True, False

    def _compare(self) -> None:
        """One's own picture with the reference, and with what it was before the last save."""
        if self.mine is None or not self.mine.shots:
            return
        mine, course = self.mine.shots[-1], self.course.shots[-1] if self.course.shots else None
        if course is not None:
            other = self._alike(mine, course) or course
            self._differing = share_differing(deviations(mine, other))
            self._compared = [mine.samples, other.samples]
            # Of as many samples as the reference has, some are the same.
            self._curve = [
                (shot.seconds, shot.samples, rms(shot, course))
                for shot in self.mine.shots
                if 2 * shot.samples <= course.samples
            ]
        if self.mine.before is not None:
            self._changed = share_differing(deviations(mine, self.mine.before))

    # ---------------------------------------------------------------- files

    def _files(self) -> Iterable[Path]:
        yield self.scene
        if self.mine is not None:
            yield from saved_files(self.folder)

    def _times(self) -> dict[Path, tuple[int, int]]:
        """When each file was saved [ns], and its bytes."""
        found = {}
        for file in self._files():
            try:
                told = file.stat()
            except OSError:
                continue
            found[file] = told.st_mtime_ns, told.st_size
        return found

    def _look(self) -> None:
        """Look at the files, and at who hasn't been heard of."""
        now = self._times()
        changed = [file for file, time in now.items() if self._seen.get(file) != time]
        changed += self._gone(now)
        self._seen |= now
        if self.scene in changed:
            self._reload()
        modules = [file.stem for file in changed if file != self.scene]
        if modules and self.mine is not None:
            if self.verdicts is not None and (known := [m for m in modules if m in COURSE]):
                self.verdicts.check(known)
            called = {need.partition(".")[0] for need in self._needs}
            if any(each in called or each not in COURSE for each in modules):
                self._save()
            self._say_state()
        for side in self.sides:
            silent = monotonic() - side.heard
            if side.goal and side.ready and silent > SILENT and side.worker is not None:
                note = f"no sign of life for {silent:.0f} s"
                if silent > ANSWER_WITHIN:
                    side.worker.end(f"no sign of life for {ANSWER_WITHIN:.0f} s")
                if note != side.note:
                    side.note = note
                    self._say_state()
                    self._go()
        if self._moved is not None and monotonic() - self._moved > STILL:
            self._stay()
        if self.verdicts is not None:
            idle = not any(side.goal or side.awaiting for side in self.sides)
            first = self.verdicts.first
            self.verdicts.start(idle and self._moved is None)
            if self._waited and not first:
                self._go()
            self._waited = first

    def _gone(self, now: Iterable[Path]) -> list[Path]:
        """Files that were there and have been away for a while."""
        away = self._seen.keys() - set(now)
        self._missing = {file: self._missing.get(file, monotonic()) for file in away}
        gone = [file for file, since in self._missing.items() if monotonic() - since > GONE]
        for file in gone:
            del self._seen[file], self._missing[file]
        return gone

    def _reload(self) -> None:
        try:
            self.loaded = load_description(self.scene)
            self._scene_trouble = ""
        except CourseError as error:
            self._scene_trouble = str(error)
            self._say_state()
            return
        # The workers know the old file.
        self.values, self._orbit = {}, (0.0, 0.0, 1.0)
        for side in self.sides:
            side.close()
        self._lost_pixel("the scene was saved meanwhile")
        self._begin(fresh=True)
        self._say("functions", self.functions())
        self._say_state()

    # ---------------------------------------------------------------- wishes of the page

    def _on_orbit(self, told: dict[str, Any]) -> None:
        turn, tilt, zoom = self._orbit
        camera = self.loaded.description.camera
        self._orbit = within_limits(
            camera, turn + told["turn"], tilt + told["tilt"], zoom * told["zoom"]
        )
        self.values["camera", "eye"] = list(orbited(camera, *self._orbit))
        self._follow()
        self._say_state()

    def _on_value(self, told: dict[str, Any]) -> None:
        slider = next((each for each in self._sliders() if list(each.path) == told["path"]), None)
        if slider is None:
            return
        value = float(min(max(told["value"], slider.low), slider.high))
        if slider.choices:
            value = min(slider.choices, key=lambda each: abs(each - value))
        self.values[slider.path] = int(value) if isinstance(slider.value, int) else value
        self._follow()
        self._say_state()

    def _on_reset(self, _told: dict[str, Any]) -> None:
        self.values, self._orbit = {}, (0.0, 0.0, 1.0)
        self._begin()
        self._say_state()

    def _on_again(self, _told: dict[str, Any]) -> None:
        if self.mine is not None:
            self._save()
            self._say_state()

    def _on_pixel(self, told: dict[str, Any]) -> None:
        width, height = self._size()
        x, y = told["x"], told["y"]
        side = self.course if told.get("side") == "course" or self.mine is None else self.mine
        if not (0 <= x < width and 0 <= y < height):
            self._cannot_tell(x, y, side, f"the picture has {width} x {height} pixels")
            return
        without = NO_PICTURE
        if side.effects == ENGINE:
            without = NO_RAYS
        self._told_again = None
        # A story is told with the functions as they are.
        self._asked_early = told if side.awaiting and not side.trouble else None
        if self._asked_early is not None:
            return
        if side.worker is None or side.trouble or side.effects == ENGINE:
            self._cannot_tell(x, y, side, without)
            return
        self._wanted_pixel, self._beside, self._story = (x, y), None, None
        self._asked = side
        side.worker.send(do="pixel", x=x, y=y, job=side.job)
        known = self.course.worker is not None and self.course.effects != ENGINE
        if side is self.mine and side.called and known:
            assert self.course.worker is not None
            self.course.worker.send(do="rays", x=x, y=y)

    def _is_right(self, story: dict[str, Any]) -> bool:
        """Whether the function whose rays are others than the course's is right by the checks all the same."""
        function = story["rays"].get("function", "")
        return self.verdicts is not None and self.verdicts.is_right(function)

    def _on_check(self, told: dict[str, Any]) -> None:
        assert self.verdicts is not None
        self.verdicts.on_check(told)
        story = self._story
        if story is not None and story["is_right"] != self._is_right(story):
            self._story = story | {"is_right": not story["is_right"]}
            self._say_story(self._story)

    def _put_beside(self) -> None:
        """Have one's own story told beside the course's rays, once both are there."""
        story, course, mine = self._story, self._beside, self.mine
        if story is None or course is None or mine is None or mine.worker is None:
            return
        if course["of"] == story["story"] and story["job"] == mine.job:
            self._beside = None
            mine.worker.send(
                do="pair", x=story["story"][0], y=story["story"][1], rays=course["rays"]
            )

    # ---------------------------------------------------------------- what the page is told

    def _size(self) -> tuple[int, int]:
        film = self.loaded.description.film
        return fitting(film.width, film.height)

    def _sliders(self) -> list[Slider]:
        modules = {need.partition(".")[0] for need in self._needs}
        return sliders(self.loaded, [m for m in COURSE if m in modules or m == self.module])

    def functions(self) -> dict[str, Any]:
        """How far one's functions are; see ``Verdicts.told``."""
        return {} if self.verdicts is None else self.verdicts.told()

    def state(self) -> dict[str, Any]:
        """All but the pictures, the functions and the story."""
        return {
            "file": self.scene.name,
            "title": self.loaded.description.title or self.scene.stem,
            "trouble": self._scene_trouble,
            "own": self._own_trouble,
            "size": self._size(),
            "sides": {side.name: self._told(side) for side in self.sides},
            "curve": self._curve,
            "curve_before": self._curve_before,
            "differing": self._differing,
            "changed": self._changed,
            "saved": self.mine is not None and self.mine.before is not None,
            "compared": self._compared,
            "sliders": [
                each.to_dict() | {"now": self.values.get(each.path, each.value)}
                for each in self._sliders()
            ],
            "moved": bool(self.values),
            "camera": {
                "eye": self.values.get(("camera", "eye"), self.loaded.description.camera.eye),
                "look_at": self.loaded.description.camera.look_at,
            },
            "needs": self._needs,
        }

    def _told(self, side: Side) -> dict[str, Any]:
        return {
            "job": side.job,
            "shown": side.shown,
            # One that follows the view is a moment late.
            "old": side.old and not (side.small and self._moved is not None),
            "small": side.small,
            "most": self._most(side),
            "version": side.version,
            "samples": side.reached,
            "seconds": side.shot.seconds if side.shot is not None else 0,
            "rendering": bool(side.goal) or side.awaiting or self._moved is not None,
            "trouble": side.trouble,
            "function": side.function,
            "note": side.note,
            "printed": side.printed,
            "yours": side.called,
        }
