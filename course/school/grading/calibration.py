"""SSIM tolerances between right and wrong, measured on the known submissions.

For each picture: the least similar that any right variant came out, over several seeds, and the most similar of those
wrong ones that the picture can tell from them. The tolerance lies between: 1 - SSIM is the geometric mean of the two.
A wrong submission that the picture can't tell is listed; other checks are there for it.
"""

from collections.abc import Callable, Iterable, Mapping
from math import sqrt
from pathlib import Path
from typing import Any

from course.base.atomic import write_rows
from course.base.version import __version__
from course.school.grading.catalog import module_checks
from course.school.grading.checks.check import Caller, Check, ModuleChecks
from course.school.grading.checks.running import run_checks
from course.school.grading.known import KnownSubmission, known, trusted
from course.school.grading.pictures.judging import ssim
from course.school.grading.pictures.whole import ALL, NAME, Together
from course.school.grading.references import prepared, reference

ROUNDING = 1e-4
"""1 - SSIM that a right picture may always have: float32 is rounded differently on other machines."""

APART = 6.0
"""A wrong submission counts as told apart if its 1 - SSIM is this many times that of the worst right one; so the
tolerance stays away from either by the root of it, a factor of 2.4."""

MARGIN = 5.0
"""Where no wrong submission is near, the tolerance stays this many times farther from 1 than the right ones."""


def calibrate(
    modules: Iterable[str], seeds: int, told: Callable[[str], None] = lambda _: None
) -> dict[str, dict[str, Any]]:
    """Tolerances by check: "thin_lens.lens_rays/picture".

    Parameters
    ----------
    seeds : how many of each submission's pictures are looked at
    told : called with a line for each check when it is done

    Returns
    -------
    check -> tolerance, right (the worst of the right ones), wrong (the best of those told apart), nearest (its name),
    unseen (wrong ones that the picture can't tell)
    """
    found: dict[str, dict[str, Any]] = {}
    for module in modules:
        submissions = known(module)
        for check in module_checks(module).checks:
            if check.kind != "picture" or check.prepare is None:
                continue
            name = f"{module}.{check.function}/{check.name}"
            found[name] = _calibrated(module, check, submissions, seeds)
            told(f"{name}: {found[name]}")
    name = f"{NAME}.scene/picture"
    found[name] = _calibrated_whole(seeds)
    told(f"{name}: {found[name]}")
    return found


def write_tolerances(found: dict[str, dict[str, Any]], seeds: int, path: Path) -> None:
    """Where the checks read them."""
    head = {"made by": f"course calibrate --seeds {seeds}", "version": __version__}
    write_rows(path, head | {"checks": found}, depth=2)


def _calibrated(
    module: str, check: Check, submissions: list[KnownSubmission], seeds: int
) -> dict[str, Any]:
    right = 1.0
    wrong: dict[str, float] = {}
    references = {seed: prepared(reference(module), seed)(module, check) for seed in range(seeds)}
    for submission in submissions:
        if not submission.right and submission.function != check.function:
            continue
        caller = trusted(submission)
        values = [_similarity(module, check, caller, seed, references[seed]) for seed in references]
        if submission.right:
            right = min(right, *values)
        else:
            wrong[submission.name] = max(values)
    return _tolerance(right, wrong)


def _tolerance(right: float, wrong: Mapping[str, float]) -> dict[str, Any]:
    """A check's entry, from the least similar right picture and the most similar one of each wrong submission."""
    least = max(1 - right, ROUNDING)
    seen = {name: value for name, value in wrong.items() if 1 - value > APART * least}
    nearest = max(seen, key=lambda name: seen[name], default="")
    farthest = MARGIN * least
    tolerance = 1 - (min(sqrt(least * (1 - seen[nearest])), farthest) if seen else farthest)
    return {
        "tolerance": round(tolerance, 6),
        "right": round(right, 6),
        "wrong": round(seen[nearest], 6) if seen else None,
        "nearest": nearest,
        "unseen": sorted(wrong.keys() - seen.keys()),
    }


def _calibrated_whole(seeds: int) -> dict[str, Any]:
    """The picture that takes all modules: the right variants of all, one after the other."""
    (check,) = module_checks(NAME).checks
    variants = {module: [k for k in known(module) if k.right] for module in ALL}
    right = 1.0
    for seed in range(seeds):
        references = prepared(reference(NAME), seed)(NAME, check)
        for number in range(min(map(len, variants.values()))):
            caller = Together(
                {module: trusted(found[number]) for module, found in variants.items()}
            )
            right = min(right, _similarity(NAME, check, caller, seed, references))
    return _tolerance(right, {})


def _similarity(module: str, check: Check, caller: Caller, seed: int, references: Any) -> float:
    """SSIM of one picture; -1 where there is none."""
    alone = ModuleChecks(module, (check,))
    (result,) = run_checks(alone, caller, lambda *_: references, seed)
    if result.broken:
        raise RuntimeError(f"seed {seed}: {result.found}\n{result.instructor}")
    if not result.figures:
        return -1.0
    arrays = result.figures[0].arrays
    return ssim(arrays["yours"], arrays["expected"])
