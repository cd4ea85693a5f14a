"""`python -m benchmarks.peer_agreement`: whether Mitsuba 3 shows what the further modules render.

A case is a scene that both programs render in batches, each with a seed of its own. Means of 8 x 8 pixels are compared
by Welch's t, see `benchmarks/mitsuba_agreement.py`; nothing is timed. Results are kept case by case in
docs/data/peer_agreement.json, and are a table of docs/peers.md. Needs `pip install .[peers]`, and LLVM 17.
"""

import shutil
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import click
import msgspec
import numpy as np

from benchmarks.mitsuba_agreement import (
    BLOCK,
    FAR,
    Agreement,
    Converged,
    compare,
    converge,
    save_difference,
)
from benchmarks.mitsuba_export import LAT_LONG_COLUMNS, export
from benchmarks.mitsuba_llvm import LlvmScene
from benchmarks.mitsuba_scalar import NativeScene
from benchmarks.mitsuba_variants import start_llvm
from benchmarks.peer_cases import rounded_deeply
from benchmarks.peer_scenes import scene_path
from benchmarks.peers import versions
from course import Scene, render
from course.base.atomic import write_text
from course.benchmarking.documents import replace_marked
from course.benchmarking.references import scene_hash
from course.benchmarking.tables import Table, print_tables
from course.engine.formats.yaml.loading import load_description
from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PROJECT
from course.engine.scene.scene import load_variant
from course.school.grading.known import known

MARK = "python -m benchmarks.peer_agreement"
OUT = Path("out/bench/peers/agreement")
DOCUMENT = PROJECT / "docs" / "peers.md"
DATA = PROJECT / "docs" / "data" / "peer_agreement.json"
SIZE, BATCHES, THREADS = (96, 64), 32, 2

DEEP = 24
"""Bounces: at the last one ours follows no mirror, and Mitsuba does, so there must be nothing left by then."""


@dataclass(frozen=True)
class Case:
    """A scene that both programs render.

    Attributes
    ----------
    module : whose functions it calls
    scene : of the course or of ``benchmarks/scenes/peers``
    words : what differs from the scene file
    values : the same as overrides
    samples : a pixel, of each batch; ``theirs`` of Mitsuba's where that differs
    product : whether our masking is made Mitsuba's, the product of two G1
    own : whether Mitsuba runs the integrator of ours, for it has no such lamps
    columns : of the environment's picture for each texel of the cube
    """

    module: str
    scene: str
    words: str
    values: Overrides = field(default_factory=dict)
    samples: int = 256
    theirs: int | None = None
    product: bool = False
    own: bool = False
    columns: int = LAT_LONG_COLUMNS


def flat(scene: str, *without: str) -> dict[tuple[str | int, ...], Any]:
    """Facets as they are, for the two programs treat normals of smooth meshes in their own ways."""
    things = load_description(scene_path(scene)).document.data["objects"]
    return {
        ("objects",): [
            thing | ({} if thing["shape"] in ("quad", "box") else {"shading": "flat"})
            for thing in things
            if thing.get("name") not in without
        ]
    }


def cases() -> dict[str, Case]:
    """What is compared, by name."""
    path: Overrides = {("integrator", "type"): "path", ("integrator", "max_depth"): DEEP}
    metal = {"refraction_index": [2.91, 2.68, 2.29], "absorption_index": [3.45, 3.21, 2.93]}
    plates = {"polished": 0.02, "smooth": 0.05, "satin": 0.1, "dull": 0.25, "rough": 0.5}
    rough: Overrides = {
        ("materials", name): {"color": 0, "mirror": 1, "conductor": metal | {"roughness": alpha}}
        for name, alpha in plates.items()
    }
    facets = "flat facets"
    # Without noise the sky's resampling would show: none of it is seen but in the balls.
    lake = flat("microfacets")
    lake["objects",][0] |= {"width": 200, "depth": 200}
    lake["camera", "look_at"] = [0, 0, 0]
    matt: Overrides = {("materials", "steel"): {"color": 0.5}}
    sky = {**path, **flat("environment_light"), **matt}
    return {
        "rough metals": Case("microfacets", "rough_metals", "the product of two G1", product=True),
        "rough glass in a box": Case(
            "microfacets", "rough_glass", "the product of two G1", product=True
        ),
        "metals and glass by a lake": Case(
            "microfacets",
            "microfacets",
            f"all paths, {facets}, no sky behind the table, the product of two G1",
            {**path, **lake},
            product=True,
            columns=8,
        ),
        "Veach's plates, Phong's lobes": Case(
            "multiple_importance", "multiple_importance", "all paths", path
        ),
        "Veach's plates, rough steel": Case(
            "multiple_importance",
            "multiple_importance",
            "all paths, plates of microfacets, the product of two G1",
            {**path, **rough},
            samples=1024,
            theirs=256,
            product=True,
        ),
        "a clear sky with its sun": Case(
            "environment_light",
            "environment_light",
            f"all paths, no mirror, {facets}",
            sky,
            columns=16,
        ),
        "a thousand lamps by the tree": Case(
            "many_lights",
            "many_lights",
            f"no flames, no mirror, {facets}",
            {**flat("many_lights", "flames"), **matt},
            theirs=16384,
        ),
        "a penumbra by blue noise": Case(
            "blue_noise", "blue_noise", facets, flat("blue_noise"), own=True
        ),
    }


def with_mitsubas_masking(folder: Path) -> Path:
    """The course's solutions with the product of two G1, which is what Mitsuba multiplies by, written to a folder."""
    for file in (PROJECT / "solutions").glob("*.py"):
        shutil.copy(file, folder)
    (product,) = (one for one in known("microfacets") if one.name == "g2_product")
    (folder / "microfacets.py").write_text(product.source, encoding="utf-8")
    return folder


@dataclass(frozen=True)
class Found:
    """A case and how its pictures agree.

    Attributes
    ----------
    blocks : means that were compared, three channels each
    correlated : relative difference of the pictures' means with the course's own masking; None where none is asked
    """

    name: str
    module: str
    scene: str
    words: str
    about: dict[str, str]
    blocks: int
    agreement: Agreement
    correlated: float | None = None


def measure(name: str, case: Case, batches: int = BATCHES, folder: Path = OUT) -> Found:
    """Render by both and compare; converged pictures are kept in a folder."""
    values = {("film", "filter"): "box", **case.values}
    path = scene_path(case.scene)
    with TemporaryDirectory() as place:
        effects = with_mitsubas_masking(Path(place)) if case.product else None
        scene = load_variant(path, values, effects)
        ours = our_picture(scene, case, batches, folder)
    theirs = their_picture(scene, case, batches, folder)
    label = name.replace(" ", "_").replace(",", "").replace("'", "")
    save_difference(theirs, ours, folder / f"{label}.png")
    correlated = None
    if case.product:
        # Only its mean is told.
        own = our_picture(load_variant(path, values), case, max(batches // 4, 2), folder)
        correlated = float(own.linear.mean() / theirs.linear.mean() - 1)
    return Found(
        name,
        case.module,
        case.scene,
        case.words,
        versions(THREADS),
        ours.blocks.size,
        compare(theirs, ours),
        correlated,
    )


def our_picture(scene: Scene, case: Case, batches: int, folder: Path) -> Converged:
    """Our converged picture."""

    def picture(seed: int) -> np.ndarray:
        return render(scene, size=SIZE, spp=case.samples, seed=seed, threads=THREADS).linear

    key = scene_hash(scene.loaded, scene.effects, samples=case.samples, batches=batches, of=SIZE)
    return converge(picture, batches, folder / f"ours_{key[:24]}.npz")


def their_picture(scene: Scene, case: Case, batches: int, folder: Path) -> Converged:
    """Mitsuba's converged picture."""
    start_llvm(THREADS)
    exported = export(scene, *SIZE, case.columns)
    samples = case.theirs or case.samples
    peer = LlvmScene(exported) if case.own else NativeScene(exported, lobes=True)
    key = scene_hash(
        scene.loaded, scene.effects, samples=samples, batches=batches, of=(*SIZE, case.columns)
    )
    picture = partial(peer.render, "independent", samples)
    return converge(picture, batches, folder / f"mitsuba_{key[:24]}.npz")


def read(path: Path = DATA) -> list[Found]:
    """All that is kept; nothing if there is no file."""
    return msgspec.json.decode(path.read_bytes(), type=list[Found]) if path.is_file() else []


def keep(found: Iterable[Found], path: Path = DATA) -> list[Found]:
    """Put results into the file, each in the place of an older one of its name."""
    kept = {each.name: each for each in (*read(path), *found)}
    ordered = [kept[name] for name in cases() if name in kept]
    text = msgspec.json.format(
        msgspec.json.encode([rounded_deeply(asdict(each)) for each in ordered])
    )
    write_text(path, text.decode() + "\n")
    return read(path)


def table(found: Iterable[Found]) -> Table:
    """A row for each case."""
    rows = []
    for each in found:
        a = each.agreement
        own = "-" if each.correlated is None else f"{each.correlated:+.2%}"
        numbers = f"{a.largest:.2f}", f"{a.far * each.blocks:.0f} of {each.blocks:,}"
        rows.append((each.name, each.module, each.words, *numbers, f"{a.mean:+.3%}", own))
    columns = "pictures", "module", "beside the scene file", "largest |t|", f"|t| > {FAR}"
    return Table(
        f"Mitsuba's pictures against ours, means of {BLOCK} x {BLOCK} pixels",
        (*columns, "mean", "ours with its own masking"),
        tuple(rows),
    )


def write_document(found: list[Found], document: Path = DOCUMENT) -> None:
    """Put the table between the marks of the document."""
    about: Mapping[str, str] = found[-1].about
    made = (
        f"Made by `{MARK} --write`, {SIZE[0]} x {SIZE[1]} pixels, {BATCHES} batches, on "
        + ", ".join(about[key] for key in ("processor", "system", "software", "peer"))
        + "."
    )
    replace_marked(document, MARK, f"{made}\n\n{table(found).markdown()}")


@click.command(help=__doc__)
@click.option("--case", "names", multiple=True, type=click.Choice(list(cases())), help="Only this.")
@click.option("--write", "writes", is_flag=True, help="Keep the results, and write docs/peers.md.")
def main(names: tuple[str, ...], writes: bool) -> None:
    """Compare what was asked for."""
    declared = cases()
    results = []
    for name in names or declared:
        results.append(measure(name, declared[name]))
        print_tables([table(results[-1:])])
        if writes:
            write_document(keep(results[-1:]))


if __name__ == "__main__":
    main()
