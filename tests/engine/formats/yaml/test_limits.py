"""`limits` bounds the files that a scene names, every kind of them, before they are read."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from course import CourseError, Scene
from course.engine.formats.pictures.files import save

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
FACES = [f"{side}.exr" for side in "abcdef"]
USES: dict[str, dict[str, Any]] = {
    "materials.painted.texture.image": {
        "materials": {"painted": {"texture": {"image": "a.exr"}}},
        "objects": [{"shape": "quad", "material": "painted"}],
    },
    "environment.image": {"environment": {"type": "lat_long", "image": "wide.exr"}},
    "environment.faces[0]": {"environment": {"type": "cube", "faces": FACES}},
    "objects[0]": {
        "materials": {"plain": {}},
        "objects": [{"shape": "mesh", "file": "a.obj", "material": "plain"}],
    },
}
"""A scene that names a file, by the key that does."""

MakeScene = Callable[..., Scene]


@pytest.fixture(autouse=True)
def files(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(TRIANGLE, encoding="utf-8")
    for name in FACES:
        save(tmp_path / name, np.full((3, 4, 4), 0.5, np.float32))
    save(tmp_path / "wide.exr", np.full((3, 2, 4), 0.5, np.float32))


@pytest.mark.parametrize("key", USES)
def test_a_file_of_more_bytes_is_refused_where_it_is_named(
    make_scene: MakeScene, tmp_path: Path, key: str
) -> None:
    name = {"environment.image": "wide.exr", "objects[0]": "a.obj"}.get(key, "a.exr")
    size = (tmp_path / name).stat().st_size
    with pytest.raises(CourseError) as caught:
        make_scene(**USES[key], limits={"bytes": size - 1})
    told = str(caught.value)
    assert key in told
    assert f"{name}: more than {size - 1:,} bytes: too large for a " in told
    assert told.endswith("; limits.bytes in the scene file allows more")
    make_scene(**USES[key], limits={"bytes": size})


@pytest.mark.parametrize(("key", "pixels"), [*zip(list(USES)[:3], (16, 8, 16), strict=True)])
def test_a_picture_of_more_pixels_is_refused_where_it_is_named(
    make_scene: MakeScene, key: str, pixels: int
) -> None:
    with pytest.raises(CourseError) as caught:
        make_scene(**USES[key], limits={"pixels": pixels - 1})
    told = str(caught.value)
    assert key in told
    assert f"are more than {pixels - 1} pixels; limits.pixels in the scene file allows more" in told
    make_scene(**USES[key], limits={"pixels": pixels})
