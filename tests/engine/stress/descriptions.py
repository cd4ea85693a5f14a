"""Random scene descriptions, drawn from the description classes themselves: whatever the format allows.

Numbers are drawn from the whole range of each key, its ends among them; most are of ordinary size, for a scene in which
all are extreme shows nothing. What takes more than one key to be right is repaired, or most scenes would be refused.
"""

import math
from functools import cache
from typing import Any

from hypothesis import strategies as st
from msgspec import inspect

from course.engine.formats.yaml.description import STEP, SceneDescription

Strategy = st.SearchStrategy[Any]

MATERIALS = ("one", "other", "third")
FILES = {
    "file": ("sliver.obj", "flat.obj", "tetrahedron.obj"),
    "cross": ("cross.exr",),
    "image": ("sky.exr",),
}
FACES = [f"face{number}.exr" for number in range(6)]

ORDINARY = st.floats(-4, 4).map(lambda x: round(x, 3)).filter(bool)
EXTREME = st.sampled_from(
    [
        *(0.0, 1e-150, 1e-60, 1e-45, 1e-38, 1e-20, 1e-10, 1e-7),
        *(1e-4, 1e4, 1e7, 1e10, 1e20, 1e38, 1e60, 1e150),
    ]
)
"""Sizes at which something may happen: the ends of float32 and of its square, and those of the format."""

MOST = {
    "width": 5,
    "height": 4,
    "max_depth": 6,
    "segments": 12,
    "sides": 8,
    "p": 3,
    "q": 3,
    "size": 8,
    "frequency": 50.0,
    "gather": 4,
    "nearest": 50,
}
"""Bounds on what only costs time."""


@cache
def descriptions() -> Strategy:
    """Plain data of scene files, most of which can be rendered."""
    return _of(inspect.type_info(SceneDescription), "").map(_repaired)


def _of(kind: inspect.Type, key: str) -> Strategy:
    match kind:
        case inspect.Metadata():
            return _of(kind.type, key)
        case inspect.StructType():
            return _struct(kind)
        case inspect.UnionType():
            return st.one_of([_of(each, key) for each in kind.types])
        case inspect.DictType():
            return st.fixed_dictionaries({name: _of(kind.value_type, "") for name in MATERIALS})
        case inspect.TupleType():
            return st.tuples(*(_of(each, key) for each in kind.item_types)).map(list)
        case inspect.VarTupleType():
            # No scene without objects or lights, which show nothing.
            least = kind.min_length or int(key in ("objects", "lights"))
            # Two fogs mostly overlap, which is refused.
            most = 1 if key == "media" else kind.max_length or 3
            return st.lists(_of(kind.item_type, key), min_size=least, max_size=most)
        case inspect.LiteralType():
            return st.sampled_from(kind.values)
        case inspect.FloatType():
            return _number(kind, key)
        case inspect.IntType():
            return _whole_number(kind, key)
        case inspect.StrType():
            return _text(key)
        case inspect.BoolType():
            return st.booleans()
        case inspect.NoneType():
            return st.none()
    raise TypeError(f"no strategy for {kind}")


def _struct(kind: inspect.StructType) -> Strategy:
    required = {f.encode_name: _of(f.type, f.encode_name) for f in kind.fields if f.required}
    optional = {f.encode_name: _of(f.type, f.encode_name) for f in kind.fields if not f.required}
    if kind.cls is SceneDescription:
        # Always there, or there would be nothing to see.
        for key in ("film", "sampler", "integrator", "materials", "objects", "lights"):
            required[key] = optional.pop(key)
    # No picture that scenes may name has layers: another layer is refused.
    optional.pop("layer", None)
    for key in {"width", "height", "samples", "segments"} & set(optional):
        # Their defaults cost too much.
        required[key] = optional.pop(key)
    if kind.tag_field and kind.tag_field != STEP:
        required[kind.tag_field] = st.just(kind.tag)
    return st.fixed_dictionaries(required, optional=optional)


def _number(kind: inspect.FloatType, key: str) -> Strategy:
    low = -math.inf if kind.ge is None and kind.gt is None else float(kind.ge or kind.gt or 0)
    high = math.inf if kind.le is None and kind.lt is None else float(kind.le or kind.lt or 0)
    high = min(high, MOST.get(key, high))

    def legal(x: float) -> bool:
        return (
            low <= x <= high
            and (kind.gt is None or x > kind.gt)
            and (kind.lt is None or x < kind.lt)
        )

    ordinary = ORDINARY.map(abs) if low >= 0 else ORDINARY
    extreme = EXTREME if low >= 0 else st.tuples(EXTREME, st.sampled_from((1, -1))).map(math.prod)
    ends = [
        x for x in (low, high, math.nextafter(low, high), math.nextafter(high, low)) if legal(x)
    ]
    ends = [x for x in ends if x == 0 or 1e-150 <= abs(x) <= 1e150]
    within = ordinary
    if low > -math.inf and high < math.inf:
        within = st.floats(low, high).filter(lambda x: x == 0 or abs(x) > 1e-150)
    rare = st.one_of(extreme.filter(legal), *([st.sampled_from(ends)] if ends else []))
    # One in twenty: with more of them most scenes would be refused.
    chance = st.integers(0, 19)
    # Made once: Hypothesis reads the source of what a new strategy filters by.
    usual = within.filter(legal)
    return chance.flatmap(lambda k: rare if k == 19 else usual)


def _whole_number(kind: inspect.IntType, key: str) -> Strategy:
    if key == "samples":
        # A square, as some samplers want it.
        return st.sampled_from([1, 4, 9])
    low = int(kind.ge if kind.ge is not None else 0)
    high = int(kind.le if kind.le is not None else 100)
    return st.integers(low, min(high, max(low, int(MOST.get(key, high)))))


def _text(key: str) -> Strategy:
    match key:
        case "material":
            return st.sampled_from(MATERIALS)
        case "samples":
            return st.sampled_from(["point", "grid 1", "grid 3"])
        case "faces":
            return st.sampled_from(FACES)
        case "file" | "cross" | "image":
            return st.sampled_from(FILES[key])
    return st.text(st.characters(exclude_categories=("C", "Z")), max_size=6)


def _repaired(description: dict[str, Any]) -> dict[str, Any]:
    """What takes more than one key to be right, mostly put right."""
    materials = description["materials"]
    clear = [name for name in MATERIALS if materials[name].get("dielectric") is not None]
    for name in clear:
        # The name of another dielectric, and none goes around itself.
        outer = materials[name]["dielectric"].pop("surrounded_by", None)
        if outer and name != clear[0]:
            materials[name]["dielectric"]["surrounded_by"] = clear[0]
    for thing in description["objects"]:
        if thing.get("from_behind", "turned") != "turned":
            if thing.get("material", MATERIALS[0]) in clear:
                del thing["from_behind"]
            else:
                description["integrator"]["shading_normals"] = "interpolated"
    for light in description["lights"]:
        if light["type"] in ("sphere", "rectangle"):
            given = [key for key in ("intensity", "radiance") if light.get(key) is not None]
            for key in ("intensity", "radiance"):
                light.pop(key, None) if key not in given[:1] else None
            if not given:
                light["intensity"] = 5.0
            if light["type"] == "sphere" and light.get("samples", "sphere") != "sphere":
                # Only a lamp by radiance has a visible side, and that and its surface are all it has.
                by_radiance = light.get("radiance") is not None
                if by_radiance and light["samples"] != "sphere by polar":
                    light["samples"] = "visible"
                elif not by_radiance and light["samples"] == "visible":
                    light["samples"] = "ball"
            if light["type"] == "rectangle" and light.get("radiance") is None:
                for key in ("two_sided", "visible"):
                    light.pop(key, None)
            elif light.get("two_sided"):
                light["visible"] = False
    for number, light in enumerate(description["lights"]):
        if light["type"] == "spot":
            light["outer_angle"] = max(
                light.get("outer_angle", 30.0), light.get("inner_angle", 20.0)
            )
        if light["type"] == "object":
            # Seldom, with more lights than objects, two of them name one, which is refused.
            which = number % len(description["objects"])
            thing = description["objects"][which]
            light["object"] = thing["name"] = f"lamp {which}"
            description["materials"][thing["material"]].setdefault("emission", 2.0)
    for fog in description.get("media", []):
        if fog.get("sphere") is not None:
            # What it fills has no densities.
            for key in ("box", "grid", "noise"):
                fog.pop(key, None)
            continue
        corners = zip(*(fog.get("box") or ([-1, -1, -1], [1, 1, 1])), strict=True)
        fog["box"] = [list(corner) for corner in zip(*map(sorted, corners), strict=True)]
        if fog.get("grid") is not None:
            fog.pop("noise", None)
    if description.get("media"):
        description.pop("photons", None)
    if description.get("photons") is not None:
        photons = description["photons"]
        photons["count"] = min(photons.get("count", 1000), 999)
        if description["integrator"].get("type") == "path":
            photons.pop("gather", None)
        if photons.get("nearest") is not None:
            photons.pop("cone", None)
    things = [*description["objects"], *description["lights"]]
    if any(any(thing.get("motion", {}).get("velocity", [])) for thing in things):
        # A hierarchy holds what stands still.
        description.pop("acceleration", None)
    for material in description["materials"].values():
        if material.get("dielectric") is not None and material.get("conductor") is not None:
            material.pop("conductor")
        if material.get("texture") is not None:
            material.pop("noise", None)
        if material.get("dielectric") is not None:
            material.pop("unlit", None)
        if (bump := material.get("bump")) is not None:
            material.pop("normal_map", None)
            carved = bump.get("image") is None
            bump["noise"] = (bump.get("noise") or {}) if carved else None
        if material.get("facets") is not None:
            material.pop("highlight", None)
        metal, glass = material.get("conductor") or {}, material.get("dielectric") or {}
        if metal.get("roughness"):
            # Microfacets blur by themselves, and have the exact equations of Fresnel.
            material.pop("gloss", None)
            metal.pop("fresnel", None)
        if glass.get("distribution") == "ggx" and glass.get("roughness"):
            material.pop("gloss", None)
            glass["roughness"] = min(glass["roughness"], 1.0)
    for thing in description["objects"]:
        if thing["shape"] == "mesh":
            # Those that are drawn have no texture coordinates.
            for key in ("normal_map", "bump", "specular_texture"):
                materials[thing.get("material", MATERIALS[0])].pop(key, None)
    for thing in description["objects"]:
        for step in thing.get("transform", []):
            if "matrix" in step:
                step["matrix"][3] = [0.0, 0.0, 0.0, 1.0]
        small, large = {
            "torus": ("tube", "radius"),
            "displaced_sphere": ("amplitude", "radius"),
        }.get(thing["shape"], ("", ""))
        if small and thing.get(small, 0.2) >= thing.get(large, 1.0):
            thing[small] = thing.get(large, 1.0) / 4
        if thing["shape"] == "torus_knot":
            thing |= {"p": 2, "q": 3, "segments": 40, "tube": thing.get("radius", 1.0) / 10}
    environment = description.get("environment", {"type": "constant"})
    if environment["type"] == "angular":
        environment["image"] = FACES[0]
    if environment["type"] == "cube":
        if environment.get("cross") is None:
            environment["faces"] = FACES
        else:
            environment.pop("faces", None)
    camera = description["camera"]
    # Most cameras look at the things, which are about the origin.
    camera["look_at"] = [x / 8 if abs(x) <= 4 else x for x in camera["look_at"]]
    if camera["eye"] == camera["look_at"]:
        camera["look_at"] = [x + 1 for x in camera["eye"]]
    if "up" in camera and camera["up"].count(0) > 1:
        camera.pop("up")
    if description["film"].get("error") is not None:
        # It takes a sampler that can go on, and enough samples to see an error.
        description["sampler"] = {"type": "sobol", "samples": 16}
        description["film"].pop("subdivision", None)
    if description["film"].get("subdivision") is not None:
        description["sampler"] = {"type": "sobol", "samples": 1}
        description["film"]["filter"] = "box"
    if {"error", "subdivision"} & {k for k, v in description["film"].items() if v is not None}:
        description["film"].pop("denoise", None)
    if description["film"].get("denoise") is not None:
        # It takes samples that tell how much they vary, all of one weight.
        description["sampler"] = {"type": "sobol", "samples": 4}
        description["film"]["filter"] = "box"
    plane = camera.get("image_plane")
    if plane:
        for low, high in (("left", "right"), ("bottom", "top")):
            plane[low], plane[high] = sorted((plane[low], plane[high]))
    lens = camera.get("lens")
    if lens:
        if (lens.get("focus_distance") is None) == (lens.get("focus_point") is None):
            lens.pop("focus_point", None)
            lens["focus_distance"] = 3.0
        if lens.get("focus_distance") is not None:
            lens["focus_distance"] = abs(lens["focus_distance"]) or 1.0
    shutter = camera.get("shutter")
    if shutter:
        first, last = sorted((shutter.get("open", 0.0), shutter.get("close", 1.0)))
        shutter |= {"open": first, "close": last}
    return description
