"""Figures of the cube map: a direction and its face, the six faces unfolded, the steps, edges and corners."""

import numpy as np

from sitebuild.diagrams.canvas import Canvas, moved
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.texels import draw_texels, draw_weights, first_of_four
from sitebuild.diagrams.view import View
from solutions import cube_map

NAMES = ("+x", "\N{MINUS SIGN}x", "+y", "\N{MINUS SIGN}y", "+z", "\N{MINUS SIGN}z")
NET = {2: (1, 0), 1: (0, 1), 4: (1, 1), 0: (2, 1), 5: (3, 1), 3: (1, 2)}
"""Where faces lie when the cube is unfolded: column and row."""

DIRECTION = np.array([0.95, 0.28, -0.42])


def axes_of(face: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A face's own axis, and the axes along which u and v grow, found by asking `face_and_uv`."""
    own = np.zeros(3)
    own[face // 2] = 1 - 2 * (face % 2)
    places = np.stack([own, *(own + 0.1 * step for step in np.eye(3))], axis=1)
    _, u, v = cube_map.face_and_uv(places)
    return own, *(np.round((w[1:] - w[0]) / 0.05) * (own == 0) for w in (u, v))


def name_of(axis: np.ndarray) -> str:
    """What an axis is called."""
    row = int(np.abs(axis).argmax())
    return NAMES[2 * row + (axis[row] < 0)]


def cube() -> Figure:
    """A direction leaves the cube through one face."""
    view = View(38, 24, up=1)
    canvas = Canvas(350, 265, (-1.95, 1.95, -1.75, 1.75), 3)
    own, along, down = axes_of(0)
    face = [own - along - down, own + along - down, own + along + down, own - along + down]
    canvas.path(view(np.stack(face, axis=1)), "wash", closed=True)
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    hidden = corners[view.depth(corners.T).argmin()]
    for a in corners:
        for b in corners:
            if (a < b).sum() == 1 and (a > b).sum() == 0:
                back = (a == hidden).all() or (b == hidden).all()
                canvas.line(view(a), view(b), "faint dashed" if back else "ink")
    corner = face[0]
    for axis, name, side in ((along, "$u$", "nw"), (down, "$v$", "w")):
        canvas.arrow(view(corner), view(corner + 0.9 * axis), "ink")
        canvas.label(view(corner + 0.85 * axis), name, side, 6)
    place = DIRECTION / np.abs(DIRECTION).max()
    canvas.arrow(view(np.zeros(3)), view(place * 1.35), "accent")
    canvas.dot(view(np.zeros(3)))
    canvas.dot(view(place), "accent", 3.6)
    for axis, name in zip(np.eye(3), ("x", "y", "z"), strict=True):
        canvas.arrow(view(np.zeros(3)), view(0.5 * axis), "faint", 5)
        canvas.label(view(0.5 * axis), f"${name}$", {"x": "se", "y": "n", "z": "sw"}[name], 4)
    canvas.label(view(place * 1.35), "direction", "e", 4, "accent")
    canvas.label(view(own + 0.6 * down), "face $+x$", "c")
    return Figure(
        "A direction leaves the cube through the face of its largest component. $u$ and $v$ tell the "
        "place on the face.",
        (
            Panel(
                canvas,
                "A direction through a cube",
                "A cube around the origin. An arrow from the middle leaves through the face +x on "
                "the right; along that "
                "face's upper edge goes u, away from the viewer, and down its near edge goes v.",
            ),
        ),
    )


def unfolded() -> Figure:
    """The six faces in one plane, each with its two axes."""
    canvas = Canvas(350, 266, (0, 4, 3, 0), 2)
    for face, (column, row) in NET.items():
        _, along, down = axes_of(face)
        lo = np.array([column, row], float)
        canvas.rectangle(lo, lo + 1, "wash ink" if face == 4 else "ink")
        start = lo + 0.14
        canvas.arrow(start, moved(start, 0.34, 0), "accent", 6)
        canvas.arrow(start, moved(start, 0, 0.34), "accent", 6)
        canvas.label(moved(start, 0.34, 0), f"$u$: ${name_of(along)}$", "e", 3)
        canvas.label(moved(start, 0, 0.34), f"$v$: ${name_of(down)}$", "e", 5)
        canvas.label(moved(lo, 0.72, 0.68), f"${NAMES[face]}$", "c")
        canvas.label(moved(lo, 0.7, 0.88), f"face {face}", "c", kind="faint")
    return Figure(
        "The cube unfolded, seen from outside. Arrows show where $u$ and $v$ grow, and the axis that this is in space. "
        "Faces that touch here show the same edge: $u$ of $-x$ grows towards $+z$, and to its right lies $+z$.",
        (
            Panel(
                canvas,
                "The six faces unfolded",
                "A cross of six squares: -x, +z, +x and -z in a row, +y above and -y below +z. In "
                "each square u grows to "
                "the right and v down. "
                + " ".join(
                    f"{NAMES[face]}: u to {name_of(axes_of(face)[1])}, v to {name_of(axes_of(face)[2])}."
                    for face in range(6)
                ),
            ),
        ),
    )


def steps() -> Figure:
    """One direction on its way to four weights."""
    size = 4
    face, (u,), (v,) = cube_map.face_and_uv(DIRECTION[:, None])
    place = np.array([u, v]) * size

    bars = Canvas(172, 172, (-0.3, 3.3, -0.9, 1.3), 4, stretch=True)
    bars.line((0, 0), (3, 0))
    for k, (name, value) in enumerate(zip("xyz", DIRECTION, strict=True)):
        largest = k == np.abs(DIRECTION).argmax()
        bars.rectangle((k + 0.2, 0), (k + 0.8, value), "wash accent" if largest else "shade ink")
        bars.label((k + 0.5, value), f"${name}$", "n" if value > 0 else "s", 4)

    square = Canvas(172, 172, (-1, 1, 1, -1), 17)
    square.rectangle((-1, -1), (1, 1), "wash ink")
    square.line((-1, 0), (1, 0), "faint")
    square.line((0, -1), (0, 1), "faint")
    spot = 2 * np.array([u, v]) - 1
    square.line((spot[0], -1), spot, "accent")
    square.line((-1, spot[1]), spot, "accent")
    square.dot(spot, "accent", 3.6)
    square.label((spot[0], -1), "$u$", "n", 2)
    square.label((-1, spot[1]), "$v$", "w", 4)
    square.label((-1, -1), "$0$", "n", 2)
    square.label((1, -1), "$1$", "n", 2)
    square.label((-1, 1), "$1$", "w", 4)

    texels = Canvas(172, 172, (0, size, size, 0), 17)
    draw_texels(texels, size, place)
    for x, words in ((0.5, "½"), (1.5, "1½"), (2.5, "2½"), (3.5, "3½")):
        texels.label((x, 0), words, "n", 3)

    low = first_of_four(place)
    near = Canvas(172, 172, (low[0] - 0.1, low[0] + 2.1, low[1] + 2.1, low[1] - 0.1), 4)
    draw_weights(near, place)
    near.dot(
        np.stack(np.meshgrid(moved(low[0], 0.5, 1.5), moved(low[1], 0.5, 1.5))).reshape(2, -1),
        "ink",
        2,
    )
    return Figure(
        f"One direction, {tuple(float(d) for d in DIRECTION)}, on a face of 4 by 4 texels.",
        (
            Panel(
                bars,
                "Step 1: the largest component",
                "Bars for the three components; that of x is the longest, and positive.",
                f"1. $x$ is the largest, so face ${NAMES[int(face[0])]}$.",
            ),
            Panel(
                square,
                "Step 2: the place on the face",
                f"A square from 0 to 1 with a point at u = {u:.2f}, v = {v:.2f}.",
                f"2. Divide: $u$ = {u:.2f}, $v$ = {v:.2f}.",
            ),
            Panel(
                texels,
                "Step 3: texels",
                f"The same point on a grid of 4 by 4 texels, at column {place[0]:.2f} and row "
                f"{place[1]:.2f}; texels have "
                "their centres at halves.",
                f"3. In texels: {place[0]:.2f} and {place[1]:.2f}.",
            ),
            Panel(
                near,
                "Step 4: four weights",
                "A square as large as a texel about the point overlaps four texels; the overlaps are the weights.",
                "4. Weights are overlaps. They sum to 1.",
            ),
        ),
    )


def seams() -> Figure:
    """Texels that meet at an edge of the cube, and at a corner."""
    size = 4
    edge = Canvas(172, 160, (-2.3, 2.3, 2.15, -2.15), 3)
    edge.rectangle((-2, -1.5), (0, 1.5), "ink")
    edge.rectangle((0, -1.5), (2, 1.5), "ink")
    edge.grid((-2, -1.5), (2, 1.5), 4, 3)
    edge.line((0, -1.75), (0, 1.75), "accent")
    place = np.array([-0.28, 0.15])
    edge.rectangle(place - 0.5, place + 0.5, "wash ink")
    edge.dot(place, "accent", 3.6)
    edge.label((-1, -1.5), "face", "n", 4)
    edge.label((1, -1.5), "neighbour", "n", 4)

    view = View(45, 35.26, up=1)
    corner = Canvas(172, 160, (-1.35, 1.35, -1.3, 1.25), 3)
    middle = view(np.ones(3))
    for k in range(3):
        a, b = (np.eye(3)[(k + n) % 3] * 2 / size for n in (1, 2))
        texel = [np.ones(3), np.ones(3) - a, np.ones(3) - a - b, np.ones(3) - b]
        corner.path(view(np.stack(texel, axis=1)) - middle[:, None], "wash", closed=True)
        for n in range(4):
            for first, second in ((a, b), (b, a)):
                line = np.ones(3) - n * first
                corner.line(
                    view(line) - middle,
                    view(line - 3 * second) - middle,
                    "faint" if n else "accent",
                )
        corner.dot(view(np.ones(3) - (a + b) / 2) - middle, "ink", 2.6)
    return Figure(
        "Left: two texels of the four lie on the neighbouring face. Right: at a corner of the cube "
        "there are only three.",
        (
            Panel(
                edge,
                "An edge of the cube",
                "Two faces side by side. A texel-sized square about a place next to the edge overlaps two texels of "
                "each.",
                "Beyond an edge: the texel at the same place along it.",
            ),
            Panel(
                corner,
                "A corner of the cube",
                "A cube seen towards one of its corners, where one texel of each of three faces meet.",
                "Beyond a corner: nothing. Three texels meet.",
            ),
        ),
    )


FIGURES = {"cube": cube, "unfolded": unfolded, "steps": steps, "seams": seams}
