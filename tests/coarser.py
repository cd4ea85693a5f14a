"""Scenes of the course with coarser meshes: of the time of a small picture, most goes into millions of triangles."""

from pathlib import Path

from course.engine.formats.yaml.description import TorusKnot
from course.engine.formats.yaml.loading import load_description
from course.engine.formats.yaml.overriding import Overrides

FINE, KNOT = 64, 512
"""Segments that a small picture may need, and those of a knot, which must have many."""


def coarser(path: Path) -> Overrides:
    """What ``load_variant`` is to change of a scene, whose own file is read and checked, too."""
    objects = load_description(path).description.objects
    most = [KNOT if isinstance(thing, TorusKnot) else FINE for thing in objects]
    return {
        ("objects", number, "segments"): fine
        for number, (thing, fine) in enumerate(zip(objects, most, strict=True))
        if getattr(thing, "segments", 0) > fine
    }
