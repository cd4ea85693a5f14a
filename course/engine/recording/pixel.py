"""The story of a pixel of a scene, from a file or from what was loaded."""

from pathlib import Path

from course.engine.functions.given import Given
from course.engine.recording.recording import record
from course.engine.recording.stages import RecordedEffects
from course.engine.recording.story import Story
from course.engine.scene.scene import Scene, effects_of, load_scene


def pixel(
    scene: Scene | str | Path,
    x: int,
    y: int,
    width: int = 1,
    height: int = 1,
    *,
    spp: int | None = None,
    size: tuple[int, int] | None = None,
    seed: int | None = None,
    effects: str | Path | Given | None = None,
) -> Story:
    """Tell why a pixel of a picture has its colour, and what the rays of its samples met.

    The samples are rendered once more, with the bits that they have in the picture of `course.render`.

    Parameters
    ----------
    scene : as it was loaded, or its file or name; see `course.load_scene`
    x, y : column and row of the upper left pixel, from the upper left corner of the picture
    width, height : of a rectangle [pixels]
    spp, size, seed : see `course.render`
    effects : see `course.load_scene`; for a file

    Raises
    ------
    CourseError
        The pixel isn't in the picture, or has no samples of its own.
    SceneError, EffectError
        See `course.load_scene` and `course.render`.
    """
    if not isinstance(scene, Scene):
        functions = RecordedEffects(effects_of(effects))
        with functions.building():
            scene = load_scene(scene, functions)
    return Story(record(scene, x, y, width, height, spp=spp, size=size, seed=seed))
