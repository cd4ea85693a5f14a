"""The checks of every function vary what a student may get wrong: nothing is always the same that need not be."""

import re

import pytest

from benchmarks.mutants.varied import FunctionSeen, gaps, varying
from course.engine.functions.modules import COURSE
from tests.lengths import share
from tests.school.solutions.contract import SOLUTIONS

EXCUSED = {
    "in 1 of 8 octants": (
        *("u", "pdf", "barycentric", "albedo", "beta"),
        *("radiosity", "emission", "reflectance", "unshot", "patch_radiosity"),
        *("radiance", "rgb", "encoded", "n", "k"),
        *("mean", "mean_a", "mean_b", "means", "variance", "variance_a", "variance_b", "variances"),
        *("filtered_variance", "critical"),
    ),
    "in 7 of 8 octants": ("filtered",),
    # Numbers of samples, statistics in standard errors and pixels have no unit that could be another.
    "only": ("count_a", "count_b", "t", "critical", "distance"),
    # Negative parts of an index are refused; a view looks from above, but for the worst directions.
    "in 2 of 8 octants": ("n", "k"),
    "in 5 of 8 octants": ("wo",),
    # Two colours that aren't any are asked for as well: one with a negative number, one with a number that is none.
    "in 3 of 8 octants": ("sigma_t", "sigma_s", "weights"),
}
"""What can't be negative: random numbers, densities, places in a triangle, light, its colours, shares and
variances, indices of refraction, and heights of what looks at a surface; beside what a solution's text says so of."""


def named(gap: str) -> tuple[str, str]:
    """The argument of a gap, and the function: of "module.function argument: ..."."""
    function, argument = gap.partition(":")[0].rpartition(".")[2].split()
    return argument, function


def is_never_negative(module: str, argument: str, function: str) -> bool:
    """Whether the solution's text says so: "power : (3, N) floating >= 0"."""
    text = SOLUTIONS.function(module, function).__doc__ or ""
    (said,) = re.findall(rf"^    (?:\w+, )*{argument}(?:, \w+)* : (.*)$", text, re.MULTILINE)[
        :1
    ] or [""]
    return bool(re.search(r"floating (>= 0|in \[0, 1)", said))


def unexcused(module: str, seen: dict[str, FunctionSeen]) -> list[str]:
    return [
        gap
        for gap in gaps(module, seen)
        if not (gap.endswith("in 1 of 8 octants") and is_never_negative(module, *named(gap)))
        and not any(
            gap.endswith(end) and gap.rpartition(":")[0].split()[-1] in names
            for end, names in EXCUSED.items()
        )
    ]


@pytest.mark.parametrize("module", share([*COURSE], 3))
def test_nothing_is_always_the_same_that_need_not_be(module: str) -> None:
    found: list[str] = []
    for seen in varying(module):
        found = unexcused(module, seen)
        # What is varied once stays so: no other seed takes it back.
        if not found:
            break
    assert not found, "\n".join(found)
