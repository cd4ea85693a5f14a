"""Figures of quasi-Monte Carlo: mirrored digits, three sets of points, the steps, shuffled patterns."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import quasi_monte_carlo


def digits() -> Figure:
    """Eight numbers in base 2, mirrored, and where they land."""
    canvas = Canvas(350, 250, (0, 350, 250, 0))
    numbers = np.arange(8)
    places = quasi_monte_carlo.radical_inverse(2, numbers)
    for x, words in ((22, "$i$"), (72, "base 2"), (142, "mirrored"), (262, "place in 0 to 1")):
        canvas.label((x, 14), words, "c")
    left, wide = 195, 136
    for i, place in zip(numbers, places, strict=True):
        y = 40 + 24 * i
        binary = f"{i:03b}"
        canvas.label((22, y), f"${i}$", "c")
        canvas.label((72, y), f"${binary}$", "c")
        canvas.arrow((98, y), (114, y), "faint", 5)
        canvas.label((142, y), f"$0.{binary[::-1]}$", "c")
        canvas.line((left, y), (left + wide, y), "faint")
        canvas.dot((left + wide * places[:i], np.full(i, y)), "faint", 2)
        canvas.dot((left + wide * place, y), "accent", 4)
    canvas.label((left, 40 + 24 * 7.6), "0", "s", 4)
    canvas.label((left + wide, 40 + 24 * 7.6), "1", "s", 4)
    return Figure(
        "Numbers 0 to 7 in base 2. The last digit becomes the first behind the point. Each new point falls into the "
        "middle of a largest gap of those before it.",
        (
            Panel(
                canvas,
                "Digits mirrored",
                "A table: "
                + ", ".join(
                    f"{i} is {i:03b}, mirrored 0.{f'{i:03b}'[::-1]}, that is {place:g}"
                    for i, place in zip(numbers, places, strict=True)
                )
                + ".",
            ),
        ),
    )


def points() -> Figure:
    """Random points, Halton's and Hammersley's."""
    count = 64
    panels = []
    for name, found in (
        ("Random", np.random.default_rng(4).random((2, count))),
        ("Halton", quasi_monte_carlo.halton(np.arange(count), 2)),
        ("Hammersley", quasi_monte_carlo.hammersley(count, 2)),
    ):
        canvas = Canvas(172, 172, (0, 1, 0, 1), 5)
        canvas.grid((0, 0), (1, 1), 8, 8)
        canvas.rectangle((0, 0), (1, 1))
        canvas.dot(found, "accent", 2.6)
        cells = {tuple(cell) for cell in np.minimum((found * 8).astype(int), 7).T.tolist()}
        empty = 64 - len(cells)
        panels.append(
            Panel(
                canvas,
                f"{name}: {empty} cells empty",
                f"{count} points on a grid of 8 by 8 cells; {empty} cells have none.",
                f"{name}: {empty} of 64 cells are empty.",
            )
        )
    return Figure(
        "64 points of each kind in a square, x the first coordinate. Hammersley's are in order along x.",
        tuple(panels),
    )


def steps() -> Figure:
    """One point of Halton's, its companions in Hammersley's set."""
    number = 6
    write, mirror = Canvas(172, 130), Canvas(172, 130)
    worth = {2: ("4", "2", "1", "½", "¼", "⅛"), 3: ("3", "1", "⅓", "⅑")}
    for k, (base, text) in enumerate(((2, "110"), (3, "20"))):
        _digits(write, 34 + 62 * k, text, worth[base][: len(text)], 62)
        write.label((8, 34 + 62 * k), f"base {base}", "e", 0)
        _digits(mirror, 34 + 62 * k, text[::-1], worth[base][len(text) :], 38)
        mirror.label((32, 34 + 62 * k), "$0.$", "w", 0)
        value = float(quasi_monte_carlo.radical_inverse(base, np.array([number]))[0])
        mirror.label((44 + 26 * len(text), 34 + 62 * k), f"= {value:.3f}", "e", 0)
    point = Canvas(172, 130, (-0.02, 1.02, -0.02, 1.02), 8)
    earlier = quasi_monte_carlo.halton(np.arange(number + 1), 2)
    point.rectangle((0, 0), (1, 1))
    point.dot(earlier[:, :number], "faint", 2.6)
    x, y = (float(v) for v in earlier[:, number])
    point.line((x, 0), (x, y), "accent thin")
    point.line((0, y), (x, y), "accent thin")
    point.dot((x, y), "accent", 4)
    count = 8
    hammersley = Canvas(172, 130, (-0.02, 1.02, -0.02, 1.02), 8)
    hammersley.grid((0, 0), (1, 1), count, 1)
    hammersley.rectangle((0, 0), (1, 1))
    every = quasi_monte_carlo.hammersley(count, 2)
    hammersley.dot(every, "faint", 2.6)
    hammersley.dot(every[:, number], "accent", 4)
    return Figure(
        "Point 6 on its way; the points before it are faint. In Hammersley's set of eight it has x = 6/8.",
        (
            Panel(
                write,
                "Step 1: digits",
                "6 is 110 in base 2, digits worth 4, 2 and 1, and 20 in base 3, digits worth 3 and 1.",
                "1. Write 6 in base 2 and in base 3.",
            ),
            Panel(
                mirror,
                "Step 2: mirrored",
                "The digits in turned order behind the point: 0.011 in base 2, 0.02 in base 3.",
                "2. Mirror the digits ...",
            ),
            Panel(
                point,
                "Halton's point 6",
                f"A square with the first seven points; point 6 is at {x:.3f} and {y:.3f}.",
                "... and that is Halton's point 6.",
            ),
            Panel(
                hammersley,
                "Step 3: Hammersley's set",
                "Eight points, one in each of eight columns.",
                "3. Eight in all: let x just count.",
            ),
        ),
    )


def _digits(canvas: Canvas, y: float, text: str, worth: tuple[str, ...], left: float) -> None:
    """A row of digits in boxes, with what each is worth above; the same accent for the last of a number."""
    for k, (digit, value) in enumerate(zip(text, worth, strict=True)):
        x = left + 26 * k
        first = value in ("1", "½", "⅓")
        canvas.rectangle((x, y - 11), (x + 22, y + 11), "wash accent" if first else "ink")
        canvas.label((x + 11, y), f"${digit}$", "c")
        canvas.label((x + 11, y - 12), value, "n", 3, "faint")


def chained() -> Figure:
    """Two patterns, each with a permutation of its own."""
    count = 8
    pattern = quasi_monte_carlo.hammersley(count, 2)
    ids = np.arange(count)
    lens, light = quasi_monte_carlo.chain((pattern, pattern), ids, np.random.default_rng(8))
    panels = []
    for found, words in (
        (pattern, "The pattern, numbered as it is made."),
        (lens, "For the lens: the ids of the rays."),
        (light, "For the light: other ids."),
    ):
        canvas = Canvas(172, 172, (-0.03, 1.1, -0.03, 1.1), 4)
        canvas.rectangle((0, 0), (1, 1))
        for i in ids:
            chosen = i == 3
            canvas.dot(found[:, i], "accent" if chosen else "ink", 4 if chosen else 2.8)
            canvas.label(found[:, i], str(i), "ne", 5, "accent" if chosen else "")
        panels.append(
            Panel(canvas, words, f"The same eight points; number 3 is marked. {words}", words)
        )
    return Figure(
        "Eight samples of a pixel. Lens and light use the same even points, but number them anew: "
        "ray 3 takes places that "
        "have nothing to do with each other.",
        tuple(panels),
    )


FIGURES = {"digits": digits, "points": points, "steps": steps, "chained": chained}
