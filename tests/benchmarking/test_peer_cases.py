"""What is kept of the comparison with another program: a run of one case loses no other."""

from dataclasses import replace
from hashlib import sha256
from pathlib import Path

import pytest

from benchmarks.mitsuba_agreement import Agreement
from benchmarks.peer_cases import (
    EFFECTS,
    FORMS,
    FURTHER,
    QUICK,
    Effort,
    Measured,
    Reached,
    Result,
    Target,
    keep_cases,
    read_cases,
)
from benchmarks.peer_document import MARK, write_document
from benchmarks.peer_scenes import PACKAGES, Package, mesh_path, parsed, scene_path
from benchmarks.peers import Point, reached
from course import load_scene
from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT

HERE = {"processor": "An Example 3000", "peer": "Mitsuba 3"}
THERE = {"processor": "Another 4000", "peer": "Mitsuba 3"}


def _case(effect: str, form: str, seconds: float = 2.0, effort: Effort = QUICK) -> Measured:
    targets = []
    for samples, factor in ((16, 1.0), (64, 4.0)):
        theirs = Reached("multijitter", factor * seconds, float(samples))
        ours = [Reached("adaptive", 1.5, 0.01), Reached("uniform", 3.0 * factor**0.5, 64)]
        targets.append(Target(samples, 0.1 / samples**0.5, theirs, ours))
    agreement = Agreement(4.0, 0.0, 1e-5, -2e-4, (12, 20))
    result = Result(effect, form, [], False, targets, 4.0, 5.0, agreement)
    return Measured(effort, HERE, result)


@pytest.fixture
def document(tmp_path: Path) -> Path:
    path = tmp_path / "peers.md"
    path.write_text(f"before\n<!-- {MARK}: begin -->\n<!-- {MARK}: end -->\n", encoding="utf-8")
    return path


def test_one_more_case_leaves_the_others(tmp_path: Path, document: Path) -> None:
    path = tmp_path / "peers.json"
    first = [_case("glossy", "scalar"), _case("glossy", "llvm"), _case("thin_lens", "llvm")]
    keep_cases(first, path)
    cases = keep_cases([_case("supersampling", "llvm")], path)
    assert [case.case for case in cases] == [
        ("llvm", "supersampling"),
        ("llvm", "glossy"),
        ("llvm", "thin_lens"),
        ("scalar", "glossy"),
    ]
    assert cases[2] == first[2]
    write_document(cases, document)
    text = document.read_text(encoding="utf-8")
    for form in ("llvm", "scalar"):
        assert f"<!-- site: peer_times {form} -->" in text
        assert f"- glossy, {form}: as it is" in text
    assert text.count("Made by") == 1
    assert text.count("| thin_lens | 16 | 2.50e-02 | multijitter | 2.000 | 3.000 (1.50) |") == 1
    assert text.count("| thin_lens | 64 | 1.25e-02 | multijitter | 8.000 | 6.000 (0.75) |") == 1
    # The worse of the two, the middle between them, and the better one.
    assert text.count("| thin_lens, llvm | 1.50 · 1.12 · 0.75 | 0.75 · 0.47 · 0.19 |") == 1


def test_the_same_case_takes_the_place_of_the_older(tmp_path: Path) -> None:
    path = tmp_path / "peers.json"
    keep_cases([_case("glossy", "llvm"), _case("glossy", "scalar")], path)
    cases = keep_cases([_case("glossy", "llvm", seconds=7.0)], path)
    assert [(*case.case, case.result.targets[0].theirs.seconds) for case in cases] == [
        ("llvm", "glossy", 7.0),
        ("scalar", "glossy", 2.0),
    ]
    assert read_cases(path) == cases


@pytest.mark.parametrize("other", [{"about": THERE}, {"effort": Effort()}])
def test_a_case_measured_otherwise_says_so(
    tmp_path: Path, document: Path, other: dict[str, object]
) -> None:
    path = tmp_path / "peers.json"
    case = replace(_case("cube_map", "llvm"), **other)
    write_document(keep_cases([_case("glossy", "llvm"), case], path), document)
    made = [
        line
        for line in document.read_text(encoding="utf-8").splitlines()
        if line.startswith("Made by")
    ]
    assert [line.rpartition(": ")[2] for line in made] == ["glossy llvm.", "cube_map llvm."]


def test_nothing_is_kept_at_first(tmp_path: Path) -> None:
    assert read_cases(tmp_path / "peers.json") == []


def test_every_case_stands_in_the_documentation() -> None:
    """In either form, but for path tracing, which is the same in both."""
    cases = {case.case for case in read_cases(PROJECT / "docs" / "data" / "peers.json")}
    assert cases >= {(form, e) for form in FORMS for e in EFFECTS} - {("scalar", "path_tracing")}


def _power_law(order: float, *knobs: float) -> list[Point]:
    """Squared errors knob^-order, a second for each eighth of a knob."""
    return [Point(knob, knob**-order, knob / 8) for knob in knobs]


@pytest.mark.parametrize("samples", [12.0, 16.0, 48.0, 350.0])
def test_seconds_to_an_error_are_exact_on_a_power_law(samples: float) -> None:
    points = {"one": _power_law(1.3, 16, 64, 256), "other": _power_law(1.0, 16, 64, 256)}
    (one,) = reached({"one": points["one"]}, samples**-1.3)
    assert one.seconds == pytest.approx(samples / 8)
    assert one.knob == pytest.approx(samples)
    assert len(reached(points, samples**-1.3)) == 1 + (samples < 100)


def test_an_error_far_from_all_measured_ones_is_not_reached() -> None:
    points = {"one": _power_law(1.0, 16, 64)}
    assert [len(reached(points, error)) for error in (1 / 129, 1 / 127, 1 / 9, 1 / 7)] == [
        *(0, 1, 1, 0)
    ]


@pytest.mark.parametrize(
    ("name", "triangles"),
    list(zip(FURTHER, (80_000, 3_676, 994, 102_000, 139_000, 164_000), strict=True)),
)
def test_further_scenes_have_as_many_triangles_as_they_say(name: str, triangles: int) -> None:
    if name in PACKAGES and not mesh_path(name).is_file():
        pytest.skip("its mesh is fetched by python -m benchmarks.peers")
    scene = load_scene(scene_path(name))
    assert sum(scene.compiled.triangles) == pytest.approx(triangles, rel=0.01)
    assert f"{triangles:,}" in scene.title


def test_a_mesh_of_a_package_is_read_and_another_file_is_refused() -> None:
    content = b"exports.positions=[[0,0,0],[1,0.5,0],[0,1,0]];\n\nexports.cells=[[0,1,2]];\n"
    package = Package("leaf", "1.0.0", "package/index.js", sha256(content).hexdigest())
    vertices, triangles = parsed(package, content)
    assert vertices.tolist() == [[0, 0, 0], [1, 0.5, 0], [0, 1, 0]]
    assert triangles.tolist() == [[0, 1, 2]]
    with pytest.raises(CourseError, match=r"leaf 1\.0\.0: package/index\.js is another file"):
        parsed(package, content.replace(b"0.5", b"0.6"))


def test_without_npm_a_mesh_is_asked_for_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("benchmarks.peer_scenes.mesh_path", lambda _: Path("nowhere.ply"))
    monkeypatch.setenv("PATH", "")
    with pytest.raises(CourseError, match=r"npm was not found.*teapot@1\.0\.0; install Node"):
        scene_path("rectangle_light")
