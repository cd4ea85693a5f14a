"""Draw a figure of any kind, or say why it can't be drawn."""

from __future__ import annotations

from course.grading.checks.check import Figure
from course.grading.reports.panels import Drawing, NotDrawable
from course.grading.reports.pictures import draw_pictures
from course.grading.reports.plots import draw_histogram, draw_points

_BY_KIND = {"pictures": draw_pictures, "points": draw_points, "histogram": draw_histogram}


def draw(figure: Figure) -> Drawing:
    """Draw a figure, whatever its arrays hold: they come from students.

    Returns
    -------
    Drawing
        Without panels, but with a sentence, where nothing can be drawn.
    """
    try:
        return _BY_KIND[figure.kind](figure)
    except NotDrawable as reason:
        return Drawing(figure.title, notes=(f"This can't be drawn: {reason}.",))
    except Exception as error:  # noqa: BLE001 - a report without this figure is better than no report
        return Drawing(figure.title, notes=(f"This can't be drawn ({type(error).__name__}).",))
