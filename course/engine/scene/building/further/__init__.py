"""Terms that a key of the scene asks for: each is a file here that is called as the key.

A file has ``compiled(loaded, frame, bound, things, world)``, which returns the world with its term. It is imported
where a scene has the key, and only there.
"""

from importlib import import_module
from pathlib import Path

from course.engine.formats.yaml.loading import Loaded
from course.engine.functions.effects import Bound
from course.engine.scene.building.frame import Frame
from course.engine.scene.building.things import Things
from course.engine.terms.world import FullWorld

KEYS = tuple(sorted(file.stem for file in Path(__file__).parent.glob("[!_]*.py")))


def with_further(
    loaded: Loaded, frame: Frame, bound: Bound, things: Things, world: FullWorld
) -> FullWorld:
    """The world with the terms that its scene asks for.

    Raises SceneError; names file, line and key path.
    """
    for key in KEYS:
        if getattr(loaded.description, key):
            term = import_module(f"{__name__}.{key}")
            world = term.compiled(loaded, frame, bound, things, world)
    return world
