"""What a comparison has seen, in words: "A is moved by about 1 pixel to the right"."""

from dataclasses import dataclass

import numpy as np

from course.engine.comparing.explanations import (
    WAYS,
    direction,
    likenesses,
    movement,
    of_channels,
    where,
)
from course.engine.comparing.fields import COLOURS
from course.engine.comparing.noise import noise_of
from course.engine.comparing.significance import SIGNS, SPOT, Comparison, Finding
from course.engine.comparing.windows import Window
from course.engine.core.types import Floats64

EXPLAINED = 0.5
"""Of the difference may remain at most where one cause is told for all of it."""

WIDEST = 512
"""Pixels along the side of what is looked at for a cause."""

MOST = 4
"""Places that are told."""

SURE = 4.0
"""Standard errors that a channel's mean must differ by to be named."""


@dataclass(frozen=True)
class Seen:
    """A sentence, and the place that it tells of; None for the whole picture."""

    text: str
    place: Window | None

    def __str__(self) -> str:
        return self.text


def seen(found: Comparison, significance: float) -> list[Seen]:
    """What differs; nothing where the pictures don't."""
    different = [one for one in found.found if one.p_value < significance]
    if not different:
        return []
    # A spot has no cause but itself.
    if different[0].kind != SPOT and (cause := _cause(found, different[0])):
        return [Seen(f"A {cause}", None)]
    first = different[0]
    told = [Seen(_sentence(found, first), None if first.whole else first.place)]
    if first.whole or first.kind not in (*COLOURS, SPOT):
        return told
    for one in different[1:]:
        if len(told) == MOST or one.whole or one.kind not in (*COLOURS, SPOT):
            continue
        if not any(other.place and other.place.meets(one.place) for other in told):
            told.append(Seen(_sentence(found, one), one.place))
    return told


def _cause(found: Comparison, first: Finding) -> str | None:
    """What makes most of the difference, if it is one thing."""
    height, width = found.pair.usable.shape
    sides = min(height, WIDEST), min(width, WIDEST)
    middle = first.place.top + first.place.height // 2, first.place.left + first.place.width // 2
    top, left = (
        min(max(at - side // 2, 0), size - side)
        for at, side, size in zip(middle, sides, (height, width), strict=True)
    )
    part = found.pair.part(Window(left, top, sides[1], sides[0]))
    best = min(likenesses(part, noise_of(part, found.level)), key=lambda one: one.left)
    return best.text if best.left < EXPLAINED else None


def _sentence(found: Comparison, one: Finding) -> str:
    at = "" if one.whole else f" {where(one.place)}"
    if one.kind == "blurred":
        return f"A is {'sharper' if one.t < 0 else 'blurrier'}{at}"
    if one.kind.startswith("alike") or one.kind == SIGNS:
        return f"A has other shapes or colours{at}"
    part = found.pair.part(one.place)
    if one.kind.startswith("moved"):
        if one.place.is_line:
            # Too little to be laid on another picture.
            words = WAYS["down" in one.kind]
            return f"A is moved {words[one.t < 0]}{at}"
        level = noise_of(part, found.level)
        across, down = movement(part, part.usable[..., None] / level.size)
        return f"A is moved by about {direction(across, down)}{at}"
    return f"A is {_brightness(part.d, part.b, one)}{at}"


def _brightness(d: Floats64, b: Floats64, one: Finding) -> str:
    means, of_b = d.mean(axis=(0, 1)), b.mean(axis=(0, 1))
    errors = d.std(axis=(0, 1)) / np.sqrt(d.shape[0] * d.shape[1])
    sure = np.abs(means) > SURE * errors
    if one.kind in COLOURS:
        sure[COLOURS.index(one.kind)] = True
    if not sure.any():
        sure[int(np.abs(means).argmax())] = True
    if (of_b[sure] > 1e-6 * np.abs(means[sure])).all():
        return of_channels(means / np.maximum(of_b, 1e-300), sure)
    size = means[sure][np.abs(means[sure]).argmax()]
    return f"{'brighter' if size > 0 else 'darker'} by {abs(size):.2g}, where B is black,"
