"""Which scenes take points by rejection."""

from __future__ import annotations

from course.formats.yaml.description import SceneDescription

BALL, DISK = "ball by rejection", "rejection"
"""What ``samples`` of a spherical light and of a lens say for it."""


def takes_rejection(scene: SceneDescription) -> bool:
    """Whether a light or the lens takes points by rejection."""
    lens = scene.camera.lens
    if lens is not None and lens.shape == "disk" and lens.samples == DISK:
        return True
    return any(getattr(light, "samples", None) == BALL for light in scene.lights)
