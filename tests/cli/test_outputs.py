"""Outputs of all commands: into folders that are there, each a file of its own, and none the file that is read."""

from pathlib import Path

import pytest
from PIL import Image

from course.base.errors import OutputError
from course.cli.outputs import check_outputs
from tests.cli.conftest import Run, files
from tests.cli.stand_in import Engine

NOWHERE = "there is no folder nowhere: make it first"


@pytest.mark.parametrize(
    "command",
    [
        "render box.yaml -o nowhere/a.png",
        "render box.yaml --heat-map nowhere/a.png",
        "render box.yaml --receipt nowhere/a.json",
        "radiosity box.yaml -o nowhere/a.png",
        "radiosity box.yaml -o nowhere/a.npz",
        "convert box.xml -o nowhere/a.yaml",
        "schema -o nowhere/a.json",
        "bench glossy --json nowhere/a.json",
        "calibrate sampling --out nowhere/a.json",
        "references --out nowhere/a.npz",
        "release --out nowhere/a.zip",
        "bundle gradescope --out nowhere/a.zip",
    ],
)
def test_no_command_makes_the_folder_of_a_file(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    def work(*_: object, **__: object) -> None:
        pytest.fail("the work has begun")

    monkeypatch.setattr("course.load_scene", work)
    monkeypatch.setattr("course.engine.formats.metu.converting.convert", work)
    monkeypatch.setattr("course.benchmarking.measuring.measure", work)
    monkeypatch.setattr("course.school.grading.calibration.calibrate", work)
    monkeypatch.setattr("course.school.grading.references.make_references", work)
    monkeypatch.setattr("course.school.grading.release.archive.write_archive", work)
    monkeypatch.setattr("course.school.grading.classes.bundles.gradescope_contents", work)
    result = run(*command.split())
    assert result.exit_code == 1
    assert NOWHERE in result.stderr
    assert not files(tmp_path)


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("render box.yaml -o a.png --heat-map a.png", "-o a.png and --heat-map a.png are one file"),
        ("render box.yaml --heat-map ./box.png", "-o box.png and --heat-map box.png are one file"),
        ("render box.yaml -o sub/../a.png --heat-map a.png", "are one file"),
        ("render box.yaml -o a.png --heat-map {here}/a.png", "are one file"),
        ("render box.yaml -o a.png --heat-map link.png", "are one file"),
        ("render box.json --receipt box.json", "--receipt box.json: this is the file that is read"),
        ("render picture.exr -o ./picture.exr", "this is the file that is read"),
        ("radiosity box.yaml -o a.npz -o a.npz", "-o a.npz and -o a.npz are one file"),
        ("radiosity box.yaml -o a.png -o b.npz -o sub/../a.png", "are one file"),
        ("radiosity room.npz -o room.npz", "-o room.npz: this is the file that is read"),
        ("convert box.json -o scene.yaml", "-o scene.yaml: this is the file that is read"),
        ("bench glossy --json a.json --plots ./a.json", "--json a.json is the folder of --plots"),
        ("demo a/box.yaml b/box.yaml", "are one file"),
    ],
)
def test_no_output_replaces_another_or_what_is_read(
    run: Run, engine: Engine, tmp_path: Path, command: str, told: str
) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "link.png").symlink_to(tmp_path / "a.png")
    (tmp_path / "box.json").write_text(
        """{"Scene": {"Cameras": {"Camera": {"_id": "1", "Position": "0 0 3", "Gaze": "0 0 -1",
        "Up": "0 1 0", "NearPlane": "-1 1 -1 1", "NearDistance": "1", "ImageResolution": "8 6"}},
        "Materials": {"Material": {"_id": "1"}}, "VertexData": "0 0 0  1 0 0  0 1 0",
        "Objects": {"Mesh": {"_id": "1", "Material": "1", "Faces": "1 2 3"}}}}"""
    )
    (tmp_path / "scene.yaml").symlink_to(tmp_path / "box.json")
    before = files(tmp_path)
    result = run(*(word.format(here=tmp_path) for word in command.split()))
    assert result.exit_code == 1, result.output
    assert told in result.stderr
    assert not engine.rendered
    assert files(tmp_path) == before


def test_two_scenes_of_one_name_are_told_before_the_folder_is_made(
    run: Run, tmp_path: Path
) -> None:
    result = run("demo", "a/box.yaml", "b/box.yaml", "-o", "new")
    assert result.exit_code == 1
    assert not files(tmp_path)


def test_files_beside_each_other_are_let_through(tmp_path: Path) -> None:
    a, b = tmp_path / "a.png", tmp_path / "b.png"
    for path in (a, b):
        path.write_bytes(b"")
    check_outputs([("-o", a), ("--heat-map", b)], [("--receipt", None)], tmp_path / "a.yaml")


def test_capitals_that_the_file_system_passes_over_are_one_file(tmp_path: Path) -> None:
    """Where the two names lead to one file that is there, whatever they look like."""
    a, b = tmp_path / "a.png", tmp_path / "A.png"
    a.write_bytes(b"")
    b.hardlink_to(a)
    with pytest.raises(OutputError, match="are one file"):
        check_outputs([("-o", a), ("--heat-map", b)])


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ("", "-o wood.png: this is the file that is read"),
        ("-o a.png --heat-map wood.png", "--heat-map"),
    ],
)
def test_no_picture_replaces_one_that_the_scene_names(
    run: Run, tmp_path: Path, options: str, told: str
) -> None:
    """A scene wood.yaml with a texture wood.png had lost it to its own picture."""
    (tmp_path / "wood.yaml").write_text(
        "camera: {eye: [0, 1, 4], look_at: [0, 0, 0]}\n"
        "materials: {wood: {texture: {image: wood.png}}}\n"
        "lights: [{type: ambient, radiance: 1}]\n"
        "objects: [{shape: quad, material: wood}]\n"
    )
    Image.new("RGB", (4, 4), "red").save(tmp_path / "wood.png")
    before = (tmp_path / "wood.png").read_bytes()
    result = run("render", "wood.yaml", *options.split())
    assert told in str(result.exception or result.stderr) + result.stderr
    assert (tmp_path / "wood.png").read_bytes() == before
    assert files(tmp_path) == {"wood.yaml", "wood.png"}
