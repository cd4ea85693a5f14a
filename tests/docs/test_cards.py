"""The home page shows each module once, the warm-up first, with minutes and what comes before it."""

import re
from pathlib import Path

import pytest
from click.testing import CliRunner
from PIL import Image

from course.cli.main import commands
from course.engine.functions.modules import COURSE, TAUGHT
from course.school.grading import progress


def test_each_module_has_a_card_in_the_order_of_the_course(site: Path) -> None:
    text = (site / "index.html").read_text(encoding="utf-8")
    shown = re.findall(r'<li><a href="modules/(\w+)\.html">.*?</li>', text, re.DOTALL)
    assert shown == ["sampling", *(module for module in COURSE if module != "sampling")]


def test_cards_say_how_long_it_takes_and_after_what(site: Path) -> None:
    text = (site / "index.html").read_text(encoding="utf-8")
    card = re.search(r'<li><a href="modules/soft_shadows\.html">(.*?)</li>', text, re.DOTALL)
    assert card
    assert "You write the functions that choose points on a light" in card[1]
    assert re.search(r"long: \d+ \+ 150 minutes, after sampling and supersampling", card[1])
    assert "<img" in card[1]


def test_a_card_has_a_small_picture_and_keeps_the_large_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("sphinx", reason='the site needs: pip install -e ".[docs]"')
    from sitebuild import cards, pictures
    from sitebuild.place import Place

    planned = pictures.shot("film")
    large = tmp_path / "large.webp"
    Image.new("RGB", planned.size).save(large)
    monkeypatch.setattr(pictures, "picture", lambda _: (large, {}))
    place = Place("", False, tmp_path, {})
    shown = cards._small(place, planned, "Film")
    assert 'width="480" height="240"' in shown
    with Image.open(place.files["_cards/film.webp"]) as image:
        assert image.size == (480, 240)
    assert place.kept == {large}


def test_status_lists_modules_in_the_order_of_the_cards(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def unwritten(_folder: Path, module: str, *_: object) -> list[dict[str, object]]:
        told = {"title": "", "found": "", "again": "", "page": ""}
        return [{"module": module, "name": "f", "state": "to do", "points": 0, "of": 10, **told}]

    monkeypatch.setattr(progress, "_checked", unwritten)
    result = CliRunner().invoke(commands, ["status", "--folder", str(tmp_path)])
    assert result.exit_code == 0, result.output
    assert re.findall(r"^(\w+)  +to do ", result.stdout, re.MULTILINE) == list(TAUGHT)
