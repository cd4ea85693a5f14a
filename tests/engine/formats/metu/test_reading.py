"""Files that are wrong: one message with file, element and remedy; and parts that nobody knows are named."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

from course.base.errors import SceneError
from course.engine.formats.metu.converting import convert
from course.engine.formats.metu.element import MetuElement, Notes
from tests.engine.formats.metu.conftest import CAMERA, MATT, Metu, tree, write
from tests.tables import put, rows

MISTAKES = rows("""
Cameras -> | Scene: Cameras is missing: expected one Camera or more
Cameras/Camera -> | Scene/Cameras: Camera is missing
Objects -> | Scene: Objects is missing
Materials -> | Scene: Materials is missing
Cameras/Camera/Position -> 1 2 | Scene/Cameras/Camera/Position is "1 2": expected 3 numbers, such as 0 1 -2.5
Cameras/Camera/Position -> 1 2 nan | Camera/Position is "1 2 nan": expected 3 numbers
Cameras/Camera/Position -> 1 2 1e999 | Camera/Position is "1 2 1e999": expected 3 numbers
Cameras/Camera/Gaze -> 0 0 0 | Gaze is "0 0 0": expected a direction
Cameras/Camera/Up -> 0 0 7 | Up is "0 0 7": expected a direction
Cameras/Camera/NearPlane -> 1 -1 -1 1 | NearPlane is "1 -1 -1 1": expected left < right and bottom < top
Cameras/Camera/NearDistance -> 0 | NearDistance is "0": expected a number > 0
Cameras/Camera/ImageResolution -> 640 0 | ImageResolution is "640 0": expected 2 whole numbers from 1 to 65536
Cameras/Camera/NumSamples -> 2.5 | NumSamples is "2.5": expected a whole number >= 1
Cameras/Camera/ApertureSize -> 1 | Camera: FocusDistance is missing or 0: expected a distance > 0
Cameras/Camera/_handedness -> both | Camera: handedness is "both": expected right or left
Cameras/Camera/_type -> fisheye | Camera: type is 'fisheye': expected lookAt or none
Cameras/Camera -> {"_id": "1", "_type": "lookAt", "ImageResolution": "4 4", "Position": "0 0 5", "Up": "0 1 0"} |
    Camera: Gaze is missing: expected an element of that name, such as 0 0 -1, or a GazePoint
Materials/Material/_type -> plastic | Material: type is 'plastic': expected mirror, conductor, dielectric or none
Materials/Material/_type -> conductor | Material: MirrorReflectance is missing: expected an element
Materials/Material/DiffuseReflectance -> -2 0 0 | DiffuseReflectance is "-2 0 0": expected 3 numbers from 0
Lights/PointLight -> {"_id": "1", "Position": "0 0 0"} | Lights/PointLight: Intensity is missing
Lights/AmbientLight -> -1 0 0 | AmbientLight is "-1 0 0": expected 3 numbers from 0
Objects/Mesh/Material -> 4 | Mesh/Material is "4": expected the id of a material; known are "1"
Objects/Mesh/Faces -> 1 2 | Mesh/Faces is "1 2": expected three vertex numbers for each triangle
Objects/Mesh/Faces -> 1 2 5 | Mesh/Faces: refers to vertex 5: expected numbers from 1 to 4
Objects/Mesh/Faces -> 0 1 2 | Mesh/Faces: refers to vertex 0: expected numbers from 1 to 4
Objects/Mesh/Faces -> {"_plyFile": "no.ply"} | Mesh/Faces: plyFile is no.ply: no such file in /
Objects/Mesh/_shadingMode -> phong | Mesh: shadingMode is "phong": expected flat or smooth
Objects/Mesh/Transformations -> t1 | Mesh/Transformations is "t1": expected names such as t1, s1, r1 or c1
Objects/MeshInstance -> {"_id": "2", "_baseMeshId": "2"} | MeshInstance: baseMeshId is "2": expected the id of a mesh
Objects/Sphere -> {"_id": "1", "Material": "1", "Center": "9", "Radius": "1"} |
    Sphere/Center: refers to vertex 9: expected numbers from 1 to 4
Transformations/Scaling -> {"_id": "1", "_data": "1 0 1"} |
    Transformations/Scaling is "1 0 1": expected 3 factors that are not 0
Transformations/Rotation -> {"_id": "1", "_data": "90 0 0 0"} |
    Transformations/Rotation is "90 0 0 0": expected degrees, and an axis
Transformations/Composite -> {"_id": "1", "_data": "1 0 0 0"} |
    Transformations/Composite is "1 0 0 0": expected 16 numbers, such as 1 0 0 0  0 1 0 0
Transformations/Composite -> {"_id": "1", "_data": "1 0 0 0 1 0 0 0 1 0 0 0 1 0 0 0 "} |
    expected a last row of 0 0 0 1, as in 1 0 0 0  0 1 0 0
Transformations/Composite -> {"_id": "1", "_data": "1 2 3 0 4 5 6 0 7 8 9 0 0 0 0 1"} |
    expected a matrix that can be inverted; this one flattens what it maps
VertexData -> 1 2 3 4 | VertexData: has 4 numbers
MaxRecursionDepth -> six | MaxRecursionDepth is "six": expected 1 number
""")
"""What is put in which place of the tree, or taken away there, and the message."""


@pytest.mark.parametrize(("place", "value", "told"), MISTAKES)
@pytest.mark.parametrize("form", ["xml", "json"])
def test_a_mistake_is_told_with_file_element_and_what_was_expected(
    tmp_path: Path, form: str, place: str, value: str, told: str
) -> None:
    scene = tree()
    scene["Materials"]["Material"] = dict(MATT)
    put(scene, place, value)
    path = write(tmp_path, scene, form)
    with pytest.raises(SceneError) as caught:
        convert(path, tmp_path / "scene.yaml")
    message = str(caught.value)
    assert message.startswith(f"{path}:")
    assert told in message
    assert "\n" not in message


@pytest.mark.parametrize(
    ("part", "given", "told"),
    [
        ("Camera", [CAMERA, CAMERA | {"Up": ""}], "Camera[2]/Up is"),
        ("Camera", [CAMERA, CAMERA], "Camera[2]: its id is given twice"),
        ("Material", [MATT, MATT], "Material[2]: its id is given twice: expected another than 1"),
    ],
)
def test_of_several_the_number_is_told(metu: Metu, part: str, given: list[Any], told: str) -> None:
    with pytest.raises(SceneError, match=re.escape(told)):
        metu.load(tree() | {f"{part}s": {part: given}})


def test_xml_mistakes_have_a_line(tmp_path: Path) -> None:
    path = write(tmp_path, tree(camera={"Gaze": "1"}), "xml")
    line = next(
        k for k, text in enumerate(path.read_text().splitlines(), start=1) if "Gaze" in text
    )
    with pytest.raises(SceneError, match=rf"scene\.xml:{line}: Scene/Cameras/Camera/Gaze is"):
        convert(path, tmp_path / "scene.yaml")


BOMB = """<?xml version="1.0"?>
<!DOCTYPE Scene [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>
<Scene>&b;</Scene>
"""


@pytest.mark.parametrize(
    ("name", "content", "told"),
    [
        ("bomb.xml", BOMB, r"bomb\.xml:2: has a document type"),
        ("a.xml", "<Scene><a></Scene>", r"a\.xml:1: not valid XML: mismatched tag"),
        ("a.xml", "", r"a\.xml:1: not valid XML: no element found"),
        ("a.xml", "<scene/>", r'a\.xml:1: the root is "scene": expected Scene'),
        ("a.xml", "<Scene>" + "<a>" * 50, r"nested more than 32 levels"),
        ("a.xml", "<Scene>&b;</Scene>", r"a\.xml:1: not valid XML: undefined entity"),
        *(
            ("a.xml", f'<?xml version="1.0" encoding="{name}"?><Scene/>', rf"a\.xml: .* {told}")
            for name, told in [
                ("klingon", "unknown encoding: klingon: save it as UTF-8"),
                ("utf-7", "not supported: save it as UTF-8"),
            ]
        ),
        ("a.json", "{", r"a\.json:1: not valid JSON"),
        ("a.json", "[]", r"expected a map with the key Scene"),
        ("a.json", '{"Scene": 1}', r"expected a map with the key Scene"),
        ("a.json", '{"Scene": {"a":' + "[" * 100_000, r"nested too deeply"),
        (
            "a.json",
            '{"Scene": {"Lights": {"PointLight": {}, "AmbientLight": "1 1 1", "PointLight": {}}}}',
            r'a\.json: "PointLight" is given twice in one map, .* expected a list of both',
        ),
        ("a.json", '{"Scene": {"Cameras": 5}}', r'Scene/Cameras is "5": expected a map'),
        ("a.json", '{"Scene": {"Cameras": {"Camera": 5}}}', r'Camera is "5": expected a map'),
        ("a.json", '{"Scene": {"Cameras": {"Camera": null}}}', r'Camera is "": expected a map'),
        ("a.obj", "", r"expected a METU scene, a file that ends in \.xml or \.json"),
    ],
)
def test_what_is_no_scene_is_refused(tmp_path: Path, name: str, content: str, told: str) -> None:
    (tmp_path / name).write_text(content, encoding="utf-8")
    with pytest.raises(SceneError, match=told):
        convert(tmp_path / name, tmp_path / "scene.yaml")
    assert not (tmp_path / "scene.yaml").exists()


LATIN = "<Scene>\n<!-- caf\u00e9 --></Scen>\n"


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (
            LATIN.encode("latin-1"),
            r"a\.xml:2: .*; byte 16 is not UTF-8: save the file as UTF-8, or",
        ),
        (LATIN.encode("utf-8"), r"a\.xml:2: not valid XML: mismatched tag$"),
        (LATIN.encode("utf-16"), r"a\.xml:2: not valid XML: mismatched tag$"),
        (
            f'<?xml version="1.0" encoding="ISO-8859-1"?>{LATIN}'.encode("latin-1"),
            r"a\.xml:2: not valid XML: mismatched tag$",
        ),
    ],
)
def test_bytes_of_another_encoding_are_told_with_the_remedy(
    tmp_path: Path, content: bytes, told: str
) -> None:
    (tmp_path / "a.xml").write_bytes(content)
    with pytest.raises(SceneError, match=told):
        convert(tmp_path / "a.xml", tmp_path / "scene.yaml")


def test_missing_files_and_folders_are_told(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"none\.xml: no such file"):
        convert(tmp_path / "none.xml", tmp_path / "scene.yaml")
    (tmp_path / "folder.xml").mkdir()
    with pytest.raises(SceneError, match=r"folder\.xml: is a folder: expected a scene file"):
        convert(tmp_path / "folder.xml", tmp_path / "scene.yaml")


def test_what_is_not_known_is_named_once_a_kind(metu: Metu) -> None:
    scene = tree(
        camera={"Tonemap": {"TMO": "ACES", "Gamma": "2.2"}, "_fovAxis": "x"},
        lights={"AmbientLight": {"_data": "9 9 9", "_hue": "warm"}},
        Shaders={"Shader": ""},
        BRDFs={"Velvet": [{"_id": "1"}, {"_id": "2"}, {"_id": "3"}]},
    )
    scene["Objects"]["Mesh"] |= {"Shaders": "1", "_lod": "2"}
    metu.load(scene)
    warnings = "\n".join(metu.warnings)
    for part in (
        "Scene/Cameras/Camera/Tonemap has TMO ACES: only Photographic is known, so it was left out",
        "Scene/Cameras/Camera, attribute fovAxis is not known",
        "Scene/Lights/AmbientLight, attribute hue is not known",
        "Scene/BRDFs/Velvet[1] is not known, and was left out (and 2 more of this kind)",
        "Scene/Shaders is not known",
        "Scene/Objects/Mesh/Shaders is not known",
        "Scene/Objects/Mesh, attribute lod is not known",
    ):
        assert part in warnings
    assert len(metu.warnings) == 7


def test_every_kind_is_named_however_many_there_are(metu: Metu) -> None:
    """The first twenty with their places, the others together, each once and with how many there are of it."""
    names = [f"Gadget{chr(65 + number)}" for number in range(25)]
    matt = MATT | {"RefractionIndex": "1.5"}
    gadgets = dict.fromkeys(names, "1") | {"GadgetZ": ["1", "2", "3"]}
    metu.load(tree(camera={"NumSamples": "5"}, materials=[matt], **gadgets))
    # What cameras and materials say comes first, and takes two of the twenty places.
    told, last = metu.warnings[:20], metu.warnings[20:]
    assert [name for name in names if any(f"Scene/{name} is not known" in w for w in told)] == (
        names[:18]
    )
    assert all("scene." in warning for warning in told)
    assert last == [
        "... and more that is not known, and was left out: "
        + ", ".join(f"Scene/{name}" for name in names[18:])
        + ", Scene/GadgetZ[1] (3 times)"
    ]


def test_what_is_told_together_is_told_by_what_it_says() -> None:
    notes = Notes()
    for number in range(24):
        thing = MetuElement("Thing", f"Scene/Thing{chr(65 + number)}", "box.xml:1")
        notes.add(thing, "is odd" if number % 2 else "is even")
    assert notes.texts()[19:] == [
        "box.xml:1: Scene/ThingT is odd",
        "... and more that is even: Scene/ThingU, Scene/ThingW",
        "... and more that is odd: Scene/ThingV, Scene/ThingX",
    ]


def test_everything_that_is_known_is_silent(metu: Metu) -> None:
    scene = tree(
        camera={"_type": "simple", "_handedness": "left"},
        ShadowRayEpsilon="1e-3",
        IntersectionTestEpsilon="1e-6",
        MaxRecursionDepth="6",
        BackgroundColor="0 0 0",
    )
    metu.load(scene)
    assert metu.warnings == []


def test_every_picture_has_a_name_of_its_own(xml: Metu, tmp_path: Path) -> None:
    """Even where a camera has the very name that another is given for want of one."""
    scene = tree()
    names = ["camera-3.png", "one.png", "one.png", "one.exr", "one-4.png"]
    scene["Cameras"]["Camera"] = [
        CAMERA | {"_id": str(number), "ImageName": name}
        for number, name in enumerate(names, start=1)
    ]
    converted, (warning,) = convert(write(tmp_path, scene, xml.form), tmp_path / "scene.yaml")
    assert "Camera[3] has the ImageName of another camera" in warning
    images = [one.image for one in converted]
    assert images == ["camera-3.png", "one.png", "camera-3-2.png", "one.exr", "one-4.png"]
    assert len({one.path for one in converted}) == len(names)


def test_both_forms_make_the_same_scene_file(tmp_path: Path) -> None:
    texts = []
    for form in ("xml", "json"):
        folder = tmp_path / form
        folder.mkdir()
        (one,), _ = convert(write(folder, tree(), form), folder / "scene.yaml")
        texts.append(one.path.read_text(encoding="utf-8").partition("\n")[2])
    assert texts[0] == texts[1]


def test_json_may_hold_numbers_and_lists_of_numbers(tmp_path: Path) -> None:
    scene = tree(camera={"Position": [0, 0, 1.5], "NearDistance": 2, "_id": 1})
    path = tmp_path / "scene.json"
    path.write_text(json.dumps({"Scene": scene}), encoding="utf-8")
    (one,), warnings = convert(path, tmp_path / "scene.yaml")
    assert warnings == []
    assert "eye: [0.0, 0.0, 1.5]" in one.path.read_text(encoding="utf-8")


def test_a_pictures_name_leads_into_no_other_folder(metu: Metu, tmp_path: Path) -> None:
    path = write(tmp_path, tree(camera={"ImageName": "../../up/one.ppm"}), metu.form)
    (one,), (warning,) = convert(path, tmp_path / "scene.yaml")
    assert one.image == "one.png"
    assert "ImageName is one.ppm: pictures are .png or .exr, so one.png is written" in warning
