"""Pictures in a notebook: as small as a page needs them, with what they have cost folded below."""

from base64 import b64encode
from html import escape
from io import BytesIO

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from course.base.texts import count
from course.engine.render.picture import Picture
from course.engine.render.sections import receipt_table

QUALITY = 90
"""Of WebP on a page: a tenth of the PNG's bytes, and no difference to be seen. ``Picture.save`` keeps every bit."""


def codes_of(picture: Picture) -> NDArray[np.uint8]:
    """(H, W, 3) as a PNG has them."""
    return picture.settings.display.codes(picture.shown)


def image(codes: NDArray[np.uint8], said: str, style: str = "") -> str:
    """An element that shows codes (H, W, 3)."""
    file = BytesIO()
    Image.fromarray(codes).save(file, "webp", quality=QUALITY)
    height, width, _ = codes.shape
    return (
        f'<img src="data:image/webp;base64,{b64encode(file.getvalue()).decode()}"'
        f' width="{width}" height="{height}" alt="{escape(said)}" style="max-width: 100%; height: auto; {style}">'
    )


def said_of(picture: Picture) -> str:
    """What a picture has, and took, in a line."""
    receipt = picture.receipt
    ended = ", ended early" if picture.interrupted else ""
    threads = count(receipt.threads, "thread")
    return f"{receipt.samples:g} samples a pixel, {receipt.wall_seconds:.2f} s on {threads}{ended}"


def picture_html(picture: Picture) -> str:
    """The picture, and its receipt folded."""
    said = said_of(picture)
    called = picture.receipt.effects.get("yours")
    own = (
        f"; yours: {', '.join(called) or 'none of the functions called'}"
        if called is not None
        else ""
    )
    return (
        f"<div>{image(codes_of(picture), f'Rendered picture: {said}')}"
        f"<details><summary>{escape(said + own)}</summary>{receipt_table(picture.receipt)}</details></div>"
    )
