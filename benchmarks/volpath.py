"""`python -m benchmarks.volpath`: fog over a floor by our paths and by Mitsuba's `volpath`, on the same cores in turn.

Both render the same light, so the mean square of the difference of two pictures by different seeds is twice a picture's
squared error, and no reference is needed. Samples are chosen so that both errors are nearly the same; what is left is
made up for by error times seconds, which stays for independent samples. Needs `pip install .[peers]`, and LLVM 17.
"""

from collections.abc import Callable
from statistics import median
from time import perf_counter
from typing import Any

import click
import numpy as np

from benchmarks.figures import Figure, summary, table
from benchmarks.mitsuba_variants import start_llvm
from course import render
from course.benchmarking.tables import print_tables
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant

SCENE = PROJECT / "benchmarks" / "scenes" / "fog.yaml"
SIGMA, ALBEDO, G = (1.0, 1.5, 2.2), (0.9, 0.8, 0.6), 0.3
EYE, LAMP, POWER = [0, 0.6, 4], [1.6, 2.0, 1.0], 12
"""Of the scene file, for Mitsuba's form of it."""

Picture = Callable[[int, int], np.ndarray]
"""Of samples a pixel and a seed, (H, W, 3)."""


def of_mitsuba(floor: bool, size: int, **integrator: Any) -> dict[str, Any]:
    """The scene as `mitsuba.load_dict` takes it; a variant has to be switched on."""
    import mitsuba as mi

    def color(values: Any) -> dict[str, Any]:
        return {"type": "rgb", "value": list(values)}

    transform = mi.ScalarTransform4f
    fog = {
        "type": "homogeneous",
        # A colour of Mitsuba's is at most 1.
        "sigma_t": color(s / 3 for s in SIGMA),
        "scale": 3.0,
        "albedo": color(ALBEDO),
        "phase": {"type": "hg", "g": G},
    }
    film = {"type": "hdrfilm", "width": size, "height": size, "rfilter": {"type": "box"}}
    scene: dict[str, Any] = {
        "type": "scene",
        "integrator": {"type": "volpath", "max_depth": 61} | integrator,
        "sensor": {
            "type": "perspective",
            "fov": 28,
            "fov_axis": "y",
            "to_world": transform().look_at(EYE, [0, 0, 0], [0, 1, 0]),
            "film": film | {"pixel_format": "rgb"},
            "sampler": {"type": "independent"},
        },
        "light": {"type": "point", "position": LAMP, "intensity": color((POWER,) * 3)},
        "cube": {"type": "cube", "bsdf": {"type": "null"}, "interior": fog},
    }
    if floor:
        lies = transform().translate([0, -1.2, 0]).rotate([1, 0, 0], -90).scale(2)
        matt = {"type": "diffuse", "reflectance": color((0.5, 0.5, 0.5))}
        scene["floor"] = {"type": "rectangle", "to_world": lies, "bsdf": matt}
    return scene


def error(picture: Picture, samples: int) -> float:
    """Mean squared error of a picture's pixels."""
    one, other = (picture(samples, seed).astype(np.float64) for seed in (101, 102))
    return float(((one - other) ** 2).mean() / 2)


def measure(size: int, samples: int, rounds: int, threads: int) -> list[Figure]:
    """Seconds to one error, ours over theirs."""
    start_llvm(threads)
    import mitsuba as mi

    scene, loaded = load_variant(SCENE), mi.load_dict(of_mitsuba(True, size))

    def ours(spp: int, seed: int) -> np.ndarray:
        return render(scene, size=(size, size), spp=spp, seed=seed, threads=threads).linear

    def theirs(spp: int, seed: int) -> np.ndarray:
        return np.array(mi.render(loaded, spp=spp, seed=seed))

    # Each compiles what it compiles.
    for picture in (ours, theirs):
        picture(samples, 1)
    errors = {ours: error(ours, samples)}
    of_theirs = max(1, round(samples * error(theirs, samples) / errors[ours]))
    errors[theirs] = error(theirs, of_theirs)
    counts = {ours: samples, theirs: of_theirs}
    seconds: dict[Picture, list[float]] = {ours: [], theirs: []}
    for seed in range(2, 2 + rounds):
        for picture, spp in counts.items():
            begun = perf_counter()
            picture(spp, seed)
            seconds[picture].append(perf_counter() - begun)
    for name, picture in (("ours", ours), ("volpath", theirs)):
        print(
            f"{name}: {counts[picture]} samples, RMSE {errors[picture] ** 0.5:.5f},"
            f" {median(seconds[picture]):.3f} s"
        )
    scale = errors[ours] / errors[theirs]
    ratios = [a / b * scale for a, b in zip(seconds[ours], seconds[theirs], strict=True)]
    return [summary("media: seconds to one error, ours / Mitsuba's volpath", ratios, 1.2)]


@click.command()
@click.option("--size", default=256, show_default=True, help="Pixels along an edge.")
@click.option("--spp", default=64, show_default=True, help="Samples a pixel of ours.")
@click.option("--rounds", default=7, show_default=True, help="Times that each is timed, in turn.")
@click.option("--threads", default=2, show_default=True)
def main(size: int, spp: int, rounds: int, threads: int) -> None:
    """Measure, and print what was found."""
    print_tables([table(measure(size, spp, rounds, threads))])


if __name__ == "__main__":
    main()
