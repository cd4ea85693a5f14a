"""Figures of glossy reflection: a lobe and why images dissolve, the steps, three ways to jitter."""

import math

import numpy as np

from course.engine.core.vectors import reflect
from sitebuild.diagrams.canvas import Canvas, columns, turned
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.lobe import lobe
from solutions import glossy


def steps() -> Figure:
    """A ray at a grazing angle, its mirrored direction, and directions of its lobe."""
    normal = np.array([[0.0], [1.0], [0.0]])
    incoming = np.array([*turned(-20), 0.0])[:, None]
    mirrored = reflect(incoming, normal)
    u = np.random.default_rng(3).random((2, 400))
    many = glossy.sample_phong_lobe(np.repeat(mirrored, 400, axis=1), 12.0, u)
    # Only directions near the plane of the drawing, so that none looks shorter than it is.
    many = many[:, np.abs(many[2]) < 0.1]
    many = many[:, np.argsort(many[1])][:, :: many.shape[1] // 8]
    kept = glossy.keep_above(many, np.repeat(normal, many.shape[1], axis=1))
    below = many[1] < 0
    drawn = []
    for step in range(1, 5):
        canvas = Canvas(172, 112, (-1.35, 1.35, -0.5, 1.1), 3)
        canvas.surface((-1.3, 0), (1.4, 0))
        canvas.arrow(-1.25 * incoming[:2, 0], (0, 0), "ink" if step == 1 else "faint")
        if step < 3:
            canvas.arrow((0, 0), 1.25 * mirrored[:2, 0], "accent" if step == 1 else "faint")
        if step == 1:
            canvas.line((0, 0), (0, 1), "faint")
            canvas.angle((0, 0), -incoming[:2, 0], (0, 1), "", 20)
            canvas.angle((0, 0), (0, 1), mirrored[:2, 0], "", 20)
        if step == 2:
            for d, down in zip(many.T, below, strict=True):
                canvas.arrow((0, 0), 1.1 * d[:2], "ink dashed" if down else "accent", 5)
        if step == 3:
            for d, old, down in zip(kept.T, many.T, below, strict=True):
                canvas.arrow((0, 0), 1.1 * d[:2], "accent" if down else "faint", 5)
                if down:
                    canvas.line((0, 0), 1.1 * old[:2], "ink dashed")
                    canvas.line(1.1 * old[:2], 1.1 * d[:2], "faint dashed")
        if step == 4:
            for d in kept.T:
                canvas.arrow((0, 0), 1.1 * d[:2], "accent", 5)
        drawn.append(canvas)
    count = int(below.sum())
    return Figure(
        "The steps for a ray that comes in flat, with a wide lobe.",
        (
            Panel(
                drawn[0],
                "Step 1: mirror",
                "A ray falls on a floor and is mirrored: both make the same angle with the normal.",
                "1. The direction is mirrored.",
            ),
            Panel(
                drawn[1],
                "Step 2: jitter",
                f"Directions spread about the mirrored one; {count} of {len(below)} point below the floor.",
                "2. Jitter it. Some fall below the surface.",
            ),
            Panel(
                drawn[2],
                "Step 3: keep above",
                "The directions below the floor are mirrored in it and point upwards.",
                "3. Those are mirrored back above it.",
            ),
            Panel(
                drawn[3],
                "Step 4: the mean",
                "All directions point upwards; each is one sample.",
                "4. Follow them; the mean is the blur.",
            ),
        ),
    )


def jitters() -> Figure:
    """Square, ball and Phong's lobe in section, each with directions of the course's function."""
    # In the plane of x and z the square of the basis of Duff et al. is seen exactly from its edge.
    direction = np.array([0.5, 0.0, math.sqrt(0.75)])
    side, radius, exponent = 0.6, 0.3, 20.0
    rng = np.random.default_rng(8)
    many = np.repeat(direction[:, None], 300, axis=1)
    panels = []
    for name, found in (
        ("square", glossy.jitter_on_plane(many, side, rng.random((2, 300)))),
        ("ball", glossy.jitter_in_ball(many, radius, rng.random((3, 300)))),
        ("lobe", glossy.sample_phong_lobe(many, exponent, rng.random((2, 300)))),
    ):
        near = found[:, np.abs(found[1]) < (1 if name == "square" else 0.12)][[0, 2], :14]
        canvas = Canvas(172, 160, (-0.55, 1.15, -0.15, 1.4), 3)
        d = direction[[0, 2]]
        across = d[::-1] * (1, -1)
        if name == "square":
            canvas.line(d - across * side / 2, d + across * side / 2, "ink")
            canvas.length(d - across * side / 2, d + across * side / 2, "", 9)
            canvas.label((0.0, 1.22), "roughness", "c")
            canvas.right_angle(d, (0, 0), d + across, 7)
        elif name == "ball":
            canvas.circle(d, radius, "wash ink")
            canvas.line(d, d + radius * turned(10), "ink thin")
            canvas.label((0.0, 1.22), "glossiness", "c")
        else:
            canvas.path(_polar(d, exponent, 1), "wash ink", closed=True)
            for degrees in (60 + 90, 60 - 90):
                canvas.line((0, 0), turned(degrees, 0.3), "faint dashed")
        for f in near.T:
            canvas.line((0, 0), f / (f @ d) if name == "square" else f, "accent thin")
        canvas.arrow((0, 0), d)
        canvas.label(0.5 * d, "$d$", "w", 16)
        words = {
            "square": "a square of side roughness",
            "ball": "a ball of radius glossiness",
            "lobe": f"Phong's lobe, here $cos^{{{exponent:.0f}}}α$",
        }[name]
        panels.append(
            Panel(
                canvas,
                f"Jitter by a {name}",
                f"A direction with {words.replace('$', '')} about it, and jittered directions.",
                words[0].upper() + words[1:],
            )
        )
    return Figure(
        "Three ways to jitter a direction $d$, in section. The thin lines are directions that the functions return.",
        tuple(panels),
    )


def _polar(direction: np.ndarray, exponent: float, length: float) -> np.ndarray:
    """The outline of a lobe: in each direction as long as its cosine's power."""
    turn = np.linspace(-np.pi / 2, np.pi / 2, 181)
    far = length * np.cos(turn) ** exponent
    axis = math.atan2(direction[1], direction[0])
    return far * columns([(math.cos(axis + t), math.sin(axis + t)) for t in turn])


FIGURES = {"lobe": lobe, "steps": steps, "jitters": jitters}
