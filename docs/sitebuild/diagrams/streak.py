"""What the film keeps of a ball that moves: the ball's places while the shutter is open, and their mean."""

import numpy as np

from sitebuild.diagrams.figure import Figure, Panel
from sitebuild.diagrams.movable import Handle, Model, Movable, Movement, Value, Values
from solutions import motion_blur

OPEN, CLOSE = -0.5, 0.5
SPEED, RADIUS = 1.6, 0.3

FRAMES, TIMES = 5, 20
"""Moments at which the ball is drawn, and those that are counted."""

HIGH = 0.6
BOTTOM, TALL = -0.5, 0.8
ACROSS = np.linspace(-1.7, 1.7, 341)


def covered(
    x: np.ndarray, speed: float = SPEED, first: float = OPEN, last: float = CLOSE
) -> np.ndarray:
    """For what share of the exposure the ball's middle line covers a place of the picture."""
    enters = np.clip((x - RADIUS) / speed, first, last)
    leaves = np.clip((x + RADIUS) / speed, first, last)
    return (leaves - enters) / (last - first)


def model(values: Values) -> Model:
    """The ball moves to the right with this speed; it is in the middle at time 0."""
    first, last, speed, place = (values[name] for name in ("open", "close", "speed", "place"))
    velocity = np.array([speed, 0.0, 0.0])

    def places(count: int) -> np.ndarray:
        u = (np.arange(count) + 0.5) / count
        times = motion_blur.shutter_times(first, last, u)
        return motion_blur.displacement(velocity, times)[0]

    x = places(FRAMES)
    begin, end = motion_blur.displacement(velocity, np.array([first, last]))[0]
    share = covered(ACROSS, speed, first, last)
    here = float(covered(np.array([place]), speed, first, last)[0])
    hits = (np.abs(places(TIMES) - place) <= RADIUS).sum()
    return Model(
        {
            "begin": np.array([begin, HIGH]),
            "end": np.array([end, HIGH]),
            **{f"frame{k}": np.array([x[k], HIGH]) for k in range(FRAMES)},
            "start": np.array([0.0, 0.16]),
            "tip": np.array([speed / 3, 0.16]),
            "curve": np.stack((ACROSS, BOTTOM + TALL * share)),
            "area": np.stack(
                (
                    np.append(ACROSS, ACROSS[[-1, 0]]),
                    np.append(BOTTOM + TALL * share, (BOTTOM, BOTTOM)),
                )
            ),
            "place": np.array([place, BOTTOM]),
            "above": np.array([place, HIGH]),
            "kept": np.array([place, BOTTOM + TALL * here]),
        },
        {
            "streak": float(end - begin) + 2 * RADIUS,
            "most": float(covered(np.array([(begin + end) / 2]), speed, first, last)[0]),
            "here": here,
            "hits": float(hits),
            "time": float(last - first),
        },
    )


MOVEMENT = Movement(
    "motion_blur/film",
    model,
    {
        "open": Value(-0.75, -0.05, OPEN, 0.05),
        "close": Value(0.05, 0.75, CLOSE, 0.05),
        "speed": Value(0.2, 1.8, SPEED, 0.05),
        "place": Value(-1.6, 1.6, 0.55, 0.05),
    },
    (
        Handle(
            "First frame: the shutter opens",
            "begin",
            ("open",),
            "{open:.2f} s; open for {time:.2f} s",
        ),
        Handle(
            "Last frame: the shutter closes",
            "end",
            ("close",),
            "{close:.2f} s; open for {time:.2f} s",
        ),
        Handle("Velocity", "tip", ("speed",), "{speed:.2f} per second"),
        Handle(
            "Place in the picture",
            "place",
            ("place",),
            "{place:.2f} to the right; covered for {here:.2f}",
        ),
    ),
    "The shutter is open for {time:.2f} s, and the streak is {streak:.3f} long. No place keeps more than {most:.3f} of "
    f"the ball's colour. The marked one keeps {{here:.3f}}: at {{hits:.0f}} of {TIMES} times the ball is there.",
)


def film() -> Figure:
    """A ball while the shutter is open, and the mean over all that time."""
    rest = model(MOVEMENT.start)
    canvas = Movable(rest, 350, 190, (-1.78, 1.78, -0.76, 1.08), 3)
    for k in range(FRAMES):
        canvas.circle(f"frame{k}", RADIUS, "ink" if k == FRAMES // 2 else "faint")
    for name in ("begin", "end"):
        canvas.circle(name, RADIUS, "faint dashed")
    canvas.label("begin", "$t_0$", "nw", 10)
    canvas.label("end", "$t_1$", "ne", 10)
    canvas.arrow("start", "tip", "ink")
    canvas.label("start", "velocity", "w", 6)
    canvas.path("area", "wash", closed=True)
    canvas.path("curve", "accent")
    canvas.line((-1.7, BOTTOM), (1.7, BOTTOM))
    canvas.line("place", "above", "faint dashed")
    canvas.dot("kept", "accent", 3)
    canvas.label((-1.15, BOTTOM), "place in the picture", "s", 8)
    return Figure(
        "Above: the ball while the shutter is open, dashed when it opens at $t_0$ and closes at $t_1$, and five "
        "frames between. Below: for what share of that time it covers each place, and so how much of its colour the "
        "film keeps there.",
        (
            Panel(
                canvas,
                "A ball during the exposure",
                "Places of a ball that moves to the right. Below them a curve rises from 0, stays level, and falls to "
                "0: the streak.",
            ),
        ),
        MOVEMENT,
    )
