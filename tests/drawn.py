"""Which numbers the paths of a scene draw."""

from dataclasses import replace
from typing import Any

from course import Scene
from course.engine.core.counters import Counters
from course.engine.core.samplers import Block
from course.engine.core.tiles import passes
from course.engine.core.types import Indices
from course.engine.render.binding import bind
from course.engine.terms.samplers.sobol import SobolSampler

Drawn = set[tuple[int, int]]
"""(dimension, width)."""


def numbers_drawn(scene: Scene) -> Drawn:
    """By a render of its own, with Sobol points."""
    found: Drawn = set()

    class Noted(SobolSampler):
        def draw(self, block: Block, dimension: int, width: int) -> Any:
            found.add((dimension, width))
            return super().draw(block, dimension, width)

        def draw_some(self, block: Block, dimension: int, width: int, path: Indices) -> Any:
            found.add((dimension, width))
            return super().draw_some(block, dimension, width, path)

    tracer = replace(bind(scene, scene.settings), sampler=Noted(0))
    for work in passes(scene.settings, tracer.sampler):
        tracer.render_tile(work.tile, work.first, work.samples, Counters())
    return found


def rows(drawn: Drawn | list[tuple[int, int]]) -> list[int]:
    """The dimensions one by one."""
    return sorted(dimension + k for dimension, width in drawn for k in range(width))
