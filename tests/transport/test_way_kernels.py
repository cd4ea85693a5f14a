"""Compiled loops over the ways of light give what the passes over arrays give, bit for bit."""

from dataclasses import fields
from typing import Any

import numpy as np
import pytest

from course import render
from course.compiled import library
from course.compiled.scatter import CompiledPathBounce, CompiledScatter
from course.core.materials import Lookup
from course.core.scatter import Scatter
from course.extras.path_bounce import DIFFUSE, MIRRORED, REFRACTED, PathBounce
from course.extras.plan import same_fields
from tests.conftest import MakeScene
from tests.transport.coarse_sphere import hits_on_a_coarse_sphere

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

GLASS = {"color": 0, "dielectric": {"refraction_index": 1.5}}
MATERIALS = {
    "floor": {"color": [0.6, 0.3, 0.1], "mirror": [0.1, 0.2, 0.3]},
    "wall": {"color": 0.7},
    "mirror": {"color": 0, "mirror": [0.9, 0.5, 0.4]},
}


@pytest.mark.parametrize("glass", [True, False], ids=["glass", "no glass"])
def test_the_same_way_and_throughput(
    make_scene: MakeScene, monkeypatch: pytest.MonkeyPatch, glass: bool
) -> None:
    taken: list[Any] = []
    passes = PathBounce._chosen

    def both(bounce: PathBounce, *arguments: Any) -> Any:
        mine = passes(bounce, *arguments)
        theirs = CompiledPathBounce(**same_fields(bounce))._chosen(*arguments)
        for one, other in zip(mine, theirs, strict=True):
            assert (one.shape, one.dtype) == (other.shape, other.dtype)
            assert one.tobytes() == other.tobytes()
        taken.append(mine[1].take(arguments[4]))
        return mine

    monkeypatch.setattr(PathBounce, "_chosen", both)
    materials = ["floor", "mirror", "glass" if glass else "wall"]
    scene = make_scene(
        camera={"eye": [0, 1, 4], "look_at": [0, 0, 0]},
        film={"width": 40, "height": 30},
        sampler={"samples": 16},
        integrator={"type": "path", "max_depth": 6, "roulette": 2},
        environment={"type": "constant", "radiance": [0.5, 0.6, 0.7]},
        materials=MATERIALS | ({"glass": GLASS} if glass else {}),
        lights=[{"type": "sphere", "center": [0, 3, 2], "radius": 0.3, "intensity": 9}],
        objects=[
            {"shape": "quad", "material": "floor", "width": 8, "depth": 8}
            | {"transform": [{"translate": [0, -0.6, 0]}]},
            *(
                {"shape": "sphere", "radius": 0.5, "segments": 24, "material": material}
                | {"transform": [{"translate": [number - 1.0, 0, 0]}]}
                for number, material in enumerate(materials)
            ),
        ],
    )
    render(scene, threads=1, compiled=False)
    ways = np.concatenate(taken)
    assert len(taken) > 4
    for way, some in ((DIFFUSE, True), (MIRRORED, True), (REFRACTED, glass)):
        assert (np.count_nonzero(ways == way) > 1000) == some


def both_forms(index: Any) -> tuple[Scatter, Scatter]:
    """Passes over arrays, and the loops."""
    surface: Any = None
    stage = surface, Lookup(np.zeros((3, 3), np.float32)), Lookup(index), None, False, None, 0.0
    return Scatter(*stage), CompiledScatter(*stage)


@pytest.mark.parametrize("some", [False, True], ids=["all hits", "some hits"])
def test_the_same_division_and_refracted_directions(some: bool) -> None:
    """Opaque, a dense and a thin medium: total reflection on either side."""
    hits = hits_on_a_coarse_sphere(6000, 3, seed=5)
    which = np.arange(0, hits.size, 3) if some else None
    index = np.array([0, 1.5, 0.7], np.float32)
    results = []
    draws: Any = None
    for scatter in both_forms(index):
        boundary = scatter.boundary(hits, which, None, 0, draws)
        chosen = np.arange(hits.size) if which is None else which
        glass = np.flatnonzero(index[hits.material[chosen]] > 0)
        there = boundary.of(glass)
        way = scatter.refracted(hits, chosen[glass], there, glass, 0, draws)
        shares = boundary.reflected, boundary.refracted
        results.append((*shares, there.cos_i, there.cos_t, there.eta, way))
    for one, other in zip(*results, strict=True):
        assert (one.shape, one.dtype) == (other.shape, other.dtype)
        assert one.tobytes() == other.tobytes()
    share, passed, _, cos_t, _, way = results[0]
    opaque = index[hits.material[which if some else slice(None)]] == 0
    assert not share[opaque].any()
    assert not passed[opaque].any()
    assert ((share == 1) & ~opaque).sum() > 100
    assert (cos_t == 0).sum() > 100
    assert (share[~opaque][cos_t == 0] == 1).all()
    assert np.allclose(share + passed, ~opaque, atol=1e-6)
    # Snell, and none comes back through the surface.
    ng = hits.ng[:, which if some else slice(None)][:, ~opaque]
    assert ((way * ng).sum(axis=0) < 1e-6).all()


def test_the_same_order_of_ways() -> None:
    nothing: Any = [None] * len(fields(PathBounce))
    rng = np.random.default_rng(8)
    kind = rng.integers(3, size=5000).astype(np.int8)
    for goes_on in (rng.random(5000) < 0.6, np.ones(5000, np.bool_), np.zeros(5000, np.bool_)):
        passes, loop = (
            form(*nothing)._ordered(goes_on, kind) for form in (PathBounce, CompiledPathBounce)
        )
        assert passes[0].tobytes() == loop[0].tobytes()
        assert passes[1:] == loop[1:]
        which, scattered, above = loop
        assert (kind[which[:scattered]] == DIFFUSE).all()
        assert (kind[which[scattered:above]] == MIRRORED).all()
        assert (kind[which[above:]] == REFRACTED).all()
        assert sorted(which) == np.flatnonzero(goes_on).tolist()


def test_the_same_places_to_leave_from() -> None:
    hits = hits_on_a_coarse_sphere(6000, 3, seed=5)
    rng = np.random.default_rng(9)
    after = rng.random((3, hits.size), np.float32)
    which = rng.permutation(hits.size)[:4000]
    for crossing in (0, 1500, 4000):
        passes, loop = (
            form.origins(hits, which, crossing, after) for form in both_forms(np.ones(3, "f4"))
        )
        for one, other in zip(passes, loop, strict=True):
            assert (one.shape, one.dtype) == (other.shape, other.dtype)
            assert one.tobytes() == other.tobytes()
        origin, throughput = loop
        side = ((origin - hits.p[:, which]) * hits.ng[:, which]).sum(axis=0)
        assert (side[:crossing] > 0).all()
        assert (side[crossing:] < 0).all()
        assert (throughput == after[:, which]).all()
