"""Small objects and lamps beside huge objects: where the scene's origin has to be, and what float32 can't hold."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from course.base.errors import CourseWarning
from course.engine.core.ray_offset import OFFSET
from course.engine.core.types import Floats64, Indices
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.document import KeyPath
from course.engine.formats.yaml.loading import Loaded
from course.engine.scene.building.cutting import MOST, unfinished
from course.engine.scene.building.frame import FARTHEST, Frame, bounds_of, frame_of
from course.engine.scene.building.motion import Shutter
from course.engine.scene.building.triangles import TOO_LARGE, SmallThings, ends_of, raised_offsets
from course.engine.shapes.mesh import Mesh
from course.engine.terms.surfaces.surface import FullPart

CUT = 64.0
"""Where triangles are cut, they become at most this many times as large as the objects beside them."""

LARGEST_RATIO = 1e12
"""Largest ratio of half the scene's extent and the smallest object for which float32 can render both."""


LARGEST = 64
"""Number of the largest objects between which thin gaps are looked for."""

THIN = 4.0
"""Width of a gap from which on rays that leave one side see the other rightly, in offsets of theirs."""

DIVIDED = 20_000
"""Largest number of triangles of a mesh whose parts are looked at one by one, which takes less than reading it."""

AT_ONCE = 64.0
"""Part of an object's way while the shutter is open in which nothing is seen sharply."""

FEW = 64
"""Largest number of an object's triangles that are tested one by one; more are tested by their common box."""


@dataclass(frozen=True)
class Extents:
    """Extents of objects and lamps, in the units of the scene file.

    Attributes
    ----------
    boxes : (F, 2, 3) float64, lowest and highest corner of all that each passes through, first the objects'
    sizes : (F,) float64, of an object the middle one of its three extents, so of a plate the width and of a rod the
        thickness, or what it goes through at once if that is more (``AT_ONCE``); of a lamp the first or, if that is
        more, its distance from the nearest object
    """

    boxes: Floats64
    sizes: Floats64

    def __add__(self, others: "Extents") -> "Extents":
        boxes, sizes = (self.boxes, others.boxes), (self.sizes, others.sizes)
        return Extents(np.concatenate(boxes), np.concatenate(sizes))


def extents_of_objects(bounds: Sequence[Floats64], boxes: Sequence[Floats64]) -> Extents:
    """Extents from the box (2, 3) of each object, and from its boxes when the shutter opens and when it closes."""
    swept = np.reshape(boxes, (-1, 2, 2, 3))
    together = np.stack((swept[:, :, 0].min(axis=1), swept[:, :, 1].max(axis=1)), axis=1)
    gone = np.abs(swept[:, 1, 0] - swept[:, 0, 0]).max(axis=1, initial=0) / AT_ONCE
    return Extents(together, np.maximum([_middle_extent(box) for box in bounds], gone))


def extents_of_lamps(
    loaded: Loaded, shutter: Shutter, objects: Extents, meshes: Sequence[Mesh]
) -> Extents:
    """Extents of the lights that have a place; one inside an object's box has no distance from that object.

    ``meshes``: of the objects; where triangles are few, their boxes are looked at instead of the object's.
    """
    boxes, sizes = [], []
    near = None
    for light in loaded.description.lights:
        match light:
            case d.PointLight():
                corners = np.array([light.position])
            case d.SphereLight():
                corners = np.array(light.center) + light.radius * np.array([[-1.0], [1.0]])
            case d.RectangleLight():
                u, v = np.array(light.edge_u), np.array(light.edge_v)
                corners = np.array(light.corner) + np.array((0 * u, u, v, u + v))
            case _:
                continue
        if near is None:
            near = _boxes_of(objects, meshes)
        start, sweep = shutter.start(light.motion), shutter.sweep(light.motion)
        own = np.stack((corners.min(axis=0), corners.max(axis=0)))
        box = np.stack(
            (own[0] + start + np.minimum(sweep, 0), own[1] + start + np.maximum(sweep, 0))
        )
        apart = np.maximum(near[:, 0] - box[1], box[0] - near[:, 1]).max(axis=1)
        distance = apart[apart > 0].min(initial=np.inf)
        boxes.append(box)
        sizes.append(max(_middle_extent(own), distance if np.isfinite(distance) else 0.0))
    return Extents(np.reshape(boxes, (-1, 2, 3)), np.array(sizes))


def _boxes_of(objects: Extents, meshes: Sequence[Mesh]) -> Floats64:
    """Boxes (B, 2, 3) of objects, or of their triangles where these are few."""
    found = [np.zeros((0, 2, 3))]
    for box, mesh in zip(objects.boxes, meshes, strict=True):
        if len(mesh.triangles) > FEW:
            found.append(box[None])
            continue
        p = mesh.vertices[mesh.triangles]
        found.append(np.stack((p.min(axis=1), p.max(axis=1)), axis=1))
    return np.concatenate(found)


def _middle_extent(box: Floats64) -> float:
    # Halved and doubled: the difference of two huge coordinates may overflow.
    return float(np.sort(box[1] / 2 - box[0] / 2)[1] * 2)


def frame_for(extents: Extents, objects: int) -> tuple[Frame, SmallThings, bool]:
    """The frame of a scene, in its coordinates the things beside which triangles may be cut, and if any is small.

    The frame is that of all objects where nothing is so small that it matters. Else its origin is where small things
    are placed best: each may be off by so much more as it is larger.
    ``objects``: how many of the extents are those of objects.
    """
    frame = frame_of(list(extents.boxes[:objects]))
    # A lamp out of float32's reach is refused where lights are compiled; the frame is that of the others.
    apart = np.abs(extents.boxes - frame.center).max(axis=(1, 2))
    there = (extents.sizes > 0) & (apart < FARTHEST * frame.scale)
    boxes, sizes = extents.boxes[there], extents.sizes[there]
    small = bool(there[:objects].any() and sizes.min() / frame.scale * TOO_LARGE < 1)
    if small:
        # Smaller objects have no surface in float32.
        sizes = np.maximum(sizes, frame.scale / LARGEST_RATIO)
        middles = (boxes[:, 0] / 2 + boxes[:, 1] / 2).T
        center = np.array([_between(middle, sizes) for middle in middles])
        own = extents.boxes[:objects]
        farthest = float(np.maximum(own[:, 1] - center, center - own[:, 0]).max())
        # The smallest is as much smaller than 1 as the farthest is larger: both are far from where products under-
        # or overflow, and lights from the least distance that counts.
        reach = float(2.0 ** np.round(np.log2(farthest / sizes.min()) / 2))
        frame = Frame(center, farthest / reach, reach)
    placed = frame.position(boxes)
    return frame, SmallThings(placed[:, 0], placed[:, 1], sizes / frame.scale), small


def _between(places: Floats64, sizes: Floats64) -> float:
    """The number whose largest distance from any of some places, in sizes of what is there, is smallest."""
    least, most = 0.0, float((places.max() - places.min()) / sizes.min())
    for _ in range(100):
        reach = least / 2 + most / 2
        if (places - reach * sizes).max() <= (places + reach * sizes).min():
            most = reach
        else:
            least = reach
    return float((places - most * sizes).max() / 2 + (places + most * sizes).min() / 2)


def warn_of_small(
    loaded: Loaded, extents: Extents, boxes: Sequence[Floats64], frame: Frame
) -> bool:
    """Say which object is too small for the scene or for its place in it, once for all of them; whether one is.

    ``extents``: of the objects alone; ``boxes`` as in ``extents_of_objects``.
    """
    swept = np.reshape(boxes, (-1, 2, 2, 3))
    nearest = np.maximum(swept[:, :, 0] - frame.center, frame.center - swept[:, :, 1])
    own = np.array([_middle_extent(box) for box in swept[:, 0]])
    # An object without extent is seen by nobody.
    sizes = np.where(own > 0, own, np.inf)
    excess = np.maximum(
        nearest.max(axis=(1, 2)) / (TOO_LARGE * sizes),
        frame.scale * frame.reach / (LARGEST_RATIO * sizes),
    )
    small = np.flatnonzero(excess > 1)
    if len(small) == 0:
        return False
    worst = int(excess.argmax())
    # The farthest point of any object, seen from this one.
    middle = extents.boxes[worst].mean(axis=0)
    reaches = np.maximum(extents.boxes[:, 1] - middle, middle - extents.boxes[:, 0]).max(axis=1)
    other = int(reaches.argmax())
    more = f" (and {len(small) - 1:,} more)" if len(small) > 1 else ""
    named = f"{_named(loaded, worst)} of a width of {own[worst]:.3g}{more}"
    across = (extents.boxes[other, 1] - extents.boxes[other, 0]).max()
    there = "it" if other == worst else f"{_named(loaded, other)}, {across:.3g} across,"
    warnings.warn(
        f"{loaded.document.where(('objects', worst))}: {named} is too small for a scene in which {there} reaches"
        f" {reaches[other]:.3g} away from its middle: float32 holds no more than the rough place of its"
        " surface; make the one larger or the other smaller, or move small objects closer together",
        CourseWarning,
        stacklevel=2,
    )
    return True


def warn_of_unfinished(
    loaded: Loaded, parts: Sequence[FullPart], things: SmallThings, pieces: int
) -> None:
    """Say which object's triangles were too many to be cut as finely as what lies beside them asks for.

    ``pieces``: how many more triangles there are than before
    """
    left = unfinished(parts, things) if pieces >= MOST / 2 else []
    if not left:
        return
    objects = len(loaded.description.objects)
    where: KeyPath = ("objects", left[0]) if left[0] < objects else ("lights",)
    what = _named(loaded, left[0]) if left[0] < objects else "a light"
    warnings.warn(
        f"{loaded.document.where(where)}: {what} has so many long thin triangles that not all were cut as finely as"
        " what lies beside them asks for: shadows and mirror images on them may be displaced; give it fewer or"
        " wider triangles",
        CourseWarning,
        stacklevel=2,
    )


def warn_of_gaps(
    loaded: Loaded,
    extents: Extents,
    frame: Frame,
    meshes: Sequence[Mesh],
    compiled: Sequence[Mesh],
    raised: float,
) -> None:
    """Say which gap between flat sides of two parts, or of one, rays that leave a surface would cross; once for all.

    Parameters
    ----------
    extents : of the objects alone
    meshes : of the objects
    compiled : the same, first of all, moved, scaled and cut
    raised : largest offset of their thin triangles
    """
    owner, things, boxes = _parts(loaded, extents, meshes)
    sizes = (boxes[:, 1] / 2 - boxes[:, 0] / 2).max(axis=1)
    some = np.argsort(-sizes, kind="stable")[:LARGEST]
    low, high = (boxes[some] - frame.center).transpose(1, 0, 2)
    # (S, S, 3): from one box to the next along each axis; negative where they reach over each other.
    way = low[None] - high[:, None]
    shared = np.maximum(low[:, None], low[None]), np.minimum(high[:, None], high[None])
    own = np.arange(len(some))
    raisers = dict[int, tuple[Floats64, Floats64]]()
    # From an object's one side to the other it is as far as it is thick.
    way[own, own] = high - low
    for axis in range(3):
        others = [k for k in range(3) if k != axis]
        reach = np.maximum(-shared[0], shared[1])[:, :, others].max(axis=2)
        beside = (shared[1] - shared[0])[:, :, others].min(axis=2)
        gap = way[:, :, axis]
        # What lies closer than float32 can tell is meant to touch.
        place = np.maximum(np.abs(low), np.abs(high))[:, axis]
        least = np.maximum(place[:, None], place[None]) * 2.0**-22
        least = np.maximum(least, reach / LARGEST_RATIO)
        leave = OFFSET * reach
        thin = (gap > least) & (gap < THIN * np.maximum(leave, raised * frame.scale))
        for i, j in np.argwhere(thin & (beside > 4 * gap)).tolist():
            first, second = int(some[i]), int(some[j])
            where = owner[first], owner[second]
            between = np.stack((shared[0][i, j], shared[1][i, j])) / frame.scale
            raisers.update((n, _raisers(compiled[n])) for n in where if n not in raisers)
            above = max(_largest_in(between, axis, *raisers[number]) for number in where)
            above = max(above * frame.scale, float(leave[i, j]))
            sides = (0, 1) if i == j else (1, 0)
            if gap[i, j] < THIN * above and all(
                _is_flat(things[number], axis, side, gap[i, j] / 64)
                for number, side in zip((first, second), sides, strict=True)
            ):
                _warn_of_gap(loaded, *where, i == j, float(gap[i, j]), float(reach[i, j]), above)
                return


def _parts(
    loaded: Loaded, extents: Extents, meshes: Sequence[Mesh]
) -> tuple[list[int], list[Mesh], Floats64]:
    """Object, mesh and box (2, 3) of each part: still meshes of files may have several, which share no corner."""
    owner, things, boxes = [], [], []
    for number, (thing, mesh) in enumerate(zip(loaded.description.objects, meshes, strict=True)):
        own = [mesh]
        if (
            isinstance(thing, d.MeshFile)
            and not any(thing.motion.velocity)
            and len(mesh.triangles) <= DIVIDED
        ):
            own = _divided(mesh)
        owner += [number] * len(own)
        things += own
        boxes += [bounds_of(part) for part in own] if len(own) > 1 else [extents.boxes[number]]
    return owner, things, np.reshape(boxes, (-1, 2, 3))


def _divided(mesh: Mesh) -> list[Mesh]:
    """The LARGEST parts of a mesh by their number of triangles; itself where it is in one piece."""
    # Heavy, and only meshes of files need it.
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    triangles = mesh.triangles
    for weld in (False, True):
        if weld:
            # Where normals or textures have a seam, or in STL, corners stand more than once in the file.
            triangles = np.unique(mesh.vertices, axis=0, return_inverse=True)[1].ravel()[triangles]
        pairs = triangles[:, :2].T.ravel(), triangles[:, 1:].T.ravel()
        size = int(triangles.max()) + 1
        sides = coo_array((np.ones(len(pairs[0])), pairs), shape=(size, size))
        part = connected_components(sides, directed=False)[1][triangles[:, 0]]
        numbers, counts = np.unique(part, return_counts=True)
        if len(numbers) == 1:
            return [mesh]
    largest = numbers[np.argsort(-counts, kind="stable")[:LARGEST]]
    return [_alone(mesh.vertices, mesh.triangles[part == number]) for number in largest]


def _alone(vertices: Floats64, triangles: Indices) -> Mesh:
    """Some triangles with their own vertices alone."""
    used, place = np.unique(triangles, return_inverse=True)
    return Mesh(vertices[used], place.reshape(triangles.shape))


def _raisers(mesh: Mesh) -> tuple[Floats64, Floats64]:
    """Corners (R, 3 corners, 3) of a mesh's thin triangles, and their least offsets (R,)."""
    p = mesh.vertices[mesh.triangles]
    offsets = raised_offsets(p)
    some = np.flatnonzero(offsets)
    return p[some], offsets[some]


def _largest_in(box: Floats64, axis: int, p: Floats64, offsets: Floats64) -> float:
    """Largest of the offsets (R,) of triangles (R, 3, 3) that reach into a box (2, 3) and lie across an axis."""
    ends, (low, high) = np.sort(box, axis=0), ends_of(p)
    room = (ends[1] - ends[0])[axis] / 64
    there = ((low <= ends[1] + room) & (high >= ends[0] - room)).all(axis=1)
    across = high[:, axis] - low[:, axis] < room
    return float(offsets[there & across].max(initial=0))


def _is_flat(mesh: Mesh, axis: int, side: int, within: float) -> bool:
    """Whether the lowest or highest side of a mesh is more than a point or an edge."""
    places = mesh.vertices[:, axis]
    end = places.max() if side else places.min()
    return int(np.count_nonzero(np.abs(places - end) < within)) > 2


def _warn_of_gap(
    loaded: Loaded, first: int, second: int, thick: bool, gap: float, reach: float, above: float
) -> None:
    between = f"{_named(loaded, first)} and {_named(loaded, second)}"
    if first == second:
        between = f"two parts of {_named(loaded, first)}"
    what = f"between {between} is a gap of {gap:.3g}"
    if thick:
        what = f"{_named(loaded, first)} is {gap:.3g} thick"
    warnings.warn(
        f"{loaded.document.where(('objects', second))}: {what}, and reaches {reach:.3g} away from the scene's middle,"
        f" where rays leave a surface by {above:.2g}: one side's shadow on the other may be lost; make it"
        " wider or the scene smaller",
        CourseWarning,
        stacklevel=2,
    )


def _named(loaded: Loaded, number: int) -> str:
    thing = loaded.description.objects[number]
    name = f' "{thing.name}"' if thing.name else ""
    return f"objects[{number}] ({thing.__struct_config__.tag}{name})"
