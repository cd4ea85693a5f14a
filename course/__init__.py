"""Penumbra, a course in distribution ray tracing.

What most programs need is here; each name is imported when it is first asked for, so that
`import course` costs nothing::

    from course import load_scene, render

    picture = render(load_scene("scenes/NAME.yaml"), spp=64)
    picture.save("NAME.png")
"""

from importlib import import_module

# Not from typing: `python -m course` imports nothing before `__main__.py` has taken the current folder out of the way.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from course.errors import CourseError as CourseError
    from course.errors import EffectError as EffectError
    from course.errors import GeometryError as GeometryError
    from course.errors import OutputError as OutputError
    from course.errors import SceneError as SceneError
    from course.jobs.picture import Picture as Picture
    from course.recording.pixel import pixel as pixel
    from course.recording.story import Story as Story
    from course.render_scene import render as render
    from course.scene.scene import Scene as Scene
    from course.scene.scene import load_scene as load_scene

__version__ = "0.1.0"

_HOMES = {
    "CourseError": "course.errors",
    "EffectError": "course.errors",
    "GeometryError": "course.errors",
    "OutputError": "course.errors",
    "Picture": "course.jobs.picture",
    "Scene": "course.scene.scene",
    "SceneError": "course.errors",
    "Story": "course.recording.story",
    "load_scene": "course.scene.scene",
    "pixel": "course.recording.pixel",
    "render": "course.render_scene",
}

__all__ = ["__version__", *_HOMES]  # noqa: PLE0604


def __getattr__(name: str) -> object:
    """Import a public name when it is first asked for (PEP 562)."""
    if name not in _HOMES:
        raise AttributeError(f"module 'course' has no attribute {name!r}")
    value = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """List the public names beside those already here."""
    return sorted({*globals(), *__all__})
