"""A recorded pixel in a notebook: the page of its rays in a frame, and a still where no page is shown."""

from base64 import b64encode
from html import escape
from io import BytesIO
from typing import Any

import numpy as np
from PIL import Image, ImageDraw

from course.engine.core.types import Floats64
from course.engine.recording.story import Story
from course.engine.recording.view import KINDS, page, view_data

SIZE = (640, 400)
"""Of the still [pixels]."""

FINER = 2
"""Times as many pixels each way are drawn, and averaged."""

TURNED, TILTED = 0.75, 0.4
"""From where the camera is, as the page has it at first [radians]."""

_SKY = (233, 237, 241)
_COLOURS = dict(
    zip(
        KINDS,
        ("#0b5cad", "#a86a00", "#17692f", "#7b3fa0", "#c2320c", "#0e7490"),
        strict=True,
    )
)
"""Of rays, as the page has them in the light."""

_DEPTH, _KIND, _START, _END, _MET = 2, 3, 4, 5, 6


def frame(story: Story) -> str:
    """The page in a frame; a notebook that isn't trusted drops it and what hides the still, and shows its text."""
    style = "width: 100%; height: 56rem; border: 0"
    text = f"{story.tree.text}; {story.reason}. In a trusted notebook the rays can be turned."
    # Between single quotes the double ones of all its data needn't be escaped.
    inside = page(story).replace("&", "&amp;").replace("'", "&#39;")
    return (
        '<div class="course-rays"><style>.course-rays > img { display: none }</style>'
        f'<iframe title="Rays of a pixel" style="{style}" srcdoc=\'{inside}\'>{escape(text)}</iframe>'
        f'<img src="data:image/png;base64,{b64encode(story.still).decode()}" alt="Rays of the pixel"></div>'
    )


def still(story: Story) -> bytes:
    """The first view of the page as a PNG: surfaces from the farthest to the nearest, and the rays over them."""
    data = view_data(story)
    rays = [row for row in data["segments"] if data["names"][row[_MET]] != "environment"]
    ends = np.array([row[_END] for row in rays] or [data["camera"]["eye"]], np.float64)
    hits = [row[_END] for row in rays if row[_DEPTH] == row[_KIND] == 0]
    hit = np.array(hits[len(hits) // 2]) if hits else None
    seen = _View(np.array(data["camera"]["eye"]), np.array(data["camera"]["up"]), ends, hit)
    width, height = (FINER * side for side in SIZE)
    picture = Image.new("RGB", (width, height), _SKY)
    pen = ImageDraw.Draw(picture, "RGBA")
    surfaces: list[tuple[float, list[tuple[float, float]], tuple[int, ...]]] = []
    for thing in data["objects"]:
        for triangle in np.array(thing["triangles"], np.float64).reshape(-1, 3, 3):
            if (corners := seen.placed(triangle)) is not None:
                facing = 1.0 if thing["lamp"] else seen.facing(triangle)
                shade = tuple(round(c * (0.45 + 0.55 * facing)) for c in thing["color"])
                places = [(float(x), float(y)) for x, y, _ in corners]
                surfaces.append((float(corners[:, 2].mean()), places, shade))
    for _, places, shade in sorted(surfaces, key=lambda one: -one[0]):
        pen.polygon(places, fill=shade)
    for row in data["segments"]:
        line = seen.placed(np.array([row[_START], row[_END]], np.float64))
        if line is not None:
            pen.line(
                [(float(x), float(y)) for x, y, _ in line],
                fill=f"{_COLOURS[KINDS[row[_KIND]]]}b0",
                width=FINER,
            )
    file = BytesIO()
    picture.resize(SIZE, Image.Resampling.BOX).quantize(128).save(file, "PNG", optimize=True)
    return file.getvalue()


class _View:
    """Looks at where rays end, from beside the camera.

    Parameters
    ----------
    eye, up : (3,) of the scene's camera
    ends : (n, 3) of rays that hit something
    hit : (3,) where one of the camera's rays ends, whose neighbourhood is seen; None if none hits anything
    """

    def __init__(self, eye: Floats64, up: Floats64, ends: Floats64, hit: Floats64 | None) -> None:
        focus = ends.mean(axis=0) * 0.75 + eye * 0.25
        extent = max(float(np.linalg.norm(np.vstack([ends, eye]) - focus, axis=1).max()), 1e-9)
        axis = int(np.abs(up).argmax())
        above = np.zeros(3)
        above[axis] = 1.0 if up[axis] >= 0 else -1.0
        first = _unit(eye - focus)
        # Around the vertical axis by Rodrigues' formula; the height is chosen.
        flat = _unit(first - above * (first @ above) + 1e-12)
        flat = flat * np.cos(TURNED) + np.cross(above, flat) * np.sin(TURNED)
        self.out = flat * np.cos(TILTED) + above * np.sin(TILTED)
        self.right = _unit(np.cross(above, self.out))
        self.above = np.cross(self.out, self.right)
        distance = 2.6 * extent
        close = distance if hit is None else 1.9 * float(np.linalg.norm(hit - eye))
        if hit is not None and close < distance:
            focus, distance = hit * 0.75 + eye * 0.25, close
        self.eye = focus + self.out * distance
        self.nearest = 0.05 * extent

    def placed(self, points: Floats64) -> Any:
        """(n, 3) columns, rows and distances of points (n, 3); None where one is behind the eye."""
        beside = points - self.eye
        distance = -beside @ self.out
        if distance.min() < self.nearest:
            return None
        width, height = (FINER * side for side in SIZE)
        scale = 1.5 * min(width, height)
        x = width / 2 + scale * (beside @ self.right) / distance
        y = height / 2 - scale * (beside @ self.above) / distance
        return np.stack([x, y, distance], axis=1)

    def facing(self, triangle: Floats64) -> float:
        """Cosine between the surface and the way to it."""
        normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
        return float(abs(_unit(normal) @ _unit(self.eye - triangle[0])))


def _unit(vector: Floats64) -> Floats64:
    length = float(np.linalg.norm(vector))
    unit: Floats64 = vector / length if length else vector
    return unit
