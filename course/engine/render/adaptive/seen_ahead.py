"""Where rays go that are sent ahead of a render: to which triangle, and through which pixel a point is seen.

No function of a student is called, and nothing is counted. A lens and a shutter are sampled evenly here.
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.accelerator import Intersections, QueryStats, StaticAccelerator
from course.engine.core.camera import Camera
from course.engine.core.motion import MovingAccelerator
from course.engine.core.types import Floats64, Mask
from course.engine.terms.cameras.apertures import PolygonLens, SquareLens
from course.engine.terms.cameras.near_plane import NearPlaneCamera
from course.engine.terms.world import FullWorld


@dataclass(frozen=True)
class CameraAxes:
    """A camera by its axes, in float64.

    Attributes
    ----------
    axes : (3, 3) rows to the right, up and forwards
    velocity : (3,) [unit of the compiled scene / exposure]
    """

    camera: Camera
    width: int
    height: int
    axes: Floats64
    velocity: Floats64

    @classmethod
    def of(cls, camera: Camera, world: FullWorld, width: int, height: int) -> "CameraAxes":
        """The view of a camera in a world."""
        axes = np.array((camera.right, camera.up, camera.forward), np.float64)
        moves = world.motion is not None and world.motion.camera_velocity is not None
        velocity = world.motion.camera_velocity if moves and world.motion else np.zeros(3)
        return cls(camera, width, height, axes, np.asarray(velocity, np.float64))

    @property
    def pixel(self) -> float:
        """Area of a pixel on the plane at distance 1."""
        steps = self.camera.step_x.astype(np.float64), self.camera.step_y.astype(np.float64)
        return float(np.linalg.norm(np.cross(*steps)))

    @property
    def aperture(self) -> float:
        """Radius of the lens, 0 for a pinhole."""
        return 0.0 if self.camera.lens is None else self.camera.lens.aperture_radius

    def eyes(self, u: Floats64, time: Floats64) -> tuple[Floats64, Floats64]:
        """Where rays begin, (3, n) in the scene, and (2, n) on the lens, from u (2, n) and times (n,) in [0, 1)."""
        lens = self.camera.lens
        if lens is None:
            points: Floats64 = np.zeros(u.shape)
        elif isinstance(lens, PolygonLens | SquareLens):
            points = lens.points(u.astype(np.float32)).astype(np.float64) * lens.aperture_radius
        else:
            turn, far = 2 * np.pi * u[1], lens.aperture_radius * np.sqrt(u[0])
            points = np.stack((far * np.cos(turn), far * np.sin(turn)))
        start = self.camera.origin[:, None] + self.axes[:2].T @ points
        return start + self.velocity[:, None] * time, points

    def through(self, x: Floats64, y: Floats64, on_lens: Floats64) -> Floats64:
        """Ways (3, n) through picture points (n,) from one place on the lens (2,)."""
        camera = self.camera
        way = camera.corner[:, None].astype(np.float64) + camera.step_x[:, None] * x
        way += camera.step_y[:, None] * y
        if camera.lens is not None:
            way -= self.axes[:2].T @ (on_lens / camera.lens.focus_distance)[:, None]
        return way

    def pixels(self, way: Floats64, on_lens: Floats64) -> tuple[Floats64, Floats64, Mask]:
        """Picture coordinates (2, n) of what is seen along ways (3, n) from places on the lens (2, n).

        Returns
        -------
        tuple of array
            The coordinates; the cosines (n,) of the ways with the view; and which lie in the picture.
        """
        x, y, depth = self.axes @ way
        near = self.camera.near if isinstance(self.camera, NearPlaneCamera) else 0.0
        ahead = depth > max(near, 1e-12)
        safe = np.where(ahead, depth, 1.0)
        slope = np.stack((x, y)) / safe
        if self.camera.lens is not None:
            # What is sharp lies on the plane in focus; rays of one pixel meet there.
            slope = slope + on_lens / self.camera.lens.focus_distance
        corner = self.axes[:2] @ self.camera.corner.astype(np.float64)
        steps = np.array(
            (self.axes[0] @ self.camera.step_x, self.axes[1] @ self.camera.step_y), np.float64
        )
        places = (slope - corner[:, None]) / steps[:, None]
        inside = (places >= 0).all(axis=0) & (places[0] < self.width) & (places[1] < self.height)
        return places, safe / np.sqrt((way * way).sum(axis=0)), ahead & inside


def can_be_asked(world: FullWorld) -> bool:
    """Whether rays may be sent ahead: a student's hierarchy would be asked for them, too."""
    return isinstance(world.surface.accelerator, StaticAccelerator | MovingAccelerator)


def nearest(world: FullWorld, origin: Floats64, way: Floats64, time: Floats64) -> Intersections:
    """What rays from origins (3, n) along ways (3, n) meet at times (n,); distances in lengths of the ways."""
    accelerator, stats = world.surface.accelerator, QueryStats()
    start, toward = (np.ascontiguousarray(x, np.float32) for x in (origin, way))
    if not isinstance(accelerator, MovingAccelerator):
        assert isinstance(accelerator, StaticAccelerator)
        return accelerator.intersect(start, toward, stats)
    found = accelerator.static.intersect(start, toward, stats)
    for mover in accelerator.movers:
        shifted = start - mover.velocity.reshape(3, 1) * time.astype(np.float32)
        other = mover.accelerator.intersect(shifted, toward, stats, limit=found.t)
        accelerator.take(found, other, mover)
    return found
