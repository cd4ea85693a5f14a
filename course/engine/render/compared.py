"""Two pictures of one view in a notebook: one over the other under a slider, and their difference on request."""

from dataclasses import dataclass
from functools import cached_property
from html import escape
from io import BytesIO

import numpy as np
from PIL import Image

from course.base.errors import CourseError
from course.engine.comparing.difference import difference_picture
from course.engine.comparing.seen import Seen, seen
from course.engine.comparing.significance import SIGNIFICANCE, Comparison, compare
from course.engine.core.types import Floats32
from course.engine.formats.pictures.files import encode_png
from course.engine.render.inline import QUALITY, codes_of, image, said_of
from course.engine.render.picture import Picture

GAP = 8
"""Pixels between the two where they stand side by side."""

STYLE = """\
.course-compared { position: relative }
.course-first { position: absolute; top: 0; left: 0; width: 100%; clip-path: inset(0 calc(100% - var(--cut, 50%)) 0 0) }
.course-compared > input { display: block !important; width: 100%; margin: .3rem 0 0 }
"""
"""What lays one over the other. A notebook that isn't trusted drops it whole, but of an element's style only a part."""


@dataclass(frozen=True, repr=False)
class ComparedPictures:
    """Two pictures of the same size; see ``Picture.compare``."""

    a: Picture
    b: Picture

    @property
    def error(self) -> float:
        """Root-mean-square difference [radiance]."""
        return self.a.error(self.b)

    @cached_property
    def found(self) -> Comparison:
        """Whether they are the same but for noise, as `course compare` tells it."""
        return compare(self.a.linear, self.b.linear)

    @cached_property
    def seen(self) -> list[Seen]:
        """What differs by more than noise, in sentences; empty where nothing does."""
        return seen(self.found, SIGNIFICANCE)

    @property
    def told(self) -> str:
        """The same in a line."""
        try:
            return "; ".join(one.text for one in self.seen) or "the same but for noise"
        except CourseError as error:
            # They may be too small, or as good as white.
            return str(error)

    @property
    def difference(self) -> "Difference":
        """A picture of a - b: red where the first is brighter, blue where the second is, frames around what is seen."""
        return Difference(difference_picture(self.a.linear, self.b.linear, self.seen))

    def __repr__(self) -> str:
        return f"<A and B differ by {self.error:.3g} (root mean square): {self.told}>"

    def _repr_jpeg_(self) -> bytes:
        """Both, side by side: a still, a fifth as large as a PNG."""
        a, b = codes_of(self.a), codes_of(self.b)
        white = np.full((len(a), GAP, 3), 255, np.uint8)
        file = BytesIO()
        Image.fromarray(np.hstack([a, white, b])).save(file, "JPEG", quality=QUALITY)
        return file.getvalue()

    def _repr_html_(self) -> str:
        """Show both under a slider; where a notebook isn't trusted they stand below each other, and there is none."""
        a, b = (
            image(codes_of(one), f"{name}: {said_of(one)}", "display: block; margin: 0")
            for name, one in (("A", self.a), ("B", self.b))
        )
        width = self.a.film.samples.shape[1]
        return (
            f'<div class="course-compared" style="width: {width}px; max-width: 100%"><style>{STYLE}</style>'
            f'<div class="course-first">{a}</div><div>{b}</div>'
            '<input type="range" min="0" max="100" value="50" aria-label="How much of A covers B"'
            ' style="display: none"'
            " oninput=\"this.parentNode.style.setProperty('--cut', this.value + '%')\">"
            f"<div>A, left or above: {escape(said_of(self.a))}; B: {escape(said_of(self.b))}</div>"
            f"<div>difference {self.error:.3g} (root mean square of radiance): {escape(self.told)}."
            " <code>.difference</code> shows where.</div></div>"
        )


@dataclass(frozen=True, repr=False)
class Difference:
    """Where two pictures differ.

    ``linear``: (3, H, W) float32
    """

    linear: Floats32

    def _repr_png_(self) -> bytes:
        return encode_png(self.linear)
