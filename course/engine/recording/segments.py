"""Segments of recorded paths: from a recorder's tables to what each ray was, met and brought, in the scene's units."""

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from course.engine.core.types import Floats32, Floats64, Numbers
from course.engine.formats.yaml import description as d
from course.engine.recording.recorder import ENVIRONMENT_LIGHT, Recorder, RecordTable
from course.engine.scene.building.materials import material_columns
from course.engine.scene.scene import Scene
from course.engine.terms.shafts.walk import CLEAR, CUT_OFF, MIXED

ENVIRONMENT = "environment"

AFAR = 2.0
"""Length of a segment that hits nothing [unit of the compiled scene, whose objects lie in [-1, 1]]."""

ROUNDING = 1e-6
"""Share of the lights' radiance that may be lost where it is summed in float32."""

BETWEEN = "the fog"
"""Where rays end between surfaces."""

ONWARD = {"mirrored", "refracted", "bounce"}
"""How rays go on from a surface."""

SHAFTS = {CLEAR: "clear", MIXED: "mixed", CUT_OFF: "cut off"}

Triple = tuple[float, float, float]


@dataclass
class Call:
    """What a function of the course was asked for one ray.

    Attributes
    ----------
    function : "module.function"
    arguments, results : by their names: a number or a list of numbers, or how a large array looks
    """

    function: str
    arguments: dict[str, Any]
    results: dict[str, Any]


@dataclass
class Segment:
    """A piece of a path, or a ray that asks for light.

    Attributes
    ----------
    number : its place in the list of segments
    parent : that of the segment at whose end it begins; None for camera rays
    pixel : (x, y)
    sample : number of the sample in its pixel
    depth : number of bounces before it
    kind : "camera", "mirrored", "refracted", "bounce", "shadow", or "environment" for a shadow ray that asks for the
        environment's light
    start, end : [units of the scene file]; a segment that meets nothing ends outside the scene
    met : the object where it ends, "environment", or the light that a shadow ray reaches
    material : of that object; None for lights and the environment
    light : that a shadow ray asks for; None for other rays
    blocked : whether something is between a shadow ray's start and its light
    shaft : what is known of the ways between its cell and the light: "clear", "mixed" or "cut off"; None if nothing
    aim : the point of the light that a shadow ray asks for; None for other rays
    before, after : throughput at the end of the parent, and at this segment's own end
    radiance : what it brings to its sample [W/(m^2 sr)]: light that its end gives off or that arrives from the
        environment, or that of the shadow ray's light, times the throughput
    source : where that light comes from, in words
    numbers : name -> numbers in [0, 1) that were drawn at its end, or for the camera ray
    calls : of the functions that chose it, in their order
    unlit : light -> why the end casts no shadow ray to it: "surface" or "light" looks away, or the "material" reflects
        no light on that side
    """

    number: int
    parent: int | None
    pixel: tuple[int, int]
    sample: int
    depth: int
    kind: str
    start: Triple
    end: Triple
    met: str
    material: str | None
    light: str | None
    blocked: bool
    aim: Triple | None
    before: Triple
    after: Triple
    radiance: Triple
    source: str
    calls: list[Call]
    numbers: dict[str, list[float]] = field(default_factory=dict)
    unlit: dict[str, str] = field(default_factory=dict)
    shaft: str | None = None


class Names:
    """What the triangles of a scene are called: their object or light, and their material."""

    def __init__(self, scene: Scene) -> None:
        description, frame = scene.loaded.description, scene.compiled.frame
        self.materials = material_columns(description).names
        triangles = scene.compiled.world.surface.triangles
        shutter = scene.compiled.shutter
        # As tables are made: what stands still first, then what moves, by velocity.
        velocities = [shutter.velocity(thing.motion, frame) for thing in description.objects]
        order = iter(
            sorted(range(len(velocities)), key=lambda n: (any(velocities[n]), velocities[n]))
        )
        surfaces = [
            f"light {number}"
            for number, light in enumerate(description.lights)
            if isinstance(light, d.RectangleLight | d.SphereLight)
            and light.radiance is not None
            and not (isinstance(light, d.RectangleLight) and not light.visible)
        ]
        self.parts: list[str] = []
        self.ends: Numbers = np.cumsum([count for _, count, _ in triangles.parts])
        first = 0
        for end in self.ends:
            lamp = int(triangles.material[first]) - len(self.materials) if end > first else -1
            self.parts.append(
                surfaces[lamp] if lamp >= 0 else _called(description, next(order, None))
            )
            first = end

    def object(self, triangle: int) -> str:
        """The object or light of a triangle; -1 is between surfaces."""
        if triangle < 0:
            return BETWEEN
        return self.parts[int(np.searchsorted(self.ends, triangle, side="right"))]

    def material(self, number: int) -> str | None:
        """A material's name; None for that of a light, and for -1, between surfaces."""
        return self.materials[number] if 0 <= number < len(self.materials) else None


def _called(scene: d.SceneDescription, number: int | None) -> str:
    """An object by its name, or its kind, numbered where there are several of it."""
    if number is None:
        return ""  # A scene without objects has a table without rows.
    thing = scene.objects[number]
    kind = thing.__struct_config__.tag
    same = sum(not o.name and o.__struct_config__.tag == kind for o in scene.objects)
    return thing.name or (f"{kind} (objects.{number})" if same > 1 else str(kind))


def segments_of(recorder: Recorder, scene: Scene, width: int) -> list[Segment]:
    """All that was recorded of a picture of that width [pixels]: each ray, and after it its shadow rays."""
    return list(_Reading(recorder, scene, width).segments())


class _Reading:
    """Reads a recorder's tables."""

    def __init__(self, recorder: Recorder, scene: Scene, width: int) -> None:
        self._recorder, self._names, self._width = recorder, Names(scene), width
        self._frame, self._world = scene.compiled.frame, scene.compiled.world
        self._triangle_materials = scene.compiled.world.surface.triangles.material
        self._hits = {int(row["id"]): row for row in recorder.hits.rows()}
        self._bounced = {int(row["id"]) for row in recorder.left_diffuse.rows()}
        self._brought: dict[int, Floats64] = defaultdict(lambda: np.zeros(3))
        for row in recorder.brought.rows():
            self._brought[int(row["id"])] += row["value"]
        self._onward: dict[int, set[str]] = defaultdict(set)
        for row in recorder.rays.rows():
            self._onward[int(row["parent"])].add(self._kind(row))
        self._drawn, self._unlit, self._shadows, self._calls = map(
            _grouped, (recorder.drawn, recorder.unlit, recorder.shadows, recorder.calls)
        )

    def segments(self) -> Iterator[Segment]:
        """See ``segments_of``."""
        known: dict[int, Segment] = {}
        count = 0
        for row in self._recorder.rays.rows():
            parent = known.get(int(row["parent"])) if row["parent"] >= 0 else None
            one = self._segment(row, parent, count)
            known[int(row["id"])] = one
            yield one
            count += 1
            for shadow in self._shadows.get(int(row["id"]), ()):
                yield self._shadow(shadow, one, count)
                count += 1

    def _segment(self, row: dict[str, Any], parent: Segment | None, number: int) -> Segment:
        """A camera ray or one that left a surface."""
        name, hit = int(row["id"]), self._hits.get(int(row["id"]))
        kind = self._kind(row)
        end = row["origin"] + row["direction"] * np.float32(AFAR) if hit is None else hit["p"]
        after = row["throughput"] if hit is None else hit["throughput"]
        # What the hit sends on by its lights is told by their shadow rays.
        own = self._brought.get(name, np.zeros(3))
        through = np.asarray(after, np.float64)
        lights = sum((s["value"] * through for s in self._shadows.get(name, ())), np.zeros(3))
        # What is left of light that is all of lights is the rounding of float32.
        own = np.where(np.abs(own - lights) > ROUNDING * np.abs(lights), own - lights, 0)
        made = self._made(int(row["parent"]) if parent else name, {kind})
        # Functions may choose no ray: the path ends or takes another way, or the hit doesn't face the light.
        lit = {s["light"] for s in self._shadows.get(name, ())}
        unlit = {row["light"] for row in self._unlit.get(name, ())} | {ENVIRONMENT_LIGHT} - lit
        after_it = {"environment", "surface", *unlit, *(ONWARD - self._onward[name])}
        return Segment(
            number=number,
            parent=None if parent is None else parent.number,
            pixel=(int(row["pixel"]) % self._width, int(row["pixel"]) // self._width),
            sample=int(row["sample"]),
            depth=row["depth"],
            kind=kind,
            start=self._place(row["origin"]),
            end=self._place(end),
            met=ENVIRONMENT if hit is None else self._names.object(int(hit["triangle"])),
            material=None if hit is None else self._names.material(int(hit["material"])),
            light=None,
            blocked=False,
            aim=None,
            before=(1.0, 1.0, 1.0) if parent is None else parent.after,
            after=_triple(after),
            radiance=_triple(own),
            source=self._source(hit),
            numbers={r["name"]: r["u"].tolist() for r in self._drawn.get(name, ())},
            calls=made + self._made(name, after_it),
            unlit={r["light"]: str(r["reason"]) for r in self._unlit.get(name, ())},
        )

    def _shadow(self, row: dict[str, Any], parent: Segment, number: int) -> Segment:
        """A shadow ray from the end of a segment."""
        sky, blocked = row["light"] == ENVIRONMENT_LIGHT, not row["free"]
        # As a share of the way to the light; lights that are infinitely far away have a direction only.
        reach = far = min(row["limit"], AFAR)
        met, material = ENVIRONMENT if sky else row["light"], None
        if blocked:
            # A ray that nothing blocks on its way is blocked where it begins, by the facet of its own surface.
            met, material, far = parent.met, parent.material, 0.0
            if row["triangle"] >= 0:
                far = float(row["far"])
                met = self._names.object(int(row["triangle"]))
                material = self._names.material(int(self._triangle_materials[row["triangle"]]))
        return Segment(
            number=number,
            parent=parent.number,
            pixel=parent.pixel,
            sample=parent.sample,
            depth=parent.depth,
            kind=ENVIRONMENT if sky else "shadow",
            start=self._place(row["origin"]),
            end=self._place(row["origin"] + row["direction"] * np.float32(far)),
            met=met,
            material=material,
            light=ENVIRONMENT if sky else row["light"],
            blocked=blocked,
            aim=self._place(row["origin"] + row["direction"] * np.float32(reach)),
            before=parent.after,
            after=parent.after,
            radiance=_triple(row["value"] * np.asarray(parent.after)),
            source="the environment" if sky else row["light"],
            calls=self._made(int(row["id"]), {row["light"]}),
            shaft=SHAFTS.get(int(row["shaft"])),
        )

    def _kind(self, row: dict[str, Any]) -> str:
        """How a ray left the surface that it comes from."""
        if row["parent"] < 0:
            return "camera"
        came = self._hits[int(row["parent"])]
        if int(row["parent"]) in self._bounced or came["triangle"] < 0:
            return "bounce"
        above = np.array_equal(came["near"], row["origin"])
        return "mirrored" if above else "refracted"

    def _place(self, x: Floats32) -> Triple:
        return _triple(x.astype(np.float64) * self._frame.scale + self._frame.center)

    def _source(self, hit: dict[str, Any] | None) -> str:
        """Where the light comes from that a ray brings without a shadow ray."""
        if hit is None:
            return "the environment"
        if hit["triangle"] < 0:
            return BETWEEN
        material = int(hit["material"])
        if self._names.material(material) is None:
            return f"{self._names.object(int(hit['triangle']))} itself"
        if self._world.ambient.any():
            return "ambient light"
        return f"the glow of '{self._names.object(int(hit['triangle']))}'"

    def _made(self, name: int, stages: set[str]) -> list[Call]:
        return [
            Call(
                row["function"],
                {key[9:]: _plain(value) for key, value in row.items() if key[:9] == "argument "},
                {key[7:]: _plain(value) for key, value in row.items() if key[:7] == "result "},
            )
            for row in self._calls.get(name, ())
            if row["stage"] in stages
        ]


def _grouped(table: RecordTable) -> dict[int, list[dict[str, Any]]]:
    rows: dict[int, list[dict[str, Any]]] = defaultdict(list)
    for row in table.rows():
        rows[int(row["id"])].append(row)
    return rows


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else value


def _triple(values: Any) -> Triple:
    x, y, z = np.asarray(values, np.float64).tolist()
    return x, y, z
