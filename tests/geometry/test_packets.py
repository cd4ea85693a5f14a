"""Packets of 16 rays answer as single rays do."""

from __future__ import annotations

import gc

import numpy as np
import pytest

from course.geometry import embree, packets
from course.geometry.embree import NO_HIT, Accelerator, QueryTime

if not packets.available():
    pytest.skip("Numba is not installed (pip install .[fast])", allow_module_level=True)


def soup(triangles: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Triangles that share no corner, all over [-1, 1]^3."""
    rng = np.random.default_rng(seed)
    center = rng.uniform(-1, 1, (triangles, 1, 3))
    corners = center + rng.normal(0, 0.1, (triangles, 3, 3))
    return (
        corners.reshape(-1, 3).astype(np.float32),
        np.arange(3 * triangles, dtype=np.int32).reshape(-1, 3),
    )


def rays(n: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(seed)
    direction = rng.normal(size=(3, n))
    direction /= np.sqrt((direction**2).sum(axis=0))
    return rng.uniform(-1, 1, (3, n)).astype(np.float32), direction.astype(np.float32)


@pytest.fixture(scope="module")
def accelerator() -> Accelerator:
    return Accelerator(*soup(2000, 1))


def both(accelerator: Accelerator, wanted: bool) -> Accelerator:
    accelerator.use_packets(wanted)
    return accelerator


# 1 to 17 and 33: packets that are not full; 20,000: many.
@pytest.mark.parametrize("n", [0, 1, 2, 15, 16, 17, 33, 20_000])
@pytest.mark.parametrize("coherent", [False, True])
def test_nearest_hits_are_the_same_bit_for_bit(
    accelerator: Accelerator, n: int, coherent: bool
) -> None:
    origin, direction = rays(n, n)
    clock = QueryTime()
    single = both(accelerator, False).intersect(origin, direction, clock)
    packet = both(accelerator, True).intersect(origin, direction, clock, coherent=coherent)
    for name in ("triangle", "u", "v", "t"):
        assert getattr(single, name).tobytes() == getattr(packet, name).tobytes(), name
    if n > 1000:
        hit = packet.triangle >= 0
        assert 0.2 < hit.mean() < 1
        assert (packet.t[~hit] == np.float32(NO_HIT)).all()


def test_limits_hold_and_rays_may_share_an_origin(accelerator: Accelerator) -> None:
    _, direction = rays(5000, 3)
    limit = np.random.default_rng(4).uniform(0, 1, 5000).astype(np.float32)
    origin = np.zeros((3, 1), np.float32)
    single = both(accelerator, False).intersect(origin, direction, QueryTime(), limit=limit)
    kept = limit.copy()
    packet = both(accelerator, True).intersect(origin, direction, QueryTime(), limit=limit)
    assert (limit == kept).all()
    assert (single.triangle == packet.triangle).all()
    hit = packet.triangle >= 0
    assert 0.05 < hit.mean() < 0.95
    assert (packet.t[hit] < limit[hit]).all()


@pytest.mark.parametrize("n", [0, 1, 16, 31, 20_000])
@pytest.mark.parametrize("limit", [0.3, 1.0, 1e30])
def test_free_ways_are_the_same(accelerator: Accelerator, n: int, limit: float) -> None:
    origin, direction = rays(n, n + 1)
    single = both(accelerator, False).unoccluded(origin, direction, limit, QueryTime())
    packet = both(accelerator, True).unoccluded(origin, direction, limit, QueryTime())
    assert packet.dtype == np.bool_
    assert (single == packet).all()
    if n > 1000:
        assert 0.02 < packet.mean() < 0.98


def test_columns_need_not_lie_next_to_each_other(accelerator: Accelerator) -> None:
    origin, direction = rays(999, 7)
    clock = QueryTime()
    expected = both(accelerator, True).intersect(origin, direction, clock)
    strided = accelerator.intersect(origin.T.copy().T, direction[:, ::-1][:, ::-1], clock)
    assert (expected.triangle == strided.triangle).all()


def test_nothing_and_a_single_triangle() -> None:
    nothing = Accelerator(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    nothing.use_packets(True)
    assert (nothing.intersect(*rays(5, 1), QueryTime()).triangle == -1).all()
    corners = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    one = Accelerator(corners, np.array([[0, 1, 2]], np.int32))
    one.use_packets(True)
    origin = np.array([[0], [0], [-2]], np.float32)
    found = one.intersect(origin, np.array([[0.0], [0.0], [1.0]], np.float32), QueryTime())
    assert found.triangle[0] == 0
    assert found.t[0] == 2


def test_hierarchies_that_nobody_uses_give_their_memory_back(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    library = packets._library()
    assert library is not None
    gc.collect()
    released = []
    release = library.rtcReleaseScene
    monkeypatch.setattr(
        library, "rtcReleaseScene", lambda scene: (released.append(scene), release(scene))
    )
    scene = packets.PacketScene(*soup(10, 2))
    number = scene._scene
    del scene
    gc.collect()
    assert released == [number]


@pytest.mark.parametrize("n", [0, 1, 255, 256, 257, 20_000])
def test_rays_that_do_not_enter_the_box_hit_nothing(accelerator: Accelerator, n: int) -> None:
    origin, direction = rays(n, n + 2)
    origin *= 4
    # Along the axes, where slabs are divided by 0, some of them in the box's own planes.
    direction[:, ::7] = np.eye(3, dtype=np.float32)[:, np.arange(n)[::7] % 3]
    origin[:, ::14] = np.float32(1.2)
    limit = np.random.default_rng(6).uniform(0, 6, n).astype(np.float32)
    accelerator = both(accelerator, True)
    found = accelerator.intersect(origin, direction, QueryTime(), limit=limit)
    packets = accelerator._packets
    assert packets is not None
    which = packets.entering(origin, direction, limit)
    assert (np.diff(which) > 0).all()
    hit = np.flatnonzero(found.triangle >= 0)
    assert np.isin(hit, which).all()
    if n > 1000:
        # By slabs of its own: the box has room to spare, and nothing else is let through.
        corners = soup(2000, 1)[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = ((c[:, None] - origin) / direction for c in (corners.min(0), corners.max(0)))
        near = np.fmax.reduce(np.fmin(a, b), axis=0).clip(0)
        far = np.fmin(np.fmin.reduce(np.fmax(a, b), axis=0), limit)
        inside = near < far - 1e-3
        apart = near > far + 1e-3
        assert np.isin(np.flatnonzero(inside), which).all()
        assert not np.isin(np.flatnonzero(apart), which).any()
        assert 0.1 < inside.mean() < 0.9


def test_where_most_rays_enter_all_are_asked(accelerator: Accelerator) -> None:
    origin, direction = rays(1000, 8)
    far = np.full(1, NO_HIT, np.float32)
    clock = QueryTime()
    assert both(accelerator, True).entering(origin, direction, far, clock) is None
    chosen = both(accelerator, True).entering(9 * origin, direction, far, clock)
    assert chosen is not None
    assert 0 < len(chosen) < 500
    assert both(accelerator, False).entering(9 * origin, direction, far, clock) is None


def test_only_the_hierarchy_that_is_asked_is_built(monkeypatch: pytest.MonkeyPatch) -> None:
    built: list[str] = []
    for name in ("EmbreeScene", "PacketScene"):
        made = getattr(embree, name)
        monkeypatch.setattr(
            embree,
            name,
            lambda *arguments, name=name, made=made, **options: (
                built.append(name),
                made(*arguments, **options),
            )[1],
        )
    for wanted, name in ((True, "PacketScene"), (False, "EmbreeScene")):
        built.clear()
        mine = Accelerator(*soup(10, 3))
        assert built == []
        for _ in range(2):
            mine.use_packets(wanted)
            assert mine.compiled == wanted
            mine.intersect(*rays(5, 1), QueryTime())
            mine.unoccluded(*rays(5, 1), 1.0, QueryTime())
        assert built == [name]
    # Whoever asks without having said how asks for single rays.
    built.clear()
    Accelerator(*soup(10, 3)).intersect(*rays(5, 1), QueryTime())
    assert built == ["EmbreeScene"]
