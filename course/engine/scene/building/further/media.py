"""Fog of a scene: from boxes, grids and noise to what rays come through."""

import warnings
from dataclasses import replace
from io import BytesIO
from itertools import combinations
from math import ceil

import numpy as np

from course.base.errors import CourseError, CourseWarning, SceneError
from course.base.inputs import read_input
from course.engine.core.lights.sample import TO_THE_LIGHT
from course.engine.core.types import Floats32, Floats64
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb
from course.engine.formats.yaml.document import KeyPath, spell
from course.engine.formats.yaml.loading import Loaded, bytes_of_files
from course.engine.functions.effects import Bound
from course.engine.scene.building.frame import Frame, in_range, in_reach
from course.engine.scene.building.things import Things
from course.engine.terms.media.bounds import Ball, Box, Corners, Sphere, overlap
from course.engine.terms.media.fog import Fog, Fogs
from course.engine.terms.media.lamps import Lamps
from course.engine.terms.media.stage import MediaStage
from course.engine.terms.media.tracking import DensityGrid
from course.engine.terms.surfaces.perlin import noise
from course.engine.terms.world import FullWorld

MOST_CELLS = 1 << 26
"""Of a grid from a file: 256 MB of float32."""

THINNEST = 1e-4
"""Least edge of a box over its distance from the scene's middle: rounding moves its faces by a thousandth of it."""


def compiled(
    loaded: Loaded, frame: Frame, bound: Bound, things: Things, world: FullWorld
) -> FullWorld:
    """The world with its fog.

    Raises SceneError: boxes that are empty, boxes or balls that overlap, grids that can't be read, coloured extinction
    of a grid, glass that absorbs within fog; names the key.
    """
    scene = loaded.description
    places = [_place(loaded, number) for number in range(len(scene.media))]
    for (one, a), (other, b) in combinations(enumerate(places), 2):
        if overlap(a, b):
            alone = "; what fills the whole scene is alone" if _endless(a) or _endless(b) else ""
            raise loaded.document.error(
                ("media", other),
                f"it overlaps media[{one}]: boxes and balls of fog may touch, but not overlap{alone}",
            )
    fogs = [_fog(loaded, frame, bound, n, place, world) for n, place in enumerate(places)]
    _check_glass(loaded, things, places)
    _warn_of_endless(loaded, places, world)
    if world.combining is not None and scene.integrator.gloss_sampling != "automatic":
        _warn(
            loaded,
            ("integrator", "gloss_sampling"),
            "in fog lamps are looked for by the lobe alone; the picture is the same on average, and noisier",
        )
    lamps = Lamps(
        world.surface,
        world.lights,
        world.environment if world.sky is not None else None,
        world.motion,
        world.choice is not None and len(world.lights) > 1,
    )
    there = Fogs(tuple(fog for fog in fogs if fog.extinction.any()))
    if not there.all:
        return world
    return replace(world, wraps=(*world.wraps, MediaStage(there, lamps)), combining=None)


def _endless(place: Corners | Sphere) -> bool:
    return not (isinstance(place, tuple) or np.isfinite(place).all())


def _place(loaded: Loaded, number: int) -> Corners | Sphere:
    """What a medium fills; a box without ends for everything."""
    medium = loaded.description.media[number]
    box = medium.box
    if medium.sphere is not None:
        if box is not None:
            raise loaded.document.error(
                ("media", number), "both box and sphere are given: expected one of them"
            )
        return np.array(medium.sphere.center, np.float64), medium.sphere.radius
    if box is None:
        return np.array([[-np.inf] * 3, [np.inf] * 3])
    corners = np.array(box, np.float64)
    if not (corners[0] < corners[1]).all():
        raise loaded.document.error(
            ("media", number, "box"),
            "expected a lowest and a highest corner, with room between them",
        )
    return corners


def _fog(
    loaded: Loaded,
    frame: Frame,
    bound: Bound,
    number: int,
    place: Corners | Sphere,
    world: FullWorld,
) -> Fog:
    medium, path = loaded.description.media[number], ("media", number)
    extinction = in_range(
        rgb(medium.extinction) * frame.scale,
        loaded,
        (*path, "extinction"),
        "the extinction",
        "a scene's size",
    )
    densities = _densities(loaded, number, place)
    albedo = rgb(medium.albedo).astype(np.float32)
    scatters = bool(albedo.any())
    names = {"ratio_tracking"} if densities is not None else {"transmittance"}
    asked_by = ("media", number, "extinction")
    if world.paths is not None:
        names |= {"delta_tracking"} if densities is not None else {"free_flight", "free_flight_pdf"}
        names |= {"henyey_greenstein", "sample_henyey_greenstein"}
    elif scatters:
        names |= {"henyey_greenstein", "in_scattering"}
        if any(light.limit <= TO_THE_LIGHT for light in world.lights):
            names.add("equiangular")
        if world.sky is not None:
            names.add("sample_henyey_greenstein")
    functions = bound.functions("media", *sorted(names), asked_by=asked_by)
    grid = None
    if densities is not None and extinction.any():
        largest = float(densities.max())
        grid = DensityGrid(
            (densities * extinction[0]).astype(np.float32),
            float(np.float32(largest) * extinction[0]),
            functions,
        )
        if not largest:
            extinction, grid = np.zeros(3, np.float32), None
    bounds = _bounds(loaded, frame, number, place)
    return Fog(bounds, extinction, albedo, medium.g, functions, grid)


def _bounds(loaded: Loaded, frame: Frame, number: int, place: Corners | Sphere) -> Box | Ball:
    """What a medium fills in the compiled scene."""
    if isinstance(place, tuple):
        path = ("media", number, "sphere")
        center, radius = frame.position(place[0]), place[1] / frame.scale
        low, high = center - radius, center + radius
        in_reach(np.stack((low, high)), loaded, path, "an end")
        _check_edges(low, high, loaded, path)
        return Ball(center.astype(np.float32), radius)
    path = ("media", number, "box")
    low, high = (
        frame.position(corner) if np.isfinite(corner).all() else corner for corner in place
    )
    if not _endless(place):
        in_reach(np.stack((low, high)), loaded, path, "a corner")
        _check_edges(low, high, loaded, path)
    return Box(low.astype(np.float32), high.astype(np.float32))


def _check_edges(low: Floats64, high: Floats64, loaded: Loaded, path: KeyPath) -> None:
    """Refuse a box so thin that its faces are rounded towards, or onto, each other."""
    farthest = np.maximum(np.abs(low), np.abs(high))
    for axis, edge, far in zip("xyz", high - low, farthest, strict=True):
        if edge < THINNEST * far:
            raise loaded.document.error(
                path,
                f"along {axis} it is {edge / far:.1e} of its distance from the middle of the scene:"
                f" expected at least {THINNEST:g} of it, which float32 can hold; give it more room, or move it",
            )


def _densities(loaded: Loaded, number: int, box: Corners | Sphere) -> Floats32 | None:
    """(X, Y, Z) what the extinction is times; None where it is even."""
    medium, path = loaded.description.media[number], ("media", number)
    if medium.grid is None and medium.noise is None:
        return None
    asks = "grid" if medium.grid is not None else "noise"
    if medium.grid is not None and medium.noise is not None:
        raise loaded.document.error(path, "both grid and noise are given: expected one of them")
    if medium.box is None or isinstance(box, tuple):
        raise loaded.document.error((*path, asks), "densities need a box that they fill; give box")
    if len(set(rgb(medium.extinction).tolist())) > 1:
        raise loaded.document.error(
            (*path, "extinction"),
            f"expected one number beside {asks}: all channels fly alike; colour its albedo",
        )
    if medium.noise is not None:
        return _noise(medium.noise, box)
    assert medium.grid is not None
    return _read(loaded, number, medium.grid)


def _noise(noise_of: d.DensityNoise, box: Floats64) -> Floats32:
    size = box[1] - box[0]
    shape = [max(1, ceil(noise_of.cells * edge / size.max())) for edge in size]
    middles = np.stack(
        np.meshgrid(
            *(
                low + (np.arange(n) + 0.5) * edge / n
                for low, edge, n in zip(box[0], size, shape, strict=True)
            ),
            indexing="ij",
        )
    ).reshape(3, -1)
    grey = (noise((middles * noise_of.scale).astype(np.float32)) + 1) / 2
    dense = np.clip((grey - noise_of.clear) / (1 - noise_of.clear), 0, 1)
    return np.asarray(dense.reshape(shape), np.float32)


def _read(loaded: Loaded, number: int, file: str) -> Floats32:
    path = ("media", number, "grid")
    name = loaded.path.parent / file
    try:
        content = read_input(name, "grid of densities", bytes_of_files(loaded.document), SceneError)
    except CourseError as error:
        raise loaded.document.error(path, str(error)) from error
    try:
        values = np.lib.format.read_array(BytesIO(content), allow_pickle=False)
    # Whatever the reader of a header's Python text makes of wrong bytes.
    except Exception as error:
        raise loaded.document.error(
            path, f"{file}: can't be read: expected an array that numpy.save has written"
        ) from error
    if (
        values.ndim != 3
        or not values.size
        or values.size > MOST_CELLS
        or values.dtype.kind not in "fiu"
    ):
        raise loaded.document.error(
            path,
            f"{file}: an array of shape {values.shape} and dtype {values.dtype}: expected numbers along three axes,"
            f" at most {MOST_CELLS:,} of them",
        )
    wrong = np.argwhere(~(np.isfinite(values) & (values >= 0) & (values < np.float32(1e20))))
    if len(wrong):
        place = tuple(wrong[0].tolist())
        raise loaded.document.error(
            path,
            f"{file}: {values[place]} at index {place}: expected densities of at least 0, and finite ones;"
            f" {len(wrong):,} of {values.size:,} are none",
        )
    return np.ascontiguousarray(values, np.float32)


def _check_glass(loaded: Loaded, things: Things, places: list[Corners | Sphere]) -> None:
    """Refuse glass that absorbs within fog, and tell of other glass: what is within it isn't left out."""
    scene = loaded.description
    for number, (thing, bounds) in enumerate(zip(things.described, things.bounds, strict=True)):
        glass = scene.materials[thing.material].dielectric
        within = [n for n, place in enumerate(places) if overlap(place, bounds)]
        if glass is None or not within or not np.any(rgb(scene.media[within[0]].extinction)):
            continue
        path = ("objects", number)
        if rgb(glass.absorption).any():
            raise loaded.document.error(
                path,
                f"its glass absorbs light, and lies in media[{within[0]}]: expected one of the two;"
                " a box of fog may leave it out",
            )
        _warn(loaded, path, f"media[{within[0]}] is in the glass as well; a box may leave it out")


def _warn_of_endless(loaded: Loaded, places: list[Corners | Sphere], world: FullWorld) -> None:
    """Tell of light that would come through fog without an end."""
    endless = [n for n, place in enumerate(places) if _endless(place)]
    if not endless or not rgb(loaded.description.media[endless[0]].extinction).all():
        return
    far = [light.name for light in world.lights if light.limit > TO_THE_LIGHT]
    if far or world.environment is not None:
        what = ", ".join(far) or "the environment"
        _warn(
            loaded,
            ("media", endless[0]),
            f"no light of {what} comes through fog without an end; give it a box",
        )


def _warn(loaded: Loaded, path: tuple[str | int, ...], what: str) -> None:
    warnings.warn(
        f"{loaded.document.where(path)}: {spell(path)}: {what}", CourseWarning, stacklevel=2
    )
