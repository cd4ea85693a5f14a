"""More than students are asked for: the reference keeps its laws in double precision, and for the worst numbers."""

from copy import deepcopy
from itertools import product

import numpy as np
import pytest

from course.school.grading.checks import declare, laws
from course.school.grading.checks.check import Trial
from course.school.grading.checks.declare import Arguments, Case, Function
from course.school.grading.checks.drawing import Draw
from course.school.grading.checks.laws import DTYPES
from course.school.grading.references import reference
from tests.school.solutions.contract import assert_unit, named, worst_units
from tests.school.solutions.test_conventions import FUNCTIONS

PRECISE = 1e-14
"""Takes the place of single precision's epsilon where all is computed in double precision."""

ROUNDED = {"lookup", "lookup_seamless", "texture_lookup"}
"""Functions whose laws round the colours that they expect to nine decimals."""

INEXACT = {
    # The results are single precision by contract.
    *("hemicube_form_factors/top", "hemicube_form_factors/side", "xorshift32/random"),
    "regular/centres",
    # Some of the worst directions are of unit length to ten digits only.
    *("orthonormal_basis/poles", "diffuse_bounce/poles"),
    # The expected chord of a square of 1e-6 is a difference from 1.
    "jitter_on_plane/extremes",
    # It is made of a law and arguments of its own.
    "estimate/one_channel",
    # The contract asks for 0.5 %.
    *(f"critical_value/{law}" for law in ("one", "normal", "values", "hundreds")),
}


class InDouble(Function):
    """Its batches are double precision, whatever a law asks for."""

    def make(self, draw: Draw, case: Case | None = None) -> Arguments:
        return super().make(draw.but(dtype=np.float64), case)


@FUNCTIONS
def test_in_double_precision_the_reference_is_as_exact(
    module: str, function: Function, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(laws, "EPSILON", 1e-10 if function.name in ROUNDED else PRECISE)
    for law in function.laws:
        if law.kind == "property" and f"{function.name}/{law.name}" not in INEXACT:
            trial = Trial(function.name, reference(module), np.random.default_rng(103))
            with named(law.name):
                law.run(InDouble(**vars(function)), trial)


class AtItsEnds(Function):
    """Arguments that no case makes are those at the ends of what is legal."""

    def make(self, draw: Draw, case: Case | None = None) -> Arguments:
        plain = Function(**vars(self))
        return plain.make(draw, case) if case else plain.ends(draw)[0]


@FUNCTIONS
def test_the_reference_keeps_its_laws_at_the_ends_of_what_is_legal(
    module: str, function: Function, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Numbers u around 0, 0.5 and 1, and the smallest there are; directions on and around the axes."""
    monkeypatch.setattr(declare, "worst_units", worst_units)
    trial = Trial(function.name, reference(module), np.random.default_rng(104))
    for dtype, scale in product(DTYPES, function.scales or (1.0,)):
        ends = function.ends(Draw(trial.rng, 1, dtype, scale))
        for a in ends:
            value = trial.call(*deepcopy([*a.values()]))
            found = function.seen(value, a, function.promoted(a) or np.float32)
            parts = found if isinstance(found, tuple) else (found,)
            for part, result in zip(parts, function.results, strict=True):
                if result.unit:
                    assert_unit(part)
    # A function's own corners, such as a light without extent, leave most laws without a meaning.
    if len(ends) > len(function.corners):
        for law in function.laws:
            if law.kind == "property" and law.case is None and law.name != "smooth":
                law.run(AtItsEnds(**vars(function)), trial)
