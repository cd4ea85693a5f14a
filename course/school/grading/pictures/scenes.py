"""Small scenes in which one function's effect fills the picture; seeds move their parts."""

from typing import Any

import numpy as np

Scene = dict[str, Any]

SIZE = (48, 36)

AMBIENT = {"type": "ambient", "radiance": 1}
FLOOR = {"shape": "quad", "material": "floor", "width": 30, "depth": 30}


def edges(
    rng: np.random.Generator, sampler: str = "regular", samples: int = 16, **film: Any
) -> Scene:
    """Thin bright bars at slight angles: a picture that is nothing but edges."""
    angles = rng.uniform(-40, 40, 7)
    colors = rng.uniform(0.3, 1, (7, 3))
    return _scene(
        camera=_camera([0, 0, 10], [0, 0, 0], 30),
        film=film,
        sampler={"type": sampler, "samples": samples},
        materials=_bright("bar", colors),
        lights=[AMBIENT],
        objects=[
            _bar(f"bar {i}", [0.12 + 0.05 * i, 9, 0.1], [-3 + i, 0, 0.05 * i], float(angle))
            for i, angle in enumerate(angles)
        ],
    )


def shadows(rng: np.random.Generator, light: dict[str, Any], samples: int = 64) -> Scene:
    """Posts and a ball on a floor, whose shadows cross the picture."""
    x = rng.uniform(-0.25, 0.25, 4)
    return _scene(
        camera=_camera([0, 4.2, 7], [0.5, 0.3, 0.4], 27),
        sampler={"samples": samples},
        materials={"floor": {"color": 0.7}, "post": {"color": [0.7, 0.3, 0.2]}},
        lights=[light, {"type": "ambient", "radiance": 0.1}],
        objects=[
            FLOOR,
            *(
                _box("post", [0.3, 1.5, 0.3], [-1.8 + 1.2 * i + float(d), 0.75, -0.4])
                for i, d in enumerate(x)
            ),
            _ball("post", 0.4, [float(x[0]), 0.4, 1.4]),
        ],
    )


def area_light(rng: np.random.Generator, **keys: Any) -> dict[str, Any]:
    """A parallelogram, slightly above and behind the posts."""
    a, b = rng.uniform(0.6, 1.2, 2)
    corner = [-3 + float(rng.uniform(-0.3, 0.3)), 4, -2]
    return {
        "type": "rectangle",
        "corner": corner,
        "edge_u": [float(a), 0.3, 0],
        "edge_v": [0.2, 0, float(b)],
        "intensity": 30,
    } | keys


def ball_light(rng: np.random.Generator, method: str) -> dict[str, Any]:
    """A ball, slightly above and behind the posts."""
    center = [-3 + float(rng.uniform(-0.4, 0.4)), 4, -2]
    radius = float(rng.uniform(0.5, 0.8))
    shape = {"type": "sphere", "center": center, "radius": radius}
    return shape | {"intensity": 30, "samples": method}


def large_ball_light(rng: np.random.Generator, method: str) -> dict[str, Any]:
    """A ball so large that posts show how full it is within."""
    return ball_light(rng, method) | {"radius": float(rng.uniform(1.8, 2.2))}


def reflections(rng: np.random.Generator, gloss: dict[str, Any], samples: int = 64) -> Scene:
    """Bright posts over a glossy floor."""
    colors = rng.uniform(0.1, 1, (5, 3))
    places = [-2 + i + float(rng.uniform(-0.2, 0.2)) for i in range(5)]
    return _scene(
        camera=_camera([0, 2.4, 6], [0, 0.4, 0], 34),
        sampler={"samples": samples},
        materials={"floor": {"color": 0, "mirror": 0.9, "gloss": gloss}, **_bright("post", colors)},
        lights=[AMBIENT],
        objects=[
            FLOOR,
            *(_box(f"post {i}", [0.5, 1.4, 0.3], [x, 0.7, -0.6]) for i, x in enumerate(places)),
        ],
    )


def out_of_focus(rng: np.random.Generator) -> Scene:
    """Pieces before, in and behind the plane of focus, seen obliquely so that no axis is the lens's own."""
    colors = rng.uniform(0.2, 1, (6, 3))
    radius, focus = float(rng.uniform(0.2, 0.3)), float(rng.uniform(4, 5))
    lens = {"aperture_radius": radius, "focus_distance": focus}
    return _scene(
        camera=_camera([2.4, 1.6, 5.0], [0, 0.5, 0], 30, lens=lens),
        sampler={"samples": 16},
        materials=_bright("piece", colors),
        lights=[AMBIENT],
        objects=[
            _bar(
                f"piece {i}",
                [0.25, 1.3, 0.25],
                [-2.2 + 0.9 * i, 0.5, 2.6 - 1.3 * i],
                25.0 * (i % 3 - 1),
            )
            for i in range(6)
        ],
    )


def moving(rng: np.random.Generator, *, lit: bool = False) -> Scene:
    """A ball and a bar that cross the picture while the shutter is open; or a light and a camera that move."""
    speed, other = map(float, rng.uniform(0.8, 1.6, 2))
    light: dict[str, Any] = {"type": "point", "position": [-2, 4, 2], "intensity": 40}
    shutter = {"open": float(rng.uniform(-0.6, -0.3)), "close": float(rng.uniform(0.4, 0.8))}
    ball = _ball("bright", 0.5, [-0.6, 0.5, 0.6]) | _moving(speed, 0.1, 0.3)
    bar = _box("bright", [0.2, 1.6, 0.2], [0.9, 0.8, -0.8]) | _moving(-other, 0, 0.4)
    light |= _moving(speed, 0, 0.5) if lit else {}
    return _scene(
        camera=_camera([0, 2.6, 6], [0, 0.4, 0], 34, shutter=shutter),
        sampler={"samples": 64},
        materials={"floor": {"color": 0.4}, "bright": {"color": [0.9, 0.6, 0.2], "ambient": 0.3}},
        lights=[light, {"type": "ambient", "radiance": 0.3}],
        objects=[FLOOR, ball, bar],
    )


def surroundings(rng: np.random.Generator, lookup: str) -> Scene:
    """A mirror ball before a cube map of few large texels; ``cross.png`` beside the scene is made by the caller."""
    direction = rng.uniform(-1, 1, 3)
    eye = 5 * direction / np.linalg.norm(direction)
    return _scene(
        camera=_camera([float(x) for x in eye], [0, 0, 0], 75),
        environment={"type": "cube", "cross": "cross.png", "lookup": lookup},
        sampler={"samples": 16},
        integrator={"max_depth": 1},
        materials={"silver": {"color": 0, "mirror": 1}},
        objects=[_ball("silver", 1.9, [0, 0, 0])],
    )


SHEET = "sheet.obj"
PAINT = "paint.png"


def painted(rng: np.random.Generator, shape: str) -> Scene:
    """One textured thing that fills most of the picture; the caller makes the files beside the scene."""
    turn = [
        {"rotate": {"axis": axis, "degrees": float(rng.uniform(low, high))}}
        for axis, low, high in (([0, 1, 0], -180, 180), ([1, 0, 0], 40, 70), ([0, 0, 1], -30, 30))
    ]
    kinds: dict[str, dict[str, Any]] = {
        "quad": {"shape": "quad", "width": float(rng.uniform(4, 5)), "depth": 3.2},
        "sphere": {"shape": "sphere", "radius": 1.7, "segments": 128},
        "mesh": {"shape": "mesh", "file": SHEET, "shading": "flat"},
    }
    return _scene(
        camera=_camera([0, 0.6, 7], [0, 0, 0], 30),
        sampler={"samples": 16},
        materials={"painted": {"color": 1, "ambient": 1, "texture": {"image": PAINT}}},
        lights=[AMBIENT],
        objects=[kinds[shape] | {"material": "painted", "transform": turn}],
    )


def sheet(rng: np.random.Generator) -> str:
    """A crumpled sheet of 4 by 3 pieces, as OBJ; each is turned by itself and shows another part of a picture."""
    x, y = np.meshgrid(np.linspace(-2, 2, 5), np.linspace(-1.6, 1.6, 4))
    corners = np.stack((x, rng.uniform(-0.2, 0.2, x.shape), -y), axis=-1).reshape(-1, 3)
    lines = ["v {:.6f} {:.6f} {:.6f}".format(*corner) for corner in corners]
    around = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) / 3
    for piece in range(12):
        places = np.roll(around, int(rng.integers(4)), axis=0) + rng.random(2)
        lines += ["vt {:.6f} {:.6f}".format(*place) for place in places]
        row, column = divmod(piece, 4)
        first, place = 5 * row + column + 1, 4 * piece + 1
        four = zip((first, first + 1, first + 6, first + 5), range(place, place + 4), strict=True)
        lines.append("f " + " ".join(f"{corner}/{number}" for corner, number in four))
    return "\n".join(lines) + "\n"


def paint(rng: np.random.Generator) -> np.ndarray[Any, np.dtype[np.uint8]]:
    """A picture (6, 8, 3) of texels of all colours."""
    return rng.integers(30, 255, (6, 8, 3)).astype(np.uint8)


VIEWS: dict[str, tuple[list[float], list[float], int]] = {
    "above": ([0, 1.9, 4.6], [0, -0.2, 0], 40),
    "flat": ([0, 0.7, 5], [0, -0.1, 0], 36),
    "below": ([0, -2.2, 2.6], [0, 0.3, 0.3], 60),
}
"""Of the water: eye, where to, and vertical field of view."""


def under_water(rng: np.random.Generator, view: str, samples: int = 16) -> Scene:
    """Bright posts on either side of a frosted surface, which mirrors if it is seen flat, and from below farther out.

    One surface alone: no ray meets the glass twice, so what a function is asked doesn't depend on another's result.
    """
    colors = rng.uniform(0.1, 1, (6, 3))
    eye, look_at, fov = VIEWS[view]
    posts = [
        _box(
            f"post {i}",
            [0.5, 1.2, 0.5],
            [-2.2 + 0.9 * i + float(rng.uniform(-0.2, 0.2)), side * 0.9, -0.9 + 0.5 * (i % 3)],
        )
        for i in range(6)
        for side in (-1, 1)
    ]
    return _scene(
        camera=_camera(eye, look_at, fov),
        sampler={"samples": samples},
        materials={
            "water": {
                "color": 0,
                "dielectric": {
                    "refraction_index": float(rng.uniform(1.3, 1.5)),
                    "roughness": float(rng.uniform(0.3, 0.5)),
                },
            },
            **_bright("post", colors),
        },
        environment={"type": "constant", "radiance": [0.15, 0.2, 0.3]},
        lights=[AMBIENT],
        objects=[{"shape": "quad", "material": "water", "width": 60, "depth": 60}, *posts],
    )


def glowing(rng: np.random.Generator) -> Scene:
    """Matt balls on a matt floor in a room whose walls glow; paths go on once, and meet a wall or something dark."""
    walls: dict[str, tuple[list[float], list[float]]] = {
        "left": ([0.1, 8, 14], [-5, 4, 1]),
        "right": ([0.1, 8, 14], [5, 4, 1]),
        "back": ([10, 8, 0.1], [0, 4, -5]),
        "front": ([10, 8, 0.1], [0, 4, 8]),
        "top": ([10, 0.1, 14], [0, 8, 1]),
    }
    glow = rng.uniform(0.3, 1, (len(walls), 3))
    return _scene(
        camera=_camera([0, 3.2, 5], [0, 0.6, 0], 34),
        sampler={"samples": 64},
        integrator={"type": "path", "max_depth": 1, "roulette": None},
        materials={
            "matt": {"color": [0.9, 0.8, 0.7]},
            **{
                name: {"color": 0, "emission": _floats(color)}
                for name, color in zip(walls, glow, strict=True)
            },
        },
        objects=[
            {"shape": "quad", "material": "matt", "width": 10, "depth": 14},
            _ball("matt", 0.8, [float(rng.uniform(-0.5, 0)), 0.8, 0]),
            _ball("matt", 0.5, [1, 0.5, float(rng.uniform(0.4, 0.9))]),
            *(_box(name, size, at) for name, (size, at) in walls.items()),
        ],
    )


THRESHOLD = 0.3

OFFSETS = (
    (1, 0, 0),
    (-1, 1, 0),
    (0, -1, -1),
    (0, 1, -1),
    (0.6, 0.6, 0.6),
    (-0.6, -0.6, -0.6),
    (0.6, 0, -0.6),
    (1, -0.6, 0),
    (-1, -1, -1),
    (0, 0, 1),
)
"""What bars differ by from the colour behind them, in units around 1.3 thresholds."""


def cells(rng: np.random.Generator) -> Scene:
    """Slanted bars before a plain wall, each of another colour: some differ from it by too little for a division."""
    wall = 0.5
    colors = [
        wall + THRESHOLD * rng.uniform(1.25, 1.4) * np.array(o) for o in rng.permutation(OFFSETS)
    ]
    return _scene(
        camera=_camera([0, 0, 10], [0, 0, 0], 30),
        film={"subdivision": {"threshold": THRESHOLD, "depth": 3}},
        sampler={"samples": 1},
        environment={"type": "constant", "radiance": wall},
        materials=_bright("bar", colors),
        lights=[AMBIENT],
        objects=[
            _bar(
                f"bar {i}",
                [float(rng.uniform(0.1, 0.45)), 9, 0.1],
                [-3.2 + 0.7 * i, 0, 0.05 * i],
                float(rng.uniform(-40, 40)),
            )
            for i in range(len(colors))
        ],
    )


def everything(rng: np.random.Generator) -> Scene:
    """Every effect at once: lens, shutter, ball light, glossy floor, cube map and a Gaussian filter."""
    colors = rng.uniform(0.2, 0.9, (3, 3))
    ball = _ball("ball", 0.6, [-1.2, 0.6, 0.4]) | _moving(float(rng.uniform(0.8, 1.4)), 0, 0)
    return _scene(
        camera=_camera(
            [0.4, 2.2, 6],
            [0, 0.6, 0],
            36,
            shutter={"open": 0, "close": 0.8},
            lens={"aperture_radius": 0.1, "focus_distance": float(rng.uniform(5.5, 6.5))},
        ),
        film={"filter": "gaussian", "sigma": 0.3},
        sampler={"samples": 64},
        integrator={"max_depth": 2},
        environment={"type": "cube", "cross": "cross.png", "scale": 0.5},
        materials={
            "floor": {"color": 0.3, "mirror": 0.5, "gloss": {"lobe": "phong", "exponent": 80}},
            "ball": _color(colors[0]),
            "post": _color(colors[1]),
        },
        lights=[ball_light(rng, "sphere"), {"type": "ambient", "radiance": 0.2}],
        objects=[
            {"shape": "quad", "material": "floor", "width": 8, "depth": 8},
            ball,
            *(_box("post", [0.3, 1.6, 0.3], [-0.6 + 1.2 * i, 0.8, -1.2 - i]) for i in range(3)),
        ],
    )


def cross(rng: np.random.Generator) -> np.ndarray[Any, np.dtype[np.uint8]]:
    """A horizontal cross (18, 24, 3) of six faces of 6 x 6 texels, every one of another colour."""
    return rng.integers(30, 255, (18, 24, 3)).astype(np.uint8)


def _scene(**parts: Any) -> Scene:
    film = {"width": SIZE[0], "height": SIZE[1]} | parts.pop("film", {})
    return {"integrator": {"max_depth": 1}, "film": film} | parts


def _camera(eye: list[float], look_at: list[float], fov: float, **more: Any) -> dict[str, Any]:
    return {"eye": eye, "look_at": look_at, "vertical_fov": fov} | more


def _moving(*velocity: float) -> dict[str, Any]:
    return {"motion": {"velocity": [*velocity]}}


def _floats(values: Any) -> list[float]:
    return [float(v) for v in values]


def _color(values: Any) -> dict[str, Any]:
    return {"color": _floats(values)}


def _bright(name: str, colors: Any) -> dict[str, dict[str, Any]]:
    """Materials that look the same in any light, NAME 0 and so on."""
    return {f"{name} {i}": _color(c) | {"ambient": 1} for i, c in enumerate(colors)}


def _thing(shape: str, material: str, transform: list[Any], **size: Any) -> dict[str, Any]:
    return {"shape": shape, "material": material, "transform": transform} | size


def _box(material: str, size: list[float], at: list[float]) -> dict[str, Any]:
    return _thing("box", material, [{"translate": at}], size=size)


def _bar(material: str, size: list[float], at: list[float], degrees: float) -> dict[str, Any]:
    """A box that is turned about z before it is moved."""
    turn = {"rotate": {"axis": [0, 0, 1], "degrees": degrees}}
    return _thing("box", material, [turn, {"translate": at}], size=size)


def _ball(material: str, radius: float, at: list[float]) -> dict[str, Any]:
    return _thing("sphere", material, [{"translate": at}], radius=radius, segments=96)
