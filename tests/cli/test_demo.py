"""`course demo`: every scene's picture, and one page that needs nothing else."""

import re
from base64 import b64decode
from html.parser import HTMLParser
from pathlib import Path

from course.cli.demo import SHOWN
from tests.cli.conftest import Run
from tests.cli.stand_in import Engine


class Page(HTMLParser):
    """What a browser would find on a page."""

    VOID = frozenset({"meta", "img", "link", "br"})

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.words: list[str] = []
        self.sources: list[str] = []
        self.links: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        if tag not in self.VOID:
            self.open.append(tag)
        values = dict(attributes)
        self.sources += [str(values["src"])] if "src" in values else []
        self.links += [str(values["href"])] if "href" in values else []

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.words.append(data.strip())


def test_each_scene_has_a_picture_and_a_place_on_the_page(
    run: Run, engine: Engine, tmp_path: Path
) -> None:
    result = run("demo", "a.yaml", "b.yaml", "--out", Path("new", "folder"))
    assert result.exit_code == 0, result.output
    folder = tmp_path / "new" / "folder"
    assert {path.name for path in folder.iterdir()} == {"a.png", "b.png", "index.html"}
    page = Page((folder / "index.html").read_text(encoding="utf-8"))
    assert page.links == ["a.png", "b.png"]
    for source, name in zip(page.sources, page.links, strict=True):
        kind, _, data = source.partition(",")
        assert kind == "data:image/png;base64"
        assert b64decode(data) == (folder / name).read_bytes()
    assert len(engine.rendered) == 2
    assert result.stdout.count("4,915,200") == 2


def test_the_page_is_whole_and_asks_for_nothing_else(
    run: Run, engine: Engine, tmp_path: Path
) -> None:
    engine.title = "<script>alert('x')</script> & \"more\""
    run("demo", "a.yaml", "--out", ".")
    text = (tmp_path / "index.html").read_text(encoding="utf-8")
    page = Page(text)
    assert not page.open
    assert "script" not in re.findall(r"<(\w+)", text)
    assert engine.title in page.words
    assert "http" not in text
    assert "url(" not in text


def test_scenes_of_the_course_are_shown_where_none_is_named(run: Run, engine: Engine) -> None:
    assert run("demo").exit_code == 0
    assert [path.stem for path, _ in engine.loaded] == list(SHOWN)
    assert all(path.is_file() for path, _ in engine.loaded)


def test_ctrl_c_ends_the_demo_without_a_page(run: Run, engine: Engine, tmp_path: Path) -> None:
    engine.picture.interrupted = True
    assert run("demo", "a.yaml", "b.yaml", "--out", "out").exit_code == 130
    assert len(engine.rendered) == 1
    assert not list((tmp_path / "out").iterdir())


def test_a_folder_that_cannot_be_made_is_named(run: Run, engine: Engine, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    result = run("demo", "a.yaml", "--out", Path("file", "sub"))
    assert result.exit_code == 1
    assert result.stderr.startswith(f"error: {Path('file', 'sub')}: this folder can't be made")
    assert not engine.loaded
