"""A picture of the work that a hierarchy was for the rays through the middles of pixels."""

from pathlib import Path

import numpy as np

from course.engine.core.types import Indices
from course.engine.formats.pictures.display import heat_map
from course.engine.formats.pictures.files import save
from course.engine.scene.building.cameras import compile_camera
from course.engine.scene.scene import Scene, SceneSettings
from course.engine.terms.surfaces.hierarchy import HierarchyAccelerator

BATCH = 16384
"""Rays that are asked at once."""


def box_tests(scene: Scene, settings: SceneSettings) -> Indices:
    """Number of boxes that each camera ray was tested with, (H, W).

    Lens and motion are left out: a ray a pixel, from the middle of the lens when the shutter opens.

    Parameters
    ----------
    scene : one whose rays a hierarchy answers
    settings : of which the size counts
    """
    accelerator = scene.compiled.world.surface.accelerator
    assert isinstance(accelerator, HierarchyAccelerator)
    width, height = settings.width, settings.height
    camera = compile_camera(scene.loaded, scene.compiled.frame, width, height)
    tests = np.empty(width * height, np.intp)
    for start in range(0, len(tests), BATCH):
        batch = np.arange(start, min(start + BATCH, len(tests)))
        y, x = (place.astype(np.float32) + np.float32(0.5) for place in np.divmod(batch, width))
        origin, direction = camera.rays(x, y, None, None)
        tests[batch] = accelerator.box_tests(origin, direction)
    return tests.reshape(height, width)


def save_box_tests(scene: Scene, settings: SceneSettings, path: Path) -> None:
    """Write them as a picture: black the fewest, white the most, logarithmic between.

    Raises OutputError when the file can't be written; then there is no such file.
    """
    save(path, heat_map(np.maximum(box_tests(scene, settings), 1)))
