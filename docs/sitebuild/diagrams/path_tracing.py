"""Figures of path tracing: a path through a room, the steps, directions of a bounce, Russian roulette."""

import math

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import path_tracing

ROOM = (2.0, 1.4)
LAMP = (0.75, 1.3, ROOM[1])
"""From x to x, and its height: it hangs on the ceiling."""

EYE = np.array([-0.55, 0.75])
HITS = np.array([[0.62, 0.0], [2.0, 0.78], [1.45, 0.0]])


def room() -> Figure:
    """A path of three hits with its shadow rays, and a last ray that runs into the lamp."""
    canvas = Canvas(350, 235, (-0.75, 2.25, -0.24, 1.62), 4)
    _room(canvas)
    rng = np.random.default_rng(3)
    for k, hit in enumerate(HITS, 1):
        place = np.array([LAMP[0] + (LAMP[1] - LAMP[0]) * rng.random(), LAMP[2]])
        canvas.line(hit, place, "ink thin dashed")
        canvas.dot(place, "ink", 2)
        canvas.label(hit, f"$β_{k}$", {1: "s", 2: "e", 3: "s"}[k], 11 if k != 2 else 9)
    last = np.array([1.12, LAMP[2]])
    for a, b in zip([EYE, *HITS], [*HITS, last], strict=True):
        canvas.arrow(a, b, "accent")
    canvas.dot(HITS.T, "ink", 3.2)
    canvas.cross(last, "ink", 4)
    canvas.label(EYE, "eye", "n", 5)
    canvas.label(((LAMP[0] + LAMP[1]) / 2, LAMP[2]), "lamp", "n", 10)
    return Figure(
        "One path: from each hit a shadow ray (dashed) asks for the lamp, and the path goes on in "
        "one direction. Where it "
        "runs into the lamp by itself, at the cross, it adds nothing: the shadow ray before has counted that light.",
        (
            Panel(
                canvas,
                "A path through a room",
                "From the eye a path runs to the floor, to the right wall, to the floor again and "
                "into the lamp. From each "
                "of the three hits a dashed shadow ray goes to a place on the lamp.",
            ),
        ),
    )


def steps() -> Figure:
    """A path grows."""
    drawn = []
    for step in (1, 2, 3, 4):
        canvas = Canvas(172, 130, (-0.75, 2.15, -0.2, 1.62), 2)
        _room(canvas)
        canvas.arrow(EYE, HITS[0], "accent" if step == 1 else "faint")
        if step in (2, 3):
            canvas.line(HITS[0], (1.0, LAMP[2]), "accent dashed" if step == 2 else "faint dashed")
        if step == 3:
            canvas.arrow(HITS[0], HITS[1], "accent")
        if step == 4:
            canvas.arrow(HITS[0], HITS[1], "faint")
            canvas.arrow(HITS[1], HITS[2], "accent")
            canvas.cross(HITS[1] + 0.3 * (HITS[2] - HITS[1]), "ink", 5)
        canvas.dot(HITS[0], "ink", 3)
        if step >= 3:
            canvas.dot(HITS[1], "ink", 3)
        drawn.append(canvas)
    words = (
        ("1. A camera ray, $β = 1$.", "A ray from the eye hits the floor."),
        ("2. Add $β$ times the light of a shadow ray.", "A dashed ray from the hit to the lamp."),
        ("3. Go on in one direction; $β$ shrinks.", "A ray from the floor to the right wall."),
        ("4. Russian roulette: on, or the end?", "At the wall the next ray may be crossed out."),
    )
    return Figure(
        "The steps at a path's first hit. Step 5 begins again at the next one.",
        tuple(
            Panel(canvas, f"Step {k}", tell, word)
            for k, (canvas, (word, tell)) in enumerate(zip(drawn, words, strict=True), 1)
        ),
    )


def bounce() -> Figure:
    """Directions of the course's function about a slanting normal, and their density."""
    count, degrees = 3000, 68
    normal = np.array([math.cos(math.radians(degrees)), math.sin(math.radians(degrees)), 0.0])
    u = np.random.default_rng(6).random((2, count))
    many = path_tracing.diffuse_bounce(np.repeat(normal[:, None], count, axis=1), u)
    near = many[:, np.abs(many[2]) < 0.05][:2, :22]
    canvas = Canvas(350, 190, (-1.7, 1.9, -0.62, 1.3), 4)
    across = np.array([normal[1], -normal[0]])
    canvas.surface(-1.4 * across, 1.4 * across)
    turn = np.linspace(-np.pi / 2, np.pi / 2, 91)
    outline = np.cos(turn) * (np.cos(turn) * normal[:2, None] + np.sin(turn) * across[:, None])
    canvas.path(outline, "wash", closed=True)
    canvas.path(outline, "ink thin")
    for way in near.T:
        canvas.line((0, 0), way, "accent thin")
        canvas.dot(way, "accent", 2)
    canvas.arrow((0, 0), 1.15 * normal[:2])
    canvas.label(1.15 * normal[:2], "normal", "e", 6)
    flat = 1.0 * (math.cos(0.9) * normal[:2] + math.sin(0.9) * across)
    canvas.angle((0, 0), flat, normal[:2], "", 30, "ink thin")
    canvas.label(0.42 * (normal[:2] + flat) / 2 * 1.6, "$θ$", "c")
    return Figure(
        "Directions of a diffuse bounce about a slanting normal. The filled shape is as long in each direction as the "
        "density $cos θ / π$ is high: a circle through the hit.",
        (
            Panel(
                canvas,
                "Directions of a diffuse bounce",
                "A slanting surface with its normal. Unit directions fan out above it, densest around the normal; a "
                "circle that touches the surface shows their density.",
            ),
        ),
    )


def roulette() -> Figure:
    """Ten paths before and after a game."""
    count, q = 10, 0.4
    beta = np.full((3, count), q)
    u = (np.arange(count) * 0.7 + 0.05) % 1
    survives, after = path_tracing.russian_roulette(beta, u)
    panels = []
    for values, alive, words in (
        (beta[0], np.ones(count, bool), f"Before: ten paths, each with $β$ = {q}."),
        (
            after[0],
            survives,
            f"After: {int(survives.sum())} paths, each with $β$ = {float(after.max()):g}.",
        ),
    ):
        canvas = Canvas(172, 130, (-0.6, count - 0.4, -0.2, 1.2), 4, stretch=True)
        canvas.line((-0.5, 0), (count - 0.5, 0))
        for k in range(count):
            if alive[k]:
                canvas.rectangle((k - 0.32, 0), (k + 0.32, values[k]), "wash accent")
            else:
                canvas.cross((k, 0.07), "faint", 3)
        mean = float(values.mean())
        canvas.line((-0.5, mean), (count - 0.5, mean), "ink dashed")
        panels.append(
            Panel(
                canvas,
                words.replace("$", ""),
                f"Bars for ten paths. {words.replace('$', '')} The mean is {mean:.2f}.",
                words,
            )
        )
    return Figure(
        f"Russian roulette with $q$ = {q}. Dashed the mean over all ten, which the game leaves as it is.",
        tuple(panels),
    )


def _room(canvas: Canvas) -> None:
    wide, tall = ROOM
    canvas.line((0, tall), (wide, tall))
    canvas.surface((0, 0), (wide, 0))
    canvas.line((wide, 0), (wide, tall))
    canvas.line((0, tall), (0, 0.95))
    canvas.line((LAMP[0], LAMP[2]), (LAMP[1], LAMP[2]), "accent thick")


FIGURES = {"room": room, "steps": steps, "bounce": bounce, "roulette": roulette}
