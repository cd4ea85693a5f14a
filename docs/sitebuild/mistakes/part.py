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
    figures = [figure for row in rows.values() for figure, _ in row]
    if place.blank:
        files = {figure: (blank(figure, place.made / "mistakes"), "") for figure in figures}
    else:
        files = STUDIO.files(figures)
    shown = []
    for row in rows.values():
        shown.append(f'<div class="mistakes" role="group" aria-label="{name}, right and wrong">\n')
        for figure, bullet in row:
            file, note = files[figure]
            address = place.address(f"_mistakes/{figure.file}", file)
            shown.append(_shown(figure, bullet, address, note))
        shown.append("</div>\n")
    return "\n".join(shown)


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


def _shown(figure: Figure, bullet: Bullet | None, address: str, note: str) -> str:
    """One figure; its caption is Markdown between blank lines."""
    looked = look(figure.function, figure.seen)
    shows = looked.shows
    if bullet is None:
        kind, caption = "right", f"**Right.** {shows}."
        alternative = f"{figure.function} as it should be. {shows}."
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
