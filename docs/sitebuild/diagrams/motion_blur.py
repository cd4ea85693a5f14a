"""Figures of motion blur: what the film keeps, the ray that moves instead of the object, the steps."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, moved, unit
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.streak import CLOSE, OPEN, RADIUS, SPEED, film
from solutions import motion_blur


def relative() -> Figure:
    """The same meeting, seen from the world and from the ball."""
    velocity, time = np.array([1.1, 0.35, 0]), np.array([1.0])
    origin, toward = np.array([-1.15, -0.85, 0]), np.array([1.05, 0.38, 0])
    moved = motion_blur.displacement(velocity, time)[:, 0]
    shifted = motion_blur.to_object_space(origin[:, None], velocity, time)[:, 0]
    way, radius = unit(toward - origin), 0.42
    panels = []
    for start, ball, title, words in (
        (origin, moved, "Seen from the world", "The ball has gone $v t$; the ray stays."),
        (
            shifted,
            np.zeros(3),
            "Seen from the ball",
            "The ball stays; the ray's start has gone $-v t$.",
        ),
    ):
        canvas = Canvas(350, 190, (-2.6, 1.9, -1.45, 1.0), 4)
        canvas.circle((0, 0), radius, "wash ink" if ball[0] == 0 else "faint dashed")
        if ball[0]:
            canvas.circle(ball[:2], radius, "wash ink")
            canvas.arrow((0, 0), ball[:2], "accent")
            canvas.label(0.16 * ball[:2], "$v t$", "n", 5, "accent")
        else:
            canvas.dot(origin[:2], "open faint", 3.2)
            canvas.arrow(origin[:2], start[:2], "accent")
            canvas.label((origin + start)[:2] / 2, "$-v t$", "se", 8, "accent")
        t = _enter(start, way, ball, radius)
        canvas.arrow(start[:2], (start + way * (t + 1.25))[:2], "faint")
        canvas.line(start[:2], (start + way * t)[:2])
        canvas.dot((start + way * t)[:2], "ink", 3.2)
        canvas.dot(start[:2], "ink", 3.2)
        canvas.label(start[:2], "ray's start", "s", 8)
        panels.append(
            Panel(
                canvas,
                title,
                "A ray meets a ball. "
                + (
                    "The ball has moved from its dashed place by v times t."
                    if ball[0]
                    else "The ball is where it was; the ray starts elsewhere, moved by minus v times t."
                ),
                f"{title}. {words}",
            )
        )
    return Figure(
        "At time $t$ the ray meets the ball at the same place of the ball, after the same length, whichever of the two "
        "is moved. The ray's direction is the same in both.",
        tuple(panels),
    )


def steps() -> Figure:
    """Times of four rays, their starts as the ball sees them, their hits, the mean."""
    u = (np.arange(4) + np.random.default_rng(6).random(4)) / 4
    times = motion_blur.shutter_times(OPEN, CLOSE, u)
    velocity = np.array([SPEED, 0, 0])
    starts = np.repeat(np.array([[0.0], [2.0], [0.0]]), 4, axis=1)
    seen = motion_blur.to_object_space(starts, velocity, times)
    hits = np.abs(seen[0]) < RADIUS * 1.6

    when = Canvas(172, 130, (-0.68, 0.68, -0.4, 0.6), 4)
    when.line((OPEN - 0.12, 0), (CLOSE + 0.12, 0), "faint")
    when.line((OPEN, 0), (CLOSE, 0), "accent thick")
    for t, words in ((OPEN, "$t_0$"), (CLOSE, "$t_1$")):
        when.line(when.away((t, 0), 0, -6), when.away((t, 0), 0, 6))
        when.label((t, 0), words, "s", 9)
    for k, t in enumerate(times, 1):
        when.arrow((t, 0.36), (t, 0.03), "ink", 6)
        when.label((t, 0.36), str(k), "n", 2)

    drawn = [when]
    for step in (2, 3):
        canvas = Canvas(172, 130, (-1.35, 1.35, -0.25, 2.4), 2)
        canvas.circle((0, 0.5), RADIUS * 1.6, "wash ink")
        for k, (o, hit) in enumerate(zip(seen.T, hits, strict=True), 1):
            if step == 2:
                canvas.dot(moved(o[:2], 0, -0.15), "accent", 3.2)
                canvas.line(moved(o[:2], 0, -0.15), moved(o[:2], 0, -0.6), "ink")
            else:
                top = 0.5 + np.sqrt(max(0, (RADIUS * 1.6) ** 2 - o[0] ** 2))
                canvas.arrow(
                    moved(o[:2], 0, -0.15),
                    (o[0], top if hit else -0.15),
                    "accent" if hit else "faint",
                    6,
                )
            canvas.label(moved(o[:2], 0, -0.15), str(k), "n", 4)
        drawn.append(canvas)

    mean = Canvas(172, 130, (-0.75, 0.75, -0.55, 0.6), 4)
    share = float(hits.mean())
    mean.rectangle((-0.4, -0.4), (0.4, 0.4), "solid", share)
    mean.rectangle((-0.4, -0.4), (0.4, 0.4), "ink")
    mean.label((0, 0), f"{int(hits.sum())} of 4", "c")
    drawn.append(mean)
    return Figure(
        "Four rays of one pixel, which look straight down at a ball that moves to the right. They "
        "all start at the same "
        "place, but at different times, and so at different places as the ball sees them.",
        (
            Panel(
                drawn[0],
                "Step 1: times",
                "A line from t0 to t1 with four arrows at random times, numbered 1 to 4.",
                "1. Each ray gets a random time.",
            ),
            Panel(
                drawn[1],
                "Step 2: starts as the ball sees them",
                "Above a ball at rest the four starts stand side by side; the earliest is farthest to the right.",
                "2. Where it starts, as the ball sees it.",
            ),
            Panel(
                drawn[2],
                "Step 3: hits",
                f"{int(hits.sum())} of the four shifted rays hit the ball, the others pass it.",
                "3. Meet the ball at rest.",
            ),
            Panel(
                drawn[3],
                "The mean",
                f"A pixel with {share:.2f} of the ball's colour.",
                "5. The mean is the pixel.",
            ),
        ),
    )


def _enter(origin: np.ndarray, way: np.ndarray, centre: np.ndarray, radius: float) -> float:
    """How far along a ray it enters a ball."""
    toward = centre - origin
    along = float(toward @ way)
    return along - float(np.sqrt(radius**2 - (toward @ toward - along**2)))


FIGURES = {"film": film, "relative": relative, "steps": steps}
