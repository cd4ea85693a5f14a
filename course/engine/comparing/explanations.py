"""What makes one picture out of another: a movement, a blur, a factor of each channel, a turn.

Each is undone, and what remains of the weighted square of the difference is compared with all of it. That says what a
difference is like; whether there is one is asked elsewhere.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from course.engine.comparing.noise import DifferenceNoise, Strip
from course.engine.comparing.windows import Window
from course.engine.core.types import Floats64, Mask

FARTHEST = 64
"""Pixels of a movement at most."""

SMALL = 0.05
"""Channels are not told that differ by less than this share of the one that differs most."""

STEPS = 12
"""Of at most a pixel each, to find a movement."""

BLURS = (0.3, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8, 4.0)
"""Standard deviations of a blur that are tried [pixels]."""

SHARED_BY_MOVING, SHARED_BY_BLURRING = 0.625, 0.54
"""What remains of independent noise alone if a picture is moved by half a pixel, or is blurred."""

WAYS = ("to the left", "to the right"), ("up", "down")
"""Of movements across and down, by negative and positive sizes."""

TURNS = {
    "is B flipped upside down": np.s_[::-1, :],
    "is B flipped left to right": np.s_[:, ::-1],
    "is B turned by 180 degrees": np.s_[::-1, ::-1],
}

BORDER = 8
"""Pixels along a picture's border that are not looked at, if it is wide enough: undoing something lacks some there."""


@dataclass(frozen=True)
class Likeness:
    """A is B, but for what the text says; ``left``: share of the difference that remains, without what noise loses."""

    text: str
    left: float


def likenesses(part: Strip, noise: DifferenceNoise) -> Iterator[Likeness]:
    """All that there are, of a part that is not empty."""
    weight = part.usable[..., None] / noise.size
    height, width = part.usable.shape
    inner = np.s_[
        min(BORDER, height // 4) : height - min(BORDER, height // 4),
        min(BORDER, width // 4) : width - min(BORDER, width // 4),
    ]

    def energy(a: Floats64, b: Floats64) -> float:
        return float((((a - b) * weight)[inner] ** 2).mean())

    whole = energy(part.a, part.b) or 1.0
    for text, index in TURNS.items():
        yield Likeness(text, energy(part.a, part.b[index]) / whole)
    factors = _factors(part, weight)
    shares = np.abs(factors - 1)
    sure = shares > SMALL * shares.max()
    yield Likeness(f"is {of_channels(factors - 1, sure)}", energy(part.a, part.b * factors) / whole)
    across, down = movement(part, weight)
    moved = _moved(part.b, across, down)
    yield Likeness(
        f"is moved by about {direction(across, down)}",
        energy(part.a, moved) / whole / SHARED_BY_MOVING,
    )
    yield _blur(part, energy, whole)


def _factors(part: Strip, weight: Floats64) -> Floats64:
    """The mean of a over that of b, of each channel."""
    of_a, of_b = ((one * weight**2).sum(axis=(0, 1)) for one in (part.a, part.b))
    factors: Floats64 = np.divide(of_a, of_b, out=np.ones(3), where=of_b > 0)
    return factors


def _blur(part: Strip, energy: Callable[[Floats64, Floats64], float], whole: float) -> Likeness:
    from scipy.ndimage import gaussian_filter

    found = []
    for word, sharp, other in (("blurrier", part.b, part.a), ("sharper", part.a, part.b)):
        for sigma in BLURS:
            left = energy(gaussian_filter(sharp, (sigma, sigma, 0)), other) / whole
            found.append((left, word, sigma))
    left, word, sigma = min(found)
    return Likeness(f"is {word} by about {_pixels(sigma)}", left / SHARED_BY_BLURRING)


def movement(part: Strip, weight: Floats64) -> tuple[float, float]:
    """Pixels to the right and down by which a is moved against b: whole ones that fit best, then parts of one."""
    grey = [(one * weight).mean(axis=2) for one in (part.a, part.b)]
    spectra = [np.fft.rfft2(one - one.mean()) for one in grey]
    fit = np.fft.irfft2(spectra[0] * spectra[1].conj(), grey[0].shape)
    height, width = fit.shape
    far = [min(FARTHEST, size // 4) for size in (height, width)]
    near = np.roll(fit, far, axis=(0, 1))[: 2 * far[0] + 1, : 2 * far[1] + 1]
    row, column = np.unravel_index(int(near.argmax()), near.shape)
    across, down = float(column - far[1]), float(row - far[0])
    for _ in range(STEPS):
        step = _step(part.a, _moved(part.b, across, down), weight)
        across, down = across + step[0], down + step[1]
        if max(map(abs, step)) < 0.01:
            break
    return across, down


def _step(a: Floats64, b: Floats64, weight: Floats64) -> tuple[float, float]:
    """Parts of a pixel by which a is moved against b.

    Source: Lucas and Kanade, "An iterative image registration technique", 1981.
    """
    down, across = (np.gradient((a + b) / 2, axis=axis) * weight for axis in (0, 1))
    cut = np.s_[BORDER:-BORDER, BORDER:-BORDER] if min(a.shape[:2]) > 4 * BORDER else np.s_[:, :]
    d = ((a - b) * weight)[cut]
    slopes = np.stack([across[cut].ravel(), down[cut].ravel()], axis=1)
    solution = np.linalg.lstsq(slopes, -d.ravel(), rcond=None)[0].clip(-1, 1)
    return float(solution[0]), float(solution[1])


def _moved(picture: Floats64, across: float, down: float) -> Floats64:
    from scipy.ndimage import shift

    moved: Floats64 = shift(picture, (down, across, 0), order=1, mode="nearest")
    return moved


def direction(across: float, down: float) -> str:
    """A movement in words: "1 pixel to the right and .5 pixels up"."""
    parts = [
        f"{_pixels(abs(size))} {words[size > 0]}"
        for size, words in zip((across, down), WAYS, strict=True)
        if abs(size) >= max(0.05, 0.1 * max(abs(across), abs(down)))
    ]
    return " and ".join(parts) or "less than 0.05 pixels"


def _pixels(size: float) -> str:
    text = f"{size:.1f}".removesuffix(".0") if size >= 0.1 else f"{size:.2f}"
    return f"{text} pixel{'' if text == '1' else 's'}"


def of_channels(shares: Floats64, sure: Mask) -> str:
    """By what share a is brighter in each channel that is sure, in words."""
    signs = {bool(share > 0) for share, one in zip(shares, sure, strict=True) if one}
    if sure.all() and len(signs) == 1:
        size = np.abs(shares)
        span = _percent(float(size.mean()))
        if size.max() > 1.5 * size.min():
            span = " / ".join(_percent(float(one)) for one in size) + " in red / green / blue"
        return f"{'brighter' if signs.pop() else 'darker'} by {span}"
    return ", ".join(
        f"{'brighter' if share > 0 else 'darker'} by {_percent(abs(float(share)))} in {name}"
        for share, one, name in zip(shares, sure, ("red", "green", "blue"), strict=True)
        if one
    )


def _percent(share: float) -> str:
    """Two digits, of 1% up whole ones."""
    return f"{100 * share:.0f}%" if share >= 0.1 else f"{100 * share:.2g}%"


def where(place: Window) -> str:
    """A place in words."""
    return f"in {place.width} x {place.height} pixels at ({place.left}, {place.top})"
