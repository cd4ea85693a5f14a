"""Points on spherical lights and on the lens: by `soft_shadows` and `thin_lens`, or by `sampling`."""

from course.engine.formats.yaml.description import SceneDescription

BALL, DISK = "ball by rejection", "rejection"
"""Values of ``samples`` of a spherical light and of a lens, for points by rejection."""

SPHERES = {
    "sphere": ("soft_shadows", "point_on_sphere"),
    "ball": ("soft_shadows", "point_in_ball"),
    "facing disk": ("soft_shadows", "point_on_facing_disk"),
    "sphere by polar": ("sampling", "sphere_by_polar"),
    "ball by polar": ("sampling", "ball_by_polar"),
    BALL: ("sampling", "ball_by_rejection"),
}
"""The module and name of the function that a light's ``samples`` ask for; the visible part needs none."""

NUMBERS = {"ball": 3, "ball by polar": 3}
"""Random numbers per point, if not 2. With rejection they only seed a generator."""

DISKS = {"polar": "disk_by_polar", DISK: "disk_by_rejection"}
"""The function of the sampling module that a lens's ``samples`` ask for."""


def takes_rejection(scene: SceneDescription) -> bool:
    """True if a light or the lens samples points by rejection."""
    lens = scene.camera.lens
    if lens is not None and lens.shape == "disk" and lens.samples == DISK:
        return True
    return any(getattr(light, "samples", None) == BALL for light in scene.lights)
