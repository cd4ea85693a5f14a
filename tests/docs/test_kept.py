"""What builds keep between them is removed when no page uses it any more, and only then."""

import importlib
import pkgutil
import runpy
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')
pytest.importorskip("latex2mathml", reason='the site needs: pip install -e ".[docs]"')

import sitebuild
from sitebuild import kept, notebook, parts, rays
from sitebuild.place import Place
from sphinx.project import Project

from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT


@pytest.fixture
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Kept files: in each folder one that is used, with what belongs to it, and one that isn't."""
    monkeypatch.setattr(kept, "ROOT", tmp_path / "kept")
    for folder in (*kept.FOLDERS, "doctrees"):
        (kept.ROOT / folder).mkdir(parents=True)
        for name in ("used.webp", "used.txt", "old.webp", "old.txt", ".course-0.tmp.webp"):
            (kept.ROOT / folder / name).touch()
    return kept.ROOT


def _left(root: Path, folder: str) -> set[str]:
    return {path.name for path in (root / folder).iterdir()}


ALL = {"used.webp", "used.txt", "old.webp", "old.txt", ".course-0.tmp.webp"}
USED = ALL - {"old.webp", "old.txt"}


def test_in_every_folder_what_is_not_used_is_removed(root: Path) -> None:
    removed = kept.forget(root / folder / "used.webp" for folder in kept.FOLDERS)
    assert [(path.parent.name, path.name) for path in removed] == [
        (folder, name) for folder in kept.FOLDERS for name in ("old.txt", "old.webp")
    ]
    for folder in kept.FOLDERS:
        assert _left(root, folder) == USED
    assert _left(root, "doctrees") == ALL


def test_a_file_of_the_same_name_in_another_folder_keeps_nothing(root: Path) -> None:
    kept.forget([root / "keys" / "used.webp", root / "series" / "old.webp"])
    assert _left(root, "keys") == USED
    assert _left(root, "series") == {"old.webp", "old.txt", ".course-0.tmp.webp"}
    assert _left(root, "pictures") == {".course-0.tmp.webp"}


def test_every_folder_that_a_part_keeps_is_among_them() -> None:
    found = set()
    for each in pkgutil.walk_packages(sitebuild.__path__, "sitebuild."):
        for value in vars(importlib.import_module(each.name)).values():
            if isinstance(value, Path) and kept.ROOT in value.parents:
                found.add(value.relative_to(kept.ROOT).as_posix())
    assert found == set(kept.FOLDERS)


def _pages() -> set[str]:
    """The pages that Sphinx finds."""
    settings = runpy.run_path(str(kept.DOCS / "conf.py"))
    project = Project(kept.DOCS, {".md": "markdown"})
    return {str(page) for page in project.discover(settings["exclude_patterns"])}


def test_the_site_is_whole_with_all_pages_only() -> None:
    pages = _pages()
    assert len(pages) > 25
    assert kept.whole(PROJECT / "docs", pages)
    for page in pages:
        assert not kept.whole(PROJECT / "docs", pages - {page}), page


def _built(folder: Path, **changes: Any) -> None:
    """Finish a build whose pages show one kept picture of each folder but the notebooks', and a notebook."""
    error = changes.pop("error", None)
    app = SimpleNamespace(
        builder=SimpleNamespace(name=changes.pop("builder", "html")),
        config=SimpleNamespace(pictures=changes.pop("pictures", "render")),
        env=SimpleNamespace(found_docs=changes.pop("pages", _pages())),
        srcdir=str(changes.pop("source", kept.DOCS)),
        outdir=str(folder / "html"),
        doctreedir=str(folder / "doctrees"),
    )
    assert not changes
    site = parts.Site(app)
    for name in kept.FOLDERS:
        if name != "notebooks":
            site.files[f"_{name}/picture.webp"] = kept.ROOT / name / "used.webp"
    site.kept.add(kept.ROOT / "notebooks" / "used.webp")
    site.finish(app, error)


def test_a_build_of_the_site_keeps_what_its_pages_are_made_of(root: Path, tmp_path: Path) -> None:
    _built(tmp_path)
    for folder in kept.FOLDERS:
        assert _left(root, folder) == USED, folder
    assert _left(root, "doctrees") == ALL
    assert (tmp_path / "html" / "_series" / "picture.webp").is_file()


@pytest.mark.parametrize(
    "changes",
    [
        {"pictures": "blank"},
        {"pages": {"index", "gallery"}},
        {"pages": set()},
        {"source": Path("/")},
        {"builder": "linkcheck"},
        {"error": OSError("the disk is full")},
    ],
    ids=["blank", "two-pages", "no-page", "elsewhere", "no-site", "failed"],
)
def test_any_other_build_removes_nothing(
    root: Path, tmp_path: Path, changes: dict[str, Any]
) -> None:
    _built(tmp_path, **changes)
    for folder in kept.FOLDERS:
        assert _left(root, folder) == ALL, folder


def test_a_notebook_that_was_run_is_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    source = PROJECT / "docs" / "notebooks" / "first_look.ipynb"
    run = tmp_path / "first_look-0.ipynb"
    run.write_bytes(source.read_bytes())
    monkeypatch.setattr(notebook, "executed", lambda _: run)
    monkeypatch.setattr(kept, "ROOT", tmp_path)
    site = parts.Site(
        SimpleNamespace(
            doctreedir=tmp_path, outdir=tmp_path, config=SimpleNamespace(pictures="render")
        )
    )
    text = site.expanded("guides/notebook", "<!-- site: notebook first_look -->\n")
    assert "```python" in text
    assert site.kept == {run}
    blank = Place("", blank=True, made=tmp_path, files={})
    notebook.notebook(blank, "first_look")
    assert blank.kept == set()


def test_the_rays_of_a_pixel_are_followed_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    followed = []
    monkeypatch.setattr(rays, "_page", lambda *pixel: followed.append(pixel) or "rays")
    pixels = [("film", 7, 9), ("film", 8, 9), ("film", 7, 8), ("glossy", 7, 9)]
    files = [rays.view(*pixel, tmp_path) for pixel in pixels]
    assert len({*files}) == len(pixels)
    assert [rays.view(*pixel, tmp_path) for pixel in pixels] == files
    assert followed == pixels


def test_a_blank_page_follows_no_rays_and_knows_its_pixel(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr(rays, "_page")
    blank = Place("", blank=True, made=tmp_path, files={})
    assert 'title="The rays of pixel 7,9 of film.yaml"' in rays.rays(blank, "film", "7,9")
    with pytest.raises(CourseError, match=r"film\.yaml has \d+x\d+ pixels; there is no 9999,0"):
        rays.rays(blank, "film", "9999,0")
