"""The course in a running notebook: one kernel for all tests that leave it as it was."""

import base64
import io
import json
import re
from collections.abc import Iterator

import numpy as np
import pytest
from PIL import Image

from course.engine.functions.effects import PROJECT
from course.school.notebooks.making import notebook_of
from tests.school.grading.lent import ReferencesFile
from tests.school.notebooks.kernels import Kernel, kernel

SCENE = str(PROJECT / "scenes" / "soft_shadows.yaml")

RIGHT = """
def displacement(velocity, time):
    if np.shape(velocity) != (3,) or np.ndim(time) != 1:
        raise ValueError(f"{np.shape(velocity)} {np.shape(time)}")
    return (np.asarray(velocity)[:, None] * time).astype(time.dtype)
"""


@pytest.fixture(scope="module")
def shared(
    tmp_path_factory: pytest.TempPathFactory, references_file: ReferencesFile
) -> Iterator[Kernel]:
    with kernel(tmp_path_factory.mktemp("notebook")) as found:
        found.lend({"motion_blur": references_file("motion_blur")})
        assert not found.run("%load_ext course\nimport numpy as np").error
        yield found


def cells(module: str, folder: str = "assignments") -> list[str]:
    text = (PROJECT / folder / f"{module}.py").read_text(encoding="utf-8")
    document = json.loads(notebook_of(module, text, PROJECT))
    return ["".join(one["source"]) for one in document["cells"] if one["cell_type"] == "code"]


def test_neither_the_package_nor_what_checks_functions_imports_ipython() -> None:
    from tests.processes import python

    imported = "import sys, course, course.school.grading.progress"
    python("-c", f"{imported}; assert 'IPython' not in sys.modules")


def test_a_stub_is_to_do_and_a_solution_right(shared: Kernel) -> None:
    setup, first, *_ = cells("motion_blur")
    assert not shared.run(setup).error
    assert "to do    shutter_times" in shared.run(first).text
    for cell in cells("motion_blur", "solutions")[:4]:
        found = shared.run(cell)
        assert not found.error
    assert "right    to_object_space" in found.text
    assert "10 of 10 points" in found.text
    assert "30 of 30 points" in shared.run("%check motion_blur").text


def test_only_the_functions_of_the_cell_are_checked(shared: Kernel) -> None:
    shown = shared.run(f"%%check motion_blur{RIGHT}").text
    assert "right    displacement" in shown
    assert "shutter_times" not in shown
    # Without a module it is that of the functions.
    assert "right    displacement" in shared.run(f"%%check{RIGHT}").text


def test_hints_by_rungs_and_places_by_cells(shared: Kernel) -> None:
    wrong = "\ndef displacement(velocity, time):\n    x = 2\n    return velocity[x + 7]\n"
    shown = shared.run(f"%%check motion_blur{wrong}")
    first = shown.text
    assert "wrong    displacement" in first
    assert f"cell In[{shown.number}], line 4" in first
    # As IPython knows it, which is told of a render.
    told = shared.run(
        "code = displacement.__code__\n"
        "print(code.co_firstlineno, get_ipython().compile.format_code_name(code.co_filename)[1])"
    )
    assert told.text == f"2 In[{shown.number}]\n"
    assert "%check motion_blur --only displacement/" in first
    assert "--hint 2" in first
    assert "smallest" not in first
    twice = RIGHT.replace("* time", "* time * 2")
    assert "smallest" in shared.run(f"%%check motion_blur --hint 2{twice}").text


def test_a_slip_in_a_name_is_told_with_what_may_be_meant(shared: Kernel) -> None:
    shared.run(f"%%check motion_blur --only none{RIGHT}")
    assert "mean displacement?" in shared.run("%check motion_blur --only displacment").text
    asked = shared.run("%check motion_blur --only displacement/linaer").text
    assert "did you mean displacement/linear?" in asked
    cell = "%%check motion_blur\ndef displacemnt(velocity, time):\n    return velocity"
    assert "displacemnt is no function of motion_blur; did you mean displ" in shared.run(cell).text


def test_arguments_in_another_order_and_a_name_bound_twice_are_told(shared: Kernel) -> None:
    cell = f"%%check motion_blur --only displacement/linear{RIGHT.replace('(velocity, time)', '(time, velocity)', 1)}"
    found = shared.run(cell, "turned")
    assert (
        "order of the stub, displacement(velocity, time); yours are (time, velocity)" in found.text
    )
    shared.run("displacement = abs", "bound anew")
    twice = shared.run("%check motion_blur --only displacement/linear").text
    assert re.search(r"cell In\[\d+\] binds displacement, as In\[\d+\] did before", twice)
    shared.run("'nothing'", "bound anew")
    assert "binds" not in shared.run(f"%%check motion_blur --only none{RIGHT}", "turned").text


def test_what_is_checked_is_what_the_cell_says_now(shared: Kernel) -> None:
    # A cell that is run again takes the place of itself, with a key and without.
    for key in (None, "a1"):
        # It would fail wherever the module is imported.
        failing = f"FACTOR = 1 / 0\n{RIGHT.replace('* time', '* time * FACTOR')}"
        assert "ZeroDivisionError" in shared.run(failing, key).error
        assert "right    displacement" in shared.run(f"%%check motion_blur{RIGHT}", key).text


def test_cells_in_any_order_tell_what_is_lacking(shared: Kernel) -> None:
    cell = "%%check thin_lens\ndef point_on_disk(u):\n    return folded(u)\n"
    assert "no cell that was run defines folded" in shared.run(cell).text
    shared.run("def folded(u):\n    return u")
    assert "no cell that was run" not in shared.run(cell).text


def test_a_cell_that_is_run_again_keeps_its_place(shared: Kernel) -> None:
    for key in ("one", None):
        shared.run("HALF = np.float32(0.5)", key)
        shared.run("ONE = HALF * 2", key and "two")
        shared.run(RIGHT.replace("* time", "* time * ONE"), key and "three")
        shared.run("HALF = np.float32(1) / 2", key)
        told = shared.run("%check motion_blur --only displacement/linear").text
        assert "right    displacement" in told
        assert "binds HALF" not in told


@pytest.mark.parametrize(
    ("cell", "told"),
    [
        ("%%check motion_blr\nx = 1", "did you mean motion_blur?"),
        ("%%check\nx = 1", "defines no function of one"),
        ("%%check motion_blur\nx = 1", "no function of motion_blur is defined here"),
        ("%check glossy", "no function of glossy is defined here"),
    ],
)
def test_what_can_not_be_checked_is_told(shared: Kernel, cell: str, told: str) -> None:
    found = shared.run(cell)
    assert told in f"{found.text} {found.error} {' '.join(found.trace)}"
    assert len(found.trace) < 4


def test_a_cell_that_fails_is_not_checked(shared: Kernel) -> None:
    found = shared.run(f"%%check motion_blur{RIGHT}\n1 / 0")
    assert "displacement  (" not in found.text
    assert "ZeroDivisionError" in found.text + found.error + "".join(found.trace)


def test_a_check_that_never_ends_is_interrupted(shared: Kernel) -> None:
    cell = "%%check motion_blur\nprint('begun')\ndef displacement(velocity, time):\n    while True:\n        pass\n"
    found = shared.run(cell, interrupt="begun")
    assert "interrupted" in found.text or "KeyboardInterrupt" in found.error
    assert shared.run("print(1 + 1)").text == "2\n"


def test_a_render_that_never_ends_is_interrupted(shared: Kernel) -> None:
    found = shared.run(
        "from course import load_scene, pixel, render\n"
        "def point_on_sphere(center, radius, u):\n"
        "    while True:\n"
        "        pass\n"
        f"scene = load_scene({SCENE!r}, effects=mine)\n"
        "print('begun')\n"
        "picture = render(scene, spp=1, size=(30, 20))\n"
        "print(picture.interrupted)",
        interrupt="begun",
    )
    # Before all else: a render of another test would never end, either.
    assert shared.run("del point_on_sphere\nprint(1 + 1)").text == "2\n"
    if "KeyboardInterrupt" not in found.error:
        assert "True" in found.text
    threads = (
        "import threading\nprint([t.name for t in threading.enumerate() if 'tiles' in t.name])"
    )
    assert shared.run(threads).text == "[]\n"


def test_mine_are_the_functions_that_are_written(shared: Kernel) -> None:
    shared.run("def image_distance(f, d):\n    raise NotImplementedError('not yet')")
    shown = shared.run("print(sorted(mine))\nmine").text
    assert "image_distance" not in shown
    assert "displacement" in shown


def test_a_picture_shows_itself_its_receipt_and_what_it_is_beside(shared: Kernel) -> None:
    found = shared.run(
        "from course import load_scene, pixel, render\n"
        "hard = render(load_scene('before/soft_shadows'), spp=4, size=(60, 40))\n"
        "soft = render(load_scene('soft_shadows', effects=mine), spp=4, size=(60, 40))\n"
        "display(soft, hard.compare(soft), hard.compare(soft).difference)\n"
        "print(soft.receipt)\nprint(hard.error(soft))\nhard.linear.shape"
    )
    assert not found.error
    picture, beside, difference, _ = found.shown
    png = Image.open(io.BytesIO(base64.b64decode(picture["image/png"])))
    assert png.size == (60, 40)
    assert "<details><summary>" in picture["text/html"]
    assert "yours:" in picture["text/html"]
    # A still beside what needs a page: both pictures.
    still = Image.open(io.BytesIO(base64.b64decode(beside["image/jpeg"])))
    assert still.size == (60 + 8 + 60, 40)
    assert 'type="range"' in beside["text/html"]
    assert beside["text/html"].count("<img") == 2
    assert "image/png" in difference
    assert max(map(len, found.text.splitlines())) < 120


def test_a_pixel_shows_its_rays_and_a_still(shared: Kernel) -> None:
    found = shared.run(
        "from course import pixel\n"
        "story = pixel('soft_shadows', 30, 30, spp=4, size=(60, 40), effects=mine)\nprint(story)\nstory"
    )
    assert not found.error
    (shown,) = found.shown
    assert "srcdoc='" in shown["text/html"]
    still = np.asarray(Image.open(io.BytesIO(base64.b64decode(shown["image/png"]))).convert("RGB"))
    # Surfaces before a sky.
    assert len(np.unique(still.reshape(-1, 3), axis=0)) > 20
    assert max(map(len, found.text.splitlines())) <= 100
    assert len(found.text.splitlines()) > 4


def test_a_wrong_function_of_a_cell_is_told_in_a_line(shared: Kernel) -> None:
    found = shared.run(
        "from course import load_scene, render\n"
        "def short(center, radius, u):\n"
        "    return u\n"
        "scene = load_scene('soft_shadows', effects={'point_on_sphere': short})\n"
        "render(scene, spp=1, size=(30, 20))"
    )
    assert len(found.trace) == 1
    assert re.search(r"soft_shadows\.point_on_sphere \(cell In\[\d+\], line 2\)", found.trace[0])
    assert "expected float32" in found.trace[0]


def test_the_error_over_time_is_a_plot(shared: Kernel) -> None:
    found = shared.run(
        "from course import error_over_time, load_scene\n"
        "error_over_time(load_scene('soft_shadows', effects=mine), seconds=0.2)"
    )
    (shown,) = found.shown
    assert "image/png" in shown
    assert "sobol" in shown["text/plain"]


def test_a_bar_is_one_output_that_is_empty_in_the_end(shared: Kernel) -> None:
    found = shared.run(
        "from course.base import progress\n"
        "progress.LONG = 0\n"
        "from course import load_scene, render\n"
        "scene = load_scene('soft_shadows', effects=mine)\n"
        "render(scene, spp=256, size=(200, 100), progress=True)\n"
        "None"
    )
    assert not found.error
    assert found.text == ""
    (bar,) = found.shown
    assert bar == {"text/html": "", "text/plain": ""}


def test_a_command_says_what_it_says_in_a_terminal(shared: Kernel) -> None:
    assert "no such file" in shared.run("%course info no.yaml").text


def test_a_kernel_that_is_started_anew_begins_where_it_is_told(shared: Kernel) -> None:
    shared.manager.restart_kernel(now=True)
    shared.client.wait_for_ready(timeout=300)
    _, first, *_ = cells("motion_blur", "solutions")
    found = shared.run(first)
    assert "%%check" in found.error + found.text
    shared.run("%load_ext course")
    assert "no cell that was run defines" in shared.run(first).text
    for cell in cells("motion_blur", "solutions")[:2]:
        found = shared.run(cell)
    assert "10 of 10 points" in found.text
