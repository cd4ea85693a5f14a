"""A rendered picture."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from course.base.errors import CourseError
from course.engine.core.film import AnyFilm
from course.engine.core.types import Floats32
from course.engine.render.receipt import Receipt
from course.engine.scene.scene import SceneSettings

if TYPE_CHECKING:
    from course.engine.render.compared import ComparedPictures


@dataclass(frozen=True)
class Picture:
    """Linear radiance, and what it took to get it.

    A picture shows itself in a notebook, and can be handed back to ``render`` to be continued.

    Attributes
    ----------
    film : the sums behind the picture
    settings : what it was rendered with; ``settings.samples`` is what was asked for
    receipt : what it has cost
    complete : every pixel has all the samples that were asked for
    interrupted : Ctrl-C ended it
    """

    film: AnyFilm
    settings: SceneSettings
    receipt: Receipt
    complete: bool
    interrupted: bool = False

    @property
    def linear(self) -> Floats32:
        """(H, W, 3) float32 linear RGB radiance, row 0 the top row."""
        return np.moveaxis(self.film.linear, 0, 2)

    @property
    def shown(self) -> Floats32:
        """(3, H, W) float32 linear RGB that a PNG shows: the denoised preview if there is one, else the picture."""
        preview: Floats32 | None = getattr(self.film, "preview", None)
        return self.film.linear if preview is None else preview

    def save(self, path: str | Path) -> None:
        """Write the picture: ``.png`` (8 bit, sRGB unless the scene's film says otherwise) or ``.exr`` (linear).

        Raises OutputError when the file can't be written; then there is no such file.
        """
        from course.engine.formats.pictures.files import save

        exact = Path(path).suffix.lower() == ".exr"
        save(Path(path), self.film.linear if exact else self.shown, self.settings.display)

    def save_heat_map(self, path: str | Path) -> None:
        """Write where the samples went: black the fewest, white the most, logarithmic between; see ``save``."""
        from course.engine.formats.pictures.display import heat_map
        from course.engine.formats.pictures.files import save

        save(Path(path), heat_map(np.maximum(self.film.samples, 1)))

    def __repr__(self) -> str:
        receipt = self.receipt
        height, width = self.film.samples.shape
        return (
            f"<Picture {width} x {height}, {receipt.samples:g} samples a pixel,"
            f" {receipt.wall_seconds:.2f} s on {receipt.threads} thread{'s' * (receipt.threads > 1)}>"
        )

    def error(self, other: "Picture") -> float:
        """Root-mean-square difference from another picture of the same size [radiance].

        Raises CourseError: it has another size.
        """
        _check_size(self, other)
        difference = self.linear.astype(np.float64) - other.linear
        return float(np.sqrt(np.mean(np.square(difference))))

    def compare(self, other: "Picture") -> "ComparedPictures":
        """Set another picture of the same size beside it, which a notebook shows under a slider.

        Raises CourseError: it has another size.
        """
        from course.engine.render.compared import ComparedPictures

        _check_size(self, other)
        return ComparedPictures(self, other)

    def _repr_png_(self) -> bytes:
        from course.engine.formats.pictures.files import encode_png

        return encode_png(self.shown, self.settings.display)

    def _repr_html_(self) -> str:
        """Show the picture, and its receipt where it is asked for; what takes away this page shows the PNG."""
        from course.engine.render.inline import picture_html

        return picture_html(self)


def _check_size(one: Picture, other: object) -> None:
    if not isinstance(other, Picture):
        raise CourseError(
            f"a picture is compared with another that render has made, not {type(other).__name__}"
        )
    sizes = [each.film.samples.shape for each in (one, other)]
    if sizes[0] != sizes[1]:
        (h, w), (height, width) = sizes
        raise CourseError(
            f"pictures of {w} x {h} and {width} x {height} pixels can't be compared; "
            "render both with the same size="
        )
