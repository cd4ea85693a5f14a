"""Commands that do their work again whenever a file is saved."""

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from course.cli.render import _named
from course.cli.watching import times
from course.engine.functions.effects import PROJECT


def later(path: Path, text: str) -> None:
    """Save a file, surely at another time than before."""
    path.write_text(text, encoding="utf-8")
    stamp = path.stat().st_mtime_ns + 10**9 * (1 + len(text))
    os.utime(path, ns=(stamp, stamp))


class Watch:
    """`course render --watch` in a process of its own, in a folder."""

    def __init__(self, folder: Path, scene: Path) -> None:
        self.picture, self.told = folder / "a.png", folder / "told.txt"
        self._seen = b""
        options = ["--size", "24x16", "--spp", "1", "--effects", "mine", "-o", "a.png", "--watch"]
        with self.told.open("wb") as out:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "course", "render", str(scene), *options],
                cwd=folder,
                stdout=out,
                stderr=out,
                env=os.environ | {"PYTHONPATH": str(PROJECT)},
                start_new_session=True,
            )

    def pictured(self) -> bool:
        """Whether there is another picture than at the last call."""
        now = self.picture.read_bytes() if self.picture.exists() else b""
        changed, self._seen = now not in (b"", self._seen), now
        return changed

    def until(self, what: Callable[[], bool]) -> None:
        """Wait until it is so."""
        deadline = time.monotonic() + 60
        while not what():
            assert time.monotonic() < deadline, self.told.read_text()
            time.sleep(0.05)

    def says(self, text: str) -> Callable[[], bool]:
        """Whether it has said that since now."""
        begin = self.told.stat().st_size
        return lambda: text in self.told.read_bytes()[begin:].decode()


def test_render_takes_a_function_as_it_was_saved_last(tmp_path: Path) -> None:
    """Also after one that never ends, one that ends the process, and one that can't be read."""
    scene = tmp_path / "scene.yaml"
    shutil.copy(PROJECT / "scenes" / "soft_shadows.yaml", scene)
    mine = tmp_path / "assignments" / "soft_shadows.py"
    mine.parent.mkdir()
    body = "def point_on_sphere(center, radius, u):\n    return center[:, None] + {} * u[:1]\n"
    watch = Watch(tmp_path, scene)
    try:
        watch.until(watch.pictured)
        later(mine, body.format(0))
        watch.until(watch.pictured)
        later(mine, body.format("[print('asked', flush=True), 1][1]"))
        watch.until(watch.pictured)
        busy = watch.says("asked")
        later(
            mine,
            "def point_on_sphere(*_):\n    print('asked', flush=True)\n    while True:\n        pass\n",
        )
        watch.until(busy)
        ended = watch.says("the process has ended by itself: exit code 7")
        later(mine, "import os\ndef point_on_sphere(*_):\n    os._exit(7)\n" + 40 * "\n")
        watch.until(ended)
        wrong = watch.says("SyntaxError")
        later(mine, "def point_on_sphere(:\n")
        watch.until(wrong)
        assert not watch.pictured()
        later(mine, body.format(2) + 10 * "\n")
        watch.until(watch.pictured)
        misspelt = watch.says("radianze")
        later(scene, scene.read_text().replace("radiance", "radianze"))
        watch.until(misspelt)
        os.killpg(watch.process.pid, signal.SIGINT)
        assert watch.process.wait(30) == 130
    finally:
        with suppress(ProcessLookupError):
            os.killpg(watch.process.pid, signal.SIGKILL)
        watch.process.wait()
    assert "Traceback" not in watch.told.read_text()


def test_files_that_a_scene_names_are_watched_too(tmp_path: Path) -> None:
    scene = tmp_path / "textures.yaml"
    shutil.copy(PROJECT / "scenes" / "textures.yaml", scene)
    names = {path.name for path in _named(scene, *times([scene]))}
    assert names == {"studio.exr", "tiles.png", "globe.png", "weave.png", "vase.obj"}
    assert _named(tmp_path / "none.yaml", 0) == []
