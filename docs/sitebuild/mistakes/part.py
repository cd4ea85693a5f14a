"""The row of figures after a list of common mistakes: what is right, then each mistake."""

from html import escape

from course.base.errors import CourseError
from sitebuild.mistakes.bullets import Bullet, bullets, plain
from sitebuild.mistakes.catalog import look, look_at
from sitebuild.mistakes.figures import STUDIO, Figure, blank
from sitebuild.mistakes.look import SIZE
from sitebuild.mistakes.plots import is_plot
from sitebuild.mistakes.submissions import submission
from sitebuild.place import Place


def mistakes(place: Place, name: str, words: str = "") -> str:
    """Show the mistakes of MODULE.FUNCTION.

    Parameters
    ----------
    words : names of wrong submissions, bullet by bullet of the list; ``;`` is between bullets, and ``-`` stands for one
        that has none

    Raises
    ------
    CourseError
        A name is of no wrong submission of that function, or there are more or fewer parts than bullets.
    """
    rows: dict[int, list[tuple[Figure, Bullet | None]]] = {}
    for bullet, names in of_bullets(name, words):
        for each in names:
            seen = look_at(name, each)
            row = rows.setdefault(seen, [(Figure(name, "", seen), None)])
            row.append((Figure(name, each, seen), bullet))
    return "\n".join(_row(place, f"{name}, right and wrong", row) for row in rows.values())


def right(place: Place, name: str, words: str) -> str:
    """Show MODULE.FUNCTION as it should be; the words are those of its mistakes, beside which it is seen again."""
    first = next(names[0] for _, names in of_bullets(name, words) if names)
    return _row(place, f"{name}, right", [(Figure(name, "", look_at(name, first)), None)])


def _row(place: Place, label: str, row: list[tuple[Figure, Bullet | None]]) -> str:
    figures = [figure for figure, _ in row]
    if place.blank:
        files = {figure: (blank(figure, place.made / "mistakes"), "") for figure in figures}
    else:
        files = STUDIO.files(figures)
    kind = "mistakes alone" if len(row) == 1 else "mistakes"
    shown = [f'<div class="{kind}" role="group" aria-label="{label}">\n']
    for figure, bullet in row:
        file, note = files[figure]
        address = place.address(f"_mistakes/{figure.file}", file)
        shown.append(_shown(figure, bullet, address, note, alone=len(row) == 1))
    return "\n".join([*shown, "</div>\n"])


def of_bullets(name: str, words: str) -> list[tuple[Bullet, list[str]]]:
    """Which submissions belong to each bullet.

    Raises
    ------
    CourseError
        There are more or fewer than bullets.
    """
    parts = [part.split() for part in words.split(";")]
    listed = bullets(name)
    if len(parts) != len(listed):
        raise CourseError(f"{name} has {len(listed)} common mistakes, and figures for {len(parts)}")
    return [
        (bullet, [] if part == ["-"] else part) for bullet, part in zip(listed, parts, strict=True)
    ]


def _shown(
    figure: Figure, bullet: Bullet | None, address: str, note: str, *, alone: bool = False
) -> str:
    """One figure; its caption is Markdown between blank lines."""
    looked = look(figure.function, figure.seen)
    shows = looked.shows
    if bullet is None:
        kind, caption = "right", f"**Right.** {shows}."
        beside = "" if alone else ", beside its mistakes"
        alternative = f"{figure.function} as it should be{beside}. {shows}."
    else:
        about = submission(figure.function, figure.name).about
        said = "" if about.strip(".").lower() == bullet.title.strip(".").lower() else f" {about}"
        kind, caption = "wrong", f"**{bullet.title}**{said} {note}".rstrip()
        alternative = plain(f"{figure.function} with a mistake. {about} {bullet.text} {note}")
    if is_plot(looked.draw):
        kind += " plot"
    width, height = SIZE
    return f"""<figure class="{kind}">
<img src="{address}" alt="{escape(alternative)}" width="{width}" height="{height}" loading="lazy">
<figcaption>

{caption}

</figcaption>
</figure>
"""
