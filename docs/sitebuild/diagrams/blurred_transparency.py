"""Figures of blurred transparency: rays at a boundary, the steps, how much is reflected."""

import math

import numpy as np

from sitebuild.diagrams.canvas import Canvas, turned
from sitebuild.diagrams.figure import Figure, Panel
from solutions import blurred_transparency

GLASS = 1.5


def bent(degrees: float, eta: float) -> tuple[np.ndarray, np.ndarray, bool, float]:
    """A ray that comes down at so many degrees to the normal: itself, refracted, whether totally reflected, and R."""
    direction = np.array([*turned(degrees - 90), 0.0])[:, None]
    normal = np.array([[0.0], [1.0], [0.0]])
    found, total = blurred_transparency.refract(direction, normal, eta)
    share = blurred_transparency.fresnel(np.array([math.cos(math.radians(degrees))]), eta)
    return direction[:2, 0], found[:2, 0], bool(total[0]), float(share[0])


def snell() -> Figure:
    """Into glass, out of it, and not out of it."""
    panels = []
    for degrees, eta, title, glass_below in (
        (50, 1 / GLASS, "Into glass: towards the normal", True),
        (28, GLASS, "Out of it: away from the normal", False),
        (55, GLASS, "Too flat: total reflection", False),
    ):
        incoming, outgoing, total, share = bent(degrees, eta)
        canvas = Canvas(172, 172, (-1, 1, -1, 1), 3)
        canvas.rectangle((-1, -1 if glass_below else 0), (1, 0 if glass_below else 1), "wash")
        canvas.line((-1, 0), (1, 0))
        canvas.line((0, -0.95), (0, 0.95), "faint dashed")
        canvas.arrow(-0.95 * incoming, (0, 0))
        canvas.angle((0, 0), -incoming, (0, 1), "$θ_i$", 26, gap=11)
        canvas.arrow((0, 0), 0.95 * outgoing, "accent")
        if not total:
            mirrored = incoming * (1, -1)
            canvas.arrow((0, 0), 0.6 * mirrored, "faint")
            canvas.label(0.6 * mirrored, f"{share:.0%}".replace("%", " %"), "n", 4)
            canvas.angle((0, 0), outgoing, (0, -1), "$θ_t$", 26, gap=11)
        canvas.label((0.72, -0.88 if glass_below else 0.86), "glass", "c")
        canvas.label((0.74, 0.88 if glass_below else -0.86), "air", "c")
        out = math.degrees(math.asin(min(1, eta * math.sin(math.radians(degrees)))))
        tells = (
            "all of it is reflected"
            if total
            else f"it goes on at {out:.0f} degrees; {share:.0%} is reflected"
        )
        panels.append(
            Panel(
                canvas,
                title,
                f"A ray comes down at {degrees} degrees to the normal; {tells}.",
                title + ".",
            )
        )
    return Figure(
        f"A ray at the surface of glass with index {GLASS}. The faint ray is the part that is reflected.",
        tuple(panels),
    )


def steps() -> Figure:
    """Bent, jittered, kept on the far side, weighed."""
    # Out of glass at nearly the critical angle, so that some come back.
    degrees, roughness = 39, 1.6
    incoming, clear, _, share = bent(degrees, GLASS)
    count = 400
    directions = np.repeat(np.array([[clear[0]], [clear[1]], [0.0]]), count, axis=1)
    normals = np.repeat(np.array([[0.0], [1.0], [0.0]]), count, axis=1)
    u = np.random.default_rng(2).random((2, count))
    kept = blurred_transparency.jitter_refraction(directions, normals, roughness, u)
    # The same numbers with a normal against which nothing has to be kept: what the square alone makes.
    raw = blurred_transparency.jitter_refraction(directions, -directions, roughness, u)
    near = np.flatnonzero(np.abs(raw[2]) < 0.12)
    near = near[np.argsort(raw[1][near])][:: max(1, len(near) // 8)]
    kept, raw = kept[:2, near], raw[:2, near]
    back = raw[1] > 0
    drawn = []
    for step in (1, 2, 3, 4):
        canvas = Canvas(172, 150, (-1.1, 1.2, -1.05, 0.95), 3)
        canvas.rectangle((-1.1, 0), (1.2, 0.95), "wash")
        canvas.line((-1.1, 0), (1.2, 0))
        canvas.arrow(-1.1 * incoming, (0, 0), "ink" if step in (1, 4) else "faint")
        if step == 1:
            canvas.line((0, -0.9), (0, 0.9), "faint dashed")
            canvas.arrow((0, 0), clear, "accent")
        if step == 2:
            canvas.arrow((0, 0), clear, "faint")
            for d, came_back in zip(raw.T, back, strict=True):
                canvas.arrow((0, 0), d, "ink dashed" if came_back else "accent", 5)
        if step == 3:
            for d, old, came_back in zip(kept.T, raw.T, back, strict=True):
                canvas.arrow((0, 0), d, "accent" if came_back else "faint", 5)
                if came_back:
                    canvas.line((0, 0), old, "ink dashed")
                    canvas.line(old, d, "faint dashed")
        if step == 4:
            for d in kept.T:
                canvas.arrow((0, 0), d, "accent", 5)
            mirrored = incoming * (1, -1)
            canvas.arrow((0, 0), 0.9 * mirrored, "ink")
            canvas.label(0.9 * mirrored, "$R$", "e", 5)
            canvas.label((-0.55, -0.5), "$1 - R$", "c")
        drawn.append(canvas)
    return Figure(
        f"A ray that leaves glass at {degrees} degrees, through a very rough surface. Here $R$ = {share:.2f}.",
        (
            Panel(
                drawn[0],
                "Step 1: bend",
                "A ray comes down through glass and is bent away from the normal.",
                "1. Bend by Snell's law.",
            ),
            Panel(
                drawn[1],
                "Step 2: jitter",
                f"Directions about the bent one; {int(back.sum())} of {len(back)} point back into the glass.",
                "2. Jitter. Some come back.",
            ),
            Panel(
                drawn[2],
                "Step 3: the far side",
                "The directions that point back are mirrored in the surface.",
                "3. Mirror those to the far side.",
            ),
            Panel(
                drawn[3],
                "Step 4: weigh",
                "One mirrored ray in the glass, weight R; the jittered ones outside, weight 1 - R together.",
                "4. Weigh the two ways by $R$.",
            ),
        ),
    )


def fresnel() -> Figure:
    """Reflectance over the angle, into glass and out of it."""
    degrees = np.linspace(0, 90, 361)
    cosine = np.cos(np.radians(degrees))
    critical = math.degrees(math.asin(1 / GLASS))
    panels = []
    for eta, words in ((1 / GLASS, "Into glass."), (GLASS, "Out of glass.")):
        share = blurred_transparency.fresnel(cosine, eta)
        canvas = Canvas(172, 165, (-16, 97, -0.2, 1.12), 3, stretch=True)
        canvas.path(
            np.concatenate(([degrees, share], [[90, 0], [0, 0]]), axis=1), "wash", closed=True
        )
        canvas.path((degrees, share), "accent")
        canvas.line((0, 0), (92, 0))
        canvas.line((0, 0), (0, 1.05))
        for angle in (0, 90):
            canvas.label((angle, 0), f"{angle}°", "s", 5)
        canvas.label((0, 1), "1", "w", 4)
        canvas.label((4, 1.0), "$R$", "e", 2)
        if eta > 1:
            canvas.line((critical, 0), (critical, 1), "faint dashed")
            canvas.label((critical, 0), f"{critical:.0f}°", "s", 5)
        panels.append(
            Panel(
                canvas,
                f"Reflectance, {words.lower()}",
                "The reflectance over the angle to the normal: 0.04 for a long way, then it climbs to 1"
                + (
                    f" at {critical:.0f} degrees, and stays there."
                    if eta > 1
                    else " at 90 degrees."
                ),
                words,
            )
        )
    return Figure(
        f"Fresnel's reflectance over $θ_i$, for an index of {GLASS}. Straight on both are 0.04. Out "
        "of glass all is reflected from "
        f"the critical angle of {critical:.0f} degrees on.",
        tuple(panels),
    )


FIGURES = {"snell": snell, "steps": steps, "fresnel": fresnel}
