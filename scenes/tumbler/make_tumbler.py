"""Write the three meshes of a tumbler with water in it, surfaces of revolution about y.

Run from the project's folder: ``python scenes/tumbler/make_tumbler.py``. Light is bent by the ratio of what lies on
both sides, so there is a mesh for each pair: ``glass.ply`` between glass and air, ``water_in_glass.ply`` between water
and glass, ``water.ply`` between water and air. Where they meet they share the bits of their vertices. Normals point
away from the medium that the material names: from glass into air, from water into glass, from water into air.
"""

from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
SEGMENTS = 96
HEIGHT, LEVEL, BASE = 1.3, 0.95, 0.14
"""Of the rim, of the water and of the floor within [m]."""
BOTTOM, TOP, WALL = 0.38, 0.46, 0.04
"""Outer radius below and above, and thickness of the wall [m]."""
ROUND, INNER_ROUND = 0.05, 0.12
"""Radii of the edge below and of the one within [m]."""


def outer(y: float) -> float:
    """Outer radius at a height."""
    return BOTTOM + (TOP - BOTTOM) * y / HEIGHT


def arc(
    r: float, y: float, radius: float, first: float, last: float, steps: int
) -> list[list[float]]:
    """Points (r, y) of a circle about (r, y), from one angle to another [degrees]."""
    angles = np.radians(np.linspace(first, last, steps + 1))
    return [[r + radius * np.cos(a), y + radius * np.sin(a)] for a in angles]


def profiles() -> dict[str, np.ndarray]:
    """Points (K, 2), radius and height, of each mesh: what is left of the way lies within the named medium."""
    ring = [outer(LEVEL) - WALL, LEVEL]
    edge = arc(outer(ROUND) - ROUND, ROUND, ROUND, -90, 0, 6)
    wall = [[outer(y), y] for y in np.linspace(ROUND, HEIGHT - WALL / 2, 9)[1:-1]]
    top = HEIGHT - WALL / 2
    rim = arc(outer(top) - WALL / 2, top, WALL / 2, 0, 180, 10)
    above = [[outer(y) - WALL, y] for y in np.linspace(top, LEVEL, 5)[1:-1]]
    low = BASE + INNER_ROUND
    below = [[outer(y) - WALL, y] for y in np.linspace(LEVEL, low, 7)[1:-1]]
    bend = arc(outer(low) - WALL - INNER_ROUND, low, INNER_ROUND, 0, -90, 8)
    return {
        "glass": np.array([[0, 0], [0.18, 0], *edge, *wall, *rim, *above, ring]),
        "water_in_glass": np.array([[0, BASE], [0.12, BASE], *bend[::-1], *below[::-1], ring]),
        "water": np.array([ring, [0.25, LEVEL], [0, LEVEL]]),
    }


def turned(profile: np.ndarray) -> bytes:
    """A binary PLY of the profile turned about y, with normals."""
    along = np.diff(profile, axis=0)
    across = np.stack((along[:, 1], -along[:, 0]), axis=1)
    across /= np.hypot(*across.T)[:, None]
    # The mean of two neighbouring pieces; on the axis it is the axis.
    normal = np.concatenate((across[:1], across[:-1] + across[1:], across[-1:]))
    normal[profile[:, 0] == 0, 0] = 0
    normal /= np.hypot(*normal.T)[:, None]
    turn = 2 * np.pi * np.arange(SEGMENTS) / SEGMENTS
    cosine, sine = np.cos(turn), np.sin(turn)

    def around(rows: np.ndarray) -> np.ndarray:
        r, y = rows.T[:, :, None]
        return np.stack((r * cosine, np.broadcast_to(y, (len(rows), SEGMENTS)), -r * sine), axis=2)

    vertices = np.concatenate((around(profile), around(normal)), axis=2).reshape(-1, 6)
    k, i = np.meshgrid(np.arange(len(profile) - 1), np.arange(SEGMENTS), indexing="ij")
    a, b = k * SEGMENTS + i, k * SEGMENTS + (i + 1) % SEGMENTS
    pairs = np.stack((a, b, b + SEGMENTS, a, b + SEGMENTS, a + SEGMENTS), axis=-1).reshape(-1, 3)
    # On the axis a row is a point: one triangle of two is left.
    places = vertices[:, :3].round(9)
    corners = places[pairs]
    whole = ~(
        (corners[:, 0] == corners[:, 1]).all(1)
        | (corners[:, 1] == corners[:, 2]).all(1)
        | (corners[:, 2] == corners[:, 0]).all(1)
    )
    faces = np.zeros(whole.sum(), np.dtype([("n", "u1"), ("v", "<i4", 3)]))
    faces["n"], faces["v"] = 3, pairs[whole]
    names = ["x", "y", "z", "nx", "ny", "nz"]
    head = "ply\nformat binary_little_endian 1.0\ncomment made by make_tumbler.py\n"
    head += f"element vertex {len(vertices)}\n"
    head += "".join(f"property float {name}\n" for name in names)
    head += f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    return head.encode() + vertices.astype("<f4").tobytes() + faces.tobytes()


def main() -> None:
    """Write all three."""
    for name, profile in profiles().items():
        (HERE / f"{name}.ply").write_bytes(turned(profile))


if __name__ == "__main__":
    main()
