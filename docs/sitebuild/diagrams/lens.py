"""A real lens: the plane in focus is sharp on the film, and a point elsewhere spreads over a disk."""

import numpy as np

from sitebuild.diagrams.canvas import meeting
from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.movable import Handle, Model, Movable, Movement, Value, Values
from solutions import thin_lens

FOCAL = 1.3


def model(values: Values) -> Model:
    """The lens stands upright at 0, the film left of it, at the image of the plane in focus."""
    focus, depth, radius = values["focus"], values["depth"], values["radius"]
    film = thin_lens.image_distance(FOCAL, focus)
    image = thin_lens.image_distance(FOCAL, depth)
    circle = float(thin_lens.circle_of_confusion(np.array([depth]), radius, focus)[0])
    rims = {"top": np.array([0.0, radius]), "bottom": np.array([0.0, -radius])}
    screen = ((-film, 0.0), (-film, 1.0))
    # Of a point nearer than the focus the rays go on to the plane, of a farther one they pass it.
    past = max(focus, depth)
    points = {
        "focused": np.array([focus, 0.0]),
        "point": np.array([depth, 0.0]),
        "sharp": np.array([-film, 0.0]),
        "plane_top": np.array([focus, 1.3]),
        "plane_bottom": np.array([focus, -1.3]),
        "film_top": np.array([-film, 1.2]),
        "film_bottom": np.array([-film, -1.2]),
        "film_foot": np.array([-film, -1.3]),
        "lens_foot": np.array([0.0, -1.3]),
        "circle_top": np.array([focus, circle / 2]),
        "circle_bottom": np.array([focus, -circle / 2]),
        **rims,
    }
    for name, rim in rims.items():
        points[f"spot_{name}"] = meeting(rim, (-image, 0), *screen)
        points[f"past_{name}"] = np.array([past, rim[1] * (1 - past / depth)])
    spot = abs(float(points["spot_top"][1] - points["spot_bottom"][1]))
    return Model(
        points,
        {
            "film": film,
            "image": image,
            "spot": spot,
            "circle": circle,
            "focus": focus,
            "depth": depth,
        },
    )


MOVEMENT = Movement(
    "thin_lens/lens",
    model,
    {
        "focus": Value(2.8, 4.9, 4.0, 0.05),
        "depth": Value(1.5, 5.0, 2.4, 0.05),
        "radius": Value(0.0, 1.1, 1.0, 0.05),
    },
    (
        Handle("Rim of the lens", "top", ("radius",), "radius {radius:.2f}"),
        Handle("Point", "point", ("depth",), "depth {depth:.2f}; its circle is {circle:.2f} wide"),
        Handle("Plane in focus", "plane_top", ("focus",), "focus distance {focus:.2f}"),
    ),
    f"With a focal length of {FOCAL:g}, the plane at $d_o$ = {{focus:.2f}} is sharp on a film at $d_i$ = {{film:.3f}}. "
    "The rays of the point at {depth:.2f} would meet at {image:.3f}: on the film they are {spot:.3f} apart. Its "
    "circle of confusion, in the plane in focus, is {circle:.3f} wide.",
)


def lens() -> Figure:
    """One distance is sharp on the film, another is not."""
    rest = model(MOVEMENT.start)
    canvas = Movable(rest, 350, 170, (-2.75, 5.3, -1.75, 1.75), 4)
    turn = np.linspace(-1, 1, 41)
    bulge = 0.16 * (1 - turn**2)
    outline = np.concatenate(([bulge, turn * 1.15], [-bulge[::-1], turn[::-1] * 1.15]), axis=1)
    canvas.line((-2.6, 0), (5.2, 0), "faint thin")
    for side in ("top", "bottom"):
        canvas.line(f"past_{side}", side, "faint")
        canvas.line("point", side, "faint")
        canvas.line(side, f"spot_{side}", "faint")
        canvas.line("focused", side, "accent")
        canvas.line(side, "sharp", "accent")
    canvas.path(outline, "wash ink", closed=True)
    canvas.line("film_bottom", "film_top", "ink")
    canvas.line("spot_bottom", "spot_top", "ink thick")
    canvas.line("plane_bottom", "plane_top", "ink dashed")
    canvas.line("circle_bottom", "circle_top", "accent thick")
    canvas.dot("focused", "accent", 3.2)
    canvas.dot("point", "ink", 3.2)
    canvas.dot("sharp", "accent", 3.2)
    canvas.label("plane_top", "plane in focus", "n", 8)
    canvas.label("film_top", "film", "n", 3)
    canvas.label((0, 1.15), "lens", "n", 6)
    canvas.length("lens_foot", "plane_bottom", "$d_o$", -9, 3)
    canvas.length("film_foot", "lens_foot", "$d_i$", -9, 3)
    return Figure(
        "The rays of a point of the plane in focus meet again in one point of the film. Those of another point meet "
        "before or behind the film, and spread over a disk on it, here the black line. The coloured line is as wide "
        "as that disk looks in the plane in focus.",
        (
            Panel(
                canvas,
                "A lens with a film",
                "On the right a plane in focus with a point on it; its rays pass the lens's rim and meet on the film "
                "on the left. The rays of a second point nearer to the lens reach the film apart from each other.",
            ),
        ),
        MOVEMENT,
    )
