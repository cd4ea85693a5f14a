"""The studio follows every save, and a student's function can do it no harm."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course.school.studio import sides, verdicts
from course.school.studio import studio as whole_studio
from course.school.studio.studio import MOST, Studio
from course.school.studio.worker import RenderWorker
from tests.lengths import LONG
from tests.school.studio.conftest import RIGHT, WRONG, until, write

DONE = 16

# Where many tests run at once, a process is long in starting.
pytestmark = pytest.mark.timeout(900)


def mine(studio: Studio) -> dict[str, Any]:
    told: dict[str, Any] = studio.state()["sides"]["mine"]
    return told


def course(studio: Studio) -> dict[str, Any]:
    told: dict[str, Any] = studio.state()["sides"]["course"]
    return told


def whole(studio: Studio) -> bool:
    """Whether all is rendered that can be."""
    sides = studio.state()["sides"].values()
    return all((s["samples"] >= DONE and not s["rendering"]) or s["trouble"] for s in sides)


def linear(studio: Studio, side: str = "mine") -> Any:
    shot = getattr(studio, side).shot
    return shot.linear


def test_without_a_function_of_ones_own_both_pictures_are_the_same(studio: Studio) -> None:
    until(lambda: whole(studio))
    assert mine(studio)["samples"] == DONE
    assert course(studio)["samples"] == min(4 * DONE, MOST)
    assert studio.state()["differing"] == 0
    assert mine(studio)["yours"] == []
    errors = [error for _, _, error in studio.state()["curve"]]
    assert len(errors) >= 4
    assert errors == sorted(errors, reverse=True)


def test_a_save_shows_what_is_wrong_and_then_what_has_changed(studio: Studio, work: Path) -> None:
    until(lambda: whole(studio))
    write(work, WRONG)
    until(lambda: mine(studio)["yours"] == ["soft_shadows.point_on_sphere"])
    until(lambda: whole(studio) and (studio.state()["differing"] or 0) > 0.01)
    # It is a change to what was before, too, for that was right.
    assert studio.state()["changed"] > 0.01
    difference = studio.picture("difference")
    assert difference is not None
    red, _, blue, _ = np.moveaxis(difference.astype(int), 2, 0)
    assert (red > blue + 50).any()
    assert (blue > red + 50).any()
    write(work, RIGHT)
    until(lambda: whole(studio) and studio.state()["differing"] == 0)
    assert studio.state()["changed"] > 0.01
    assert studio.state()["curve_before"]


WRONGS = {
    "import os\nos.abort()\n": "process ended: abort",
    "import os\nos._exit(3)\n": "exit code 3",
    "while True:\n    print('x' * 100000)\n": "printed more than",
    "return np.full((3, u.shape[1]), np.nan, u.dtype)\n": "soft_shadows.point_on_sphere",
    "return center / radius['a']\n": "soft_shadows.point_on_sphere",
    "return ((\n": "can't be imported",
    "exit()\n": "soft_shadows.point_on_sphere",
    # Nobody is there to answer, and what is read is no command of the studio's.
    "input('radius? ')\n": "raised EOFError",
}
"""What a function may do, and what is said of it."""


def test_what_goes_wrong_is_told_and_a_save_mends_it(studio: Studio, work: Path) -> None:
    until(lambda: mine(studio)["samples"] == DONE)
    for number, (body, told) in enumerate(WRONGS.items(), 1):
        write(work, body)
        until(lambda told=told: told in mine(studio)["trouble"])
        # Each mends what was before it, too: another process has begun, and told of other trouble.
        if LONG or number in (1, len(WRONGS)):
            write(work, RIGHT)
            until(lambda: mine(studio)["samples"] and not mine(studio)["trouble"])
    # The reference has gone on.
    until(lambda: course(studio)["samples"] == 4 * DONE)


def test_an_endless_loop_is_told_with_its_line_while_it_lasts(studio: Studio, work: Path) -> None:
    until(lambda: mine(studio)["samples"] == DONE)
    write(work, "while True:\n    pass\n")
    note = until(lambda: mine(studio)["note"])
    assert note.startswith("soft_shadows.point_on_sphere has been running for")
    source = (work / "assignments" / "soft_shadows.py").read_text(encoding="utf-8").splitlines()
    line = int(note.rpartition("line ")[2])
    assert source[line - 1].strip() in ("while True:", "pass")
    until(lambda: course(studio)["samples"] == 4 * DONE)
    write(work, RIGHT)
    until(lambda: mine(studio)["samples"] == DONE and not mine(studio)["note"])


def test_a_loop_that_is_left_alone_is_ended(
    studio: Studio, work: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    until(lambda: mine(studio)["samples"] == DONE)
    monkeypatch.setattr(whole_studio, "ANSWER_WITHIN", 2.0)
    write(work, "while True:\n    pass\n")
    assert "no answer within" in until(lambda: mine(studio)["trouble"])


def test_what_a_function_prints_is_shown(studio: Studio, work: Path) -> None:
    write(work, f"print('radius', radius)\n{RIGHT}")
    assert "radius" in until(lambda: mine(studio)["printed"])


@pytest.mark.usefixtures("checked")
def test_checks_follow_a_save(studio: Studio, work: Path) -> None:
    def state() -> str:
        functions = studio.functions()["modules"]
        every = {f["name"]: f["state"] for module in functions for f in module["functions"]}
        return str(every["point_on_sphere"])

    until(lambda: state() == "to do")
    write(work, WRONG)
    until(lambda: state() == "wrong")
    told = studio.functions()
    assert told["next"] == "soft_shadows.point_on_sphere"
    file, _, line = told["where"].rpartition(":")
    rows = Path(file).read_text(encoding="utf-8").splitlines()
    assert rows[int(line) - 1].startswith("def point_on_sphere(")
    write(work, RIGHT)
    until(lambda: state() == "right")


def states(events: Any, last: Any) -> list[dict[str, Any]]:
    """What a page is told of the pictures until one thing is."""
    told: list[dict[str, Any]] = []
    while not told or not last(told[-1]):
        name, data = events.get(timeout=280)
        told += [data] if name == "state" else []
    return told


def test_what_belongs_to_the_view_before_says_so(studio: Studio) -> None:
    until(lambda: whole(studio))
    assert studio.picture("difference") is not None
    events = studio.listen()
    studio.ask("orbit", turn=0.5, tilt=0.1, zoom=1.0)

    def done(told: dict[str, Any]) -> bool:
        sides = told["sides"].values()
        return bool(told["moved"]) and not any(s["old"] or s["rendering"] for s in sides)

    told = [each for each in states(events, done) if each["moved"]]
    # A small picture of the new view comes first; the reference and the difference are of the one before.
    small = [each for each in told if each["sides"]["mine"]["small"]]
    assert small
    assert not small[-1]["sides"]["mine"]["old"]
    assert any(each["sides"]["mine"]["shown"] == told[-1]["sides"]["mine"]["job"] for each in small)
    for each in told:
        both = each["sides"].values()
        assert each["differing"] is None or not any(s["old"] or s["small"] for s in both)
    assert all(each["sides"]["course"]["old"] for each in small)
    assert told[-1]["differing"] == 0
    # The small picture is of the same view: its means over a sixth are those of the whole.
    assert studio.picture("difference") is not None
    assert mine(studio)["samples"] == mine(studio)["most"] == DONE


def test_the_story_of_a_pixel_belongs_to_the_view_that_is_shown(studio: Studio, work: Path) -> None:
    write(work, RIGHT)
    until(lambda: mine(studio)["yours"] and whole(studio))
    for side in ("mine", "course"):
        story = story_of(studio, 20, 40, side)
        events = studio.listen()
        studio.ask("orbit", turn=0.4, tilt=0.2, zoom=1.0)
        stories = (told for name, told in iter(events.get, None) if name == "story")
        assert "old" not in next(stories)
        assert next(stories)["old"] == "The view has changed"
        # Then comes that of the new view.
        again = next(stories)
        studio.forget(events)
        assert "old" not in again
        assert again["side"] == side
        assert again["job"] > story["job"]
        assert again["rays"]["segments"] != story["rays"]["segments"]
        until(lambda: whole(studio))


def test_a_story_that_can_be_told_no_more_is_gone(studio: Studio, work: Path) -> None:
    write(work, RIGHT)
    until(lambda: mine(studio)["yours"] and whole(studio))
    story_of(studio, 20, 40)
    events = studio.listen()
    write(work, "return ((\n")
    stories = (told for name, told in iter(events.get, None) if name == "story")
    last = next(told for told in stories if "failed" in told)
    assert "rays" not in last
    studio.forget(events)


@pytest.mark.usefixtures("checked")
def test_the_verdict_of_what_the_scene_calls_comes_before_the_picture(
    studio: Studio, work: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # How long it takes decides nothing here.
    monkeypatch.setattr(verdicts, "PICTURES_WAIT", 1e9)
    until(lambda: whole(studio))
    events = studio.listen()
    write(work, WRONG)
    seen: list[tuple[int, str, str]] = []
    samples, job = DONE, mine(studio)["job"]
    while not seen or seen[-1][1] != "wrong":
        name, told = events.get(timeout=280)
        if name == "state" and told["sides"]["mine"]["job"] > job:
            samples = told["sides"]["mine"]["samples"]
            assert samples <= 1
        if name == "functions":
            every = {
                f"{f['module']}.{f['name']}": f["state"]
                for module in told["modules"]
                for f in module["functions"]
            }
            states = every["soft_shadows.point_on_sphere"], every["soft_shadows.light_grid"]
            seen.append((samples, *states))
    # The rest of the module is checked after it.
    assert seen[-1][2] == "checking"
    until(lambda: mine(studio)["samples"] == DONE)


def test_a_slider_changes_both_pictures_and_nothing_else_can_be_changed(studio: Studio) -> None:
    until(lambda: whole(studio))
    before, job = linear(studio).copy(), mine(studio)["job"]
    studio.ask("value", path=["lights", 0, "intensity"], value=3)
    studio.ask("value", path=["lights", 0, "radius"], value=0.1)
    until(lambda: mine(studio)["job"] == job + 1 and mine(studio)["samples"] and whole(studio))
    until(lambda: course(studio)["samples"] == 4 * DONE and not course(studio)["old"])
    assert np.abs(linear(studio) - before).max() > 0.05
    np.testing.assert_allclose(linear(studio).mean(), linear(studio, "course").mean(), rtol=0.02)
    now = {tuple(each["path"]): each["now"] for each in studio.state()["sliders"]}
    assert now["lights", 0, "radius"] == 0.1
    studio.ask("reset")
    until(lambda: mine(studio)["job"] == job + 2 and whole(studio))
    np.testing.assert_array_equal(linear(studio), before)


def test_an_orbit_moves_the_camera_and_not_what_is_looked_at(viewer: Studio) -> None:
    until(lambda: course(viewer)["samples"] >= DONE)
    before = linear(viewer, "course").copy()
    viewer.ask("orbit", turn=0.5, tilt=0.1, zoom=1.0)
    until(lambda: course(viewer)["job"] == 2 and course(viewer)["samples"] >= DONE)
    assert np.abs(linear(viewer, "course") - before).max() > 0.05
    camera = viewer.state()["camera"]
    distance = [
        np.linalg.norm(np.subtract(e, camera["look_at"])) for e in (camera["eye"], (0, 1.2, 4))
    ]
    assert distance[0] == pytest.approx(distance[1], rel=1e-4)


def test_a_pixel_tells_its_story_with_ones_own_function(studio: Studio, work: Path) -> None:
    write(work, RIGHT)
    until(lambda: mine(studio)["yours"] and mine(studio)["samples"] == DONE)
    events = studio.listen()
    studio.ask("pixel", x=20, y=40)
    story = until(lambda: next((d for n, d in iter(events.get, None) if n == "story"), None))
    assert story["story"] == [20, 40]
    assert "soft_shadows.point_on_sphere was asked" in str(story["tree"])
    assert len(story["rays"]["samples"]) == DONE
    # Nothing is kept waiting.
    until(lambda: whole(studio))


def story_of(studio: Studio, x: int, y: int, side: str = "mine") -> dict[str, Any]:
    """The last that is told of a pixel: beside the course's rays, if it is one's own."""
    events, before = studio.listen(), studio._story
    studio.ask("pixel", x=x, y=y, side=side)
    while True:
        name, told = events.get(timeout=280)
        # A page that is opened is told the last one.
        if (
            name == "story"
            and told is not before
            and told["side"] == side
            and (side != "mine" or "beside" in told or "failed" in told)
        ):
            studio.forget(events)
            return dict(told)


@pytest.mark.usefixtures("checked")
def test_a_pixel_has_the_courses_rays_beside_ones_own(studio: Studio, work: Path) -> None:
    write(work, WRONG)
    until(lambda: mine(studio)["yours"] and whole(studio))
    story = story_of(studio, 20, 40)
    rays = story["rays"]
    assert rays["function"] == "soft_shadows.point_on_sphere"
    assert len(rays["right"]["samples"]) == len(rays["samples"]) == DONE
    assert rays["right"]["segments"] != rays["segments"]
    name = rays["function"]
    assert any(
        line.startswith(f"{name} returned x ") and "; the course's is x " in line
        for line in story["beside"]
    )
    # Of the same numbers the lamp's points are ten times as far from its centre.
    center = np.mean([r for row in rays["right"]["segments"] for _, r in row[9]], axis=0)
    far = [
        np.linalg.norm(
            np.array([r for row in each["segments"] for _, r in row[9]]) - center, axis=1
        ).mean()
        for each in (rays, rays["right"])
    ]
    assert far[1] / far[0] == pytest.approx(10, rel=0.3)
    assert not story["is_right"]
    # A right function may turn the numbers another way.
    write(work, RIGHT.replace("2 * u[0]", "2 * u[1]").replace("pi * u[1]", "pi * u[0]"))
    until(lambda: whole(studio) and studio.state()["differing"] == 0)
    until(lambda: studio.verdicts is not None and studio.verdicts.functions.get("soft_shadows"))
    story = story_of(studio, 20, 40)
    assert story["rays"]["function"] == name
    assert story["is_right"]
    job = mine(studio)["job"]
    write(work, RIGHT)
    until(lambda: mine(studio)["job"] > job and whole(studio))
    story = story_of(studio, 20, 40)
    assert story["beside"] == []
    assert "right" not in story["rays"]
    assert not story["is_right"]
    # The course's own story has none beside it, and nothing is kept waiting.
    assert "beside" not in story_of(studio, 20, 40, "course")
    until(lambda: whole(studio))


def test_a_scene_with_a_mistake_is_told_and_a_save_mends_it(studio: Studio, work: Path) -> None:
    until(lambda: mine(studio)["samples"] == DONE)
    file = work / "ball.yaml"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("radius: 0.8", "radius: -1"), encoding="utf-8")
    assert "lights[0].radius" in until(lambda: studio.state()["trouble"])
    file.write_text(text.replace("radius: 0.8", "radius: 0.2"), encoding="utf-8")
    until(lambda: not studio.state()["trouble"] and whole(studio))
    sliders = {tuple(each["path"]): each["value"] for each in studio.state()["sliders"]}
    assert sliders["lights", 0, "radius"] == 0.2


def test_nothing_runs_on_when_it_is_closed(work: Path) -> None:
    studio = Studio(work / "ball.yaml", "mine")
    studio.start()
    until(lambda: mine(studio)["samples"] == DONE)
    write(work, "while True:\n    pass\n")
    until(lambda: mine(studio)["note"])
    processes = [side.worker._process for side in studio.sides if side.worker is not None]
    studio.close()
    assert all(process.poll() is not None for process in processes)


def everything(studio: Studio) -> str:
    """What is known of the functions."""
    return str(studio.functions())


def test_a_file_that_is_deleted_or_renamed_is_noticed(studio: Studio, work: Path) -> None:
    write(work, WRONG)
    until(lambda: mine(studio)["yours"] and whole(studio) and studio.state()["differing"])
    file = work / "assignments" / "soft_shadows.py"
    file.rename(work / "assignments" / "soft_shadow.py")
    until(lambda: "There is no" in everything(studio) and "soft_shadows.py" in everything(studio))
    # None of it is one's own any more.
    until(lambda: not mine(studio)["yours"] and whole(studio))
    assert studio.state()["differing"] == 0
    (work / "assignments" / "soft_shadow.py").rename(file)
    until(lambda: mine(studio)["yours"] and whole(studio) and studio.state()["differing"])
    assert "There is no" not in everything(studio)


def test_a_function_that_is_deleted_is_the_courses_again(studio: Studio, work: Path) -> None:
    write(work, WRONG)
    until(lambda: mine(studio)["yours"] and whole(studio) and studio.state()["differing"])
    file = work / "assignments" / "soft_shadows.py"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("def point_on_sphere(", "def point_on_spere("), encoding="utf-8")
    until(lambda: not mine(studio)["yours"] and whole(studio))
    assert not mine(studio)["trouble"]
    assert studio.state()["differing"] == 0


def test_a_scene_that_is_gone_is_told_and_comes_back(studio: Studio, work: Path) -> None:
    until(lambda: mine(studio)["samples"] == DONE)
    scene = work / "ball.yaml"
    scene.rename(work / "elsewhere.yaml")
    assert "ball.yaml" in until(lambda: studio.state()["trouble"])
    (work / "elsewhere.yaml").rename(scene)
    until(lambda: not studio.state()["trouble"] and whole(studio))


@pytest.mark.usefixtures("checked")
def test_saves_in_quick_succession_start_few_processes_and_the_last_one_counts(
    studio: Studio, work: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    until(lambda: studio.mine is not None and studio.mine.spare_ready)
    started: list[float] = []

    class Counted(RenderWorker):
        def __init__(self, *arguments: Any) -> None:
            started.append(time.monotonic())
            super().__init__(*arguments)

    monkeypatch.setattr(sides, "RenderWorker", Counted)
    saves = 40 if LONG else 16
    for n in range(saves):
        # Every other one can't be imported: an editor saves what is half written.
        write(work, "return ((\n" if n % 2 else RIGHT.replace("radius *", f"0.{n + 1} * radius *"))
        time.sleep(0.1)
    # Each of them had one of its own before, and there are those that wait.
    assert len(started) < 0.7 * saves
    write(work, WRONG)
    until(lambda: mine(studio)["yours"] and whole(studio) and (studio.state()["differing"] or 0))
    assert not mine(studio)["trouble"]
    storm = linear(studio).copy()
    studio.ask("again")
    until(lambda: not mine(studio)["samples"])
    until(lambda: mine(studio)["samples"] == DONE)
    np.testing.assert_array_equal(linear(studio), storm)


def test_a_save_while_a_pixel_is_told_has_it_told_again(studio: Studio, work: Path) -> None:
    write(work, f"import time\ntime.sleep(0.3)\n{WRONG}")
    until(lambda: mine(studio)["yours"] and whole(studio))
    events = studio.listen()
    studio.ask("pixel", x=20, y=40)
    until(lambda: studio._wanted_pixel)
    write(work, RIGHT)
    stories = (told for name, told in iter(events.get, None) if name == "story")
    # Until it is told again, the page says that it is.
    assert next(stories)["old"] == "You have saved a file"
    story = next(stories)
    assert story["story"] == [20, 40]
    assert story["job"] == mine(studio)["job"]
    until(lambda: whole(studio) and studio.state()["differing"] == 0)
    # And with every save from then on.
    write(work, WRONG)
    until(lambda: mine(studio)["yours"] and studio.state()["differing"])
    story = until(
        lambda: next((d for n, d in iter(events.get, None) if n == "story" and "beside" in d), None)
    )
    studio.forget(events)


@pytest.mark.usefixtures("checked")
def test_what_a_function_has_started_ends_with_it(studio: Studio, work: Path) -> None:
    import psutil

    # Its name is this test's own: others may run beside it.
    name = str(work)
    body = (
        "import subprocess, sys\n"
        f"subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)', {name!r}])\n"
    )
    write(work, body + RIGHT)
    until(lambda: mine(studio)["yours"] and mine(studio)["samples"] == DONE)

    def left() -> int:
        return sum(
            name in (each.info["cmdline"] or ()) for each in psutil.process_iter(["cmdline"])
        )

    assert left()
    write(work, RIGHT)
    until(lambda: not left())


def test_an_error_of_the_studio_is_told_and_it_goes_on(studio: Studio, work: Path) -> None:
    until(lambda: whole(studio))
    look = studio._look

    def fails() -> None:
        studio._look = look  # type: ignore[method-assign]
        raise RuntimeError("of its own")

    studio._look = fails  # type: ignore[method-assign]
    assert "of its own" in until(lambda: studio.state()["own"])
    write(work, WRONG)
    until(lambda: mine(studio)["yours"] and whole(studio))


def test_saves_share_a_process_until_it_reads_them(monkeypatch: pytest.MonkeyPatch) -> None:
    sent: list[list[str]] = []

    class Told:
        def __init__(self, *_: Any) -> None:
            sent.append([])

        def send(self, **command: Any) -> None:
            sent[-1].append(command["do"])

        def end(self, _why: str) -> None:
            pass

    monkeypatch.setattr(sides, "RenderWorker", Told)
    side = sides.Side("mine", "mine", True, lambda *_: None)
    for _ in range(3):
        side.start("ball.yaml", [], True)
    assert sent == [["scene", "pause"]]
    side.load()
    assert sent == [["scene", "pause", "load"]]
    side.start("ball.yaml", [], True)
    assert sent[1:] == [["scene", "pause"]]
    # One that has failed before it read them is no use.
    side.fail("no scene")
    side.start("ball.yaml", [], True)
    assert len(sent) == 3


def test_a_studio_that_was_stopped_for_a_while_ends_nobody(
    studio: Studio, work: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(work, f"import time\ntime.sleep(0.2)\n{RIGHT}")
    until(lambda: studio.mine is not None and studio.mine.called and studio.mine.goal)
    # As after Ctrl-Z and fg, or the sleep of a machine whose clock goes on.
    now = time.monotonic
    monkeypatch.setattr(whole_studio, "monotonic", lambda: now() + 1000)
    until(lambda: mine(studio)["samples"] == DONE or mine(studio)["trouble"])
    assert not mine(studio)["trouble"]


def test_a_file_that_lets_nobody_else_run_is_told_and_ended(
    studio: Studio, work: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A number that takes minutes, in the file itself, had been "rendering" for ever."""
    write(work, RIGHT)
    until(lambda: mine(studio)["yours"] and mine(studio)["samples"] == DONE)
    file = work / "assignments" / "soft_shadows.py"
    text = file.read_text(encoding="utf-8")
    with monkeypatch.context() as sooner:
        sooner.setattr(whole_studio, "SILENT", 1.0)
        sooner.setattr(whole_studio, "ANSWER_WITHIN", 4.0)
        file.write_text("import re\nre.match('(a+)+b', 60 * 'a')\n" + text, encoding="utf-8")
        assert until(lambda: mine(studio)["note"]).startswith("no sign of life for")
        assert "no sign of life" in until(lambda: mine(studio)["trouble"])
    write(work, RIGHT)
    until(lambda: mine(studio)["samples"] == DONE and not mine(studio)["trouble"])


def test_a_camera_that_can_go_no_further_turns_back_at_once(viewer: Studio) -> None:
    def eye() -> Any:
        return viewer.state()["camera"]["eye"]

    first = eye()
    for _ in range(40):
        viewer.ask("orbit", turn=0.0, tilt=0.3, zoom=1.5)
    highest = until(lambda: eye() != first and viewer._queue.empty() and eye())
    viewer.ask("orbit", turn=0.0, tilt=-0.3, zoom=0.8)
    until(lambda: np.linalg.norm(np.subtract(eye(), highest)) > 1)


def test_a_function_whose_name_is_spelt_wrongly_is_told(studio: Studio, work: Path) -> None:
    until(lambda: mine(studio)["samples"] == DONE)
    file = work / "assignments" / "soft_shadows.py"
    text = file.read_text(encoding="utf-8").replace("def point_on_sphere(", "def point_on_spheres(")
    file.write_text(text.replace("raise NotImplementedError", "return 1  #"), encoding="utf-8")
    told = until(lambda: mine(studio).get("printed"))
    assert "has no point_on_sphere, and a point_on_spheres" in told


def test_a_failure_of_the_studio_itself_is_told_until_something_works(
    studio: Studio, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fails(_told: dict[str, Any]) -> None:
        raise OverflowError("too large")

    with monkeypatch.context() as patched:
        patched.setattr(studio, "_on_orbit", fails)
        studio.ask("orbit", turn=0.1, tilt=0, zoom=1.0)
        until(lambda: "too large" in studio.state()["own"])
    studio.ask("orbit", turn=0.1, tilt=0, zoom=1.0)
    until(lambda: not studio.state()["own"])
