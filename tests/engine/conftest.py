"""A small scene that goes through every stage of the renderer."""

from collections.abc import Callable, Sequence
from typing import Any

import pytest

from course import Scene

EveryStage = Callable[..., Scene]


@pytest.fixture
def every_stage(make_scene: Callable[..., Scene]) -> EveryStage:
    """Mirror, absorbing glass, smooth and flat meshes, and every kind of light, scaled and moved at will.

    Nothing in it touches or lies in one plane: there, the last bit of a coordinate decides what is seen.
    """

    def make(k: float = 1.0, away: Sequence[float] = (0, 0, 0), **parts: Any) -> Scene:
        def at(*x: float) -> list[float]:
            return [k * c + a for c, a in zip(x, away, strict=True)]

        def times(*x: float) -> list[float]:
            return [k * c for c in x]

        def moved(*x: float) -> list[dict[str, Any]]:
            return [{"translate": at(*x)}]

        glass = {"refraction_index": 1.5, "absorption": [0.5 / k, 0.1 / k, 0.2 / k]}
        description: dict[str, Any] = {
            "camera": {"eye": at(0.3, 1.8, 4), "look_at": at(0, 0.6, 0), "vertical_fov": 45},
            "film": {"width": 40, "height": 30},
            "environment": {"type": "constant", "radiance": [0.1, 0.2, 0.3]},
            "materials": {
                "white": {},
                "shiny": {"color": [0.8, 0.5, 0.3], "specular": 0.3},
                "mirror": {"color": 0.1, "mirror": 0.8},
                "glass": {"dielectric": glass},
            },
            "lights": [
                {"type": "ambient", "radiance": 0.05},
                {"type": "point", "position": at(1.2, 3, 2), "intensity": 8 * k * k},
                {"type": "directional", "direction": [0.3, -1, -0.2], "irradiance": 0.4},
                {
                    "type": "rectangle",
                    "corner": at(-2, 2.5, -0.5),
                    "edge_u": times(1, 0, 0),
                    "edge_v": times(0, 0, 1),
                    "intensity": 4 * k * k,
                },
                {
                    "type": "rectangle",
                    "corner": at(-1, 2.6, 1),
                    "edge_u": times(1, 0, 0),
                    "edge_v": times(0, 0, 1),
                    "radiance": 3,
                },
                {
                    "type": "sphere",
                    "center": at(0, 2, 2),
                    "radius": 0.3 * k,
                    "intensity": 2 * k * k,
                },
                {"type": "sphere", "center": at(-1.5, 1.2, 1.2), "radius": 0.2 * k, "radiance": 4},
            ],
            "objects": [
                {"shape": "quad", "material": "white", "width": 6 * k, "depth": 6 * k}
                | {"transform": moved(0, 0, 0)},
                {"shape": "sphere", "material": "shiny", "radius": 0.6 * k}
                | {"transform": moved(-1, 0.63, 0.3)},
                {"shape": "box", "material": "mirror", "size": times(0.8, 1.1, 0.7)}
                | {"transform": moved(0.4, 0.561, -0.9)},
                {"shape": "sphere", "material": "glass", "radius": 0.5 * k}
                | {"transform": moved(0.9, 0.52, 0.7)},
            ],
        }
        return make_scene(**(description | parts))

    return make
