"""Whatever a scene file says, it renders to a finite picture or is refused by a message that names its line.

Where tests/scene stops at the description, these go on to the picture. A warning of NumPy is an error, here as in all
tests: an overflow on the way is a picture that is wrong somewhere.
"""

import copy
import json
import re
import warnings
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest
from hypothesis import given, note
from hypothesis import strategies as st
from numpy.typing import NDArray

from course import CourseError, load_scene, render
from course.base.errors import CourseWarning
from course.engine.formats.pictures.files import save
from course.engine.formats.yaml.description import Light, Object
from tests.changed_trees import change
from tests.engine.stress.descriptions import FACES, FILES, descriptions
from tests.engine.stress.examples import examples
from tests.lengths import LONG

MESHES = {
    "sliver.obj": "v 0 0 0\nv 1 1e-9 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n",
    "flat.obj": "v 0 0 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\n",
    "tetrahedron.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
}
PICTURES = {"cross.exr": (3, 4), "sky.exr": (4, 8)} | dict.fromkeys(FACES, (2, 2))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the meshes and pictures are that scenes may name."""
    folder = tmp_path_factory.mktemp("scenes")
    for name, text in MESHES.items():
        (folder / name).write_text(text, encoding="utf-8")
    rng = np.random.default_rng(0)
    for name, size in PICTURES.items():
        save(folder / name, rng.random((3, *size), np.float32))
    return folder


def test_every_file_that_scenes_may_name_is_there(folder: Path) -> None:
    for name in (*FACES, *(name for names in FILES.values() for name in names)):
        assert (folder / name).is_file()


def outcome(content: str, folder: Path) -> str:
    """What becomes of a scene file: "refused", "black" or "seen"; any other end is an error."""
    path = folder / "fuzz.yaml"
    path.write_text(content, encoding="utf-8")
    note(content)
    scene, refusal = None, ""
    with warnings.catch_warnings():
        # Of objects too small beside others; what becomes of them is to be finite all the same.
        warnings.simplefilter("ignore", CourseWarning)
        try:
            scene = load_scene(path, "solutions")
        except CourseError as error:
            refusal = str(error)
    if scene is None:
        assert re.match(rf"{re.escape(str(path))}:[1-9][0-9]*: ", refusal), refusal
        return "refused"
    settings = scene.settings
    # Where the file leaves them out, or has been spoilt there, they would cost too much.
    size, spp = (min(settings.width, 5), min(settings.height, 4)), min(settings.samples, 16)
    with suppress(CourseError), warnings.catch_warnings():
        # Of photons that find no way, which is told by those that were sent.
        warnings.simplefilter("ignore", CourseWarning)
        # Refused for its settings, which may as well come from the command line.
        return judged(render(scene, size=size, spp=spp, threads=1).linear)
    return "refused"


def judged(picture: NDArray[np.float32]) -> str:
    """A picture that is finite and not negative shows something or nothing."""
    assert np.isfinite(picture).all()
    assert (picture >= 0).all()
    return "seen" if picture.any() else "black"


def written(description: Any) -> str:
    # JSON is YAML, but for characters that it writes as halves of pairs.
    return json.dumps(description, ensure_ascii=False, indent=1)


def test_random_scenes_render_finite_or_are_refused_by_their_line(folder: Path) -> None:
    found: list[str] = []
    drawn: set[str] = set()

    @examples(short=60, long=2000)
    @given(description=descriptions())
    def check(description: dict[str, Any]) -> None:
        drawn.update(kinds(description))
        found.append(outcome(written(description), folder))

    check()
    # Many are rendered and show something, and everything occurs; or this would say little. Three of five are rendered,
    # but Hypothesis draws constants of whatever modules are loaded, so the sixty aren't always the same: a quarter or
    # fewer of them are rendered less often than once in a million.
    assert found.count("seen") + found.count("black") > len(found) / (3 if LONG else 4)
    # Of sixty, drawn otherwise after any change of the sources, fewer may happen to be seen than of many.
    assert found.count("seen") > len(found) / (3 if LONG else 6)
    everything = {kind.__struct_config__.tag for kind in (*get_args(Object), *get_args(Light))}
    everything |= {"gloss", "dielectric", "mirror", "lens", "shutter", "camera motion"}
    everything |= {"constant", "cube", "lat_long", "angular"}
    everything |= {"sobol", "random", "jittered", "regular"}
    everything |= {"sphere by polar", "ball by polar", "ball by rejection", "interpolated", "near"}
    # Hypothesis lets the modules that happen to be loaded have a say in what it draws, and the rarest kinds are in one
    # description of twenty: sixty of them may well do without one or the other.
    assert len(everything - drawn) <= (0 if LONG else len(everything) // 4)


def kinds(description: dict[str, Any]) -> Iterator[str]:
    """What a scene is made of."""
    camera = description["camera"]
    yield from (thing["shape"] for thing in description["objects"])
    yield from (light["type"] for light in description["lights"])
    yield from (light["samples"] for light in description["lights"] if "samples" in light)
    yield description["integrator"].get("shading_normals", "bent")
    for material in description["materials"].values():
        yield from (key for key in ("gloss", "dielectric", "mirror") if material.get(key))
    yield description.get("environment", {"type": "constant"})["type"]
    yield description["sampler"].get("type", "sobol")
    yield from (key for key in ("lens", "shutter", "near") if camera.get(key))
    yield from ("camera motion" for _ in [0] if camera.get("motion"))


WRONG = st.one_of(
    st.none(),
    st.booleans(),
    st.sampled_from([-1, 0, 1, 2**31, 2**32, -(10**30), 10**149, 0.5, -1e-150, 1e150, 4097]),
    st.sampled_from(["", "box", "point", "grid 0", "grid 99", "missing.obj", "none", "\\", "é"]),
    st.lists(st.sampled_from([0, 1.5, "x", None]), max_size=4),
    st.dictionaries(st.sampled_from(["type", "shape", "lobe", "scale"]), st.just(1), max_size=2),
)


@examples(short=40, long=2000)
@given(data=st.data())
def test_random_scenes_with_mistakes_render_finite_or_are_refused_by_their_line(
    data: st.DataObject, folder: Path
) -> None:
    description = copy.deepcopy(data.draw(descriptions()))
    for _ in range(data.draw(st.integers(1, 3))):
        change(description, data, WRONG, ["radius", "lens", "gloss", "colour"])
    outcome(written(description), folder)
