"""What is said of a function that isn't written yet, or fails: which line of the scene asks for it."""

from collections.abc import Iterator
from contextlib import contextmanager

from course.base.errors import EffectError, FunctionError
from course.engine.functions.effects import Bound
from course.engine.scene.scene import Scene


@contextmanager
def lines_named(scene: Scene, bound: Bound) -> Iterator[None]:
    """Say of a function that fails, or isn't written yet, which line of the scene asks for it."""
    where = scene.loaded.document.where
    try:
        yield
    except FunctionError as error:
        if (path := bound.asked_by(error.function)) is None:
            raise
        raise error.asked_by(where(path), path) from error.__cause__
    except NotImplementedError as error:
        function, folder = str(error).partition(":")[0], scene.effects.folder
        if (path := bound.asked_by(function)) is None:
            told = str(error) or "a function is not written yet"
            raise EffectError(f"{told} (in {folder})") from error
        file = folder / function.partition(".")[0]
        unwritten = FunctionError(f"{error} ({file}.py)", function)
        raise unwritten.asked_by(where(path), path) from error
