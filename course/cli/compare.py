"""`course compare A B`: two pictures, and whether they are the same but for noise."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from course.base.errors import CourseError
from course.cli import options
from course.cli.outputs import check_outputs
from course.cli.tables import print_sections
from course.engine.render.sections import Section

if TYPE_CHECKING:
    from course.engine.comparing.seen import Seen
    from course.engine.comparing.significance import Comparison, Finding

DIFFERENT = 1
TROUBLE = 2
"""Exit codes as those of `diff` and `cmp`, which scripts know: 0 the same, 1 different, 2 trouble."""

TESTS = {
    "brightness": ("red", "green", "blue"),
    "movement": ("moved across", "moved down"),
    "sharpness": ("blurred",),
    "shapes": ("alike across", "alike down", "one sign"),
    "spot": ("spot",),
}
"""Names of tests, and the kinds of `course.engine.comparing.significance.Finding` that each looks for."""

FEW = 0.5
"""Share of pixels that differ, below which noise is not what makes the difference: it would make nearly all differ."""


@click.command()
@click.argument("a", metavar="A", type=options.PATH)
@click.argument("b", metavar="B", type=options.PATH)
@click.option(
    "--significance",
    type=click.FloatRange(0, 1, min_open=True, max_open=True),
    default=1e-4,
    show_default=True,
    metavar="P",
    help="Call them different where noise alone shows as much in less than this share of pairs.",
)
@click.option(
    "--difference",
    type=options.PATH,
    help="Write A - B in colours, as .png: red where A is brighter, blue where B is; with frames\n"
    "around what was seen.",
)
@click.option(
    "--json", "json_path", callback=options.json_path, help="Write what was found as JSON."
)
def compare(
    a: Path, b: Path, significance: float, difference: Path | None, json_path: Path | None
) -> None:
    """Tell whether two pictures are the same but for noise.

    Takes two renders of a scene by different seeds, numbers of samples or programs: EXR, HDR, PNG
    or JPEG, in any mixture. How noisy they are needn't be known. If one has 8 bits, both are
    compared as 8 bits show them, and pixels that are cut off at white are left out.

    Says what differs: brightness, everywhere or in a place, colours, a movement, a blur, or a spot.

    Exit codes: 0 no difference shown, 1 different, 2 trouble.
    """
    try:
        found = _compare(a, b, significance, difference, json_path)
    except CourseError as error:
        click.echo(f"error: {error}", err=True)
        raise click.exceptions.Exit(TROUBLE) from error
    if found.p_value < significance:
        raise click.exceptions.Exit(DIFFERENT)


def _compare(
    a: Path, b: Path, significance: float, difference: Path | None, json_path: Path | None
) -> Comparison:
    from course.engine.comparing.seen import seen
    from course.engine.comparing.significance import compare as compare_pictures
    from course.engine.formats.pictures.reading import LINEAR, read_picture

    for source in (a, b):
        check_outputs([("--difference", difference)], [("--json", json_path)], source)
    if difference is not None and difference.suffix.lower() != ".png":
        raise CourseError(f"--difference {difference}: colours are written as .png")
    first, second = read_picture(a), read_picture(b)
    coded = a.suffix.lower() not in LINEAR, b.suffix.lower() not in LINEAR
    try:
        found = compare_pictures(first, second, coded)
    except CourseError as error:
        raise CourseError(f"{a}, {b}: {error}") from error
    differences = seen(found, significance)
    if difference is not None:
        from course.engine.comparing.difference import difference_picture
        from course.engine.formats.pictures.files import write_png

        write_png(difference, difference_picture(first, second, differences))
    print_sections(f"{a} - {b}", _sections(found, differences, significance))
    if json_path is not None:
        from course.base.atomic import write_text

        told = {"a": str(a), "b": str(b), "significance": significance}
        write_text(
            json_path, json.dumps({**told, **_told(found, differences)}, indent=2, allow_nan=False)
        )
    return found


def _told(found: Comparison, differences: list[Seen]) -> dict[str, Any]:
    """Plain data."""
    return {
        "different": bool(differences),
        "p_value": found.p_value,
        "seen": [
            {"text": one.text, "place": None if one.place is None else asdict(one.place)}
            for one in differences
        ],
        "tests": [asdict(one) for one in found.found],
        "mean_difference": found.mean_difference,
        "mean": found.mean,
        "rmse": found.rmse,
        "differing": found.differing,
        "largest": found.largest,
        "clipped": found.clipped,
        "coded": found.coded,
    }


def _sections(found: Comparison, differences: list[Seen], significance: float) -> list[Section]:
    different = bool(differences)
    sign = "<" if different else ">="
    verdict = "different" if different else "no difference but noise"
    most, column, row = found.largest
    share = f"{found.differing:.2%}"
    few = 0 < found.differing < FEW and not different
    hint = (
        f"; but only {share} of the pixels differ: look at these with --difference" if few else ""
    )
    means = [
        f"{name} {d:+.3g} ({d / m:+.3%})" if m else f"{name} {d:+.3g}"
        for name, d, m in zip("RGB", found.mean_difference, found.mean, strict=True)
    ]
    verdicts = [("verdict", f"{verdict} (p-value {sign} {significance:g}){hint}")]
    verdicts += [("seen" if one is differences[0] else "", one.text) for one in differences]
    return [
        ("", verdicts),
        (
            "p-value",
            [
                ("altogether", f"{found.p_value:.2g}"),
                *((name, _p_value(found.least(*kinds))) for name, kinds in TESTS.items()),
            ],
        ),
        (
            "difference",
            [
                ("mean", ", ".join(means)),
                ("RMSE", f"{found.rmse:.4g}"),
                ("pixels", f"{share} differ, most by {most:+.3g} at column {column}, row {row}"),
            ],
        ),
        (
            "compared",
            [
                (
                    "left out",
                    f"{found.clipped:.2%} of the pixels: cut off at white, or beside such",
                ),
                (
                    "values",
                    "as 8 bits show them, decoded" if found.coded else "as the files hold them",
                ),
            ],
        ),
    ]


def _p_value(least: Finding) -> str:
    place = least.place
    at = (
        "in the whole picture"
        if least.whole
        else f"in {place.width} x {place.height} pixels at ({place.left}, {place.top})"
    )
    return f"{least.p_value:.2g}" + (f", {at}" if least.p_value < 1 else "")
