"""A lobe about the mirrored direction, directions sampled from it, and the floor that mirrors those below it."""

import math

import numpy as np

from sitebuild.diagrams.canvas import turned
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.movable import Handle, Model, Movable, Movement, Value, Values
from solutions import glossy, importance_sampling

COUNT = 9
REACH, LONG = 1.5, 3.0
"""Lengths of the lobe's middle and of the sampled directions."""


def model(values: Values) -> Model:
    """Degrees: `angle` of the ray above the floor, `half` from the middle to where the lobe is half as dense."""
    angle, half = values["angle"], values["half"]
    exponent = math.log(0.5) / math.log(math.cos(math.radians(half)))
    mirrored = turned(angle)
    axis = np.array([*mirrored, 0.0])
    # Of the lobe's directions those in the plane of the drawing, by turns on both sides.
    side = math.atan2(-mirrored[0], mirrored[1]) / (2 * math.pi)
    number = np.arange(COUNT)
    u = np.stack(((number + 0.5) / COUNT, (side + 0.5 * (number % 2)) % 1))
    many = np.repeat(axis[:, None], COUNT, axis=1)
    sampled = glossy.sample_phong_lobe(many, exponent, u)
    up = np.repeat(np.array([[0.0], [1.0], [0.0]]), COUNT, axis=1)
    kept = glossy.keep_above(sampled, up)
    degrees = np.linspace(-90, 90, 121)
    middle = importance_sampling.phong_lobe_pdf(np.ones(1), exponent)
    density = importance_sampling.phong_lobe_pdf(np.cos(np.radians(degrees)), exponent)
    around = np.radians(angle + degrees)
    return Model(
        {
            "floor": np.zeros(2),
            "source": 2.4 * mirrored * (-1, 1),
            "mirrored": 1.75 * mirrored,
            "shape": REACH * density / middle * np.stack((np.cos(around), np.sin(around))),
            "side": turned(angle + half, 2.1),
            "low": turned(angle - half, 2.1),
            "arc": 2.1
            * np.stack([turned(angle + t) for t in np.linspace(-half, half, 25)], axis=1),
            "directions": LONG * kept[:2],
        },
        {
            "exponent": exponent,
            "half": half,
            "middle": float(middle[0]),
            "below": float((sampled[1] < 0).sum()),
            "steepest": float(np.degrees(np.arccos(kept[1].max()))),
            "flattest": float(np.degrees(np.arccos(kept[1].min()))),
        },
    )


MOVEMENT = Movement(
    "glossy/lobe",
    model,
    {"angle": Value(8, 88, 38, 1), "half": Value(3, 60, 15, 1)},
    (
        Handle("Ray", "source", ("angle",), "{angle:.0f} degrees above the floor"),
        Handle(
            "Side of the lobe", "side", ("half",), "{half:.0f} degrees, exponent {exponent:.1f}"
        ),
    ),
    "Exponent {exponent:.1f}: half as dense as in the middle, where the density is {middle:.3f} per steradian, at "
    f"{{half:.1f}} degrees to the side. Of {COUNT} sampled directions, {{below:.0f}} pointed below the floor and were "
    "mirrored; they leave at {steepest:.1f} to {flattest:.1f} degrees from the normal.",
)


def lobe() -> Figure:
    """A lobe over a floor, and how wide its rays spread."""
    rest = model(MOVEMENT.start)
    canvas = Movable(rest, 350, 205, (-2.5, 3.5, -0.3, 3.15), 3)
    canvas.lines("floor", "directions", "faint")
    canvas.path("shape", "wash accent", closed=True)
    canvas.line("floor", "low", "faint dashed")
    canvas.line("floor", "side", "faint dashed")
    canvas.path("arc", "ink")
    canvas.arrow("source", "floor")
    canvas.arrow("floor", "mirrored")
    canvas.line((0, 0), (0, 2.1), "faint")
    canvas.surface((-2.4, 0), (3.4, 0))
    canvas.label((0, 2.1), "normal", "n", 3)
    canvas.label("source", "ray", "n", 9)
    return Figure(
        "A lobe. The length of the filled shape in a direction is the density $p(ω)$ there; at the dashed lines it is "
        "half of that in the middle. The thin lines are directions that sample_phong_lobe chose and keep_above "
        "mirrored: they spread with distance.",
        (
            Panel(
                canvas,
                "A lobe about the mirrored direction",
                "A ray falls on a floor. Around the mirrored direction lies a drop-shaped lobe, and nine directions "
                "spread from its foot.",
            ),
        ),
        MOVEMENT,
    )
