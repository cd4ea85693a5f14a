"""Small renders of purpose-made scenes."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import yaml
from PIL import Image

from course.effects import Effects
from course.imaging.srgb import linear_to_srgb8
from course.rendering.rendering import render
from course.scene.scene import load_scene
from sitebuild.mistakes.look import SIZE, Draw
from sitebuild.mistakes.submissions import functions

Scene = dict[str, Any]


class _Overlaid(Effects):
    """The right functions, but for one."""

    def __init__(self, path: str, made: ModuleType) -> None:
        super().__init__("solutions")
        self._path, self._made = path, made

    def function(self, module: str, name: str) -> Callable[..., Any]:
        if f"{module}.{name}" == self._path:
            return getattr(self._made, name)  # type: ignore[no-any-return]
        return getattr(functions(module), name)  # type: ignore[no-any-return]


def scene(path: str, description: Mapping[str, Any]) -> Draw:
    """Make a `Draw` that renders a scene with MODULE.FUNCTION laid over the right functions."""
    film = {"width": SIZE[0], "height": SIZE[1]} | description.get("film", {})
    return partial(_rendered, path, {"integrator": {"max_depth": 2}} | description | {"film": film})


def _rendered(path: str, description: Scene, made: ModuleType, right: ModuleType) -> Image.Image:  # noqa: ARG001
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.yaml"
        file.write_text(yaml.safe_dump(description), encoding="utf-8")
        loaded = load_scene(file, _Overlaid(path, made))
        linear = render(loaded, threads=1, compiled=False).linear
    return shown(linear)


def shown(linear: np.ndarray[Any, Any]) -> Image.Image:
    """A linear picture (H, W, 3) as screens want it; what is no number is magenta."""
    rows = np.moveaxis(np.asarray(linear, np.float32), -1, 0)
    lost = ~np.isfinite(rows).all(axis=0)
    picture = np.ascontiguousarray(linear_to_srgb8(np.where(lost, 0, rows)))
    picture[lost] = (255, 0, 255)
    return Image.fromarray(picture)


def glow(*color: float) -> dict[str, Any]:
    """A material that looks the same whatever lights it; the scene needs an ambient light of radiance 1."""
    return {"color": [0, 0, 0], "ambient": 1} | {"color": list(color)}


def box(material: str, size: list[float], at: list[float], *turns: tuple[str, float]) -> Scene:
    """A box, turned about axes in that order, then put at its place."""
    axes = {"x": [1, 0, 0], "y": [0, 1, 0], "z": [0, 0, 1]}
    turned = [{"rotate": {"axis": axes[axis], "degrees": angle}} for axis, angle in turns]
    transform = [*turned, {"translate": at}]
    return {"shape": "box", "material": material, "size": size, "transform": transform}


def ball(material: str, radius: float, at: list[float]) -> Scene:
    """A smooth ball."""
    return {
        "shape": "sphere",
        "material": material,
        "radius": radius,
        "segments": 128,
        "transform": [{"translate": at}],
    }


def floor(material: str, size: float = 40) -> Scene:
    """A wide floor at height 0."""
    return {"shape": "quad", "material": material, "width": size, "depth": size}
