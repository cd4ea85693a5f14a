"""Figures of the film: the curves of tone mapping and of sRGB, and the steps from radiance to codes."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import film


def _axes(right: str, up: str, window: tuple[float, float, float, float]) -> Canvas:
    canvas = Canvas(172, 150, window, 14, stretch=True)
    canvas.line((0, 0), (window[1], 0))
    canvas.line((0, 0), (0, window[3]))
    canvas.label((window[1] / 2, 0), right, "s", 2)
    canvas.label((0, window[3]), up, "e", 4)
    return canvas


def curves() -> Figure:
    """What tone mapping compresses, and where the codes go."""
    scaled = np.linspace(0, 4, 80)
    white = 4.0
    tone = _axes("$L$", "$D$", (0, 4, -0.14, 1.05))
    tone.path(np.stack((scaled, scaled * (1 + scaled / white**2) / (1 + scaled))), "accent")
    tone.path(np.array([[0, 1], [0, 1]]), "faint dashed")
    value = np.linspace(0, 1, 80)
    code = _axes("linear", "encoded", (0, 1, -0.14, 1.05))
    code.path(np.stack((value, film.encode_srgb(np.tile(value, (3, 1)))[0])), "accent")
    code.path(np.array([[0, 1], [0, 1]]), "faint dashed")
    return Figure(
        "Dark luminances keep their contrast, bright ones share what is left up to the white, here at 4. The curve of "
        "sRGB gives half of its codes to the darkest fifth.",
        (
            Panel(
                tone,
                "Tone mapping",
                "A curve that begins along the diagonal and bends to 1.",
                "Tone mapping",
            ),
            Panel(
                code,
                "The curve of sRGB",
                "A curve that is steep next to black.",
                "The curve of sRGB",
            ),
        ),
    )


def steps() -> Figure:
    """A wedge of brightness through the steps."""
    wedge = np.tile(10.0 ** np.linspace(-1.5, 1.5, 16), (3, 1))
    exposed = film.expose(wedge, -1.0)
    toned = film.photographic(exposed, 0.4, 1.0, 1.0)
    encoded = film.encode_srgb(toned)
    codes = film.quantize(encoded, np.full(encoded.shape, 0.5)) / 255
    panels = []
    for words, title, values in (
        ("1. Expose, and convert.", "Step 1: exposure", exposed),
        ("2. Map the luminances.", "Step 2: tone mapping", toned),
        ("3. Encode.", "Step 3: encoding", encoded),
        ("4. Round to codes.", "Step 4: codes", np.rint(codes * 8) / 8),
    ):
        canvas = Canvas(172, 100, (0, 16, 0, 1.05), 6, stretch=True)
        for k, value in enumerate(np.minimum(values[0], 1)):
            kind = "wash accent" if values[0][k] > 1 else "wash"
            canvas.rectangle((k, 0), (k + 1, float(value)), kind)
        canvas.line((0, 0), (16, 0))
        canvas.line((0, 1), (16, 1), "faint dashed")
        panels.append(
            Panel(canvas, title, f"Sixteen bars from dark to bright: {title.lower()}.", words)
        )
    return Figure(
        "A wedge whose light grows by a thousand, up to the screen's white (dashed). What is above it is cut off here. "
        "Codes are drawn as nine steps in place of 256.",
        tuple(panels),
    )


FIGURES = {"curves": curves, "steps": steps}
