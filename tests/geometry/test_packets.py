"""Packets of 16 rays answer as single rays do."""

import gc
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from course.casters.choice import static_accelerator
from course.compiled import library, packets
from course.compiled.accelerator import PacketAccelerator, in_packets
from course.core import embree
from course.core.accelerator import NO_HIT, Accelerator, QueryStats, StaticAccelerator

if not library.available():
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
def accelerator() -> StaticAccelerator:
    return static_accelerator(*soup(2000, 1))


def packed(accelerator: StaticAccelerator) -> PacketAccelerator:
    found = in_packets(accelerator)
    assert isinstance(found, PacketAccelerator)
    return found


# 1 to 17 and 33: packets that are not full; 20,000: many.
@pytest.mark.parametrize("n", [0, 1, 2, 15, 16, 17, 33, 20_000])
@pytest.mark.parametrize("coherent", [False, True])
def test_nearest_hits_are_the_same_bit_for_bit(
    accelerator: StaticAccelerator, n: int, coherent: bool
) -> None:
    origin, direction = rays(n, n)
    stats = QueryStats()
    single = accelerator.intersect(origin, direction, stats)
    packet = packed(accelerator).intersect(origin, direction, stats, coherent=coherent)
    for name in ("triangle", "u", "v", "t"):
        assert getattr(single, name).tobytes() == getattr(packet, name).tobytes(), name
    if n > 1000:
        hit = packet.triangle >= 0
        assert 0.2 < hit.mean() < 1
        assert (packet.t[~hit] == np.float32(NO_HIT)).all()


@pytest.mark.parametrize("n", [1, 15, 16, 17, 1000])
def test_few_rays_are_answered_alike_without_a_loop(accelerator: StaticAccelerator, n: int) -> None:
    origin, direction = rays(n, n)
    for start in (origin, origin[:, :1]):
        found = packets.packets_of(accelerator).few(start, direction)
        single = accelerator.intersect(start, direction, QueryStats())
        for name in ("triangle", "u", "v", "t"):
            assert getattr(single, name).tobytes() == getattr(found, name).tobytes(), name


def test_triangles_are_built_once(accelerator: StaticAccelerator) -> None:
    built = packets.packets_of(accelerator)
    assert packed(accelerator).packets is built
    assert packed(accelerator).blockers is built


@pytest.mark.parametrize("query", library.QUERIES)
def test_embree_keeps_to_the_rows_of_a_packet(accelerator: StaticAccelerator, query: str) -> None:
    """Shadow queries, too, touch the rows of hits where the processor has no AVX-512."""
    from course.compiled.query_kernels import ALL_ROWS

    guard = np.float32(12345)
    memory = np.full((ALL_ROWS + 41, 16), guard, np.float32)
    memory = memory.reshape(-1)[-memory.ctypes.data % 64 // 4 :][: (ALL_ROWS + 40) * 16]
    packet = memory.reshape(-1, 16)
    packet[:3], packet[4:7] = rays(16, 5)
    packet[3], packet[7], packet[8] = 0, 0, np.inf
    whole = packet.view(np.int32)
    whole[9], whole[10:12], whole[18] = -1, 0, -1
    valid = np.full(32, -1, np.int32)
    valid = valid[-valid.ctypes.data % 64 // 4 :][:16]
    arguments = np.zeros(16, np.uint32)
    arguments[1] = 0xFFFFFFFF
    scene = packed(accelerator).packets
    embree = library.library()
    assert scene is not None
    assert embree is not None
    getattr(embree, query)(
        valid.ctypes.data, scene.scene, packet.ctypes.data, arguments.ctypes.data
    )
    assert (packet[8] < np.inf).any()
    assert (packet[ALL_ROWS:] == guard).all()


def test_limits_hold_and_rays_may_share_an_origin(accelerator: StaticAccelerator) -> None:
    _, direction = rays(5000, 3)
    limit = np.random.default_rng(4).uniform(0, 1, 5000).astype(np.float32)
    origin = np.zeros((3, 1), np.float32)
    single = accelerator.intersect(origin, direction, QueryStats(), limit=limit)
    kept = limit.copy()
    packet = packed(accelerator).intersect(origin, direction, QueryStats(), limit=limit)
    assert (limit == kept).all()
    assert (single.triangle == packet.triangle).all()
    hit = packet.triangle >= 0
    assert 0.05 < hit.mean() < 0.95
    assert (packet.t[hit] < limit[hit]).all()


@pytest.mark.parametrize("n", [0, 1, 16, 31, 20_000])
@pytest.mark.parametrize("limit", [0.3, 1.0, 1e30])
def test_free_ways_are_the_same(accelerator: StaticAccelerator, n: int, limit: float) -> None:
    origin, direction = rays(n, n + 1)
    single = accelerator.unoccluded(origin, direction, limit, QueryStats())
    packet = packed(accelerator).unoccluded(origin, direction, limit, QueryStats())
    assert packet.dtype == np.bool_
    assert (single == packet).all()
    if n > 1000:
        assert 0.02 < packet.mean() < 0.98


def test_columns_need_not_lie_next_to_each_other(accelerator: StaticAccelerator) -> None:
    origin, direction = rays(999, 7)
    stats = QueryStats()
    expected = packed(accelerator).intersect(origin, direction, stats)
    strided = packed(accelerator).intersect(origin.T.copy().T, direction[:, ::-1][:, ::-1], stats)
    assert (expected.triangle == strided.triangle).all()


def test_nothing_and_a_single_triangle() -> None:
    none = static_accelerator(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    nothing = packed(none)
    assert (nothing.intersect(*rays(5, 1), QueryStats()).triangle == -1).all()
    corners = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    one = packed(static_accelerator(corners, np.array([[0, 1, 2]], np.int32)))
    origin = np.array([[0], [0], [-2]], np.float32)
    found = one.intersect(origin, np.array([[0.0], [0.0], [1.0]], np.float32), QueryStats())
    assert found.triangle[0] == 0
    assert found.t[0] == pytest.approx(2, rel=2e-7)


def test_hierarchies_that_nobody_uses_give_their_memory_back(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    queries = library.library()
    assert queries is not None
    gc.collect()
    released = []
    release = queries.rtcReleaseScene
    monkeypatch.setattr(
        queries, "rtcReleaseScene", lambda scene: (released.append(scene), release(scene))
    )
    scene = packets.EmbreePackets(*soup(10, 2))
    number = scene.scene
    del scene
    gc.collect()
    assert released == [number]


@pytest.mark.parametrize("n", [0, 1, 255, 256, 257, 20_000])
def test_rays_that_do_not_enter_the_box_hit_nothing(accelerator: StaticAccelerator, n: int) -> None:
    origin, direction = rays(n, n + 2)
    origin *= 4
    # Along the axes, where slabs are divided by 0, some of them in the box's own planes.
    direction[:, ::7] = np.eye(3, dtype=np.float32)[:, np.arange(n)[::7] % 3]
    origin[:, ::14] = np.float32(1.2)
    limit = np.random.default_rng(6).uniform(0, 6, n).astype(np.float32)
    found = packed(accelerator).intersect(origin, direction, QueryStats(), limit=limit)
    packets = packed(accelerator).packets
    assert packets is not None
    which = packets.entering(origin, direction, limit)
    assert (np.diff(which) > 0).all()
    hit = np.flatnonzero(found.triangle >= 0)
    assert np.isin(hit, which).all()
    # Where they are looked at first, the answers are the same.
    apart = replace(packed(accelerator), apart=True)
    chosen = apart.intersect(origin, direction, QueryStats(), limit=limit)
    assert (chosen.triangle == found.triangle).all()
    assert (
        apart.unoccluded(origin, direction, 1.5, QueryStats())
        == packed(accelerator).unoccluded(origin, direction, 1.5, QueryStats())
    ).all()
    if n > 1000:
        # By slabs of its own: the box has room to spare, and nothing else is let through.
        corners = soup(2000, 1)[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = ((c[:, None] - origin) / direction for c in (corners.min(0), corners.max(0)))
        near = np.fmax.reduce(np.fmin(a, b), axis=0).clip(0)
        far = np.fmin(np.fmin.reduce(np.fmax(a, b), axis=0), limit)
        inside = near < far - 1e-3
        outside = near > far + 1e-3
        assert np.isin(np.flatnonzero(inside), which).all()
        assert not np.isin(np.flatnonzero(outside), which).any()
        assert 0.1 < inside.mean() < 0.9


@pytest.mark.parametrize("apart", [False, True])
def test_where_most_rays_enter_all_are_asked(
    accelerator: StaticAccelerator, apart: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[int] = []
    scene = packets.PacketScene
    intersect, unoccluded = scene.intersect, scene.unoccluded

    def nearest(self: Any, *arguments: Any) -> Any:
        which = arguments[4] if len(arguments) > 4 else None
        asked.append(arguments[1].shape[1] if which is None else len(which))
        return intersect(self, *arguments)

    def free(self: Any, *arguments: Any) -> Any:
        asked.append(arguments[1].shape[1])
        return unoccluded(self, *arguments)

    monkeypatch.setattr(scene, "intersect", nearest)
    monkeypatch.setattr(scene, "unoccluded", free)
    mine, stats = replace(packed(accelerator), apart=apart), QueryStats()
    origin, direction = rays(1000, 8)
    for times, some in ((1, False), (9, apart)):
        asked.clear()
        mine.intersect(times * origin, direction, stats)
        mine.unoccluded(times * origin, direction, 1e30, stats)
        assert len(asked) == 2
        for count in asked:
            assert 0 < count < 500 if some else count == 1000


def test_only_the_hierarchy_that_is_asked_is_built(monkeypatch: pytest.MonkeyPatch) -> None:
    built: list[str] = []
    for module, name in ((embree, "EmbreeScene"), (packets, "EmbreePackets")):
        made = getattr(module, name)
        monkeypatch.setattr(
            module,
            name,
            lambda *arguments, name=name, made=made, **options: (
                built.append(name),
                made(*arguments, **options),
            )[1],
        )
    for wanted, name in ((True, "EmbreePackets"), (False, "EmbreeScene")):
        built.clear()
        mine = static_accelerator(*soup(10, 3))
        assert built == []
        for _ in range(2):
            asked: Accelerator = packed(mine) if wanted else mine
            asked.intersect(*rays(5, 1), QueryStats())
            asked.unoccluded(*rays(5, 1), 1.0, QueryStats())
        assert built == [name]
