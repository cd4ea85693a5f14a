"""Figures of microfacets: which normals there are and which are seen, and the steps to the mirrored ray."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas
from sitebuild.diagrams.figure import Figure, Panel
from solutions import microfacets

ALPHA = 0.7
VIEW = np.radians(68)
"""Angle of the view to the normal."""


def _view(size: float = 1.0) -> tuple[float, float]:
    return size * float(np.sin(VIEW)), size * float(np.cos(VIEW))


def _profile() -> np.ndarray:
    """Corners (2, n) of a landscape whose slopes are those of GGX, roughly."""
    u = np.random.default_rng(11).random(13)
    slope = ALPHA * np.sqrt(u / (1 - u)) * np.resize((1.0, -1.0), 13)
    step = 2 / 13
    height = np.concatenate(([0], np.cumsum(np.clip(slope, -1.6, 1.6) * step)))
    x = np.linspace(-1, 1, 14)
    return np.stack((x, height - height.mean() - (height[-1] - height[0]) * x / 2))


def _rose(visible: bool) -> np.ndarray:
    """Density of normals over their angle, in the plane of the view, (2, n) around the origin."""
    angle = np.linspace(-np.pi / 2, np.pi / 2, 181)
    wm = np.stack((np.sin(angle), 0 * angle, np.cos(angle)))
    x, z = _view()
    wo = np.repeat([[x], [0.0], [z]], angle.size, axis=1)
    size = microfacets.ggx(wm[2], ALPHA) * wm[2]
    if visible:
        size = microfacets.visible_normal_pdf(wo, wm, ALPHA)
    return wm[[0, 2]] * size / 0.75


def normals() -> Figure:
    """The landscape, all its normals, and those that are seen."""
    land = Canvas(172, 150, (-1.15, 1.15, -0.55, 1.0), 4)
    corners = _profile()
    x, z = _view()
    land.path(corners, "ink")
    for a, b in zip(corners.T[:-1], corners.T[1:], strict=True):
        step = b - a
        if -step[1] * x + step[0] * z > 0:
            land.line(a, b, "accent thick")
    land.arrow((0.1, 0.12), (0.1 + 0.9 * x, 0.12 + 0.9 * z), "ink")
    land.label((0.1 + 0.75 * x, 0.12 + 0.75 * z), "view", "n", 8)
    panels = [
        Panel(
            land,
            "A rough surface",
            "A zigzag line seen from the right at a flat angle; the slopes that look to the viewer are marked.",
            "Mirrors that look to the viewer",
        )
    ]
    for visible, word, about in (
        (False, "All normals", "A lobe about the vertical, the same to the left and to the right."),
        (
            True,
            "Visible normals",
            "A lobe that leans to the viewer and has nothing that looks away.",
        ),
    ):
        rose = Canvas(172, 150, (-0.72, 0.72, -0.12, 1.2), 4)
        rose.path(_rose(visible), "wash accent", closed=True)
        rose.line((-0.7, 0), (0.7, 0))
        rose.arrow((0, 0), _view(0.75))
        panels.append(Panel(rose, word, about, word))
    return Figure(
        "GGX normals of alpha 0.7, and a view at 68 degrees: the density of all normals by the area that they cover, "
        "and of those that the viewer sees, to one scale.",
        tuple(panels),
    )


def steps() -> Figure:
    """From the view to the mirrored ray."""
    x, z = _view()
    squeezed = np.array((ALPHA * x, z)) / np.hypot(ALPHA * x, z)
    turn = np.linspace(0, np.pi, 61)
    arc = np.stack((np.cos(turn), np.sin(turn)))

    first = Canvas(172, 120, (-1.2, 1.2, -0.2, 1.35), 4)
    first.path(arc, "faint")
    first.surface((-1.15, 0), (1.15, 0))
    first.arrow((0, 0), _view(1.2), "faint")
    first.arrow((0, 0), 1.2 * squeezed, "accent")

    seen = Canvas(172, 120, (-1.25, 1.25, -0.95, 1.1), 4)
    whole = np.linspace(0, 2 * np.pi, 121)
    outline = np.stack((np.cos(whole), np.sin(whole)))
    outline[1] = np.where(outline[1] < 0, squeezed[1] * outline[1], outline[1])
    seen.path(outline, "wash accent", closed=True)
    seen.path(np.stack((np.cos(whole), np.sin(whole))), "faint dashed")
    seen.line((-1, 0), (1, 0), "faint")
    u = np.random.default_rng(3).random((2, 60))
    a, b = np.sqrt(u[0]) * (np.cos(2 * np.pi * u[1]), np.sin(2 * np.pi * u[1]))
    s = (1 + squeezed[1]) / 2
    b = (1 - s) * np.sqrt(1 - a * a) + s * b
    seen.dot((a[1:], b[1:]), "ink", 1.6)
    seen.dot((0.0, 0.42), "accent", 3.5)

    # The point lies at that height above the view's axis, in the plane of view and normal.
    up = np.array((-squeezed[1], squeezed[0]))
    dome = 0.42 * up + np.sqrt(1 - 0.42**2) * squeezed
    back = np.array((ALPHA * dome[0], dome[1])) / np.hypot(ALPHA * dome[0], dome[1])
    third = Canvas(172, 120, (-1.2, 1.2, -0.2, 1.35), 4)
    third.path(arc, "faint")
    third.surface((-1.15, 0), (1.15, 0))
    third.arrow((0, 0), 1.2 * dome, "faint")
    third.arrow((0, 0), 1.2 * back, "accent")

    view = np.array((x, z))
    mirrored = 2 * (view @ back) * back - view
    last = Canvas(172, 120, (-1.2, 1.2, -0.2, 1.35), 4)
    last.surface((-1.15, 0), (1.15, 0))
    last.line(
        -0.22 * np.array((back[1], -back[0])), 0.22 * np.array((back[1], -back[0])), "accent thick"
    )
    last.arrow((0, 0), 0.8 * back, "faint")
    last.arrow((0, 0), 1.2 * view, "ink")
    last.arrow((0, 0), 1.2 * mirrored, "accent")
    return Figure(
        "The plane of view and normal; in the second picture the hemisphere as it is seen from the squeezed view.",
        (
            Panel(
                first,
                "Step 1: squeeze the view",
                "A hemisphere with the view, and the squeezed view, which is steeper.",
                "1. Squeeze the view.",
            ),
            Panel(
                seen,
                "Step 2: a point of what is seen",
                "Half a disk above and half an ellipse below, evenly filled with dots; one of them is chosen.",
                "2. Draw a point of what is seen.",
            ),
            Panel(
                third,
                "Step 3: back to the surface",
                "The normal of the hemisphere at that point, and the steeper one of the surface.",
                "3. Take its normal back.",
            ),
            Panel(
                last,
                "Step 4: mirror the ray",
                "A small mirror with its normal, the view, and the direction mirrored by it.",
                "4. Mirror the ray, and weigh it.",
            ),
        ),
    )


FIGURES = {"normals": normals, "steps": steps}
