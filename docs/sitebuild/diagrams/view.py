"""Solids on paper: parallel lines stay parallel, and what is behind is dashed."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sitebuild.diagrams.canvas import Canvas

Points = NDArray[np.float64]


class View:
    """A camera far away.

    Parameters
    ----------
    azimuth, elevation : where it stands, in degrees: about the axis that points up, and above the horizon
    up : 1 for y, 2 for z
    """

    def __init__(self, azimuth: float, elevation: float, up: int = 2) -> None:
        a, e = math.radians(azimuth), math.radians(elevation)
        toward = np.array([math.cos(a) * math.cos(e), math.sin(a) * math.cos(e), math.sin(e)])
        right = np.array([-math.sin(a), math.cos(a), 0])
        axes = np.stack((right, np.cross(toward, right), toward))
        # With y up, the other two are z and x: the three stay right-handed.
        self.axes = axes if up == 2 else axes[:, [1, 2, 0]]

    def __call__(self, point: ArrayLike) -> Points:
        """Where a point (3,), or (3, N) points, lie on the paper."""
        return self.axes[:2] @ np.asarray(point, float)

    def depth(self, point: ArrayLike) -> Points:
        """How far before the origin's plane they lie: positive is nearer to the eye."""
        return self.axes[2] @ np.asarray(point, float)


def ring(
    canvas: Canvas,
    view: View,
    height: float,
    radius: float,
    kind: str = "faint",
    hidden: str = "faint dashed",
    limit: float = 0,
) -> None:
    """A horizontal circle about the z axis; the part whose depth is below the limit is dashed, or left out."""
    turn = np.linspace(0, 2 * np.pi, 145)
    points = np.stack((radius * np.cos(turn), radius * np.sin(turn), np.full(145, height)))
    near = view.depth(points) >= limit - 1e-9
    pieces = np.flatnonzero(np.diff(near)) + 1
    for run in np.split(np.arange(145), pieces):
        along = np.append(run, run[-1] + 1) if run[-1] < 144 else run
        line = kind if near[run[0]] else hidden
        if line and len(along) > 1:
            canvas.path(view(points[:, along]), line)
