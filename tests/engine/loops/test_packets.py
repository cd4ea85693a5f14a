"""Packets of 16 rays answer as single rays do."""

import gc

import numpy as np
import pytest

from course.engine.casters.choice import static_accelerator
from course.engine.core import embree
from course.engine.core.accelerator import NO_HIT, QueryStats, StaticAccelerator
from course.engine.loops import embree_device, packets
from course.engine.loops.scene_tables import scene_tables

if not embree_device.available():
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


# 1 to 17 and 33: packets that are not full; 3,000: many.
@pytest.mark.parametrize("n", [0, 1, 2, 15, 16, 17, 33, 3000])
def test_nearest_hits_are_the_same_bit_for_bit(accelerator: StaticAccelerator, n: int) -> None:
    origin, direction = rays(n, n)
    for start in (origin, origin[:, :1]):
        found = packets.packets_of(accelerator).few(start, direction)
        single = accelerator.intersect(start, direction, QueryStats())
        for name in ("triangle", "u", "v", "t"):
            assert getattr(single, name).tobytes() == getattr(found, name).tobytes(), name
        if n > 1000:
            hit = found.triangle >= 0
            assert 0.2 < hit.mean() < 1
            assert (found.t[~hit] == np.float32(NO_HIT)).all()


def test_triangles_are_built_once(accelerator: StaticAccelerator) -> None:
    built = packets.packets_of(accelerator)
    assert packets.packets_of(accelerator) is built
    tables = scene_tables(accelerator)
    assert tables.scenes.tolist() == tables.blockers.tolist() == [built.scene]


@pytest.mark.parametrize("query", embree_device.queries())
def test_embree_keeps_to_the_rows_of_a_packet(accelerator: StaticAccelerator, query: str) -> None:
    """Shadow queries, too, touch the rows of hits where the processor is narrower."""
    guard, width = np.float32(12345), packets.WIDTH
    memory = np.full((packets.ALL_ROWS + 57, width), guard, np.float32)
    memory = memory.reshape(-1)[-memory.ctypes.data % 64 // 4 :][: (packets.ALL_ROWS + 40) * width]
    packet = memory.reshape(-1, width)
    packet[:3], packet[4:7] = rays(width, 5)
    packet[3], packet[7], packet[8] = 0, 0, np.inf
    whole = packet.view(np.int32)
    whole[9], whole[10:12], whole[18] = -1, 0, -1
    valid = np.full(32, -1, np.int32)
    valid = valid[-valid.ctypes.data % 64 // 4 :][:width]
    arguments = np.zeros(16, np.uint32)
    arguments[1] = 0xFFFFFFFF
    scene = packets.packets_of(accelerator)
    embree = embree_device.library()
    assert embree is not None
    getattr(embree, query)(
        valid.ctypes.data, scene.scene, packet.ctypes.data, arguments.ctypes.data
    )
    assert (packet[8] < np.inf).any()
    assert (packet[packets.ALL_ROWS :] == guard).all()


def test_nothing_and_a_single_triangle() -> None:
    none = static_accelerator(np.zeros((0, 3), np.float32), np.zeros((0, 3), np.int32))
    assert scene_tables(none).scenes.tolist() == [0]
    corners = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    one = packets.packets_of(static_accelerator(corners, np.array([[0, 1, 2]], np.int32)))
    origin = np.array([[0], [0], [-2]], np.float32)
    found = one.few(origin, np.array([[0.0], [0.0], [1.0]], np.float32))
    assert found.triangle[0] == 0
    assert found.t[0] == pytest.approx(2, rel=2e-7)


def test_hierarchies_that_nobody_uses_give_their_memory_back(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    queries = embree_device.library()
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
            if wanted:
                scene_tables(mine)
            else:
                mine.intersect(*rays(5, 1), QueryStats())
        assert built == [name]
