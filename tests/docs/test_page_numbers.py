"""What pages say was measured: as it stands in docs/data, or as the course finds it again.

A number that a page writes with so many digits has to be the found one, rounded to them.
"""

import json
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks import adaptive_sampling, bounding_volumes, importance_sampling, sampling
from benchmarks.adaptive_sampling import Point, rays_for
from benchmarks.path_tracing import SCENE as CORNELL_BOX
from course import load_scene, render
from course.benchmarking.estimators import FURTHER_BENCHED
from course.benchmarking.plot_data import Plot, read_records
from course.engine.functions.effects import PROJECT
from course.engine.functions.modules import COURSE
from course.engine.loops.embree_device import available
from course.engine.radiosity.radiosity import PATCHES
from course.engine.radiosity.solving import GATHERED, KEPT_BYTES
from course.engine.render.box_tests import box_tests as boxes_met
from course.engine.scene.scene import load_variant
from tests.lengths import LONG, share

DOCS = PROJECT / "docs"
DATA = DOCS / "data"

NUMBER = r"(-?\d[\d,]*(?:\.\d+)?)"
"""A number as pages write it: -0.50, 16,384, 1.5."""


def prose(page: str) -> str:
    """A page on one line; a module's is called by the module."""
    paths = [DOCS / "modules" / f"{page}.md", DOCS / f"{page}.md"]
    (path,) = [path for path in paths if path.exists()]
    return " ".join(path.read_text(encoding="utf-8").split())


def said(page: str, pattern: str) -> tuple[str, ...]:
    """The numbers of a sentence of a page, in which each N stands for one."""
    found = re.findall(pattern.replace("N", NUMBER), prose(page))
    assert len(found) == 1, (page, pattern, "expected once", len(found))
    return found[0] if isinstance(found[0], tuple) else (found[0],)


def table(module: str, heading: str) -> list[list[str]]:
    """The rows of the table whose first line has those words."""
    text = (DOCS / "modules" / f"{module}.md").read_text(encoding="utf-8")
    (block,) = [
        each
        for each in re.findall(r"(?:^\|.*\|\n)+", text, re.MULTILINE)
        if heading in each.split("\n")[0]
    ]
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines()]
    return rows[2:]


def value(text: str) -> float:
    """A number that may be a share in percent."""
    number = float(text.rstrip("%").replace(",", ""))
    return number / 100 if text.endswith("%") else number


def told(text: str, found: float, *, within: float = 0.0) -> bool:
    """Whether a text is that number, rounded to its own digits; ``within`` may be added for noise."""
    decimals = len(text.rstrip("%").partition(".")[2])
    half = 0.5 * 10.0**-decimals / (100 if text.endswith("%") else 1)
    return abs(value(text) - found) <= half * (1 + 1e-9) + within


def plots(module: str, file: str = "") -> dict[str, Plot]:
    """What was measured of a module."""
    record = read_records(DATA / f"{file or module}.json")[module]
    return {plot.name: plot for plot in record.plots}


def figures(part: str) -> dict[str, dict[str, Any]]:
    """The figures of a part of `make bench`, by name."""
    parts = json.loads((DATA / "ratios.json").read_text(encoding="utf-8"))
    return {figure["name"]: figure for figure in parts[part]["figures"]}


@pytest.mark.parametrize(
    ("text", "found", "right"),
    [
        ("-0.50", -0.4985, True),
        ("-0.50", -0.4945, False),
        ("16,384", 16384.4, True),
        ("16,384", 16385, False),
        ("5.7%", 0.0568, True),
        ("5.7%", 0.0576, False),
        ("0", 0.4, True),
    ],
)
def test_a_number_is_told_with_its_own_digits(text: str, found: float, right: bool) -> None:
    assert told(text, found) is right


# ---------------------------------------------------------------- course bench


@pytest.mark.parametrize("module", FURTHER_BENCHED)
def test_orders_of_the_further_modules(module: str) -> None:
    numbers = said(
        module,
        r"renders the scene with one to N samples a pixel, N x N pixels\. "
        r"Random samples reach order N, jittered ones N, and Sobol points N\.",
    )
    record = read_records(DATA / "bench.json")[module]
    (plot,) = record.plots
    series = {line.name: line for line in plot.series}
    assert value(numbers[0]) == series["Sobol"].x["samples"][-1]
    assert record.about.startswith(f"{numbers[1]} x {numbers[2]} pixels")
    assert f"course bench {module} --quick" in prose(module)
    assert "--quick" in record.command
    for text, name in zip(numbers[3:], ("random", "jittered", "Sobol"), strict=True):
        order = series[name].order
        assert order is not None
        assert told(text, order), (name, order)


HALF = r"\$-1/2\$"
EXPECTED = {
    "supersampling": (r"an order near \$-3/4\$", -0.75),
    "soft_shadows": (rf"Expect orders between {HALF} and \$-3/4\$", -0.75),
    "glossy": (rf"Expect orders only slightly better than {HALF}, if at all", -0.6),
    "thin_lens": (rf"Expect orders between {HALF} and \$-5/8\$", -0.625),
    "motion_blur": (rf"Expect orders between {HALF} and \$-1\$", -1.0),
    "cube_map": (rf"orders between {HALF} and \$-3/4\$", -0.75),
    "blurred_transparency": ("so expect orders little better", -0.6),
}
"""What a page says of jittered and Sobol points, and the best order that this can mean."""


@pytest.mark.parametrize("module", EXPECTED)
def test_orders_are_what_the_pages_lead_to_expect(module: str) -> None:
    sentence, best = EXPECTED[module]
    said(module, sentence)
    series = {line.name: line.order for line in plots(module, "bench")["samplers"].series}
    # An order of three or four seeds scatters by some hundredths, and depends as much on how many samples there are.
    assert series["random"] == pytest.approx(-0.5, abs=0.03)
    for name in ("jittered", "Sobol"):
        order = series[name]
        assert order is not None
        assert best - 0.05 <= order <= -0.5 + 0.03, (module, name)


# ---------------------------------------------------------------- sampling


def test_points_that_rejection_draws_and_keeps() -> None:
    numbers = said(
        "sampling",
        r"Of N points of the square that `disk_by_rejection` drew for a million, the share N lay in the disk, with a "
        r"standard error of N; \$\\pi / 4\$ is N\. Of N points of the cube N lay in the ball, with the same error; "
        r"\$\\pi / 6\$ is N\.",
    )
    disk, ball = sampling.acceptances(1_000_000)
    for candidates, rate, expected, found in (
        (numbers[0], numbers[1], numbers[3], disk),
        (numbers[4], numbers[5], numbers[6], ball),
    ):
        assert value(candidates) == found.candidates
        assert told(rate, found.rate)
        assert told(expected, found.expected)
        # Of one function's share and of the other's, it has the same digits.
        assert told(numbers[2], found.error)


def test_a_ball_in_ten_dimensions() -> None:
    said("sampling", "in ten dimensions it is a quarter of a per cent")
    assert math.pi**5 / math.factorial(5) / 2**10 == pytest.approx(0.0025, rel=0.01)


# ---------------------------------------------------------------- importance sampling


def test_variances_are_predicted_and_measured() -> None:
    off = {
        name.partition(":")[0]: figure["value"]
        for name, figure in figures("importance_sampling").items()
    }
    numbers = said(
        "importance_sampling",
        r"measures the three, each with four million samples\. They are off by N, N and N standard errors\.",
    )
    assert pytest.approx(4e6, rel=0.05) == importance_sampling.BATCHES * importance_sampling.SAMPLES
    for text, way in zip(numbers, ("uniform", "cosine", "Phong lobe"), strict=True):
        assert told(text, off[f"cos³ by {way}"]), way
    rows = table("importance_sampling", "variance, predicted")
    expected = importance_sampling.predicted(importance_sampling.HIGHLIGHT)
    assert len(rows) == len(expected)
    for (_, variance, _, measured), (way, found) in zip(rows, expected.items(), strict=True):
        if math.isinf(found):
            assert (variance, measured) == ("infinite", "")
        else:
            assert told(variance, found), way
            assert told(measured, off[f"cos + 8 cos⁵⁰ by {way}"]), way


def test_variances_are_measured_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the benchmark's own numbers, without its clock: whether they are those of the data shows in how far off."""
    monkeypatch.setattr(
        importance_sampling, "median_seconds", lambda timed, *_: dict.fromkeys(timed)
    )
    off = figures("importance_sampling")
    integrands = (
        (importance_sampling.CUBE, "| density | variance |"),
        (importance_sampling.HIGHLIGHT, "variance, predicted"),
    )
    for integrand, heading in share(integrands, 2):
        found = importance_sampling.measure(
            integrand, importance_sampling.BATCHES, importance_sampling.SAMPLES
        )
        rows = table("importance_sampling", heading)
        for row, way in zip(rows, found, strict=False):
            if math.isinf(way.predicted):
                assert row[-2:] == ["", ""]
                continue
            (measured,) = [row[-1]] if integrand is importance_sampling.CUBE else [row[-2]]
            assert told(measured, way.measured), way.name
            figure = off[f"{integrand.title} by {way.name}: variance off by [standard errors]"]
            assert abs(way.off) == pytest.approx(figure["value"], rel=1e-3)


def test_uniform_directions_make_noise_on_open_ground() -> None:
    samples, noise = said(
        "importance_sampling",
        r"Both pictures take N samples a pixel\. .* N% of the brightness on open ground",
    )
    scene = load_scene(PROJECT / "scenes" / "before" / "importance_sampling.yaml")
    assert scene.settings.samples == value(samples)
    # Each sample is twice its cosine, which is uniform: 4/3 - 1 is the variance.
    expected = math.sqrt(1 / 3 / value(samples))
    assert told(noise, 100 * expected)
    # The floor behind the objects, where they hide nothing of the sky; 400 pixels have a deviation that is off by a
    # sixth once in 1e5 pictures.
    ground = render(scene, size=(300, 200), compiled=False).linear[:20, -20:, 0]
    assert ground.std() / ground.mean() == pytest.approx(expected, rel=1 / 6)


def test_the_cube_s_variances_are_their_closed_forms() -> None:
    found = importance_sampling.predicted(importance_sampling.CUBE)
    rows = table("importance_sampling", "| density | variance |")
    for row, way in zip(rows, ("uniform", "cosine", "Phong lobe"), strict=True):
        assert told(re.findall(r"approx ([\d.]+)\$", row[2])[0], found[way]), way
    said("importance_sampling", "about nineteen times as many samples as the last")
    assert found["uniform"] / found["Phong lobe"] == pytest.approx(19, abs=0.5)


# ---------------------------------------------------------------- quasi-Monte Carlo


def test_orders_of_point_sets() -> None:
    rows = table("quasi_monte_carlo", "a disk's area")
    found = plots("quasi_monte_carlo")
    assert [row[0] for row in rows] == [line.name for line in found["disk"].series]
    for number, row in enumerate(rows):
        for text, name in zip(row[1:], ("disk", "smooth", "path"), strict=True):
            order = found[name].series[number].order
            assert order is not None
            assert told(text, order), (row[0], name)
    text = prose("quasi_monte_carlo")
    (first, last, seeds) = said(
        "quasi_monte_carlo", "measures the error over N to N points, as a mean over N seeds"
    )
    (samples,) = {line.x["samples"] for plot in found.values() for line in plot.series}
    assert (value(first), value(last)) == (samples[0], samples[-1])
    assert read_records(DATA / "quasi_monte_carlo.json")["quasi_monte_carlo"].about.startswith(
        f"{seeds} seeds"
    )
    usual, widest = re.findall(
        r"about \$\\pm ([\d.]+)\$, and \$\\pm ([\d.]+)\$ for Sobol's in six", text
    )[0]
    for name, figure in figures("quasi_monte_carlo").items():
        is_widest = name.startswith("a product of six") and name.endswith("order of Sobol")
        half = (figure["high"] - figure["low"]) / 2
        assert half == pytest.approx(float(widest if is_widest else usual), rel=0.3), name


# ---------------------------------------------------------------- blue noise


def test_errors_of_five_samplers_before_and_after_a_blur() -> None:
    rows = table("blue_noise", "after a blur")
    found = plots("blue_noise")
    names = {"random": "independent", "jittered": "jittered", "sobol": "Sobol"}
    names |= {"dithered": "dithered", "blue_noise": "blue noise"}
    seen = {}
    for row in rows:
        sampler = row[0].strip("`")
        for cell, plot in zip(row[1:], ("rmse", "seen"), strict=True):
            (line,) = [s for s in found[plot].series if s.name == names[sampler]]
            texts = cell.split(", ")
            assert all(told(*pair) for pair in zip(texts, line.y, strict=True)), (sampler, plot)
        seen[sampler] = line.y[line.x["samples"].index(4)]
    assert [row[0].strip("`") for row in rows] == list(names)
    (share,) = said("blue_noise", "error seen from afar is N of that of `sobol` and a third")
    assert told(share, seen["blue_noise"] / seen["sobol"])
    assert seen["blue_noise"] / seen["random"] == pytest.approx(1 / 3, abs=0.03)
    lowest = {line.name: line.y[0] for line in found["spectrum"].series}
    assert lowest["blue noise"] == pytest.approx(1 / 8, abs=0.01)
    assert lowest["Sobol"] == pytest.approx(1, abs=0.1)


def test_errors_in_equal_time() -> None:
    fast, slow = said("blue_noise", "needs N seconds of the processor where `blue_noise` needs N")
    at = {line.name: line.x["seconds"][1] for line in plots("blue_noise")["seen"].series}
    assert told(fast, at["Sobol"])
    assert told(slow.rstrip("."), at["blue noise"])
    ratios = said(
        "blue_noise",
        r"the blurred error of `sobol` is about the same, N times that of `blue_noise`\. That of jittered samples is N "
        r"times as large, and that of independent ones N times\.",
    )
    for text, other in zip(ratios, ("Sobol", "jittered", "independent"), strict=True):
        name = f"blue_noise: error seen from afar in equal time, {other} / blue noise"
        assert told(text, figures("blue_noise")[name]["value"])


# ---------------------------------------------------------------- adaptive sampling


def test_rays_saved_by_division_in_the_module_s_scene() -> None:
    corners, width, height, lattice, saved, shared = said(
        "adaptive_sampling",
        r"N at N by N pixels, of N in the lattice of the smallest cells\. So N% were saved\. In N cases,",
    )
    picture = render(load_scene(adaptive_sampling.SCENE), compiled=available())
    assert picture.linear.shape[:2] == (int(height), int(width))
    found = picture.receipt.subdivision
    assert found is not None
    assert told(f"{saved}%", found["saved"])
    assert value(lattice) == found["lattice"]
    # Rounding may divide another cell on another machine.
    assert value(corners) == pytest.approx(found["corners"], rel=1e-4)
    assert value(shared) == pytest.approx(found["shared"], rel=1e-4)


def _points(plot: Plot, name: str) -> list[Point]:
    (line,) = [series for series in plot.series if series.name == name]
    return [
        Point(rays, error, math.nan) for rays, error in zip(line.x["samples"], line.y, strict=True)
    ]


def test_rays_that_a_grid_would_need() -> None:
    found = plots("adaptive_sampling")
    edges, wires = found["edges"], found["wires"]
    grid = _points(edges, "k x k grid")
    divided = _points(edges, "divided over 0.1")
    rows = table("adaptive_sampling", "RMSE without wires")
    assert [row[0] for row in rows] == ["1", "2", "3", "4", "5"]
    for depth, rays, error, equal, times in rows:
        point = divided[int(depth)]
        needed = rays_for(point.error, grid)
        assert told(rays, point.rays), depth
        assert told(error, point.error), depth
        # The file's six digits move the fourth of what is interpolated.
        assert told(equal, needed, within=1e-3 * needed), depth
        assert told(times, needed / point.rays, within=1e-3 * needed / point.rays), depth
    threshold, fallen, left, depth, needed_rays = said(
        "adaptive_sampling",
        r"With a threshold of N the error falls to N\. With the wires in the scene it stays at N from depth N on, "
        r"which a grid reaches with N rays\.",
    )
    assert told(fallen, _points(edges, f"divided over {threshold}")[-1].error)
    thin = _points(wires, "divided over 0.1")
    deepest = thin[-1]
    assert [told(left, point.error) for point in thin].index(True) == int(depth)
    assert all(told(left, point.error) for point in thin[int(depth) :])
    assert told(needed_rays, rays_for(deepest.error, _points(wires, "k x k grid")))
    width, height, scene_threshold = said(
        "adaptive_sampling", r"scene at N by N pixels, by `[^`]*`, with threshold N\. The error"
    )
    about = read_records(DATA / "adaptive_sampling.json")["adaptive_sampling"].about
    assert about.startswith(f"{width} x {height} pixels")
    assert scene_threshold == "0.1"


# ---------------------------------------------------------------- bounding volumes


def test_tests_a_ray_in_the_data() -> None:
    lines = {line.name: line for line in plots("bounding_volumes")["tests"].series}
    boxes, triangles = (
        dict(zip(lines[name].x["samples"], lines[name].y, strict=True))
        for name in ("boxes", "triangles")
    )
    for size, leaf, _, box_tests, triangle_tests in table("bounding_volumes", "| leaf size |"):
        if leaf == "4":
            assert told(box_tests, boxes[value(size)])
            assert told(triangle_tests, triangles[value(size)])
    size, rays, billions, box_tests, triangle_tests = said(
        "bounding_volumes",
        r"A knot of N triangles, and N rays towards it: by brute force that makes N billion tests\. With boxes each "
        r"ray is tested with N boxes and N triangles",
    )
    assert value(rays) == bounding_volumes.RAYS
    assert told(billions, value(size) * value(rays) / 1e9)
    assert told(box_tests, boxes[value(size)])
    assert told(triangle_tests, triangles[value(size)])
    more, longer = said("bounding_volumes", "So N times the triangles take N times the tests")
    least, most = min(boxes), max(boxes)
    assert value(more) == most / least
    assert told(longer, (boxes[most] + triangles[most]) / (boxes[least] + triangles[least]))


def test_tests_a_ray_of_the_scene() -> None:
    boxes, triangles, size = said(
        "bounding_volumes", r"tests: N with boxes and N with triangles a ray, of N triangles\."
    )
    scene = load_scene(PROJECT / "scenes" / "bounding_volumes.yaml")
    assert value(size) == sum(scene.compiled.triangles)
    width, height = scene.settings.width, scene.settings.height
    # With a fourth of the pixels the means are those of all to 0.1%.
    receipt = render(scene, size=(width, height) if LONG else (width // 2, height // 2)).receipt
    assert receipt.tests is not None
    rays = sum(receipt.rays.values())
    assert told(boxes, receipt.tests["boxes"] / rays, within=0.01)
    assert told(triangles, receipt.tests["triangles"] / rays, within=0.01)
    fewest, most, half = said(
        "bounding_volumes",
        r"high in the sky takes N test with a box, the costliest ray N, and half of all rays at most N\.",
    )
    each = boxes_met(scene, scene.settings)
    assert (value(fewest), value(most)) == (each.min(), each.max())
    assert value(half) == np.median(each)


def test_threads_of_a_walk() -> None:
    *speed_ups, faster = said(
        "bounding_volumes",
        r"is N times as fast as in one piece \(N to N over repetitions\), and Embree N times \(N to N\)\."
        r" In one thread Embree is N times as fast",
    )
    measured = figures("bounding_volumes")
    names = ("hierarchy in NumPy: one thread / two", "the same in Embree: one thread / two")
    kinds = [measured[name][kind] for name in names for kind in ("value", "low", "high")]
    for text, found in zip(speed_ups, kinds, strict=True):
        assert told(text, found)
    assert told(faster, measured["hierarchy: walk in NumPy / Embree"]["value"])


def test_nodes_of_a_tree_of_halves() -> None:
    for size, leaf, nodes, *_ in table("bounding_volumes", "| leaf size |"):
        leaves = 2 ** math.ceil(math.log2(value(size) / value(leaf)))
        assert value(nodes) == 2 * leaves - 1, (size, leaf)


def test_tests_a_ray_with_other_leaves() -> None:
    rays = bounding_volumes._rays()
    _, corners = bounding_volumes._knot(bounding_volumes.USUAL)
    rows = table("bounding_volumes", "| leaf size |")
    others = [row for row in rows if row[1] != "4"]
    assert [row[1] for row in others] == ["1", "32"]
    for size, leaf, _, boxes, triangles in share(others, 2):
        assert value(size) == corners[0].shape[1]
        hierarchy = bounding_volumes.build(*bounding_volumes._boxes(corners), int(leaf))
        hit, _, box_tests, triangle_tests = bounding_volumes.traverse(hierarchy, *corners, *rays)
        # Rounding may add a test here or there on another machine.
        assert told(boxes, box_tests.mean(), within=0.01), leaf
        assert told(triangles, triangle_tests.mean(), within=0.01), leaf
    said("bounding_volumes", "rays from all around a knot, two thirds of which hit it")
    assert (hit >= 0).mean() == pytest.approx(2 / 3, abs=0.03)


# ---------------------------------------------------------------- path tracing


def test_rays_that_a_path_casts() -> None:
    width, height, samples = (
        int(text)
        for text in said(
            "path_tracing", r"In this scene, with N by N pixels and N samples each, paths cost"
        )
    )
    rows = table("path_tracing", "rays for each path")
    assert [row[0] for row in rows] == ["null", "5", "2", "1", "0"]
    for bounces, rays in rows:
        roulette = None if bounces == "null" else int(bounces)
        scene = load_variant(CORNELL_BOX, {("integrator", "roulette"): roulette})
        receipt = render(scene, size=(width, height), spp=samples, compiled=available()).receipt
        found = sum(receipt.rays.values()) / receipt.rays["camera"]
        # Rounding may send a path elsewhere on another machine: of 65,536 paths that hardly moves the mean.
        assert told(rays, found, within=0.01), bounces


def test_the_error_that_roulette_makes() -> None:
    samples, first, last = said(
        "path_tracing",
        "With N samples a pixel, the error grows from N in the first row to N in the last",
    )
    series = {line.name: line for line in plots("path_tracing")["roulette"].series}
    errors = []
    for name in ("never", "from bounce 5", "from bounce 2", "from the first"):
        line = series[name]
        errors.append(line.y[line.x["samples"].index(int(samples))])
    assert errors == sorted(errors)
    assert told(first, errors[0])
    assert told(last, errors[-1])


# ---------------------------------------------------------------- radiosity


def test_light_that_is_missing() -> None:
    (plot,) = plots("radiosity").values()
    series = {line.name: line for line in plot.series}
    rows = table("radiosity", "light missing")
    shots = series["bound"].x["shots"]
    assert [value(row[0]) for row in rows] == list(shots)
    for number, (_, *cells) in enumerate(rows):
        names = ("light missing", "with the ambient term", "bound")
        for text, name in zip(cells, names, strict=True):
            assert told(text, series[name].y[number]), (number, name)


def test_what_radiosity_keeps() -> None:
    (patches,) = said("radiosity", r"`scenes/radiosity\.yaml` in N patches")
    assert value(patches) == PATCHES
    assert read_records(DATA / "radiosity.json")["radiosity"].about == f"{patches} patches"
    (gathered,) = said("radiosity", "Up to N patches are gathered, more are shot")
    assert value(gathered) == GATHERED
    kept, table_size = said(
        "radiosity",
        r"is kept for the patch's next shot, up to N MiB; the table of all form factors would take N GB for the "
        r"patches' two sides",
    )
    assert value(kept) * 2**20 == KEPT_BYTES
    assert told(table_size, 4 * (2 * PATCHES) ** 2 / 1e9)


# ---------------------------------------------------------------- blurred transparency


def _ball(folder: Path, roughness: float, distance: float, *, gloss: bool) -> float:
    """The mean radiance that a rough ball of glass shows of a room of radiance 1, over the disk that it fills."""
    angle = 32.0
    glass: dict[str, Any] = {
        "color": 0,
        "dielectric": {"refraction_index": 1.5, "roughness": roughness},
    }
    if gloss:
        glass["gloss"] = {"lobe": "plane", "roughness": roughness}
    path = folder / "ball.yaml"
    path.write_text(
        json.dumps(
            {
                "camera": {"eye": [0, 0, distance], "look_at": [0, 0, 0], "vertical_fov": angle},
                "film": {"width": 32, "height": 32},
                # Every path that leaves the ball brings the same, so few of them tell it.
                "sampler": {"samples": 8},
                "integrator": {"type": "path", "max_depth": BOUNCES, "roulette": None},
                "environment": {"type": "constant", "radiance": 1},
                "materials": {"glass": glass},
                "objects": [{"shape": "sphere", "material": "glass"}],
            }
        ),
        encoding="utf-8",
    )
    lost = 1 - float(render(load_scene(path), compiled=available()).linear.mean(dtype=np.float64))
    # Seen from so many radii the ball fills a cone, and that a disk of the picture.
    disk = math.pi / (distance**2 - 1) / (2 * math.tan(math.radians(angle / 2))) ** 2
    return 1 - lost / disk


BOUNCES = 6


def test_a_rough_ball_keeps_no_light(tmp_path: Path) -> None:
    numbers: Sequence[str] = said(
        "blurred_transparency",
        r"In a white room a ball of roughness N, seen from four radii away, shows N of the light, and one of roughness "
        r"N also N \(path tracing, at most N bounces\)",
    )
    assert int(numbers[4]) == BOUNCES
    for roughness, light in (numbers[:2], numbers[2:4]):
        for gloss in (False, True):
            found = _ball(tmp_path, float(roughness), 4.0, gloss=gloss)
            assert found == pytest.approx(float(light), abs=1e-5), (roughness, gloss)


def test_glass_straight_on_and_at_brewster_s_angle() -> None:
    straight, angle = said(
        "blurred_transparency", r"glass reflects N %\. At Brewster's angle, N degrees"
    )
    assert told(f"{straight}%", ((1.5 - 1) / (1.5 + 1)) ** 2)
    assert told(angle, math.degrees(math.atan(1.5)))


# ---------------------------------------------------------------- denoising


@pytest.mark.parametrize(
    ("heading", "names"),
    [
        ("all light, as in the scene |", ("scene",) * 3),
        ("direct light alone |", ("direct",) * 3 + ("floor",) * 2),
        ("equal pixels that are separated", ("separated",) * 2),
    ],
)
def test_errors_and_levels_of_denoising(heading: str, names: tuple[str, ...]) -> None:
    measured = plots("denoising")
    rows = table("denoising", heading)
    assert len(rows) == len(names)
    for k, row in enumerate(rows):
        label = row[0].removeprefix("the tiles, ")
        for sampler, cells in (("random", row[1:5]), ("Sobol", row[5:])):
            lines = [
                line for line in measured[names[k]].series if line.name == f"{sampler}, {label}"
            ]
            # A line of shares that are hardly over 0 is left out of the data.
            assert len(lines) == 1 or names[k] == "separated"
            share = 100 if names[k] == "separated" else 1
            kept = {n: y for line in lines for n, y in zip(line.x["samples"], line.y, strict=True)}
            for cell, samples in zip(cells, (4, 16, 64, 256), strict=True):
                # What is 0 has no place on logarithmic axes, and is left out of the data.
                assert told(cell, share * kept.get(samples, 0.0)), (row[0], sampler, samples)


# ---------------------------------------------------------------- what samplings gain


def test_what_visible_normals_gain() -> None:
    numbers = said(
        "microfacets",
        "drawing all normals takes N times as many samples for the same error here, and N times as long",
    )
    for text, what in zip(numbers, ("samples", "seconds"), strict=True):
        name = f"microfacets: {what} for the same error, all normals / visible ones"
        assert told(text, figures("microfacets")[name]["value"]), name


def test_what_directions_by_a_picture_gain() -> None:
    numbers = said(
        "environment_light",
        r"In the time that each takes for N samples directions by the cosine have N times the error of inversion, "
        r"N times that of the alias table and N times that of `automatic`\.",
    )
    ways = ("by inversion", "by an alias table", "by picture and cosine (automatic)")
    for text, way in zip(numbers[1:], ways, strict=True):
        name = (
            f"environment_light: error in equal time at {numbers[0]} samples, by the cosine / {way}"
        )
        assert told(text, figures("environment_light")[name]["value"]), name


def test_what_a_light_tree_gains_and_costs() -> None:
    rows = table("many_lights", "RMSE, each as probable")
    found, measured = plots("many_lights"), figures("many_lights")
    errors, costs = (
        {line.name: dict(zip(line.x["lamps"], line.y, strict=True)) for line in found[name].series}
        for name in ("lamps", "cost")
    )
    walk = next(name for name in costs if name.startswith("the tree's choice"))
    hits = value(re.findall(r"[\d,]+", walk)[0])
    for row in rows:
        lamps = int(value(row[0]))
        each, tree = errors["each as probable"][lamps], errors["by a light tree"][lamps]
        assert told(row[1], each)
        assert told(row[2], tree)
        assert told(row[3], costs["each as probable"][lamps])
        assert told(row[4], costs["by a light tree"][lamps])
        name = f"many_lights: error in equal time, one of {row[0]} as probable / by the tree"
        assert told(row[5], measured[name]["value"])
        assert told(row[6], 1e9 * costs[walk][lamps] / hits)
    assert [row[0] for row in rows] == ["10", "100", "1,000", "10,000"]
    scene, ratio, largest = said(
        "many_lights",
        r"In the scene above, a choice with equal probabilities has N times the tree's error in equal time, .* N times "
        r"as long for 10,000 lamps as for 10, .* means of blocks of pixels are compared, the largest \$\|t\|\$ is N\.",
    )
    equal = "many_lights: error in equal time at 64 samples, each as probable / by a light tree"
    assert told(scene, measured[equal]["value"])
    assert told(
        ratio, measured["many_lights: seconds of the tree's choice, 10,000 / 10 lamps"]["value"]
    )
    t = "many_lights: largest |t| of a block, one by the tree against all of 1,000"
    assert told(largest, measured[t]["value"])


def test_what_lamps_and_lobes_together_gain() -> None:
    numbers = said(
        "multiple_importance",
        r"At equal samples a pixel the combination has N to N times the error of the better strategy\. .* "
        r"the combination has up to N times the error of the lobe .* In N of the 20 cells it has less than a fifth of "
        r"the worse strategy's error\. .* relative MSE\) is N times smaller than that of the worse strategy, and N "
        r"times smaller than that of the better one\.",
    )
    low, high, timed, cells, worse, better = numbers
    found = {
        name.partition(": ")[2]: figure for name, figure in figures("multiple_importance").items()
    }
    equal = found["error at equal samples, both / the better strategy, worst of 20"]
    assert told(low, equal["low"])
    assert told(high, equal["high"])
    assert told(
        timed, found["error in equal time, both / the better strategy, worst of 20"]["high"]
    )
    share = "share of plates and lamps where both have a fifth of the worse error"
    assert value(cells) == round(20 * found[share]["value"])
    for text, what in ((worse, "worse"), (better, "better")):
        assert told(
            text, found[f"relative error in equal time, the {what} strategy / both"]["value"]
        )


# ---------------------------------------------------------------- grading


def test_what_grading_costs() -> None:
    numbers = said(
        "grading",
        r"One submission takes N s with the six core modules and N s with fifteen of the N, .* A class of 200, made "
        r"of N right and wrong submissions, takes N minutes with the core modules and N with these fifteen\. "
        r".* the N graded renders "
        r"take N times as long with workers as without\. The worst single one takes N times as long \(`(.*?)`\)",
    )
    core, whole, all_modules, kinds, core_class, whole_class, renders, pipe, worst, slowest = (
        numbers
    )
    measured = {name: figure["value"] for name, figure in figures("grading").items()}
    assert int(all_modules) == len(COURSE)
    for text, name in (
        (core, "6 core modules of one submission [s]"),
        (whole, "all 15 modules of one submission [s]"),
        (core_class, f"a class of 200, 6 core modules, from {kinds} submissions [min]"),
        (whole_class, f"a class of 200, all 15 modules, from {kinds} submissions [min]"),
        (pipe, f"graded renders through workers / without, all {renders} together"),
        (worst, f"a single picture, the worst ({slowest})"),
    ):
        assert told(text, measured[name]), name
