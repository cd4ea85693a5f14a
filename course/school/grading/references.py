"""Arrays that checks compare with: made with the reference solutions, or read where there are none.

A student's copy has no solutions; ``course references`` writes there what the checks of the usual seed need.
"""

from collections.abc import Callable, Iterable, Mapping
from functools import cache, lru_cache
from importlib.resources import as_file, files
from pathlib import Path

import numpy as np

from course.base.atomic import replacing
from course.base.errors import CourseError
from course.base.inputs import read_arrays, shown
from course.engine.functions.effects import PROJECT, Effects
from course.engine.functions.modules import COURSE
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Array, Caller, Check, References, generator
from course.school.grading.checks.trusted import TrustedModule
from course.school.grading.pictures.whole import ALL, NAME, Together
from course.school.grading.report import USUAL_SEED

SOLUTIONS = PROJECT / "solutions"


def reference(module: str) -> Caller:
    """The reference solution of a module; ``CourseError`` where it isn't there."""
    if not SOLUTIONS.is_dir():
        raise CourseError("what is right is made with the solutions, and this copy has none")
    effects = Effects(SOLUTIONS)
    if module == NAME:
        return Together({name: reference(name) for name in ALL})
    return TrustedModule({name: effects.function(module, name) for name in COURSE[module]})


KEPT = 32
"""Checks of which a maker of references keeps the arrays; a module has fewer that need any."""


def prepared(reference: Caller, seed: int) -> References:
    """References made on the spot with the reference solution's module, once for each check; they are read-only."""

    @lru_cache(maxsize=KEPT)
    def make(module: str, check: Check) -> Mapping[str, Array]:
        assert check.prepare is not None
        arrays = check.prepare(reference, generator(seed, module, check))
        for array in arrays.values():
            array.setflags(write=False)
        return arrays

    return lambda module, check: {} if check.prepare is None else make(module, check)


def make_references(modules: Iterable[str], seed: int, out: Path) -> int:
    """Write the arrays of some modules' checks as one .npz file; how many arrays there are."""
    arrays: dict[str, Array] = {}
    for module in modules:
        make = prepared(reference(module), seed)
        checks = module_checks(module)
        for check in (*checks.checks, *checks.prints.values(), *checks.rays.values()):
            for name, array in make(module, check).items():
                arrays[f"{_key(module, check)}/{name}"] = array
    arrays["seed"] = np.array(seed)
    out.parent.mkdir(parents=True, exist_ok=True)
    with replacing(out) as temporary, temporary.open("wb") as file:
        np.savez_compressed(file, **arrays)  # type: ignore[arg-type]  # its stub takes no arrays by name
    return len(arrays)


def read_references(path: Path, seed: int, module: str | None = None) -> References:
    """References from such a file; ``CourseError`` where it can't be read, or was made for another seed.

    ``module``: read no other's; to unpack all takes a quarter of a second
    """

    def wanted(name: str) -> bool:
        return module is None or name == "seed" or name.startswith(f"{module}.")

    arrays = read_arrays(path, "file of references", wanted)
    found = arrays.pop("seed", np.zeros(0)).tolist()
    if not isinstance(found, int) or any(name.count("/") < 2 for name in arrays):
        raise CourseError(f"{shown(path)}: is no file of references")
    if found != seed:
        raise CourseError(f"{path}: holds references for the seed {found}, not {seed}")
    by_check: dict[str, dict[str, Array]] = {}
    for name, array in arrays.items():
        # A check's own name has one slash: "thin_lens.lens_rays/picture".
        parts = name.split("/", 2)
        by_check.setdefault("/".join(parts[:2]), {})[parts[2]] = array

    return _kept(by_check, lambda key: f"{path}: has no references for {key}; make them anew")


def references(seed: int = USUAL_SEED) -> References:
    """References for a seed: made on the spot where the solutions are, else those that came with this copy.

    Raises CourseError: there are neither.
    """
    if SOLUTIONS.is_dir():

        @cache
        def maker(module: str) -> References:
            return prepared(reference(module), seed)

        # A solution is loaded when the first check asks for what it has to make.
        return lambda module, check: maker(module)(module, check) if check.prepare else {}
    with as_file(files("course.school.grading") / "data" / "references.npz") as path:
        if not path.is_file():
            raise CourseError(
                "this copy has neither solutions nor references; get the course's archive anew"
            )
        # No array of it: only whether it is such a file.
        read_references(path, USUAL_SEED, "")
    told = f"this copy has those for the seed {USUAL_SEED} only, not {seed}"
    none = _kept({}, lambda key: f"{key} compares with a reference, and {told}")

    def find(module: str, check: Check) -> Mapping[str, Array]:
        known = _came_with_this_copy(module) if seed == USUAL_SEED or check.any_seed else none
        return known(module, check)

    return find


@cache
def _came_with_this_copy(module: str) -> References:
    with as_file(files("course.school.grading") / "data" / "references.npz") as path:
        return read_references(path, USUAL_SEED, module)


def has_references(seed: int) -> bool:
    """True if checks that need references can be made here: with any seed where the solutions are, else with one."""
    return SOLUTIONS.is_dir() or seed == USUAL_SEED


def _kept(by_check: Mapping[str, Mapping[str, Array]], missing: Callable[[str], str]) -> References:
    """References that were made before; ``missing`` is told of a check that has none and needs some."""

    def find(module: str, check: Check) -> Mapping[str, Array]:
        key = _key(module, check)
        if check.prepare is not None and key not in by_check:
            raise CourseError(missing(key))
        return by_check.get(key, {})

    return find


def _key(module: str, check: Check) -> str:
    return f"{module}.{check.function}/{check.name}"
