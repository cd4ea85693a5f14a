"""Penumbra, a course in distribution ray tracing.

What most programs need is here; each name is imported when it is first asked for, so that
`import course` costs nothing::

    from course import load_scene, render

    picture = render(load_scene("scenes/NAME.yaml"), spp=64)
    picture.save("NAME.png")
"""

from importlib import import_module

from course.base.version import __version__

# Not from typing: `python -m course` imports nothing before `__main__.py` has taken the current folder out of the way.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from course.base.errors import CourseError as CourseError
    from course.base.errors import EffectError as EffectError
    from course.base.errors import GeometryError as GeometryError
    from course.base.errors import OutputError as OutputError
    from course.base.errors import SceneError as SceneError
    from course.engine.recording.pixel import pixel as pixel
    from course.engine.recording.story import Story as Story
    from course.engine.render.convergence import error_over_time as error_over_time
    from course.engine.render.picture import Picture as Picture
    from course.engine.render.render import render as render
    from course.engine.scene.scene import Scene as Scene
    from course.engine.scene.scene import load_scene as load_scene


_HOMES = {
    "CourseError": "course.base.errors",
    "EffectError": "course.base.errors",
    "GeometryError": "course.base.errors",
    "OutputError": "course.base.errors",
    "Picture": "course.engine.render.picture",
    "Scene": "course.engine.scene.scene",
    "SceneError": "course.base.errors",
    "Story": "course.engine.recording.story",
    "error_over_time": "course.engine.render.convergence",
    "load_scene": "course.engine.scene.scene",
    "pixel": "course.engine.recording.pixel",
    "render": "course.engine.render.render",
}

__all__ = ["__version__", *_HOMES]  # noqa: PLE0604


def __getattr__(name: str) -> object:
    """Import a public name when it is first asked for (PEP 562)."""
    if name not in _HOMES:
        raise AttributeError(f"module 'course' has no attribute {name!r}")
    value = getattr(import_module(_HOMES[name]), name)
    globals()[name] = value
    return value


def load_ipython_extension(shell: object) -> None:
    """Give a notebook `%%check`, `%course` and `mine`; called by `%load_ext course`."""
    import_module("course.school.notebooks.extension").load(shell)


def unload_ipython_extension(shell: object) -> None:
    """Take them away; called by `%unload_ext course`."""
    import_module("course.school.notebooks.extension").unload(shell)


def __dir__() -> list[str]:
    """List the public names beside those already here."""
    return sorted({*globals(), *__all__})
