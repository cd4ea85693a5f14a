"""Rendering on a Dask cluster: a real scheduler and its workers, each a process of its own on this machine."""

import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import Picture, Scene, load_scene, render
from course.base.errors import CourseError, EffectError
from course.engine.core.tiles import Tile, Work
from course.engine.formats.meshes.files import save_ply
from course.engine.formats.pictures.files import save
from course.engine.functions.modules import MODULES
from course.engine.render.cluster import connection as connection_module
from course.engine.render.cluster import executor as cluster_module
from course.engine.render.cluster.executor import PIECE, next_piece
from course.engine.render.cluster.parcel import KeptScenes, WorkOrder, edition, pack, unpack
from course.engine.shapes.curved import sphere
from tests.dask_cluster import Cluster
from tests.engine.conftest import EveryStage
from tests.lengths import fewer

ROOT = Path(__file__).parents[4]


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """A scheduler with two workers of one thread each."""
    pytest.importorskip("distributed", reason='the engine dask is an extra: pip install ".[dask]"')
    with closing(Cluster(tmp_path_factory.mktemp("cluster"))) as started:
        started.add_worker()
        started.add_worker()
        started.wait_for_workers(2)
        yield started


def film_of(kind: str) -> dict[str, Any]:
    # 80 x 70 pixels make several tiles at 16 samples, the last of a row and of a column narrower.
    return {"width": 80, "height": 70, "filter": kind}


def assert_same(here: Picture, there: Picture) -> None:
    assert here.linear.std() > 0
    assert here.linear.tobytes() == there.linear.tobytes()
    assert np.array_equal(here.film.samples, there.film.samples)
    assert here.receipt.rays == there.receipt.rays
    assert here.receipt.numbers == there.receipt.numbers
    assert here.receipt.samples == there.receipt.samples
    assert here.complete
    assert there.complete


@fewer
@pytest.mark.parametrize("filter_", ["box", "gaussian"])
@pytest.mark.parametrize(
    ("sampler", "samples"), [("sobol", 40), ("random", 24), ("jittered", 16), ("regular", 16)]
)
def test_a_cluster_renders_the_same_bits_and_counts_the_same(
    every_stage: EveryStage, cluster: Cluster, sampler: str, samples: int, filter_: str
) -> None:
    scene = every_stage(film=film_of(filter_))
    there = render(scene, sampler=sampler, spp=samples, address=cluster.address)
    assert_same(render(scene, sampler=sampler, spp=samples, threads=1), there)
    assert there.receipt.threads == 2
    assert there.receipt.seconds["trace"] > 0
    assert there.receipt.embree_seconds > 0


def test_samples_go_where_the_error_is_as_they_do_here(
    every_stage: EveryStage, cluster: Cluster
) -> None:
    scene = every_stage()
    here = render(scene, error=0.008, spp=256)
    assert len(np.unique(here.film.samples)) > 1
    there = render(scene, error=0.008, spp=256, address=cluster.address)
    assert_same(here, there)
    assert here.receipt.error == there.receipt.error


def test_a_picture_is_continued_elsewhere(every_stage: EveryStage, cluster: Cluster) -> None:
    scene = every_stage()
    start = render(scene, spp=24)
    more = render(scene, spp=40, start=start, address=cluster.address)
    assert more.linear.tobytes() == render(scene, spp=40).linear.tobytes()


def test_a_time_limit_begins_when_the_workers_have_the_scene(
    every_stage: EveryStage, cluster: Cluster, tmp_path: Path
) -> None:
    mine = tmp_path / "mine"
    shutil.copytree(ROOT / "solutions", mine)
    with (mine / "supersampling.py").open("a") as module:
        module.write("\nimport sys, time\nif 'dask_worker' in sys.argv[0]:\n    time.sleep(1.5)\n")
    scene = load_scene(every_stage().path, effects=mine)
    began = time.monotonic()
    picture = render(scene, time_limit=1, address=cluster.address)
    assert time.monotonic() - began >= 2.5
    assert picture.film.samples.min() >= 1
    assert not picture.complete


def test_progress_goes_from_nothing_to_all(every_stage: EveryStage, cluster: Cluster) -> None:
    told: list[tuple[float, bool]] = []
    scene = every_stage(film=film_of("box"))
    render(scene, spp=64, address=cluster.address, progress=lambda *now: told.append(now))
    assert told == sorted(told)
    assert told[0][0] < 1
    assert not told[0][1]
    assert told[-1] == (1.0, True)


def test_ctrl_c_keeps_what_there_is(every_stage: EveryStage, cluster: Cluster) -> None:
    scene = every_stage(film={"width": 96, "height": 64})

    def progress(_done: float, covered: bool) -> None:
        if covered:
            signal.raise_signal(signal.SIGINT)

    picture = render(scene, spp=65536, progress=progress, address=cluster.address)
    assert picture.interrupted
    assert not picture.complete
    samples = np.unique(picture.film.samples)
    assert 16 <= samples[0] <= samples[-1] < 65536
    these = picture.film.samples == samples[0]
    assert np.array_equal(
        picture.linear[these], render(scene, spp=int(samples[0])).linear[these]
    ), "every pixel is right for its samples"


def test_a_worker_lost_half_way_loses_nothing(
    every_stage: EveryStage, cluster: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A tile a task, so that there is much to do half-way.
    monkeypatch.setattr(cluster_module, "PIECE", 1e-9)
    scene = every_stage(film={"width": 160, "height": 120, "filter": "gaussian"})
    lost = cluster.add_worker()
    cluster.wait_for_workers(3)
    killed_at: list[float] = []

    def progress(done: float, _covered: bool) -> None:
        if 0.2 < done < 0.9 and not killed_at:
            lost.kill()
            lost.wait()
            killed_at.append(done)

    there = render(scene, spp=48, progress=progress, address=cluster.address)
    assert killed_at
    assert there.receipt.threads == 3
    assert_same(render(scene, spp=48), there)


@pytest.fixture(scope="module")
def scheduler(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    """A scheduler without a worker."""
    pytest.importorskip("distributed", reason='the engine dask is an extra: pip install ".[dask]"')
    with closing(Cluster(tmp_path_factory.mktemp("scheduler"))) as started:
        yield started


@pytest.fixture
def lone(scheduler: Cluster) -> Iterator[Cluster]:
    """A scheduler with a single worker, which may be killed; what is left of its workers goes afterwards."""
    scheduler.add_worker()
    scheduler.wait_for_workers(1)
    yield scheduler
    scheduler.close_workers()


@pytest.fixture
def mortal(tmp_path: Path) -> Iterator[Cluster]:
    """The same with a scheduler of its own, which may be killed, too."""
    pytest.importorskip("distributed", reason='the engine dask is an extra: pip install ".[dask]"')
    with closing(Cluster(tmp_path)) as started:
        started.add_worker()
        started.wait_for_workers(1)
        yield started


@pytest.mark.parametrize(
    ("which", "told"),
    [("mortal", "the scheduler has gone"), ("lone", "all workers have gone")],
    ids=["scheduler", "worker"],
)
def test_a_cluster_that_goes_is_told(
    every_stage: EveryStage,
    request: pytest.FixtureRequest,
    monkeypatch: pytest.MonkeyPatch,
    which: str,
    told: str,
) -> None:
    monkeypatch.setattr(connection_module, "ALONE", 0.3)
    cluster: Cluster = request.getfixturevalue(which)
    goes = cluster.scheduler if which == "mortal" else cluster.processes[-1]

    def progress(done: float, _covered: bool) -> None:
        if done > 0:
            goes.kill()

    with pytest.raises(CourseError, match=told):
        render(every_stage(), spp=65536, progress=progress, address=cluster.address)


@pytest.mark.parametrize("direct", [False, True], ids=["asked", "cut off"])
def test_a_scheduler_that_goes_while_results_are_fetched_is_told(
    every_stage: EveryStage, mortal: Cluster, monkeypatch: pytest.MonkeyPatch, direct: bool
) -> None:
    """What the client meets then depends on the moment: so it is also made to meet a connection that is cut off."""
    distributed = pytest.importorskip("distributed")
    gather = distributed.Client.gather
    asked = []

    async def cut_off() -> None:
        raise distributed.comm.CommClosedError("reset by peer")

    def at_the_wrong_moment(self: Any, *arguments: Any, **keywords: Any) -> Any:
        asked.append(arguments)
        if len(asked) < 3:
            return gather(self, *arguments, **keywords)
        mortal.scheduler.kill()
        return cut_off() if direct else gather(self, *arguments, **keywords)

    monkeypatch.setattr(distributed.Client, "gather", at_the_wrong_moment)
    with pytest.raises(CourseError, match="the scheduler has gone"):
        render(every_stage(), spp=65536, address=mortal.address)
    assert len(asked) == 3


class Loss:
    """A worker dies when it has told that it is done with something, and nobody has got that yet."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, worker: subprocess.Popen[bytes]) -> None:
        self.worker = worker
        self.covered = self.happened = False
        self._arrived = cluster_module.arrived
        monkeypatch.setattr(cluster_module, "arrived", self._lost)

    def progress(self, _done: float, covered: bool) -> None:
        """Of a render; nothing is lost until every pixel has something."""
        self.covered |= covered

    def _lost(self, ended: Any) -> list[Any]:
        arrived = [*self._arrived(ended)]
        if arrived and self.covered and not self.happened:
            self.worker.kill()
            self.worker.wait()
            self.happened = True
        return arrived


def test_the_last_worker_goes_with_what_it_has_done(
    every_stage: EveryStage, lone: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(connection_module, "ALONE", 0.3)
    loss = Loss(monkeypatch, lone.processes[-1])
    with pytest.raises(CourseError, match="all workers have gone"):
        render(every_stage(), spp=65536, progress=loss.progress, address=lone.address)
    assert loss.happened


@pytest.mark.parametrize("ends", ["time limit", "Ctrl-C"])
def test_what_is_lost_is_not_awaited_when_the_render_is_to_end(
    every_stage: EveryStage, lone: Cluster, monkeypatch: pytest.MonkeyPatch, ends: str
) -> None:
    loss = Loss(monkeypatch, lone.processes[-1])

    def progress(done: float, covered: bool) -> None:
        loss.progress(done, covered)
        if loss.happened and ends == "Ctrl-C":
            signal.raise_signal(signal.SIGINT)

    picture = render(
        every_stage(),
        spp=65536,
        time_limit=3 if ends == "time limit" else None,
        progress=progress,
        address=lone.address,
    )
    assert loss.happened
    assert not picture.complete
    assert picture.film.samples.min() >= 1


def test_another_worker_does_again_what_was_lost(
    every_stage: EveryStage, lone: Cluster, monkeypatch: pytest.MonkeyPatch
) -> None:
    lone.add_worker()
    lone.wait_for_workers(2)
    loss = Loss(monkeypatch, lone.processes[-1])
    scene = every_stage()
    there = render(scene, spp=512, progress=loss.progress, address=lone.address)
    assert loss.happened
    assert_same(render(scene, spp=512), there)


def test_what_a_function_raises_on_a_worker_is_raised_here(
    every_stage: EveryStage, cluster: Cluster, tmp_path: Path
) -> None:
    scene = every_stage(lights=[])
    module = tmp_path / "supersampling.py"
    module.write_text("def resolve(radiance, weights):\n    raise ZeroDivisionError('in a tile')\n")
    with pytest.raises(
        EffectError, match=r"raised ZeroDivisionError: in a tile in line 2 of supersampling"
    ):
        render(load_scene(scene.path, effects=tmp_path), address=cluster.address)
    module.write_text(
        "def resolve(radiance, weights):\n"
        "    raise NotImplementedError('supersampling.resolve: not written yet')\n"
    )
    with pytest.raises(EffectError, match=r"supersampling.resolve: not written yet .*asks for it"):
        render(load_scene(scene.path, effects=tmp_path), address=cluster.address)


def test_an_address_where_nobody_answers_is_told(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed", reason='the engine dask is an extra: pip install ".[dask]"')
    assert connection_module.ANSWER_WITHIN == 10
    monkeypatch.setattr(connection_module, "ANSWER_WITHIN", 0.5)
    scene = every_stage()
    with socket.socket() as deaf:
        deaf.bind(("127.0.0.1", 0))
        port = deaf.getsockname()[1]
        for listens in (False, True):
            if listens:
                deaf.listen()
            began = time.monotonic()
            with pytest.raises(CourseError, match=rf"^tcp://127.0.0.1:{port}: no dask scheduler"):
                render(scene, address=f"tcp://127.0.0.1:{port}")
            # Left to itself, a client waits for 30 seconds or for ever.
            assert time.monotonic() - began < 25
    with pytest.raises(CourseError, match=r"^nonsense: no dask scheduler"):
        render(scene, address="nonsense")


def test_a_missing_package_is_told_with_the_way_to_get_it(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(CourseError, match=r'pip install "penumbra-course\[dask\]"'):
        render(every_stage(), address="tcp://127.0.0.1:1")


def test_threads_are_not_for_a_cluster(every_stage: EveryStage) -> None:
    with pytest.raises(CourseError, match="workers of a cluster have their own"):
        render(every_stage(), threads=2, address="tcp://127.0.0.1:1")


@pytest.fixture
def far(make_scene: Callable[..., Scene], tmp_path: Path) -> Scene:
    """A scene of all effects whose mesh, pictures and functions have paths up, down and from the root."""
    shutil.copytree(ROOT / "solutions", tmp_path / "mine")
    (tmp_path / "meshes").mkdir()
    save_ply(sphere(1.0, 16), tmp_path / "meshes" / "ball.ply")
    rng = np.random.default_rng(5)
    for name in "abcdef":
        save(tmp_path / f"{name}.exr", rng.random((3, 4, 4), np.float32))
    plain = make_scene(
        camera={
            "eye": [0, 0.5, 4],
            "look_at": [0.5, 0, 0],
            "lens": {"aperture_radius": 0.1, "focus_point": [0, 0, 1]},
            "shutter": {"open": 0, "close": 0.5},
        },
        film={"width": 80, "height": 70, "filter": "gaussian"},
        sampler={"type": "sobol", "samples": 20},
        environment={
            "type": "cube",
            "faces": [str(tmp_path / "a.exr"), *(f"{name}.exr" for name in "bcdef")],
        },
        materials={
            "grey": {},
            "gold": {"mirror": 0.9, "gloss": {"lobe": "phong", "exponent": 40}},
            "glass": {"dielectric": {"refraction_index": 1.5}},
        },
        lights=[{"type": "sphere", "center": [1, 3, 3], "radius": 0.5, "intensity": 9}],
        objects=[
            {"shape": "mesh", "file": f"../{tmp_path.name}/meshes/ball.ply", "material": "gold"},
            {"shape": "mesh", "file": "meshes/ball.ply", "material": "grey"}
            | {"transform": [{"translate": [1.5, 0, 0.1]}], "motion": {"velocity": [0, 1, 0]}},
            {"shape": "sphere", "radius": 0.4, "material": "glass"}
            | {"transform": [{"translate": [0.6, 0.1, 1.6]}]},
        ],
    )
    return load_scene(plain.path, effects=tmp_path / "mine")


def test_a_parcel_is_the_scene_where_none_of_its_files_is(far: Scene, tmp_path: Path) -> None:
    here = render(far)
    parcel = pack(far)
    assert parcel == pack(far), "the digest is that of the content"
    shutil.rmtree(far.path.parent)
    there = tmp_path / "there"
    there.mkdir(parents=True)
    assert_same(here, render(unpack(parcel.content, there)))


def test_a_scene_of_all_effects_and_its_files_is_sent_to_a_cluster(
    far: Scene, cluster: Cluster
) -> None:
    here = render(far)
    called = {function.partition(".")[0] for function in here.receipt.effects["called"]}
    assert called == set(MODULES)
    assert_same(here, render(far, address=cluster.address))


def test_a_file_that_has_gone_is_told(far: Scene) -> None:
    (far.path.parent / "meshes" / "ball.ply").unlink()
    with pytest.raises(CourseError, match=r"scene.yaml: a file that it names has gone.*ball.ply"):
        render(far, address="tcp://127.0.0.1:1")


def test_a_worker_compiles_a_scene_once_and_keeps_two(
    every_stage: EveryStage, monkeypatch: pytest.MonkeyPatch
) -> None:
    folders: list[Path] = []

    def counted(content: bytes, folder: Path) -> Scene:
        folders.append(folder)
        return unpack(content, folder)

    monkeypatch.setattr("course.engine.render.cluster.parcel.unpack", counted)
    scene = every_stage()
    order = WorkOrder(scene.settings, False, edition())
    parcels = [pack(every_stage(seed=seed)) for seed in range(3)]
    with closing(KeptScenes()) as kept:
        first = kept.tracer(parcels[0], order)
        assert kept.tracer(parcels[0], order) is first
        more = kept.tracer(parcels[0], replace(order, settings=replace(scene.settings, samples=9)))
        assert more.settings.samples == 9
        assert more.integrator.surface is first.integrator.surface
        assert len(folders) == 1
        kept.tracer(parcels[1], order)
        kept.tracer(parcels[0], order)
        assert len(folders) == 2
        kept.tracer(parcels[2], order)
        assert [folder.exists() for folder in folders] == [True, False, True], "the oldest goes"
        for parcel in (parcels[0], parcels[2]):
            kept.tracer(parcel, order)
        assert len(folders) == 3
    assert not any(folder.exists() for folder in folders)


def test_a_worker_with_another_edition_of_the_course_refuses(every_stage: EveryStage) -> None:
    scene = every_stage()
    with pytest.raises(CourseError, match=r"a worker runs course .*, and here is course 0.0"):
        KeptScenes().tracer(pack(scene), WorkOrder(scene.settings, False, "course 0.0"))


@pytest.mark.parametrize(
    ("seconds_a_tile", "tiles"), [(0.0, 1), (PIECE / 5, 5), (PIECE * 2, 1), (1e-6, 16)]
)
def test_pieces_are_worth_handing_out(seconds_a_tile: float, tiles: int) -> None:
    work = [Work(Tile(number, 0, 0, 8, 4), 0, 0, 2, True) for number in range(40)]
    rest = iter(work)
    pieces = list(iter(lambda: next_piece(rest, seconds_a_tile / 64), []))
    assert [item for piece in pieces for item in piece] == work
    assert {len(piece) for piece in pieces[:-1]} == {tiles}
