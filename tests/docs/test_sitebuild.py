"""The parts that the site is made of: pictures that are kept, docstrings, references."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from PIL import Image

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')
pytest.importorskip("latex2mathml", reason='the site needs: pip install -e ".[docs]"')

from docutils import nodes
from sitebuild import ahead, docstrings, key_headings, mathematics, numbers, parts, pictures
from sitebuild.place import Place

SCENE = """\
title: A ball
camera: {eye: [0, 0, 4], look_at: [0, 0, 0]}
film: {width: 1200, height: 300}
sampler: {samples: 2}
materials: {grey: {}}
lights: [{type: point, position: [0, 3, 3], intensity: 20}]
objects: [{shape: sphere, material: grey, segments: 16}]
"""


@pytest.fixture
def scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    path = tmp_path / "ball.yaml"
    path.write_text(SCENE, encoding="utf-8")
    monkeypatch.setattr(pictures, "scene_path", lambda name: tmp_path / f"{name}.yaml")
    return path


@pytest.mark.usefixtures("scene")
def test_a_picture_is_rendered_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    planned = pictures.shot("ball")
    path, receipt = pictures.picture(planned, tmp_path / "kept")
    with Image.open(path) as image:
        assert image.size == planned.size == (1200, 300)
        assert image.convert("L").getextrema()[1] > 50
    assert receipt["samples"] == 2
    assert receipt["rays"]["camera"] == 1200 * 300 * 2
    monkeypatch.setattr(pictures, "render", None)
    assert pictures.picture(planned, tmp_path / "kept") == (path, receipt)


def test_what_changes_the_picture_changes_its_key(scene: Path) -> None:
    keys = {pictures.shot("ball").key}
    for old, new in (
        ("samples: 2", "samples: 3"),
        ("samples: 2", "samples: 2, type: random"),
        ("height: 300", "height: 400"),
        ("intensity: 20", "intensity: 21"),
        ("title: A ball", "seed: 5"),
    ):
        scene.write_text(SCENE.replace(old, new), encoding="utf-8")
        keys.add(pictures.shot("ball").key)
    assert len(keys) == 6
    scene.write_text(SCENE.replace("A ball", "The same"), encoding="utf-8")
    assert pictures.shot("ball").key in keys


def test_twice_the_pixels_across_have_the_same_light(scene: Path) -> None:
    def planned(old: str, new: str) -> tuple[tuple[int, int], int]:
        scene.write_text(SCENE.replace(old, new), encoding="utf-8")
        shot = pictures.shot("ball")
        return shot.size, shot.samples

    assert planned("samples: 2", "samples: 64") == ((1200, 300), 16)
    assert planned("samples: 2", "samples: 36, type: jittered") == ((1200, 300), 9)
    assert planned("samples: 2", "samples: 20") == ((1200, 300), 5)
    assert planned("width: 1200, height: 300", "width: 400, height: 300") == ((800, 600), 2)
    # Small ones, and those whose pixels are looked at.
    assert planned("width: 1200", "width: 300") == ((300, 300), 2)
    more = "height: 300, subdivision: {}"
    assert planned("height: 300", more)[0] == (600, 150)


def test_pictures_take_the_place_of_grey_ones_while_others_are_made(tmp_path: Path) -> None:
    site, file = tmp_path / "site", tmp_path / "made.webp"
    (site / "_pictures").mkdir(parents=True)
    grey = site / "_pictures" / "a.webp"
    grey.write_bytes(b"grey")
    file.write_bytes(b"colours")
    place = Place("../", False, tmp_path, {}, site=site)
    assert place.address("_pictures/a.webp", file) == "../_pictures/a.webp"
    assert grey.read_bytes() == b"colours"
    # What no page shows yet waits for its page.
    place.address("_pictures/b.webp", file)
    assert not (site / "_pictures" / "b.webp").exists()


def test_pictures_are_drawn_ahead_once_for_an_engine(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn, codes = [], [2, 0]
    pool = SimpleNamespace(submit=lambda *call: drawn.append(call), shutdown=lambda **_: None)
    writing = SimpleNamespace(wait=lambda: codes.pop(0))
    monkeypatch.setattr(ahead, "ProcessPoolExecutor", lambda *_: pool)
    monkeypatch.setattr(ahead, "wait", len)
    monkeypatch.setattr(ahead.subprocess, "Popen", lambda _: writing)
    monkeypatch.setattr(ahead.kept, "ROOT", tmp_path / "kept")
    (site := tmp_path / "site").mkdir()

    def began() -> tuple[int, int]:
        drawn.clear()
        return ahead.main(str(tmp_path / "trees"), str(site)), len(drawn)

    code, count = began()
    assert (code, count > 100) == (2, True)  # a page is wrong: no picture is taken for drawn
    assert began() == (0, count)
    assert began() == (0, 0)
    # With another engine pictures are drawn anew, and pages that are there stay as they are.
    monkeypatch.setattr(ahead, "engine_hash", lambda _: "another")
    (site / "index.html").touch()
    assert began() == (0, count)
    assert [call[1][0] for call in drawn][:3] == [*ahead.LONG, "before_after"]
    assert {call[1][0] for call in drawn} == {*ahead.LONG, *ahead.DRAWN}
    assert codes == []


def test_what_is_drawn_ahead_takes_the_place_of_grey(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(parts.PARTS, "picture", lambda place, *_: place.address("_a/b.webp", file))
    (tmp_path / "_a").mkdir()
    (grey := tmp_path / "_a" / "b.webp").touch()
    (file := tmp_path / "drawn").write_bytes(b"colours")
    ahead.draw(("picture", "ball", ""), tmp_path)
    assert grey.read_bytes() == b"colours"


@pytest.mark.usefixtures("scene")
def test_the_command_is_the_pictures() -> None:
    assert pictures.shot("ball").command == (
        "course render scenes/ball.yaml --size 1200x300 --spp 2 -o ball.png"
    )


def _app(folder: Path) -> SimpleNamespace:
    """As much of Sphinx as expanding a page asks for."""
    return SimpleNamespace(doctreedir=str(folder), config=SimpleNamespace(pictures="blank"))


def test_a_page_is_read_again_when_its_parts_change(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("plain", "keys"):
        (tmp_path / f"{name}.md").write_text(
            "<!-- site: scene_keys -->\n" if name == "keys" else "Words.\n", encoding="utf-8"
        )
    env = SimpleNamespace(
        found_docs={"plain", "keys"}, doc2path=lambda name: tmp_path / f"{name}.md"
    )
    site = parts.Site(_app(tmp_path))
    assert site.outdated(None, env) == []
    assert site.outdated(None, env) == []
    monkeypatch.setitem(parts.PARTS, "scene_keys", lambda *_: "another")
    assert site.outdated(None, env) == ["keys"]
    # To expand pages takes half of the time of a build: it is done once.
    monkeypatch.setitem(parts.PARTS, "scene_keys", lambda *_: "a third")
    source = ["<!-- site: scene_keys -->\n"]
    site.expand_page(None, "keys", source)
    assert source == ["another\n"]


def test_an_unknown_part_is_named(tmp_path: Path) -> None:
    with pytest.raises(Exception, match="site: nonsense --"):
        parts.Site(_app(tmp_path)).expanded("page", "<!-- site: nonsense -->\n")


def test_docstrings_keep_their_sections() -> None:
    lines = docstrings.restructured(
        """Do it, with |a - b| and a_.

        Parameters
        ----------
        u : (2, N) in [0, 1)
        k : int,
            at least `1`

        Raises
        ------
        ValueError
            Another shape.
        """.replace("\n        ", "\n").splitlines()
    )
    assert [line for line in lines if line] == [
        r"Do it, with \|a - b\| and a\_.",
        "**Parameters**",
        "``u``",
        "   (2, N) in [0, 1)",
        "``k``",
        "   int, at least ``1``",
        "**Raises**",
        "ValueError",
        "   Another shape.",
    ]


def test_headings_of_the_format_are_words() -> None:
    assert key_headings.heading("ImagePlaneDescription") == "Image plane"
    assert key_headings.heading("Quad") == "Quad"


def test_formulas_keep_an_upright_d_and_room_around_functions() -> None:
    formula = mathematics.mathml(r"L(p) \cos\theta\, \mathrm{d}x")
    assert formula.count("<mspace") == 3
    assert "<mtext>d</mtext>" in formula
    # A power belongs to the function, and nothing comes between.
    assert "<msup><mi>cos</mi>" in mathematics.mathml(r"\cos^2 x")


@pytest.mark.parametrize(
    ("cell", "joined"),
    [
        ("2.07e-03", ["2.07e-03"]),
        ("1.85 .. 1.90", ["1.85 .. 1.90"]),
        ("-0.57 (-0.60 .. -0.54)", ["-0.57", "(-0.60 .. -0.54)"]),
        ("≤ 1.9", ["≤ 1.9"]),
        ("(396, 132)", ["(396, 132)"]),
        ("4.180 (0.78)", []),
        ("a well-known case", []),
        ("+0.4% by 3e+2 of 5", ["+0.4%", "3e+2"]),
    ],
)
def test_numbers_in_tables_are_not_broken(cell: str, joined: list[str]) -> None:
    paragraph = nodes.paragraph("", cell)
    table = nodes.table("", nodes.row("", nodes.entry("", paragraph)))
    numbers.join_numbers(table)
    assert paragraph.astext() == cell
    found = [part.astext() for part in paragraph.findall(nodes.inline)]
    assert found == joined


def test_only_tables_and_no_code_have_numbers_joined() -> None:
    code = nodes.entry("", nodes.paragraph("", "", nodes.literal("", "1e-3")))
    page = nodes.section("", nodes.paragraph("", "from 1 .. 2"), nodes.row("", code))
    numbers.join_numbers(page)
    assert not list(page.findall(nodes.inline))
