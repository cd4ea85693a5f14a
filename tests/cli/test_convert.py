"""`course convert`, and `course render` of METU scenes: files, names and pictures."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tests.cli.conftest import Run, files

CAMERA = """<Camera id="{id}">
  <Position>0 0 3</Position><Gaze>0 0 -1</Gaze><Up>0 1 0</Up>
  <NearPlane>-1 1 -1 1</NearPlane><NearDistance>1</NearDistance>
  <ImageResolution>8 6</ImageResolution><ImageName>{name}</ImageName><NumSamples>9</NumSamples>
</Camera>
"""
SCENE = """<Scene>
<BackgroundColor>10.9 300 20</BackgroundColor>
<Cameras>{cameras}</Cameras>
<Lights><AmbientLight>50.5 50.5 50.5</AmbientLight>
<AreaLight id="1"><Position>0 2 2</Position><Normal>0 -1 0</Normal><Size>1</Size>
<Radiance>90 90 90</Radiance></AreaLight></Lights>
<Materials><Material id="1"><AmbientReflectance>1 1 1</AmbientReflectance>
<DiffuseReflectance>0.5 0.5 0.5</DiffuseReflectance></Material></Materials>
<VertexData>-1 -1 0  1 -1 0  0 1 0  0 0 1</VertexData>
<Objects><Mesh id="1"><Material>1</Material><Faces>1 2 3</Faces></Mesh>
<Sphere id="1"><Material>1</Material><Center>4</Center><Radius>0.5</Radius></Sphere></Objects>
<Glitter/>
</Scene>
"""


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "box.xml"
    path.write_text(SCENE.format(cameras=CAMERA.format(id=1, name="front.png")), encoding="utf-8")
    return path


@pytest.fixture
def two_cameras(tmp_path: Path) -> Path:
    cameras = CAMERA.format(id=1, name="front.png") + CAMERA.format(id="b", name="back.exr")
    path = tmp_path / "two.xml"
    path.write_text(SCENE.format(cameras=cameras), encoding="utf-8")
    return path


@pytest.mark.usefixtures("scene")
def test_a_scene_is_converted_beside_its_meshes(run: Run, tmp_path: Path) -> None:
    result = run("convert", "box.xml")
    assert result.exit_code == 0
    assert files(tmp_path) == {"box.xml", "box.yaml", "box.meshes"}
    assert files(tmp_path / "box.meshes") == {"mesh-1.ply"}
    assert "box.yaml: camera 1, front.png" in result.output
    assert "warning: box.xml:17: Scene/Glitter is not known, and was left out" in result.output


@pytest.mark.usefixtures("two_cameras")
def test_each_camera_has_a_file(run: Run, tmp_path: Path) -> None:
    result = run("convert", "two.xml", "-o", Path("sub", "other.yaml"))
    assert result.exit_code == 1
    (tmp_path / "sub").mkdir()
    assert run("convert", "two.xml", "-o", Path("sub", "other.yaml")).exit_code == 0
    assert files(tmp_path / "sub") == {"other.front.yaml", "other.back.yaml", "other.meshes"}


@pytest.mark.usefixtures("scene")
def test_the_picture_is_the_same_directly_and_by_way_of_yaml(run: Run, tmp_path: Path) -> None:
    assert run("render", "box.xml", "--seed", "3").exit_code == 0
    assert files(tmp_path) == {"box.xml", "front.png"}
    assert run("convert", "box.xml").exit_code == 0
    assert run("render", "box.yaml", "--seed", "3").exit_code == 0
    assert (tmp_path / "front.png").read_bytes() == (tmp_path / "box.png").read_bytes()
    assert run("render", "box.xml", "-o", "a.exr", "--seed", "3").exit_code == 0
    assert run("render", "box.yaml", "-o", "b.exr", "--seed", "3").exit_code == 0
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()


@pytest.mark.usefixtures("scene")
def test_pictures_are_cut_down_to_8_bits_without_a_gamma(run: Run, tmp_path: Path) -> None:
    assert run("render", "box.xml").exit_code == 0
    with Image.open(tmp_path / "front.png") as picture:
        assert "srgb" not in picture.info
        pixels = np.array(picture)
    assert pixels.shape == (6, 8, 3)
    assert pixels[0, 0].tolist() == [10, 255, 20]
    # The triangle's lower corner looks away from the light, which is above and before it.
    assert (pixels[..., 0] >= 50).any()


@pytest.mark.usefixtures("two_cameras")
def test_each_camera_gives_its_picture(run: Run, tmp_path: Path) -> None:
    assert run("render", "two.xml").exit_code == 0
    assert files(tmp_path) == {"two.xml", "front.png", "back.exr"}


@pytest.mark.usefixtures("two_cameras")
def test_one_of_the_cameras_can_be_chosen(run: Run, tmp_path: Path) -> None:
    assert run("render", "two.xml", "--camera", "b", "-o", "one.png").exit_code == 0
    assert files(tmp_path) == {"two.xml", "one.png"}
    result = run("render", "two.xml", "--camera", "c")
    assert result.exit_code == 1
    assert "error: --camera c: two.xml has the cameras 1, b" in result.output


@pytest.mark.parametrize(
    "option", [("-o", "a.png"), ("--receipt", "a.json"), ("--heat-map", "a.png")]
)
@pytest.mark.usefixtures("two_cameras")
def test_one_file_for_two_pictures_is_refused(
    run: Run, tmp_path: Path, option: tuple[str, str]
) -> None:
    result = run("render", "two.xml", *option)
    assert result.exit_code == 1
    assert f"{option[0]} names one file, but two.xml has 2 cameras" in result.output
    assert "--camera (1, b)" in result.output
    assert files(tmp_path) == {"two.xml"}


@pytest.mark.usefixtures("scene")
def test_a_mesh_file_that_cant_be_read_is_told_by_the_scene_that_names_it(
    run: Run, tmp_path: Path
) -> None:
    text = (tmp_path / "box.xml").read_text(encoding="utf-8")
    bad = text.replace("<Faces>1 2 3</Faces>", '<Faces plyFile="bad.ply"/>')
    (tmp_path / "bad.xml").write_text(bad, encoding="utf-8")
    (tmp_path / "bad.ply").write_text("no mesh", encoding="utf-8")
    for command in ("render", "convert", "info"):
        result = run(command, "bad.xml")
        assert result.exit_code == 1
        assert "error: bad.xml:15: Scene/Objects/Mesh/Faces: plyFile can't be used" in result.output
        assert "bad.ply: not a PLY file that can be read" in result.output
        assert "scene.yaml" not in result.output
    assert files(tmp_path) == {"box.xml", "bad.xml", "bad.ply"}


@pytest.mark.usefixtures("two_cameras")
def test_a_scene_is_described_for_each_camera(run: Run, tmp_path: Path) -> None:
    result = run("info", "two.xml")
    assert result.exit_code == 0, result.output
    lines = [line.split() for line in result.stdout.splitlines()]
    assert [line for line in lines if "camera" in line and line[0] == "two.xml,"] == [
        ["two.xml,", "camera", "1"],
        ["two.xml,", "camera", "b"],
    ]
    # Functions are called for this scene, and not for a file that nobody has seen.
    assert [line[-1] for line in lines if "soft_shadows.point_on_rectangle" in line] == [
        "two.xml"
    ] * 2
    assert "scene.yaml" not in result.output
    one = run("info", "two.xml", "--camera", "b")
    assert "camera 1" not in one.stdout
    assert "camera b" in one.stdout
    assert files(tmp_path) == {"two.xml"}


@pytest.mark.usefixtures("scene")
def test_what_an_error_to_aim_at_needs_is_told_by_its_option(run: Run, tmp_path: Path) -> None:
    result = run("render", "box.xml", "--error", "1")
    assert result.exit_code == 1
    assert "box.xml: --error adds samples where the error is" in result.stderr
    assert "(jittered): say --sampler sobol, too" in result.stderr
    text = (tmp_path / "box.xml").read_text(encoding="utf-8")
    (tmp_path / "one.xml").write_text(text.replace("<NumSamples>9</NumSamples>", ""))
    result = run("render", "one.xml", "--error", "1")
    assert "(regular): say --sampler sobol --spp 64, too" in result.stderr
    for name, options in (("box.xml", []), ("one.xml", ["--spp", "64"])):
        result = run("render", name, "--error", "1", "--sampler", "sobol", *options)
        assert result.exit_code == 0, result.output


@pytest.mark.usefixtures("two_cameras")
def test_all_pictures_can_be_written_before_the_first_is_rendered(run: Run, tmp_path: Path) -> None:
    (tmp_path / "back.exr").mkdir()
    result = run("render", "two.xml")
    assert result.exit_code == 1
    assert "back.exr: can't be written, because it is a folder" in result.stderr
    assert files(tmp_path) == {"two.xml", "back.exr"}


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("convert", "no.xml"), "no.xml: no such file"),
        (
            ("convert", "box.xml", "-o", "box.txt"),
            "box.txt: the name of a scene file must end in .yaml",
        ),
        (("render", "no.json"), "no.json: no such file"),
        (("render", "box.yaml", "--camera", "1"), "--camera is for METU scenes"),
        (("info", "box.yaml", "--camera", "1"), "--camera is for METU scenes"),
        (("info", "box.xml", "--camera", "7"), "box.xml has the cameras 1"),
        (("radiosity", "box.xml"), "`course convert box.xml` makes one of it"),
        (("demo", "box.xml"), "`course convert box.xml` makes one of it"),
    ],
)
@pytest.mark.usefixtures("scene")
def test_mistakes_are_told(run: Run, tmp_path: Path, arguments: tuple[str, ...], told: str) -> None:
    result = run(*arguments)
    assert result.exit_code == 1
    assert told in result.output
    assert files(tmp_path) == {"box.xml"}
