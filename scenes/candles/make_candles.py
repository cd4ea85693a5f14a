"""Write the lights of ``many_lights.yaml``, a thousand candles, in both of its forms, and the mesh of their flames.

Run from the project's folder: ``python scenes/candles/make_candles.py``. The candles stand on a spiral whose turns are
the golden angle apart, as the seeds of a sunflower do, so that each has as much room as any other. A lamp is a point
just below its flame, a tetrahedron that can be seen and lights nothing.
"""

from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
COUNT, SPACING, INNER = 1000, 0.36, 14
GOLDEN = np.pi * (3 - np.sqrt(5))
WARM, COOL = np.array([0.30, 0.15, 0.05]), np.array([0.09, 0.12, 0.30])
"""Intensities [W/sr] of the middle and of the rim."""

MOON = "  - {type: directional, direction: [0.5, -0.8, -0.3], irradiance: [0.03, 0.036, 0.054]}\n"


def candles() -> tuple[np.ndarray, np.ndarray]:
    """Positions (COUNT, 3) [m] and intensities (COUNT, 3) [W/sr]; none stands in the ring or in the block."""
    k = np.arange(INNER, INNER + 2 * COUNT)
    x, z = SPACING * np.sqrt(k) * np.array((np.cos(GOLDEN * k), np.sin(GOLDEN * k)))
    free = [np.hypot(x - there, z + 0.7) > room for there, room in ((-3.1, 1.35), (3, 0.95))]
    x, z = (place[np.logical_and(*free)][:COUNT] for place in (x, z))
    radius = np.hypot(x, z)
    far = ((radius - radius[0]) / (radius[-1] - radius[0]))[:, None]
    return np.stack((x, np.full(COUNT, 0.18), z), axis=1), WARM + (COOL - WARM) * far


def flames(position: np.ndarray) -> bytes:
    """A binary PLY of one tetrahedron above each candle."""
    tip = np.array([[0, 0.16, 0], [0.03, 0.05, 0], [-0.015, 0.05, 0.026], [-0.015, 0.05, -0.026]])
    vertices = (position[:, None] + tip).reshape(-1, 3).astype("<f4")
    sides = np.array([[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]])
    faces = np.zeros(4 * COUNT, np.dtype([("n", "u1"), ("v", "<i4", 3)]))
    faces["n"] = 3
    faces["v"] = (4 * np.arange(COUNT)[:, None, None] + sides).reshape(-1, 3)
    head = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    return head.encode() + vertices.tobytes() + faces.tobytes()


def main() -> None:
    """Write all that follows from the candles' places."""
    position, intensity = candles()
    lamps = "".join(
        f"  - {{type: point, position: [{x:.2f}, {y:.2f}, {z:.2f}], intensity: [{r:.3f}, {g:.3f}, {b:.3f}]}}\n"
        for (x, y, z), (r, g, b) in zip(position, intensity, strict=True)
    )
    (HERE / "flames.ply").write_bytes(flames(position))
    for folder in ("", "before"):
        path = HERE.parent / folder / "many_lights.yaml"
        rest, mark, _ = path.read_text().partition("lights:\n")
        path.write_text(rest + mark + MOON + lamps)


if __name__ == "__main__":
    main()
