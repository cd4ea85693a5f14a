"""Packets of 4, 8 and 16 rays make the same picture; each width that isn't this process's in one of its own.

To compile the loops takes a minute, so `make stress` tries them. Embree's stand-in takes packets of 16 always, and
test_choice.py has its loop make the picture of its single rays.
"""

import os
from hashlib import sha256

import pytest

from course import load_scene, render
from course.base.errors import CourseError
from course.engine.functions.effects import PROJECT
from course.engine.loops import embree_device
from course.engine.loops.embree_device import NATIVE, WIDTH_VARIABLE
from tests.conftest import Compiling
from tests.lengths import LONG
from tests.processes import python

if not embree_device.available() or embree_device.library() is None:
    pytest.skip("Numba or Embree is not installed (pip install .[fast])", allow_module_level=True)

SCENE = PROJECT / "scenes" / "glossy.yaml"
PROGRAM = """
import sys
from hashlib import sha256
from course import load_scene, render
from course.engine.loops import embree_device
from course.engine.terms.shafts import stage
stage.WORTH = stage.SAMPLES_A_TRIANGLE = 0
picture = render(load_scene(sys.argv[1]), spp=4, size=(30, 20), sampler="sobol", compiled=True, threads=1)
spared = sum(picture.receipt.spared.values())
shadows = spared + picture.receipt.rays["shadow"]
print(embree_device.width(), sha256(picture.linear.tobytes()).hexdigest(), shadows, spared > 0)
"""


@pytest.mark.skipif(not LONG, reason="takes minutes: make stress")
@pytest.mark.parametrize("width", sorted({*NATIVE} - {embree_device.width()}))
def test_every_width_makes_the_picture_of_single_rays(
    width: int, compiled_in_turns: Compiling
) -> None:
    with compiled_in_turns():
        done = python("-c", PROGRAM, SCENE, environment={**os.environ, WIDTH_VARIABLE: str(width)})
    single = render(load_scene(SCENE), spp=4, size=(30, 20), sampler="sobol", compiled=False)
    expected = sha256(single.linear.tobytes()).hexdigest()
    shadows = single.receipt.rays["shadow"]
    assert done.stdout.split() == [str(width), expected, str(shadows), "True"]


def test_the_device_says_how_wide_it_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(WIDTH_VARIABLE, raising=False)
    embree, device = embree_device.library(), embree_device.device()
    assert embree is not None
    width = embree_device.width.__wrapped__()
    asked = {n: bool(embree.rtcGetDeviceProperty(device, number)) for n, number in NATIVE.items()}
    assert width == max((n for n, native in asked.items() if native), default=4)


@pytest.mark.parametrize("wanted", ["5", "32", "wide"])
def test_another_width_is_refused(wanted: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(WIDTH_VARIABLE, wanted)
    if embree_device.chosen() == "embree":
        with pytest.raises(CourseError, match="expected 4, 8 or 16"):
            embree_device.width.__wrapped__()
