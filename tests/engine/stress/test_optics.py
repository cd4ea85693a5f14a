"""The cells that physics judges: what is wrong in the renderer's own formulae is told by them, in either form of it."""

import math
from typing import Any

import numpy as np
import pytest

from benchmarks.stress import optics
from benchmarks.stress.cells import Cell, tame
from benchmarks.stress.running import judge_some
from course.engine.core import scatter
from course.engine.terms.scattering import conductors, rough_glass
from tests.forms import in_both_forms
from tests.lengths import fewer


def made_of(substance: str, beyond: str = "darker") -> list[Cell]:
    """Plates that are looked at askew, in which every ray that matters is followed."""
    home = tame("optics").with_level("substance", substance).with_level("beyond", beyond)
    home = home.with_level("depth", "16")
    return [home.with_level("incidence", f"{degrees} degrees") for degrees in (30, 56.31, 75)]


def refracting(substance: str) -> list[Cell]:
    """Those of them in which some light goes through."""
    return made_of(substance)[: 1 if substance == "thin" else None]


def failed(cells: list[Cell], compiled: bool) -> int:
    return sum(not verdict.passed for verdict in judge_some(cells, compiled))


@fewer
@in_both_forms
@pytest.mark.parametrize("substance", optics.SUBSTANCES)
def test_every_substance_is_as_physics_has_it(substance: str, compiled: bool) -> None:
    beyond = "the same" if substance == "frosted glass" else "darker"
    assert not failed(made_of(substance, beyond), compiled)


def schlick(cos_i: Any, eta: Any) -> Any:
    """A reflectance that conserves energy, has the right value straight on and along the surface, and is wrong."""
    share, cos_t = RIGHT(cos_i, eta)
    straight = ((1 - eta) / (1 + eta)) ** 2
    cosine = np.where(eta > 1, cos_t, cos_i)
    return np.where(share == 1, share, straight + (1 - straight) * (1 - cosine) ** 5), cos_t


RIGHT = scatter.fresnel_and_cos_t


@pytest.mark.parametrize("substance", ["glass", "thin", "diamond", "coloured glass"])
def test_a_wrong_reflectance_of_glass_is_told(
    substance: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    cells = refracting(substance)
    monkeypatch.setattr(scatter, "fresnel_and_cos_t", schlick)
    # The two formulae meet at some angle, which for the coloured glass is 75 degrees.
    assert failed(cells, compiled=False) >= max(1, len(cells) - 1)


@pytest.mark.parametrize("substance", ["gold", "chromium"])
def test_a_wrong_reflectance_of_metals_is_told(
    substance: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    cells = made_of(substance)
    monkeypatch.setattr(conductors, "conductor_reflectance", conductors.approximate_reflectance)
    assert failed(cells, compiled=False) == len(cells)


def test_light_that_frosted_glass_keeps_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    cells = [cell.with_level("depth", "2") for cell in made_of("frosted glass", "the same")]
    right = rough_glass.bend

    def wrong(*arguments: Any) -> Any:
        return right(*arguments[:6], None, arguments[7])

    monkeypatch.setattr(rough_glass, "bend", wrong)
    assert failed(cells, compiled=False) == len(cells)


def test_the_formulae_are_those_of_the_books() -> None:
    """Straight on, at Brewster's angle, at the critical one, and silver's in Born and Wolf's table."""
    assert optics.reflectance(0.0, 1.5) == pytest.approx(0.04)
    brewster = math.atan(1.5)
    across = ((1.5**2 - 1) / (1.5**2 + 1)) ** 2
    assert optics.reflectance(brewster, 1.5) == pytest.approx(across / 2)
    assert optics.reflectance(math.asin(1 / 1.33) + 1e-9, 1 / 1.33) == 1
    n, k = 0.2, 3.44
    straight = ((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k)
    assert optics.metal_reflectance(0.0, complex(n, k)) == pytest.approx(straight)
    assert optics.metal_reflectance(0.7, complex(1.5, 1e-12)) == pytest.approx(
        optics.reflectance(0.7, 1.5)
    )


def test_a_plate_in_a_furnace_cannot_be_seen() -> None:
    for substance in ("glass", "thin", "diamond"):
        for cell in made_of(substance, "the same"):
            deep = cell.with_level("depth", "64")
            assert np.allclose(optics.radiance(deep), optics.brightest(deep), rtol=1e-12)
