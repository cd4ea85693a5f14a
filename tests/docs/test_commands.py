"""Every command and every piece of code on the pages is run, in a copy of the course, in the order of the page."""

import os
import re
import shutil
import subprocess
import zipfile
from pathlib import Path

import pytest

from course.engine.functions.effects import PROJECT
from tests.docs.blocks import Block, blocks
from tests.docs.following import ONCE
from tests.processes import python

PARTS = ("assignments", "benchmarks", "course", "docs", "scenes", "solutions")
FILES = ("CONTRIBUTING.md", "LICENSE", "Makefile", "README.md", "pyproject.toml")

PAGES = [
    *sorted((PROJECT / "docs").rglob("*.md")),
    PROJECT / "README.md",
    PROJECT / "CONTRIBUTING.md",
    PROJECT / "scenes" / "README.md",
]
FOLLOWED = [
    path.relative_to(PROJECT).as_posix()
    for path in PAGES
    # Tests build what these pages show: test_new_module.py and test_extending.py.
    if blocks(path) and path.name not in ("new_module.md", "extend.md")
]
LONG = {"README.md", "docs/performance.md"}
LONG |= {f"docs/guides/{name}.md" for name in ("grades", "instructors", "students")}
"""Pages that have classes graded, modules checked and measured, or the scenes of the demo rendered."""

MODULES = [page for page in FOLLOWED if page.startswith("docs/modules/")]
SHORT = [page for page in FOLLOWED if page not in (*MODULES, *LONG)]
TOGETHER = [*(MODULES[i::2] for i in range(2)), *(SHORT[i::2] for i in range(2))]
TOGETHER += [[page] for page in FOLLOWED if page in LONG]
"""Pages that one process follows, in one copy: to make it takes longer than what most of them say."""

KNOWN_SUBMISSIONS = {"right": 1, "wrong": 3}
"""Submissions of a module that are kept for `course calibrate`, which renders a large picture with each right one."""

FINEST, KNOT = 32, 288
"""Flat pieces of a curve in the copy; a knot needs 8 (p + q), and one with many turns is a spring."""

SKY = 24
"""Texels along the faces of an environment in the copy."""

SMALL_SCENE = """\
camera: {eye: [0, 2, 6], look_at: [0, 1, 0]}
film: {width: 96, height: 64}
sampler: {samples: 4}
materials: {grey: {}}
lights: [{type: sphere, center: [3, 5, 3], radius: 1, intensity: 60}]
objects: [{shape: sphere, material: grey, segments: 16}]
"""


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    return _copied(tmp_path / "penumbra")


def _copied(folder: Path) -> Path:
    """Copy the course, with what pages take for granted: a scene, a METU scene, submissions."""
    for part in PARTS:
        shutil.copytree(PROJECT / part, folder / part, ignore=_too_many)
    for file in FILES:
        shutil.copyfile(PROJECT / file, folder / file)
    for scene in (folder / "scenes").rglob("*.yaml"):
        # What costs most in small pictures is to make the meshes and the sky.
        lines = scene.read_text(encoding="utf-8").splitlines(keepends=True)
        scene.write_text("".join(map(_coarse, lines)), encoding="utf-8")
    (folder / "few").mkdir()
    for name in ("scenes/NAME.yaml", "few/ball.yaml"):
        (folder / name).write_text(SMALL_SCENE, encoding="utf-8")
    metu = PROJECT / "scenes" / "metu"
    shutil.copyfile(metu / "showroom.xml", folder / "SCENE.xml")
    for mesh in metu.glob("*.ply"):
        shutil.copyfile(mesh, folder / mesh.name)
    written, handed_in = folder / "solutions" / "adaptive_sampling.py", folder / "SUBMISSIONS"
    (handed_in / "ada").mkdir(parents=True)
    shutil.copyfile(written, handed_in / "ada" / written.name)
    with zipfile.ZipFile(handed_in / "ben.zip", "w") as archive:
        archive.write(folder / "assignments" / written.name, written.name)
    return folder


def _too_many(folder: str, names: list[str]) -> list[str]:
    if Path(folder).name == "__pycache__":
        # Compiled loops are most of a checkout that has been used.
        return [name for name in names if name.endswith((".nbi", ".nbc"))]
    # Questions name many wrong submissions, those of film in the copy.
    kept = KNOWN_SUBMISSIONS.get(Path(folder).parent.name)
    if kept is None or Path(folder).name == "film":
        return []
    return sorted(name for name in names if name.endswith(".py"))[kept:]


def _coarse(line: str) -> str:
    if "{type: lat_long," in line:
        line = re.sub(r", size: \d+", "", line).replace("lat_long,", f"lat_long, size: {SKY},")
    most = KNOT if "shape: torus_knot" in line else FINEST
    return re.sub(
        r"\b(segments|sides): (\d+)", lambda found: f"{found[1]}: {min(int(found[2]), most)}", line
    )


def _follow(pages: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join([str(folder), str(PROJECT)])
    wide = os.environ | {"COLUMNS": "120"}
    line = ("-m", "tests.docs.following", *pages)
    return python(*line, folder=folder, path=path, environment=wide, may_fail=True)


@pytest.mark.parametrize("pages", TOGETHER, ids=" ".join)
def test_pages_can_be_followed(pages: list[str], copy: Path) -> None:
    ended = _follow(pages, copy)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    for page in pages:
        shown = blocks(copy / page)
        assert [
            int(found) for found in re.findall(rf"^{page}:(\d+): ", ended.stdout, re.MULTILINE)
        ] == [block.line for block in shown]
    shutil.rmtree(copy)


def test_what_a_modules_page_measures_is_measured_for_the_page_of_performance() -> None:
    lines = [block.text for block in blocks(PROJECT / "docs" / "performance.md")]
    for page in MODULES:
        for block in blocks(PROJECT / page):
            if block.text.startswith("course bench "):
                assert any(line.startswith(f"course bench {Path(page).stem} ") for line in lines)


PAGE = """\
Save this as `a.yaml`:

```yaml
camera: {eye: [0, 0, 4], look_at: [0, 0, 0]}
objects: []
```

and say `course info a.yaml`:

    course render a.yaml -o a.png     # a comment

    # no: a list of names is not yaml
    x = [1]
"""


def test_what_is_run_once_stands_on_its_page() -> None:
    for line, page in ONCE.items():
        assert re.search(
            rf"^ {{4}}{re.escape(line)}( +#.*)?$", (PROJECT / page).read_text("utf-8"), re.MULTILINE
        )


def test_what_a_page_shows_is_found_in_order(tmp_path: Path) -> None:
    path = tmp_path / "page.md"
    path.write_text(PAGE, encoding="utf-8")
    scene = "camera: {eye: [0, 0, 4], look_at: [0, 0, 0]}\nobjects: []\n"
    first, second, third, *rest = blocks(path)
    assert first == Block("yaml", scene, 4, "Save this as `a.yaml`:")
    assert second == Block("inline", "course info a.yaml", 8, "")
    assert (third.kind, third.line) == ("command", 10)
    assert [block.kind for block in rest] == ["command", "command"]


WRONG = [
    # A picture is made before the mistake, and isn't there on the next page.
    ("    course render scenes/NAME.yaml -o made.png\n    course nonsense", "No such command"),
    ("    course compare made.png made.png", "made.png: no such file"),
    ("    course render scenes/nowhere.yaml", "nowhere.yaml"),
    ("    course check supersampling --only resolve/nonsense", "no check"),
    ("    course render scenes/NAME.yaml --colour red", "No such option"),
    ("    make nonsense", "nonsense"),
    ("    python -m benchmarks nonsense", "nonsense"),
    ('    python -m pip install -e ".[nonsense]"', "no extra"),
    ("Say `course nonsense` to it.", "No such command"),
    ("    py -3 -m nonsense", "does not know"),
    ("```cobol\nx\n```", "cobol"),
    ("```python\nfrom course import nonsense\n```", "nonsense"),
    ("```yaml\n- {type: lantern}\n```", "lantern"),
]
"""What a page may say, and what is told of it."""


def test_what_does_not_work_is_told(copy: Path) -> None:
    pages = [f"page{number}.md" for number in range(len(WRONG))]
    for page, (line, _) in zip(pages, WRONG, strict=True):
        (copy / page).write_text(f"Words.\n\n{line}\n", encoding="utf-8")
    ended = _follow(pages, copy)
    assert ended.returncode == 1
    told = re.split(r"^(?=page\d+\.md:)", ended.stderr, flags=re.MULTILINE)
    told = [one for one in told if one.startswith("page")]
    for page, one, (_, why) in zip(pages, told, WRONG, strict=True):
        assert one.startswith(f"{page}:")
        assert why in one
