"""Compiled loops over lights and hits give what the passes over arrays give, bit for bit."""

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from course.compiled import library
from course.compiled.direct import CompiledDirectLight
from course.compiled.direct import towards as compiled_towards
from course.compiled.stages import CompiledIntegrator, CompiledSobolSampler
from course.core.counters import Counters
from course.core.direct import DENSE, Candidates, DirectLight
from course.core.hits import Hits
from course.core.integrator import Integrator
from course.core.lights.sample import Sample, towards
from course.core.materials import Lookup
from course.core.rays import Dimensions, Draws
from course.core.samplers import Block
from course.extras.samplers.sobol import SobolSampler
from tests.transport.coarse_sphere import hits_on_a_coarse_sphere

if not library.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)

N = 5000


def same(mine: Any, theirs: Any) -> None:
    assert (mine.shape, mine.dtype) == (theirs.shape, theirs.dtype)
    assert mine.tobytes() == theirs.tobytes()


@pytest.fixture(scope="module")
def hits() -> Hits:
    return hits_on_a_coarse_sphere(N, 4, seed=4)


@pytest.mark.parametrize("of_its_own", [True, False], ids=["a point each", "one point"])
@pytest.mark.parametrize(
    ("normal", "two_sided"), [(None, False), ([0, -0.6, 0.8], False), ([0, -0.6, 0.8], True)]
)
def test_what_arrives(hits: Hits, of_its_own: bool, normal: Any, two_sided: bool) -> None:
    rng = np.random.default_rng(6)
    on_light = rng.normal(size=(3, N if of_its_own else 1)).astype(np.float32)
    if of_its_own:
        # As close as can be: no light is infinitely bright.
        on_light[:, :20] = np.nextafter(hits.near_origin[:, :20], np.float32(9))
    normal = None if normal is None else np.array(normal, np.float32)
    passes, loop = (
        form(on_light, hits.near_origin, normal, two_sided) for form in (towards, compiled_towards)
    )
    for name in ("to_light", "inverse_length", "factor"):
        same(getattr(passes, name), getattr(loop, name))
    assert np.isfinite(loop.factor).all()
    if of_its_own:
        assert (loop.factor[:20] > 1e10).all() or normal is not None
        assert ((loop.factor == 0).sum() > N / 5) == (normal is not None and not two_sided)


def forms(shaded: Any = None) -> tuple[DirectLight, DirectLight]:
    """Passes over arrays, and the loops."""
    nothing: Any = None
    stage = nothing, (), None, shaded, nothing, None, nothing
    return DirectLight(*stage), CompiledDirectLight(*stage)


PASSES, LOOPS = forms()


def faced(
    hits: Hits, sample: Sample, shaded: Any = None
) -> tuple[Candidates | None, Candidates | None]:
    """By passes over arrays, and by the loops."""
    passes, loop = (form._candidates(hits, sample) for form in forms(shaded))
    return passes, loop


def assert_same_light(hits: Hits, passes: Candidates | None, loop: Candidates | None) -> None:
    """The same hits show the light, and their arrays are the same there; the rest of them get nothing."""
    assert passes is not None
    assert loop is not None
    same(passes.index, loop.index)
    place = loop.index if passes.columns is None and loop.columns is not None else slice(None)
    for name in ("irradiance", "cosine", "origin", "to_light", "inverse_length"):
        mine, theirs = getattr(passes, name), getattr(loop, name)
        same(mine[..., place] if mine.shape[-1] == hits.size else mine, theirs)
    assert loop.mask is None
    if passes.mask is not None:
        same(np.flatnonzero(passes.mask), loop.index)
        assert not passes.irradiance[~passes.mask].any()


@pytest.mark.parametrize("shape", [N, 1], ids=["a direction each", "one direction"])
@pytest.mark.parametrize("front", [0.0, 1.0], ids=["few", "most"])
@pytest.mark.parametrize(
    "shaded",
    [None, [[True, False, True, True]], [[False] * 4], [[True] * 4, [True, False, False, True]]],
)
def test_which_hits_face_the_light(hits: Hits, shape: int, front: float, shaded: Any) -> None:
    rng = np.random.default_rng(7)
    to_light = rng.normal(size=(3, shape)).astype(np.float32)
    if front:
        # So that most hits face it, from one direction as from many.
        to_light += np.float32(3) * (hits.ns if shape > 1 else hits.ns.mean(axis=1, keepdims=True))
    sample = Sample(
        to_light,
        1 / np.linalg.norm(to_light, axis=0).astype(np.float32),
        np.maximum(rng.normal(size=shape) + front, 0 if shape > 1 else 1).astype(np.float32),
    )
    shaded = None if shaded is None else np.array(shaded)
    passes, loop = faced(hits, sample, shaded)
    if shaded is not None and not shaded.any():
        assert passes is None
        assert loop is None
        return
    assert_same_light(hits, passes, loop)
    assert passes is not None
    assert 500 < len(passes.index) < N
    # Copies are made where few face it, and only there.
    assert (passes.columns is None) == (len(passes.index) >= DENSE * N)
    if shaded is None and shape > 1:
        assert (passes.columns is None) == (front > 0)


def test_all_hits_face_the_light(hits: Hits) -> None:
    """Then nothing is gathered."""
    sample = Sample(hits.ns, np.ones(N, np.float32), np.ones(N, np.float32))
    passes, loop = faced(hits, sample)
    assert_same_light(hits, passes, loop)
    for each in (passes, loop):
        assert each is not None
        assert len(each.index) == N
        assert each.columns is None
        assert each.mask is None
        assert each.origin is hits.near_origin


def test_a_light_that_is_no_number_lights_nothing(hits: Hits) -> None:
    """By passes over all hits it would, times 0: only copies leave it behind."""
    factor = np.ones(N, np.float32)
    factor[7] = np.nan
    passes, loop = faced(hits, Sample(hits.ns, np.ones(N, np.float32), factor))
    assert_same_light(hits, passes, loop)
    assert passes is not None
    assert passes.columns is not None
    assert 7 not in passes.index
    assert np.isfinite(passes.irradiance).all()


@pytest.mark.parametrize("share", [0.3, 0.9], ids=["few", "most"])
def test_which_facets_turn_away(hits: Hits, share: float) -> None:
    rng = np.random.default_rng(8)
    to_light = rng.normal(size=(3, N)).astype(np.float32)
    # Nothing but chance says which of them face it, so some of those that don't look as if their facets turned away.
    factor = np.sign((hits.ns * to_light).sum(axis=0)) * np.where(rng.random(N) < share, 1, -1)
    passes, loop = faced(hits, Sample(to_light, np.ones(N, np.float32), factor.astype(np.float32)))
    assert_same_light(hits, passes, loop)
    assert passes is not None
    assert loop is not None
    assert (passes.columns is None) == (share > DENSE)
    found = [
        each.hit(form._turned_away(hits, each, each.to_light, np.float32(0.3)))
        for form, each in ((PASSES, passes), (LOOPS, loop))
    ]
    same(*found)
    assert 100 < len(found[1]) < len(loop.index)


def test_lights_add_up(hits: Hits) -> None:
    rng = np.random.default_rng(9)
    totals: list[Any] = [None, None]
    for share in (0.3, 1.0, 0.8):
        factor = np.where(rng.random(N) < share, 1, 0).astype(np.float32)
        sample = Sample(hits.ns, np.ones(N, np.float32), factor)
        color = rng.random(3, np.float32)
        for number, (form, each) in enumerate(
            zip((PASSES, LOOPS), faced(hits, sample), strict=True)
        ):
            assert each is not None
            totals[number] = form._accumulated(totals[number], hits, each, each.irradiance, color)
        same(*totals)
    assert (totals[1] > 0).any()


@pytest.mark.parametrize("tinted", [False, True], ids=["plain", "textures"])
@pytest.mark.parametrize("shiny", [False, True], ids=["matt", "highlights"])
@pytest.mark.parametrize("alike", [False, True], ids=["four colours", "one colour"])
def test_colours_of_materials(hits: Hits, alike: bool, shiny: bool, tinted: bool) -> None:
    rng = np.random.default_rng(12)
    colors, specular = rng.random((2, 3, 4), np.float32)
    if alike:
        colors[:] = colors[:, :1]
    if tinted:
        hits = replace(hits, tint=rng.random((3, N), np.float32))
    arriving = rng.random((2, 3, N), np.float32)
    totals = []
    for form in (PASSES, LOOPS):
        stage = replace(form, diffuse=Lookup(colors), specular=Lookup(specular) if shiny else None)
        diffuse, highlights = arriving.copy()
        totals.append(stage._reflected(hits, diffuse, highlights if shiny else None))
    same(*totals)


def test_radiance_is_added_to_the_film() -> None:
    """Several rays of a path, into a stretch of a larger film."""
    rng = np.random.default_rng(10)
    path = rng.integers(600, size=N)
    radiance, throughput = rng.random((2, 3, N), np.float32)
    films = np.zeros((2, 3, 1000), np.float32)
    stages: Any = [None] * len(fields(Integrator))
    for film, form in zip(films, (Integrator, CompiledIntegrator), strict=True):
        form(*stages).add_radiance(film[:, 200:800], path, radiance.copy(), throughput)
    same(*films)
    assert np.allclose(films[1].sum(axis=1), (radiance * throughput).sum(axis=1), rtol=1e-4)
    assert not films[1][:, :200].any()
    assert not films[1][:, 800:].any()


@pytest.mark.parametrize("samples", [16, 12, 1])
@pytest.mark.parametrize(("dimension", "width"), [(0, 2), (3, 1), (6, 2), (6, 1), (9, 1), (4, 4)])
def test_the_same_numbers_are_drawn(samples: int, dimension: int, width: int) -> None:
    rng = np.random.default_rng(11)
    block = Block(rng.permutation(90000)[:800].astype(np.uint32), 3 * samples, samples, 5)
    drawn = []
    path = rng.permutation(block.size)[: block.size // 3]
    skip = dimension % 2
    dimensions = Dimensions([("before", dimension - skip), ("light", skip + width)], [])
    for sampler in (SobolSampler(7), CompiledSobolSampler(SobolSampler(7))):
        draws = Draws(sampler, dimensions, block, Counters())
        drawn.append(draws("light", path, width=width, skip=skip))
    same(*drawn)
    same(drawn[1], SobolSampler(7).draw(block, dimension, width).take(path, axis=1))
