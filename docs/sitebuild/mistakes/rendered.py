"""Small renders with one function wrong: of scenes that the grader's picture checks render, and of scenes made here."""

from collections.abc import Callable, Mapping
from functools import partial
from types import ModuleType
from typing import Any

import numpy as np
from PIL import Image

from course.school.grading.checks.check import Figure
from course.school.grading.pictures.rendered import MakeScene, loaded, rendered
from course.school.grading.reports.drawing import draw_pictures
from sitebuild.mistakes.look import SIZE, Draw
from sitebuild.mistakes.numbers import scene_numbers, trial
from sitebuild.mistakes.submissions import functions

Scene = dict[str, Any]

SEED = 7
"""Of the parts of a check's scene that differ from one grading to the next."""


def scene(path: str, description: Mapping[str, Any]) -> Draw:
    """Make a `Draw` that renders a scene with MODULE.FUNCTION in place of the right one."""
    return checked(path, lambda _: {"integrator": {"max_depth": 2}} | description)


def checked(path: str, make: MakeScene) -> Draw:
    """Make a `Draw` that renders the scene of a picture check, in the size of the site's figures.

    Parameters
    ----------
    path : MODULE.FUNCTION
    make : the scene, as in `course.school.grading.pictures.scenes`
    """
    return partial(_rendered, path, make)


def _rendered(path: str, make: MakeScene, made: ModuleType, right: ModuleType) -> Image.Image:  # noqa: ARG001
    def find(module: str, name: str) -> Callable[..., Any]:
        whose = made if f"{module}.{name}" == path else functions(module)
        return getattr(whose, name)  # type: ignore[no-any-return]

    rng = scene_numbers(SEED)
    description = make(rng)
    film = description.get("film", {}) | {"width": SIZE[0], "height": SIZE[1]}
    seeded = {"seed": trial()} if trial() else {}
    return shown(rendered(loaded(description | {"film": film}, find, rng), **seeded))


def shown(picture: np.ndarray[Any, Any]) -> Image.Image:
    """A linear picture (3, H, W) as the grader's reports show it; what is no number is magenta."""
    (panel,) = draw_pictures(Figure("pictures", "", {"yours": np.asarray(picture)})).panels
    assert panel.pixels is not None
    return Image.fromarray(panel.pixels)


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
