"""Tables say the same on a terminal and elsewhere."""

import sys

import pytest

from course.base.texts import count
from course.cli import tables
from course.engine.render.sections import plain_text, receipt_sections
from tests.cli.stand_in import RECEIPT

SECTIONS = [("rays", [("camera", "12"), ("shadow", "7")]), ("effects", [("[red]lens", "off")])]


def test_plain_columns_line_up() -> None:
    assert plain_text("box.png", SECTIONS).splitlines() == [
        "box.png",
        "  rays     camera     12",
        "           shadow     7",
        "  effects  [red]lens  off",
    ]


def test_a_terminal_shows_the_same_words(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    tables.print_sections("box [1].png", SECTIONS)
    shown = capsys.readouterr().out
    for word in ("box [1].png", "rays", "camera", "12", "shadow", "7", "[red]lens", "off"):
        assert word in shown


def test_a_receipt_leaves_out_what_was_not_used() -> None:
    sections = dict(receipt_sections(RECEIPT))
    assert [label for label, _ in sections["rays"]] == [
        "camera",
        "shadow",
        "refraction",
        "a second",
    ]
    assert dict(sections["rays"])["a second"] == "19.4 million"


def test_embrees_share_is_of_all_threads_time() -> None:
    rows = dict(dict(receipt_sections(RECEIPT))["time"])
    assert "50% of all threads' time" in rows["inside Embree"]


@pytest.mark.parametrize(("mean", "told"), [(64, "64"), (64.0, "64"), (10.94, "10.9 on average")])
def test_the_samples_that_were_reached_are_told(mean: float, told: str) -> None:
    sections = dict(receipt_sections(RECEIPT | {"samples": mean}))
    assert sections["samples"] == [("a pixel", told)]


def test_shadow_rays_that_were_not_sent_are_told_with_their_share() -> None:
    sent = RECEIPT | {"rays": {"camera": 9, "shadow": 30}, "spared": {"clear": 60, "cut off": 10}}
    rows = dict(dict(receipt_sections(sent))["not sent"])
    assert rows["clear"].startswith("60% of the shadow rays")
    assert rows["cut off"].startswith("10% of the shadow rays")
    assert "not sent" not in dict(receipt_sections(RECEIPT))


def test_what_was_skipped_is_one_line() -> None:
    skipped = dict.fromkeys(("thin_lens", "motion_blur", "cube_map"), "nothing needs it")
    receipt = RECEIPT | {"effects": {"called": [], "skipped": skipped}}
    sections = dict(receipt_sections(receipt))
    assert sections["effects"] == [("skipped", "3 that the scene doesn't need")]


def test_a_receipt_of_nothing_divides_by_nothing() -> None:
    empty = RECEIPT | {
        "rays": {},
        "numbers": {},
        "effects": {"called": [], "skipped": {}},
        "seconds": {},
        "wall_seconds": 0.0,
        "caster": "embree",
        "embree_seconds": 0.0,
    }
    assert [heading for heading, _ in receipt_sections(empty)] == ["samples", "time"]
    assert plain_text("nothing", [])


def test_counts_agree_with_their_noun() -> None:
    assert count(1, "thread") == "1 thread"
    assert count(12345, "sample") == "12,345 samples"
