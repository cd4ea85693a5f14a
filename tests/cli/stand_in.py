"""A stand-in for the renderer: what the command line does must not depend on how rays fly."""

from dataclasses import dataclass, field
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from course.engine.formats.pictures.display import Display
from course.engine.formats.pictures.files import save

RECEIPT: dict[str, Any] = {
    "rays": {"camera": 4915200, "shadow": 4800000, "reflection": 0, "refraction": 12},
    "numbers": {"pixel": 9830400, "light": 9600000},
    "effects": {"called": ["supersampling.resolve"], "skipped": {"thin_lens": "the aperture is 0"}},
    "seconds": {"camera": 0.05, "trace": 0.5, "film": 0.125},
    "caster": "embree",
    "embree_seconds": 0.5,
    "wall_seconds": 0.5,
    "threads": 2,
    "samples": 16,
    "error": None,
    "pixels": 307200,
    "seed": 7,
    "version": "0.1.0",
}


class Receipt:
    """What a render cost."""

    def to_dict(self) -> dict[str, Any]:
        return RECEIPT


@dataclass
class Picture:
    """A picture of one colour."""

    interrupted: bool = False
    complete: bool = True
    receipt: Receipt = field(default_factory=Receipt)
    settings: Any = field(
        default_factory=lambda: SimpleNamespace(sampler="sobol", display=Display())
    )
    linear: Any = field(default_factory=lambda: np.full((3, 4, 3), 0.5, np.float32))

    @property
    def shown(self) -> Any:
        return np.moveaxis(self.linear, -1, 0)

    def save(self, path: Path) -> None:
        save(path, self.shown)


@dataclass
class Scene:
    """A scene that knows its title."""

    title: str = "A <box> & a ball"
    why_dark: str = ""
    loaded: Any = None

    def summary(self) -> dict[str, dict[str, object]]:
        return {
            "scene": {"triangles": 82000, "lights": 1},
            "effects": {"supersampling": "called", "thin_lens": "skipped: the aperture is 0"},
            "nothing": {},
        }


@dataclass
class Engine:
    """What the stand-in was asked, and what it is to answer."""

    loaded: list[tuple[Path, dict[str, Any]]] = field(default_factory=list)
    rendered: list[dict[str, Any]] = field(default_factory=list)
    picture: Picture = field(default_factory=Picture)
    error: BaseException | None = None
    title: str = "A <box> & a ball"
    why_dark: str = ""

    def load_scene(self, path: Path, described: Any = None, **options: Any) -> Scene:
        self.loaded.append((path, options))
        return Scene(self.title, self.why_dark)

    def render(self, _scene: Scene, **options: Any) -> Picture:
        self.rendered.append(options)
        if self.error is not None:
            raise self.error
        return self.picture
