"""What pages say of radiosity's iterations and of radiosity beside path tracing: found again, or as it was measured."""

import pytest

from benchmarks import path_tracing, radiosity
from benchmarks.mitsuba_agreement import BLOCK
from course import load_scene
from course.engine.functions.effects import PROJECT
from course.engine.radiosity.patches import RadiosityFunctions, make_patches
from course.engine.radiosity.radiosity import PATCHES, TOLERANCE, solve
from course.engine.radiosity.solving import GATHERED, gathered
from course.engine.scene.scene import Scene
from tests.docs.test_page_numbers import figures, said, table, told, value

BESIDE = "radiosity, beside path tracing: "


@pytest.fixture(scope="module")
def room() -> Scene:
    return load_scene(radiosity.SCENE)


def accuracy(pattern: str) -> tuple[str, ...]:
    """The numbers of a sentence of docs/accuracy.md; each N stands for one."""
    return said("accuracy", pattern)


def test_light_that_iterations_miss(room: Scene, monkeypatch: pytest.MonkeyPatch) -> None:
    """With half of the benchmark's rays, which moves no digit, and as long as a bit changes."""
    (patches,) = said("radiosity", "Gathering in the room with N patches")
    assert value(patches) == GATHERED
    rows = {int(row[0]): row[1] for row in table("radiosity", "| iterations | missing |")}
    assert list(rows) == list(radiosity.ITERATIONS)
    divided, functions = make_patches(room, GATHERED), RadiosityFunctions(room.effects)
    (still,) = said("radiosity", "From iteration N on no bit of the float32 numbers changes")
    steps = gathered(divided, functions, 0.0, None, rays=2_000_000).steps
    assert steps <= value(still) < 1.2 * steps
    last = radiosity.ITERATIONS[-1]
    assert steps < last < radiosity.LIMIT
    assert rows.pop(last) == "0%"
    monkeypatch.setattr(radiosity, "LIMIT", steps)
    found = radiosity.iterate(divided, functions, tuple(rows), 24)
    for number, text in rows.items():
        assert told(text, found[number].left), (number, found[number].left)
    (sides,) = said("radiosity", "each of the patches' N sides looks through its hemicube")
    assert value(sides) == 2 * GATHERED


def test_radiosity_beside_path_tracing(room: Scene) -> None:
    """One row, measured again beside a fourth of the paths, whose noise moves it by up to 0.05%.

    The others take longer; the last is the benchmark's, which writes it into docs/data.
    """
    pixels, _, left, paths, square, _ = said(
        "radiosity",
        r"have N by N pixels here, the solution is within N% of convergence, and the reference has N paths a pixel\. "
        r"Squares of N by N pixels",
    )
    measured = (radiosity.PIXELS, radiosity.PATHS, radiosity.SQUARE)
    assert tuple(map(value, (pixels, paths, square))) == measured
    assert value(f"{left}%") == pytest.approx(TOLERANCE / 10)
    rows = {
        int(value(row[0])): row[1:] for row in table("radiosity", "| patches | means differ by")
    }
    assert list(rows) == [500, 1000, 2500, PATCHES]
    paths_picture = radiosity.trace(room, radiosity.PATHS // 4)
    solution = solve(room, patches=GATHERED, tolerance=TOLERANCE / 10)
    found = radiosity.beside_paths(solution, paths_picture)
    for text, number in zip(rows[GATHERED], (found.mean, found.rms), strict=True):
        assert told(text, number, within=5e-4), number
    recorded = {
        name.removeprefix(BESIDE): figure["value"] / 100
        for name, figure in figures("radiosity").items()
        if name.startswith(BESIDE)
    }
    for text, name in zip(
        rows[PATCHES], ("means differ by, %", "squares differ by, RMS, %"), strict=True
    ):
        if name in recorded:
            assert told(text, recorded[name]), name


def test_both_pages_say_the_same() -> None:
    rows = {
        int(value(row[0])): row[1:] for row in table("radiosity", "| patches | means differ by")
    }
    mean, rms = said(
        "radiosity",
        r"to 1% in the means and to 2% in the squares; measured were N% and N%\.",
    )
    numbers = accuracy(
        r"the mean of `scenes/radiosity\.yaml` differs from that of path tracing by N%, and squares of 8 by 8 pixels "
        r"by N% of the mean \(root mean square\)\. Within 0\.1% of convergence, these are N% and N%\."
    )
    assert numbers == (mean, rms, *(text.rstrip("%") for text in rows[PATCHES]))
    # The bound that is stated holds for what was measured.
    assert value(mean) <= 1
    assert value(rms) <= 2


def test_the_records_of_the_accuracy_page() -> None:
    missing = accuracy("ends at 1%; N% of all light is missing then")[0]
    recorded = figures("radiosity")["radiosity: light missing then, % of all"]
    assert told(missing, recorded["value"])
    width, height, batches, samples, side, _ = accuracy(
        "N by N pixels in N batches of N samples with a seed each, and compares the means of N by N pixels"
    )
    effort = path_tracing.Effort()
    assert (int(width), int(height)) == effort.size
    assert (int(batches), int(samples)) == (effort.batches, effort.samples)
    assert int(side) == BLOCK
    count, largest, mean = accuracy(
        r"That gives N values, one for each block and channel; the largest \$\|t\|\$ is N\. .*? means differ by N%\."
    )
    assert int(count) == 3 * (effort.size[0] // BLOCK) * (effort.size[1] // BLOCK)
    found = figures("path_tracing")
    assert told(largest, found["path tracing, beside Mitsuba: largest |t| of a block"]["value"])
    assert told(mean, found["path tracing, beside Mitsuba: means differ by (percent)"]["value"])


def test_the_tolerances_that_are_named_are_the_tests_own() -> None:
    """The sentences name test files; what they hold to stands there."""
    tests = PROJECT / "tests" / "engine"
    paths = (tests / "terms" / "paths" / "test_path_tracing.py").read_text(encoding="utf-8")
    accuracy(r"requires this of all pixels to one part in N, for")
    assert "np.allclose(render(scene).linear, 1 / (1 - reflectance), rtol=1e-5)" in paths
    solving = (tests / "radiosity" / "test_solving.py").read_text(encoding="utf-8")
    accuracy(
        r"requires this of gathering to N% in the room and to N% in the sphere, and of shooting to N% in the mean"
    )
    assert "light / (1 - 0.5), rtol=1e-4)" in solving
    assert "2 / (1 - reflectance), rtol=2e-5)" in solving
    assert "pytest.approx(2 / (1 - reflectance), rel=1e-3)" in solving
    viewing = (tests / "radiosity" / "test_viewing.py").read_text(encoding="utf-8")
    mean, rms, patches = accuracy(
        r"`tests/engine/radiosity/test_viewing\.py` allows N% and N% for N patches"
    )
    assert f"patches={int(value(patches))}," in viewing
    assert f"rel={value(mean) / 100:g})" in viewing
    assert f"<= {value(rms) / 100:g} * level" in viewing
