"""The plug-in point: the folder whose functions the renderer calls for each effect.

An ``Effects`` object is made once, passed down to whoever calls a function, and imports a module when the first
function of it is asked for. A scene that doesn't use an effect never imports its module.
"""

import ast
import os
import re
import sys
import warnings
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from importlib.abc import Loader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

from course.base.errors import CourseWarning, EffectError, Ended
from course.engine.functions.modules import COURSE, meant
from course.engine.functions.notebook.reading import LARGEST_FILE
from course.engine.functions.sources import (
    cells_of,
    find_module,
    is_notebook,
    named,
    program_of,
    saved_files,
)

PACKAGE = Path(__file__).resolve().parents[2]
"""The package ``course``."""

CHECKOUT = (PACKAGE.parent / "pyproject.toml").is_file()
"""True in a clone or a student's copy; false in an installed wheel."""

PROJECT = PACKAGE.parent if CHECKOUT else PACKAGE.parent / "penumbra_course_files"
"""The folder of ``solutions``, ``scenes`` and ``docs``. A student's copy has no ``solutions``."""


def own_assignments() -> Path:
    """The folder of the functions that are to be written: the current folder's, or the project's where it has none.

    An installed wheel has none, and near a folder of `course start` the project's aren't meant. In a folder of that
    name, where notebooks are run, it is the current one.
    """
    here = Path("assignments")
    if not here.is_dir() and _inside():
        return Path()
    return here if here.is_dir() or not CHECKOUT or _way() else PROJECT / here


def _inside() -> bool:
    """Whether the current folder is the assignments of a folder of `course start`, and holds some."""
    here = Path.cwd()
    own = here.name == "assignments" and here.parent != PROJECT
    return own and any(path.stem in COURSE for path in saved_files(here))


def begin() -> str:
    """What to do where the current folder has no assignments: go to one that has them, else make one."""
    return _way() or "`course start FOLDER` makes a folder to work in"


def _way() -> str:
    """The way to a folder of `course start` above or below the current one; empty where there is none.

    So it is where the project itself is one of them.
    """
    here = Path.cwd()
    above = [folder for folder in here.parents[:3] if (folder / "assignments").is_dir()]
    below = sorted(folder.parent for folder in here.glob("*/assignments") if folder.is_dir())
    near = above[:1] or [here / folder for folder in below]
    if CHECKOUT and PROJECT in (here, *near):
        return ""
    # A blank in a name has to be quoted in every shell.
    names = [os.path.relpath(folder) for folder in near[:3]]
    ways = [f'`cd "{name}"`' if " " in name else f"`cd {name}`" for name in names]
    return f"{' or '.join(ways)} goes to your course" if ways else ""


@dataclass(frozen=True)
class Need:
    """A function that rendering a scene calls.

    Attributes
    ----------
    function : "module.function"
    asked_by : the key path in the scene file whose value makes it necessary
    """

    function: str
    asked_by: tuple[str | int, ...]


class Effects:
    """The student-facing functions, from one folder of ``NAME.py`` files.

    Raises EffectError when the folder doesn't exist.

    Parameters
    ----------
    folder : where the modules are; ``solutions`` and ``assignments`` mean the current folder's or else the project's
        (see ``own_assignments``), and ``mine`` means the assignments, with the solution's function in the place of each
        that is not written; where there are no solutions, with a stand-in that switches its effect off. None means
        ``mine`` in a folder made by `course start` and in a student's copy, else the solutions.
    filled : whether what another folder hasn't written is replaced, as ``mine`` has it
    trusted : whether what the functions return is taken as it is; None means the project's own solutions, and no others
    """

    def __init__(
        self, folder: str | Path | None = None, trusted: bool | None = None, *, filled: bool = False
    ) -> None:
        own = Path("assignments").is_dir() and Path.cwd() != PROJECT
        if folder is None and (own or _inside()):
            # In a folder made by `course start`.
            folder = "mine"
        elif folder is None:
            # A student's copy has no solutions.
            folder = "solutions" if (PROJECT / "solutions").is_dir() else "mine"
            if way := _way():
                warnings.warn(
                    f"no folder assignments here, so all functions are the course's: {way}",
                    CourseWarning,
                    stacklevel=2,
                )
        path = Path(folder)
        self._rest: Effects | None = None
        self._stands_in = False
        # A folder of `course start` may have that name; its functions are deeper.
        if str(folder) == "mine" and (not path.is_dir() or (path / "assignments").is_dir()):
            folder, filled = "assignments", True
        if filled:
            if (PROJECT / "solutions").is_dir():
                self._rest = Effects("solutions")
            else:
                self._stands_in = True
        if str(folder) == "assignments":
            path = own_assignments()
            if not path.is_dir():
                raise EffectError(f"no folder assignments here; {begin()}")
        elif str(folder) == "solutions" and not path.is_dir():
            path = PROJECT / path
        # Path.is_dir raises an error of its own for a name that is too long.
        alone = is_notebook(path) and os.path.isfile(path)  # noqa: PTH113
        if not alone and not os.path.isdir(path):  # noqa: PTH112
            raise EffectError(
                f"no folder {path} with effect functions; --effects takes mine, solutions, assignments, a folder "
                "or a notebook"
            )
        self.folder = path
        self.trusted = path.resolve() == PROJECT / "solutions" if trusted is None else trusted
        self._written: dict[str, frozenset[str]] = {}
        self._functions: dict[tuple[str, str], Callable[..., Any]] = {}
        self._modules: dict[str, ModuleType] = {}

    @property
    def mixed(self) -> bool:
        """True if functions that are not written are replaced by those of the solutions, or by stand-ins."""
        return self._rest is not None or self._stands_in

    @property
    def all_own(self) -> bool:
        """True if no function that was asked for until now is a student's."""
        return self.trusted or (self.mixed and not self._functions)

    @property
    def on_solutions(self) -> bool:
        """True if the solutions are in the place of functions that are not written."""
        return self._rest is not None

    def stand_in(self, module: str, name: str) -> str:
        """What a picture looks like with the stand-in for a function; empty if it is written, or has none."""
        if not self._stands_in or self.written(module, name):
            return ""
        # Here, for a command line's help needs no NumPy.
        from course.engine.functions.stand_ins import STAND_INS

        return STAND_INS.get(f"{module}.{name}", (None, ""))[1]

    def written(self, module: str, name: str) -> bool:
        """True if the folder has the function, and its last word isn't that it is not written yet."""
        if module not in self._written:
            there = find_module(self.folder, module)
            self._written[module] = (
                frozenset() if there is None else written_in(program_of(there, module), module)
            )
            file = named(self.folder, module)
            if self.mixed and there is None and (near := misnamed(file)):
                warnings.warn(
                    f"{file} is missing, so its functions count as not written; is it {near}?",
                    CourseWarning,
                    stacklevel=2,
                )
        return name in self._written[module]

    def idle(self, called: Iterable[str]) -> list[str]:
        """What is written and was not called: functions of modules that were, and else modules; none if trusted.

        ``called``: "module.function"
        """
        called, found = set(called), []
        if self.trusted:
            return []
        for module, names in COURSE.items():
            own = [f"{module}.{name}" for name in names if self.written(module, name)]
            asked = called.intersection(f"{module}.{name}" for name in names)
            found += [name for name in own if name not in called] if asked else [module] * bool(own)
        return found

    @property
    def imported(self) -> tuple[str, ...]:
        """Names of the modules that have been needed so far."""
        return tuple(self._modules)

    def function(self, module: str, name: str) -> Callable[..., Any]:
        """One function of a module, importing the module if this is its first; guarded where it isn't trusted.

        Raises EffectError when the file or the function is missing or the file can't be imported.
        """
        if self.mixed and not self.written(module, name):
            self._tell_of_slip(module, name)
        if self._rest is not None and not self.written(module, name):
            return self._rest.function(module, name)
        if self.stand_in(module, name):
            from course.engine.functions.stand_ins import STAND_INS

            return STAND_INS[f"{module}.{name}"][0]
        known = self._functions.get((module, name))
        if known is not None:
            return known
        file = find_module(self.folder, module) or named(self.folder, module)
        function: Callable[..., Any] | None = getattr(self._module(module), name, None)
        if function is None or not callable(function):
            raise EffectError(f"{file} has no function {name}")
        if not self.trusted:
            # Here, for a command line's help needs no NumPy.
            from course.engine.functions.guard import guarded

            function = guarded(f"{module}.{name}", function, file)
        self._functions[module, name] = function
        return function

    def _tell_of_slip(self, module: str, name: str) -> None:
        """Warn of a file that has no such function, but one with a name that is much like it."""
        others = [each for each in self._written[module] if each not in COURSE[module]]
        file = find_module(self.folder, module) if others else None
        if (
            file
            and not _defines(program_of(file, module), name)
            and (near := get_close_matches(name, others, 1))
        ):
            warnings.warn(
                f"{file} has no {name}, and a {near[0]}: {name} counts as not written",
                CourseWarning,
                stacklevel=3,
            )

    def _module(self, name: str) -> ModuleType:
        if name not in self._modules:
            file = find_module(self.folder, name) or named(self.folder, name)
            self._modules[name] = _import_file(file, name)
        return self._modules[name]


class Alone(Effects):
    """A folder's functions, and stand-ins for those that are not written, though there be solutions."""

    def __init__(self, folder: str | Path = "mine") -> None:
        super().__init__(folder, filled=True)
        self._rest, self._stands_in = None, True


class NothingWritten(Alone):
    """Stand-ins for all functions, as in a copy without solutions in which nothing is written yet."""

    def __init__(self, folder: str | Path = "mine") -> None:
        super().__init__(folder)
        self.trusted = True

    def written(self, module: str, name: str) -> bool:
        """See ``Effects``."""
        return False

    def _tell_of_slip(self, module: str, name: str) -> None:
        """No file is read, so none can have a slip."""


def written_in(text: bytes | str, module: str) -> frozenset[str]:
    """Names in a module's text, without functions that only raise NotImplementedError in the end, as stubs do.

    A text that Python can't read has every name of the module: importing it says what is wrong.
    """
    try:
        body = ast.parse(text).body
    except (SyntaxError, ValueError):
        return frozenset(COURSE.get(module, ()))
    names: set[str] = set()
    for node in body:
        if isinstance(node, ast.FunctionDef):
            last = node.body[-1]
            stub = isinstance(last, ast.Raise) and "NotImplementedError" in ast.dump(last)
            # The line may have been left where nothing reaches it any more.
            stub = stub and not _returns(node)
            # The last definition of a name is the one that counts.
            names = names - {node.name} if stub else names | {node.name}
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names |= {alias.asname or alias.name for alias in node.names}
        elif isinstance(node, ast.Assign):
            names |= {target.id for target in node.targets if isinstance(target, ast.Name)}
    return frozenset(names)


def misnamed(file: Path) -> Path | None:
    """The file that may be meant by a missing one: a copy or one in capitals, there or in a folder there, or a slip."""
    letters = re.compile("[^a-z]")
    name = letters.sub("", file.stem)
    others_own = COURSE.keys() - {file.stem}
    others = [
        other
        for other in sorted([*file.parent.glob("*.py*"), *file.parent.glob("[!_.]*/*.py")])
        if other.stem not in others_own and other.is_file()
    ]
    begun = (other for other in others if letters.sub("", other.name.lower()).startswith(name))
    alike = meant(file.stem, (other.stem for other in others))
    return next(begun, None) or next((other for other in others if other.stem == alike), None)


def _defines(text: bytes, name: str) -> bool:
    """True if a module's text has the function, written or not."""
    body = ast.parse(text).body
    return any(isinstance(node, ast.FunctionDef) and node.name == name for node in body)


def _returns(node: ast.AST) -> bool:
    """Whether a function has a return of its own: those of functions within it are not."""
    return any(
        isinstance(each, ast.Return)
        or (not isinstance(each, ast.FunctionDef | ast.ClassDef) and _returns(each))
        for each in ast.iter_child_nodes(node)
    )


class Bound:
    """The functions that one scene is bound to, with what asks for them: its receipt and its errors follow from that.

    ``needs``: of each function the first that asked.

    Parameters
    ----------
    effects : whose functions
    needs : what was bound before
    """

    def __init__(self, effects: Effects, needs: Iterable[Need] = ()) -> None:
        self._effects = effects
        self._needs = {need.function: need for need in needs}

    @property
    def needs(self) -> tuple[Need, ...]:
        """In the course's order."""
        order = {f"{module}.{name}": None for module in COURSE for name in COURSE[module]}
        return tuple(self._needs[function] for function in order if function in self._needs)

    def asked_by(self, function: str) -> tuple[str | int, ...] | None:
        """The key path that makes "module.function" necessary, if any does."""
        need = self._needs.get(function)
        return None if need is None else need.asked_by

    def function(
        self, module: str, name: str, asked_by: tuple[str | int, ...]
    ) -> Callable[..., Any]:
        """See ``Effects.function``; it is noted down."""
        function = self._effects.function(module, name)
        self._needs.setdefault(f"{module}.{name}", Need(f"{module}.{name}", asked_by))
        return function

    def functions(
        self, module: str, *names: str, asked_by: tuple[str | int, ...]
    ) -> SimpleNamespace:
        """Some functions of a module, to be called by their own names; see ``function``."""
        return SimpleNamespace(**{name: self.function(module, name, asked_by) for name in names})


def _import_file(path: Path, stem: str) -> ModuleType:
    """Import a module's file under a name of its own, so that two folders with equal names don't meet."""
    if not path.is_file():
        raise EffectError(f"{path} is missing; the scene needs its functions")
    if not is_notebook(path) and path.stat().st_size > LARGEST_FILE:
        # Python would read all of it, whatever its size.
        raise EffectError(
            f"{path}: more than {LARGEST_FILE:,} bytes: too large for a file of functions"
        )
    name = f"course_effects.{path.parent.name}.{stem}"
    spec = spec_from_file_location(name, path, loader=_loader(name, path, stem))
    if spec is None or spec.loader is None:
        raise EffectError(f"{path} can't be imported")
    module = module_from_spec(spec)
    sys.modules[name] = module
    here = Path.cwd()
    try:
        spec.loader.exec_module(module)
    except (KeyboardInterrupt, Ended):
        raise
    except BaseException as error:
        # SystemExit at import would end the render in silence.
        del sys.modules[name]
        raise EffectError(f"{path} can't be imported: {type(error).__name__}: {error}") from error
    finally:
        # Scripts like to go to their own folder; outputs and other modules are named from ours.
        os.chdir(here)
    return module


def _loader(name: str, path: Path, stem: str) -> Loader | None:
    """What imports a notebook's cells; None for a program, which Python itself imports."""
    if not is_notebook(path):
        return None
    # Here, for programs need nothing of it.
    from course.engine.functions.notebook.importing import CellsLoader

    return CellsLoader(name, path.absolute(), cells_of(path, stem))
