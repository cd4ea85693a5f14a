"""A sheet of pictures for lectures: rows of pictures of one size, each under its name."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

from course.core.types import Floats32
from course.formats.pictures.display import linear_to_srgb8

Cell = tuple[str, Floats32]
"""A picture's name, and the picture: (3, H, W) linear RGB."""

GAP = 8
CAPTION = 34
"""Pixels between pictures, and above a picture for its name."""


def draw_sheet(rows: Sequence[Sequence[Cell | None]], path: Path) -> Path:
    """Draw square pictures of one size in rows, as a PNG; None leaves a place empty."""
    (side,) = {picture.shape[-1] for row in rows for _, picture in filter(None, row)}
    width = max(map(len, rows)) * (side + GAP) + GAP
    page = Image.new("RGB", (width, len(rows) * (side + CAPTION) + GAP), "white")
    draw, font = ImageDraw.Draw(page), ImageFont.load_default(size=16)
    for y, row in enumerate(rows):
        for x, cell in enumerate(row):
            if cell is not None:
                name, picture = cell
                left, top = GAP + x * (side + GAP), y * (side + CAPTION)
                draw.text((left, top + 8), name, "black", font)
                page.paste(Image.fromarray(linear_to_srgb8(picture)), (left, top + CAPTION))
    path.parent.mkdir(parents=True, exist_ok=True)
    page.save(path)
    return path
