"""`course render`: options in, one whole file out, and what is said when that can't be."""

import errno
import json
from pathlib import Path

import numpy as np
import pytest

from course.base.errors import SceneError
from tests.cli.conftest import Run, files
from tests.cli.stand_in import RECEIPT, Engine, Picture


def test_the_picture_has_the_scenes_name_and_lies_here(
    run: Run, engine: Engine, tmp_path: Path
) -> None:
    result = run("render", Path("far", "box.yaml"))
    assert result.exit_code == 0
    assert files(tmp_path) == {"box.png"}
    assert engine.loaded == [(Path("far", "box.yaml"), {"effects": None})]


def test_what_options_leave_open_is_left_to_the_scene(run: Run, engine: Engine) -> None:
    run("render", "box.yaml")
    (options,) = engine.rendered
    assert set(options) == {
        *("spp", "size", "sampler", "seed", "threads", "time_limit"),
        *("error", "progress", "address", "denoise", "shafts"),
    }
    assert not options.pop("shafts")
    assert set(options.values()) == {None}


def test_options_reach_the_renderer(run: Run, engine: Engine, tmp_path: Path) -> None:
    options = (
        "--spp 9 --size 64x48 --sampler jittered --seed 7 --threads 3 --time-limit 2.5 --error 0.25"
    )
    result = run("render", "box.yaml", "-o", "a.EXR", "--effects", "assignments", *options.split())
    assert result.exit_code == 0
    assert engine.loaded[0][1] == {"effects": "assignments"}
    assert engine.rendered[0].pop("since") > 0
    assert engine.rendered == [
        {
            "spp": 9,
            "size": (64, 48),
            "sampler": "jittered",
            "seed": 7,
            "threads": 3,
            "time_limit": 2.5,
            "error": 0.25,
            "progress": None,
            "address": None,
            "denoise": None,
            "shafts": False,
        }
    ]
    assert files(tmp_path) == {"a.EXR"}


def test_shafts_that_were_asked_for_and_spared_nothing_are_told(run: Run, engine: Engine) -> None:
    told = run("render", "box.yaml", "--shafts").output
    assert "--shafts: all rays were sent" in told
    assert engine.rendered[-1]["shafts"] is True
    assert "shafts" not in run("render", "box.yaml").output


def test_the_address_of_a_cluster_reaches_the_renderer(run: Run, engine: Engine) -> None:
    assert run("render", "box.yaml", "--engine", "dask", "--address", "tcp://far:1").exit_code == 0
    (options,) = engine.rendered
    assert options["address"] == "tcp://far:1"
    assert options["threads"] is None


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ("--engine dask", "--engine dask needs --address tcp://HOST:PORT"),
        ("--address tcp://far:1", "--address is for --engine dask"),
        ("--engine threads --address tcp://far:1", "--address is for --engine dask"),
        ("--engine dask --address tcp://far:1 --threads 2", "--threads is for --engine threads"),
        *((to, "must end in .png or .exr") for to in ("-o a.gif", "-o .", "--heat-map a.gif")),
    ],
)
def test_what_can_not_be_done_is_told_before_the_work(
    run: Run, engine: Engine, tmp_path: Path, options: str, told: str
) -> None:
    result = run("render", "box.yaml", *options.split())
    assert result.exit_code == 1
    assert result.stderr.startswith("error: ")
    assert told in result.stderr
    assert not engine.loaded
    assert not files(tmp_path)


WRONG = {
    "--engine": ("cloud",),
    "--spp": ("0", "65537", "many"),
    "--size": ("640", "640x0", "65537x1", "-1x5", "1e2x5"),
    "--sampler": ("latin",),
    "--seed": ("-1", "4294967296"),
    "--threads": ("0",),
    "--time-limit": ("0", "-1", "nan", "inf", "soon"),
    "--error": ("0", "-0.1", "nan", "inf", "little"),
    "--receipt": ("box.yaml",),
    "--no-such-option": ("",),
}


@pytest.mark.parametrize(("option", "value"), [(name, v) for name, of in WRONG.items() for v in of])
def test_wrong_usage_exits_2_and_renders_nothing(
    run: Run, engine: Engine, tmp_path: Path, option: str, value: str
) -> None:
    result = run("render", "box.yaml", option, value)
    assert result.exit_code == 2
    assert option in result.stderr
    assert not engine.loaded
    assert not files(tmp_path)


@pytest.mark.usefixtures("engine")
def test_the_limits_of_the_options_are_allowed(run: Run) -> None:
    for options in (
        "--spp 1 --size 65536x1 --seed 0 --threads 1 --time-limit 1e-3 --error 1e-9",
        "--spp 65536 --size 1x65536 --seed 4294967295",
    ):
        assert run("render", "box.yaml", *options.split()).exit_code == 0


@pytest.mark.parametrize(
    ("error", "told"),
    [
        (SceneError("box.yaml:3: objects[0].radius is -1"), "box.yaml:3: objects[0].radius is -1"),
        (NotImplementedError("thin_lens.lens_rays: not written yet"), "not written yet"),
        (MemoryError(), "not enough memory"),
        (MemoryError("3 TB"), "not enough memory: 3 TB"),
        (PermissionError(errno.EACCES, "Permission denied", "/a.ply"), "/a.ply: permission denied"),
        (OSError(errno.ENOSPC, "No space left on device"), "error: no space left on device"),
        (OSError(errno.ENAMETOOLONG, "", "x" * 300), f"too long for a file: {'x' * 80}..."),
    ],
)
def test_a_refusal_is_one_message_and_nothing_else(
    run: Run, engine: Engine, tmp_path: Path, error: BaseException, told: str
) -> None:
    engine.error = error
    result = run("render", "box.yaml", "--receipt", "cost.json")
    assert result.exit_code == 1
    assert result.stderr.startswith("error: ")
    assert result.stderr.rstrip("\n").endswith(told)
    assert result.stderr.count("\n") == 1
    assert not result.stdout
    assert not files(tmp_path)


def test_a_black_picture_is_rendered_with_one_line_that_says_why(
    run: Run, engine: Engine, tmp_path: Path
) -> None:
    engine.why_dark = "the picture will be black: there are no lights"
    result = run("render", "box.yaml")
    assert result.exit_code == 0
    assert result.stderr == "warning: box.yaml: the picture will be black: there are no lights\n"
    assert files(tmp_path) == {"box.png"}


@pytest.mark.parametrize(
    ("radiance", "told"),
    [
        (0.0, "every pixel is black; `course pixel`"),
        (1e-5, "the brightest is 1e-05 and white is 1;"),
    ],
)
def test_a_picture_in_which_nothing_is_seen_is_told(
    run: Run, engine: Engine, radiance: float, told: str
) -> None:
    engine.picture.linear = np.full((3, 4, 3), radiance, np.float32)
    assert told in run("render", "box.yaml").stderr
    assert bool(run("render", "box.yaml", "-o", "box.exr").stderr) == (radiance == 0)
    # A code of 1 is seen.
    engine.picture.linear[1, 1] = 4e-4
    assert not run("render", "box.yaml").stderr


def test_a_defect_is_not_taken_for_a_mistake_of_the_user(run: Run, engine: Engine) -> None:
    engine.error = ZeroDivisionError("a defect")
    assert run("render", "box.yaml").exception is engine.error


def test_ctrl_c_keeps_what_there_is_under_another_name(
    run: Run, engine: Engine, tmp_path: Path
) -> None:
    (tmp_path / "a.exr").write_text("before")
    engine.picture.interrupted, engine.picture.complete = True, False
    result = run("render", "box.yaml", "-o", "a.exr", "--receipt", "cost.json")
    assert result.exit_code == 130
    assert "a.partial.exr" in result.stderr
    assert files(tmp_path) == {"a.exr", "a.partial.exr"}
    assert (tmp_path / "a.exr").read_text() == "before"


def test_ctrl_c_without_a_picture_writes_nothing(run: Run, engine: Engine, tmp_path: Path) -> None:
    engine.error = KeyboardInterrupt()
    result = run("render", "box.yaml")
    assert result.exit_code == 130
    assert result.stderr == "interrupted\n"
    assert not files(tmp_path)


def test_a_time_limit_counts_from_reading_the_scene_on(
    run: Run, engine: Engine, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("course.cli.render.monotonic", lambda: 100.0 + len(engine.loaded))
    assert run("render", "box.yaml", "--time-limit", "10").exit_code == 0
    assert engine.rendered[0]["since"] == 100.0


def test_pixels_that_a_time_limit_left_black_are_told(
    run: Run, engine: Engine, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(engine.picture.receipt, "to_dict", lambda: RECEIPT | {"samples": 0.6})
    result = run("render", "box.yaml", "--time-limit", "1")
    assert result.exit_code == 0
    assert "over when 60% of the pixels had a sample; the others are black" in result.stderr
    monkeypatch.setattr(engine.picture.receipt, "to_dict", lambda: RECEIPT)
    assert "black" not in run("render", "box.yaml", "--time-limit", "1").stderr


@pytest.mark.parametrize(
    ("sampler", "spp", "told"),
    [("regular", (), True), ("sobol", (), False), ("regular", ("--spp", "4"), False)],
)
def test_a_sampler_that_seconds_add_nothing_to_is_told(
    run: Run, engine: Engine, sampler: str, spp: tuple[str, ...], told: bool
) -> None:
    engine.picture.settings.sampler = sampler
    result = run("render", "box.yaml", "--time-limit", "1", *spp)
    assert ("places all its samples at once" in result.stderr) == told


def test_a_time_limit_gives_the_picture_its_own_name(
    run: Run, engine: Engine, tmp_path: Path
) -> None:
    engine.picture.complete = False
    assert run("render", "box.yaml", "--time-limit", "1").exit_code == 0
    assert files(tmp_path) == {"box.png"}


@pytest.fixture
def heat_maps(monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """Where heat maps were asked for; each is a file of one word."""
    written: list[Path] = []

    def save_heat_map(_picture: Picture, path: Path) -> None:
        path.write_text("warm")
        written.append(path)

    monkeypatch.setattr(Picture, "save_heat_map", save_heat_map, raising=False)
    return written


@pytest.mark.usefixtures("engine")
def test_a_heat_map_is_written_beside_the_picture(
    run: Run, heat_maps: list[Path], tmp_path: Path
) -> None:
    assert run("render", "box.yaml", "--error", "0.1", "--heat-map", "where.exr").exit_code == 0
    assert files(tmp_path) == {"box.png", "where.exr"}
    assert heat_maps == [Path("where.exr")]
    assert run("render", "box.yaml", "--error", "0.1").exit_code == 0
    assert len(heat_maps) == 1, "only where it is asked for"


def test_ctrl_c_leaves_no_heat_map(
    run: Run, engine: Engine, heat_maps: list[Path], tmp_path: Path
) -> None:
    engine.picture.interrupted, engine.picture.complete = True, False
    assert run("render", "box.yaml", "--error", "0.1", "--heat-map", "a.png").exit_code == 130
    assert files(tmp_path) == {"box.partial.png"}
    assert not heat_maps


@pytest.mark.usefixtures("engine")
@pytest.mark.parametrize(("estimated", "reached"), [(0.0099, True), (0.01, True), (0.0231, False)])
def test_an_error_that_was_aimed_at_is_told_with_what_it_took(
    run: Run, monkeypatch: pytest.MonkeyPatch, estimated: float, reached: bool
) -> None:
    error = {"target": 0.01, "estimated": estimated, "fewest": 16, "most": 1536}
    error |= {"uniform": 80.0, "saved": 0.6}
    monkeypatch.setitem(RECEIPT, "error", error)
    monkeypatch.setitem(RECEIPT, "samples", 32.04)
    told = " ".join(run("render", "box.yaml", "--error", "0.01").stdout.split())
    assert "samples a pixel 32.0 on average, 16 to 1,536" in told
    assert f"estimated error {estimated:.3g}" in told
    assert ("above the target 0.01" in told) is not reached
    assert "saved 60% of 80.0 in every pixel alike" in told


def test_the_receipt_is_written_as_json(run: Run, engine: Engine, tmp_path: Path) -> None:
    assert run("render", "box.yaml", "--receipt", "cost.json").exit_code == 0
    written = json.loads((tmp_path / "cost.json").read_text())
    assert written == engine.picture.receipt.to_dict()


@pytest.mark.usefixtures("engine")
def test_the_receipt_is_printed_as_plain_text_where_there_is_no_terminal(run: Run) -> None:
    result = run("render", "box.yaml")
    assert not result.stderr
    lines = [line.split() for line in result.stdout.splitlines()]
    assert lines[0] == ["box.png"]
    assert ["rays", "camera", "4,915,200"] in lines
    assert ["effects", "called", "supersampling.resolve"] in lines
    assert "skipped 1 that the scene doesn't need" in " ".join(result.stdout.split())
    assert "the aperture is 0" not in result.stdout
    assert ["samples", "a", "pixel", "16"] in lines
    assert "reflection" not in result.stdout
    assert result.stdout.isascii()
