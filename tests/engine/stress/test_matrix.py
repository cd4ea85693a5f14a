"""The matrix of the stress suite: its design, its short form, and that each of its statements can fail."""

import dataclasses
import json
import math
import pickle
from collections import Counter
from functools import cache
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from scipy.special import pdtrc

from benchmarks.stress import axes, box, parts, room
from benchmarks.stress.__main__ import main
from benchmarks.stress.axes import AXES, NOTHING, U, level
from benchmarks.stress.cells import (
    AROUND,
    OUTER,
    STAGES,
    Cell,
    all_cells,
    cell_named,
    legal,
    possible_pairs,
    short_form,
    tame,
)
from benchmarks.stress.files import Placement, SceneFiles
from benchmarks.stress.probes import Response, probe
from benchmarks.stress.report import BEGIN, END, rows_of, write_page
from benchmarks.stress.running import judge_all, judge_some, shrunk, wild_levels
from benchmarks.stress.triangles import cut
from benchmarks.stress.verdict import (
    CLOSED_FORMS,
    FALSE_FAIL,
    SCENES,
    Judge,
    Verdict,
    compare,
    most_of,
)
from course import render
from course.engine.core import ray_offset
from course.engine.loops.embree_device import available as packets_available
from course.engine.shapes import displaced_sphere
from tests.lengths import fewer
from tests.once import Once

REJECTION = "ball by rejection"


_once: list[Once] = []


@pytest.fixture(scope="module", autouse=True)
def one_process_designs(once: Once) -> None:
    """Cells are designed where a test asks for them first."""
    _once.append(once)


@cache
def cells() -> tuple[Cell, ...]:
    """All of them; they take seconds to design, which whoever only collects tests need not wait for."""

    def make(file: Path) -> None:
        file.write_bytes(pickle.dumps(all_cells()))

    found: tuple[Cell, ...] = pickle.loads(_once[-1]("cells.pickle", make).read_bytes())
    return found


@cache
def short() -> list[Cell]:
    """The short form."""
    return short_form(cells())


def cell(stage: str, **levels: str) -> Cell:
    """A tame cell but for some levels; underscores stand for spaces."""
    named = {axis.replace("_", " "): name for axis, name in levels.items()}
    home = tame(stage)
    return dataclasses.replace(
        home, levels=home.levels | {a: level(a, n) for a, n in named.items()}
    )


# ---------------------------------------------------------------- the design


def test_there_are_two_thousand_cells_all_legal_and_no_two_alike() -> None:
    assert len(cells()) >= 2000
    assert len({each.name for each in cells()}) == len(cells())
    assert len({(each.stage, str(each.levels)) for each in cells()}) == len(cells())
    assert all(legal(each) for each in cells())


@pytest.mark.parametrize("stage", STAGES)
def test_every_two_levels_meet_that_a_file_can_hold_together(stage: str) -> None:
    met = {pair for each in cells() if each.stage == stage for pair in each.pairs()}
    assert set(possible_pairs(tame(stage), STAGES[stage])) <= met
    # What can't meet is little.
    number = sum(1 for _ in possible_pairs(tame(stage), STAGES[stage]))
    names = [len(AXES[axis]) for axis in STAGES[stage]]
    assert number > 0.98 * (sum(names) ** 2 - sum(n * n for n in names)) / 2


@pytest.mark.parametrize("stage", STAGES)
def test_no_level_is_rare(stage: str) -> None:
    there = [each for each in cells() if each.stage == stage]
    for axis in STAGES[stage]:
        counts = Counter(each.levels[axis].name for each in there)
        assert set(counts) == {each.name for each in AXES[axis]}
        assert min(counts.values()) > len(there) / len(counts) / 2


def test_a_family_of_cells_has_one_twin_which_is_well_conditioned() -> None:
    families = {each.family for each in cells() if each.stage == "room"}
    for _, members in groupby((c for c in cells() if c.stage == "room"), key=lambda c: c.family):
        twins = {str({a: e.value for a, e in each.twin().levels.items()}) for each in members}
        assert len(twins) == 1
    assert 5 * len(families) < sum(each.stage == "room" for each in cells())
    for each in cells():
        twin = each.twin()
        assert (twin["scale"], twin["offset"]) == (1, 0)
        if each.stage != "optics":
            assert twin["triangles"] == ("two", None)
            assert not 0 < twin["aperture"] < 1e-4 or twin["aperture"] == NOTHING


def test_the_short_form_has_every_level() -> None:
    levels = {(c.stage, axis, e.name) for c in cells() for axis, e in c.levels.items()}
    assert {(c.stage, axis, e.name) for c in short() for axis, e in c.levels.items()} == levels
    assert len(short()) < 60


def test_the_engine_offsets_rays_as_the_bound_says() -> None:
    """Change them there, and say in benchmarks/stress/axes.py what the bound becomes."""
    for name in ("OFFSET", "LONG", "MOST"):
        assert getattr(axes, name) == getattr(ray_offset, name)


@pytest.mark.parametrize("closed", [False, True])
@pytest.mark.parametrize("name", [each.name for each in AXES["triangles"]])
def test_however_it_is_cut_the_square_is_covered_once(name: str, closed: bool) -> None:
    kind, size = level("triangles", name).value
    made = cut(kind, size, closed=closed)
    p = made.points[made.triangles]
    a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    area = (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / 2
    assert (area >= 0).all()
    assert area.sum() == pytest.approx(8 if kind in ("doubled", "sheets") else 4)
    assert np.abs(made.points).max() == 1
    if closed:
        # On the border only the corners, which the neighbours have too.
        border = made.points[np.abs(made.points).max(axis=1) == 1]
        assert (np.abs(border) == 1).all()


def test_the_longest_slivers_are_as_long_as_they_say() -> None:
    for name in ("strips 100", "strips 1e+06", "needles 1000", "graded 1e-06"):
        kind, size = level("triangles", name).value
        made = cut(kind, size, closed=False)
        p = made.points[made.triangles]
        edges = np.linalg.norm(p - np.roll(p, 1, axis=1), axis=2)
        ratio = edges.max(axis=1) / edges.min(axis=1)
        assert ratio.max() >= 0.5 * max(size, 1 / size)


# ---------------------------------------------------------------- the cells


@pytest.mark.parametrize("stage", STAGES)
def test_the_short_form_passes(stage: str) -> None:
    for verdict in judge_all([each for each in short() if each.stage == stage], jobs=1):
        assert verdict.passed, verdict
        assert verdict.finite
        assert verdict.share <= 1


@pytest.mark.parametrize("stage", CLOSED_FORMS)
def test_the_closed_form_is_what_the_well_conditioned_twin_shows(
    stage: str, tmp_path: Path
) -> None:
    module = CLOSED_FORMS[stage]
    for depth in ("0", "1", "5"):
        each = cell(stage, depth=depth)
        picture = SCENES[stage](each).picture(tmp_path)
        assert np.abs(picture - module.radiance(each)).max() <= module.tolerance(each).max()


@pytest.mark.parametrize(
    ("axis", "tiny", "levels", "units"),
    [
        # A lobe and a motion of 1e-30 draw numbers, but the picture is that without them.
        ("roughness", "1e-06", {}, 0),
        ("motion", "object 1e-7", {}, 0),
        # These rays go to the point in focus and not along the pinhole's, which is the same to rounding only.
        *(("aperture", "1e-05", {"lens": lens}, 32) for lens in ("disk", "square", "polygon")),
        # These lobes make their directions unit length, which the mirrored ones are to rounding only.
        *(("roughness", "1e-06", {"lobe": lobe}, 32) for lobe in ("ball", "phong")),
    ],
)
def test_what_is_nothing_changes_nothing(
    axis: str, tiny: str, levels: dict[str, str], units: int, tmp_path: Path
) -> None:
    plain = cell("room", sampler="regular", resolution="33 x 17", light="directional", **levels)
    expected = room.room(plain).picture(tmp_path)
    twin = room.room(plain.with_level(axis, tiny).twin()).picture(tmp_path)
    assert np.abs(twin - expected).max() <= units * U * expected.max()


def test_no_pixel_of_the_room_exceeds_its_bound_which_is_not_far_off(tmp_path: Path) -> None:
    for light, least in (("directional", 0.3), ("sky", 0.2), ("rectangle", 0.02)):
        each = cell("room", light=light)
        picture = room.room(each).picture(tmp_path)
        assert least < picture.max() / room.brightest(each) <= 1


@pytest.mark.parametrize("size", ["1e-3", "0.1", "1"])
def test_a_light_that_is_an_object_keeps_its_distance(size: str) -> None:
    """The bound on the energy takes it for a ball that rests on LIGHT."""
    each = cell("room", light="object", light_size=size)
    found = parts.lamp_object(each, parts.placement(each))
    assert found is not None
    thing, _ = found
    sizes = {key: thing[key] for key in ("radius", "amplitude", "segments", "seed")}
    shape = displaced_sphere(**sizes, frequency=6.0)
    distance = np.linalg.norm(shape.vertices, axis=1)
    assert 0.5 * each["light size"] < distance.min()
    assert distance.max() <= each["light size"]
    x, y, z = parts.LIGHT
    assert thing["transform"] == [{"translate": [x, y + each["light size"], z]}]


def test_the_visible_part_is_of_a_visible_sphere(tmp_path: Path) -> None:
    """The same lamp, and about the same light in the room, by other points of it."""
    for size in AXES["light size"]:
        part, whole = (
            parts.lamp(each, parts.placement(each))
            for each in (
                cell("room", light=kind, light_size=size.name)
                for kind in (parts.VISIBLE_PART, "visible sphere")
            )
        )
        assert whole is not None
        assert part == whole | {"samples": "visible"}
        assert "radiance" in whole
    each = cell("room", light=parts.VISIBLE_PART, light_size="1")
    pictures = [
        room.room(some).picture(tmp_path)
        for some in (each, each.with_level("light", "visible sphere"))
    ]
    assert not np.array_equal(*pictures)
    assert 0.9 < pictures[0].mean() / pictures[1].mean() < 1.1
    assert room.least_in_furnace(each) == 0


@pytest.mark.skipif(not packets_available(), reason="without Numba there is one way alone")
def test_a_cell_may_be_judged_with_compiled_loops_or_without(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The same in the picture, the furnace and the twin, and the verdict too."""
    asked = []

    def rendered(*args: Any, **options: Any) -> Any:
        asked.append(options["compiled"])
        return render(*args, **options)

    monkeypatch.setattr("benchmarks.stress.files.render", rendered)
    each = cell("room", light=parts.VISIBLE_PART)
    verdicts = []
    for compiled in (True, False, None):
        verdicts += judge_all([each], 1, compiled=compiled)
        # The twin and sixteen changes of it; the cell and the furnace.
        assert asked == [compiled] * 19
        asked.clear()
    assert all(verdict.passed for verdict in verdicts)
    assert verdicts[0].error == verdicts[1].error


def test_points_by_rejection_are_one_point_in_the_room() -> None:
    """Of a larger light they are all others as soon as one ray meets something else, and no twin has the same."""
    there = [each for each in cells() if each.levels.get("light") == level("light", REJECTION)]
    assert {each["light size"] for each in there if each.stage == "room"} == {0.0, 1e-7, 1e-5}
    assert {each["light size"] for each in there if each.stage == "box"} > {0.1, 1.0, 30.0}


@fewer
@pytest.mark.parametrize("angle", ["steep", "camera 0.0001", "mirror 1e-06"])
@pytest.mark.parametrize("resolution", ["64 x 1", "24 x 18"])
@pytest.mark.parametrize("stage", ["room", "patch", "box"])
def test_the_near_plane_hides_nothing(
    stage: str, resolution: str, angle: str, tmp_path: Path
) -> None:
    """Not even what a lens as large as may be has just before it; twice as deep it may."""
    open_wide = cell(stage, aperture="1", angle=angle, resolution=resolution)
    picture = SCENES[stage](open_wide).picture(tmp_path)
    blind = SCENES[stage](open_wide.with_level("near plane", "1"))
    assert blind.description["camera"]["near"] > 0
    assert np.abs(blind.picture(tmp_path) - picture).max() <= 32 * U * picture.max()


def test_a_camera_in_glass_sees_the_room(tmp_path: Path) -> None:
    each = cell("room", glass=AROUND, resolution="33 x 17")
    seen = room.room(each).picture(tmp_path)
    assert (seen > 0).all()
    assert seen.std(axis=(0, 1)).min() > 0.05 * seen.max()
    # The way from the eye to the near plane absorbs too.
    blind = room.room(each.with_level("near plane", "1")).picture(tmp_path)
    assert np.abs(blind - seen).max() <= 32 * U * seen.max()


def test_scaling_moving_and_turning_keep_shapes() -> None:
    points = np.random.default_rng(0).normal(size=(20, 3))
    place = Placement(7.0, 3.0, 33.0)
    moved = place.points(points)
    distances = [np.linalg.norm(p[:, None] - p[None], axis=2) for p in (points, moved)]
    assert np.allclose(distances[1], 7 * distances[0])
    assert np.allclose(
        moved.mean(axis=0) - place.points(np.zeros((1, 3))), place.vector(*points.mean(axis=0))
    )


# ---------------------------------------------------------------- each statement can fail


@pytest.fixture(scope="module")
def twin(tmp_path_factory: pytest.TempPathFactory) -> Response:
    """The twin of a tame cell of the room."""
    return probe(room.room(cell("room").twin()), tmp_path_factory.mktemp("twin"))


def verdict_on(picture: Any, twin: Response, each: Cell | None = None) -> Verdict:
    verdict = Verdict("made up", {})
    compare(picture, twin, each or cell("room"), verdict)
    return verdict


def test_the_twin_is_equal_to_itself(twin: Response) -> None:
    verdict = verdict_on(twin.picture, twin)
    assert verdict.passed
    assert (verdict.share, verdict.jumps) == (0, 0)


def test_most_of_a_picture_is_smooth_and_its_edges_are_edges(twin: Response) -> None:
    assert 0.01 < twin.edges.mean() < 0.3
    # An edge is where neighbours differ.
    assert (twin.contrast[twin.edges] > 1e-3).all()


def test_a_picture_that_is_a_little_off_is_told(twin: Response) -> None:
    for factor in (1 + 3e-5, 1 - 3e-5):
        assert not verdict_on(twin.picture * factor, twin).passed
    assert verdict_on(twin.picture * (1 + 2 * U), twin).passed


def test_the_power_of_an_object_may_err_as_its_area_does(twin: Response) -> None:
    for size, passes in (("1e-3", True), ("0.1", False)):
        each = cell("room", light="object", light_size=size)
        assert verdict_on(twin.picture * 1.0002, twin, each).passed == passes


def test_one_wrong_pixel_is_told(twin: Response) -> None:
    y, x = np.argwhere(~twin.edges)[50]
    wrong = twin.picture.copy()
    wrong[y, x] *= 1.001
    verdict = verdict_on(wrong, twin)
    assert "1 of 432 pixels differ" in verdict.trouble[0]


def test_a_jump_at_an_edge_is_let_pass_and_many_are_not(twin: Response) -> None:
    wrong = twin.picture.copy()
    at = np.argwhere(twin.edges)
    allowed = verdict_on(wrong, twin).jumps_allowed
    assert 1 <= allowed < len(at) / 4
    for y, x in at[:allowed]:
        wrong[y, x] += 0.25 * twin.contrast[y, x]
    assert verdict_on(wrong, twin).passed
    for y, x in at[allowed : 2 * allowed]:
        wrong[y, x] += 0.25 * twin.contrast[y, x]
    assert "pixels at edges" in verdict_on(wrong, twin).trouble[0]


def test_a_firefly_at_an_edge_is_told(twin: Response) -> None:
    y, x = np.argwhere(twin.edges)[0]
    wrong = twin.picture.copy()
    wrong[y, x] += 5 * twin.contrast[y, x]
    assert verdict_on(wrong, twin).trouble == [
        "a pixel at an edge shows what is not seen around it"
    ]


def test_thin_triangles_excuse_as_many_pixels_as_they_cover(twin: Response) -> None:
    thin = cell("room", triangles="strips 10000")
    smooth = np.argwhere(~twin.edges & (twin.steepness > 0.1))
    wrong = twin.picture.copy()
    for y, x in smooth[:5]:
        wrong[y, x] += thin.levels["triangles"].thin_shift * twin.steepness[y, x]
    assert verdict_on(wrong, twin, thin).passed
    assert not verdict_on(wrong, twin).passed
    everywhere = twin.picture + (thin.levels["triangles"].thin_shift * twin.steepness)[..., None]
    assert not verdict_on(everywhere, twin, thin).passed


@pytest.mark.parametrize("value", [math.nan, math.inf, -1e-9])
@pytest.mark.parametrize("stage", STAGES)
def test_a_pixel_that_is_no_radiance_is_told(
    stage: str, value: float, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    picture = np.full((18, 24, 3), 0.5)
    picture[3, 4, 1] = value
    monkeypatch.setattr(Judge, "_picture", lambda *_: picture)
    verdict = Judge(tmp_path)(cell(stage))
    assert not verdict.passed
    assert not verdict.finite


@pytest.mark.parametrize("stage", CLOSED_FORMS)
def test_a_pixel_that_is_not_the_closed_form_is_told(
    stage: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    module, each = CLOSED_FORMS[stage], cell(stage)
    for factor in (1 + 1e-5, 1 - 1e-5):
        picture = np.broadcast_to(module.radiance(each), (18, 24, 3)).copy()
        monkeypatch.setattr(Judge, "_picture", lambda *_, p=picture: p)
        assert Judge(tmp_path)(each).passed
        picture[3, 4] *= factor
        assert not Judge(tmp_path)(each).passed


def test_energy_that_is_created_or_lost_is_told(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    each, judge = cell("room", depth="16"), Judge(tmp_path)
    shown = judge.twin(each).picture
    for furnace, told in ((1 + 1e-4, "created"), (0.5, "lost"), (1.0, "")):
        pictures = iter((shown, np.full(shown.shape, furnace)))
        monkeypatch.setattr(Judge, "_picture", lambda *_, p=pictures: next(p))
        trouble = judge(each).trouble
        assert [told in each for each in trouble] == ([True] if told else [])


def test_an_error_in_a_cell_is_its_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Judge, "_picture", lambda *_: 1 / 0)
    verdict = judge_some([cell("box")])[0]
    assert verdict.trouble == ["ZeroDivisionError: division by zero"]


def test_a_poisson_variable_hardly_ever_exceeds_its_most() -> None:
    for mean in (1e-9, 1e-4, 0.1, 1.0, 10.0, 300.0, 5000.0):
        n = most_of(mean)
        assert pdtrc(n, mean) <= FALSE_FAIL
        assert n == 0 or mean > 700 or pdtrc(n - 1, mean) > FALSE_FAIL


def test_a_failing_cell_is_shrunk_to_what_makes_it_fail(monkeypatch: pytest.MonkeyPatch) -> None:
    def picture(_self: Judge, files: Any) -> Any:
        far = "offset" if abs(files.description["camera"]["eye"][0]) > 1e3 else ""
        return np.full((18, 24, 3), math.nan if far else 0.3 * 3)

    monkeypatch.setattr(Judge, "_picture", picture)
    wild = cell("box", offset="1e+06", triangles="fine 24", roughness="1", corner="35 degrees")
    assert wild_levels(shrunk(wild)) == {"offset": "1e+06"}


# ---------------------------------------------------------------- the report


def test_rows_hold_the_worst_of_their_cells() -> None:
    verdicts = [
        Verdict("a", {"scale": "metre"}, True, 0.9, 1e-7, 0.5, 1, 2),
        Verdict("b", {"scale": "metre"}, True, 0.5, 3e-7, 0.2, 0, 2, 0.1, ["broken"]),
        Verdict("c", {"scale": "parsec"}, True, 0.1, 0.0, 0.0, 0, 0),
    ]
    metre, parsec, every = rows_of(verdicts)
    assert (metre.cells, metre.failed, metre.error, metre.share, metre.jumps) == (
        2,
        1,
        3e-7,
        0.5,
        1,
    )
    assert (parsec.level, parsec.cells, parsec.failed) == ("parsec", 1, 0)
    assert (every.cells, every.failed, every.energy) == (3, 1, 0.9)


def test_the_page_keeps_what_others_have_written(tmp_path: Path) -> None:
    page = tmp_path / "docs" / "accuracy.md"
    verdicts = [Verdict("a", {"scale": "metre"}, True)]
    write_page(verdicts, page)
    assert page.read_text().startswith("# Accuracy\n\n" + BEGIN)
    page.write_text("# Mine\n\nbefore\n\n" + page.read_text().split("\n\n", 1)[1] + "\nafter\n")
    write_page([*verdicts, Verdict("b", {"scale": "parsec"}, True)], page)
    text = page.read_text()
    assert text.startswith("# Mine\n\nbefore\n\n" + BEGIN)
    assert text.endswith("\nafter\n")
    assert text.count(BEGIN) == text.count(END) == 1
    assert "parsec" in text
    assert "Every cell passed." in text


def test_one_cell_can_be_judged_alone_from_the_command_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    name = next(each.name for each in short() if each.stage == "box")
    done = CliRunner().invoke(main, ["--cell", name])
    assert done.exit_code == 0, done.output
    assert f"{name} passed" in done.output
    kept = json.loads((tmp_path / f"out/stress/{name}/cell/scene.yaml").read_text())
    assert kept == box.box(cell_named(name)).description
    refused = CliRunner().invoke(main, ["--cell", "room-9999"])
    assert refused.exit_code == 2
    assert "no cell room-9999" in refused.output


def test_the_cells_of_one_light_can_be_judged_from_the_command_line(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    asked = []
    monkeypatch.setattr(SceneFiles, "picture", lambda _self, _folder, how: asked.append(how))
    command = ["--light", parts.VISIBLE_PART, "--short", "--compiled", "--jobs", "1", "--json", "a"]
    CliRunner().invoke(main, command)
    levels = [each["levels"] for each in json.loads((tmp_path / "a").read_text())["verdicts"]]
    assert {each["light"] for each in levels} == {parts.VISIBLE_PART}
    assert len(levels) > 5
    assert set(asked) == {True}
    refused = CliRunner().invoke(main, ["--light", "lantern"])
    assert refused.exit_code == 2


def test_a_broken_cell_is_the_exit_code_and_is_named(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(Judge, "_picture", lambda *_: np.full((1, 1, 3), math.nan))
    done = CliRunner().invoke(
        main, ["--short", "--stage", "box", "--jobs", "1", "--json", "a.json"]
    )
    assert done.exit_code == 1
    written = json.loads((tmp_path / "a.json").read_text())
    assert len(written["failed"]) == written["cells"] > 5
    assert f"python -m benchmarks.stress --cell {written['failed'][0]}" in done.output


def test_the_outer_axes_are_those_on_which_twins_are_alike() -> None:
    for axis in OUTER:
        assert len({str(each.twin) for each in AXES[axis]}) == 1
