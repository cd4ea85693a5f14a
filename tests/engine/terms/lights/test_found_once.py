"""Every light that a scene file can name, on every kind of surface, by every way of looking for lamps: found once.

A row of plates shows a light in the mirrored direction. Its brightness is worked out in float64: by directions of the
plate's lobe, or by points on the light where only these find it. A light that is missed leaves 0 of that, and one that
is found in two ways shows twice. The rows are made of the scene format's own lists: what is new there fails here.
"""

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args, get_type_hints

import numpy as np
import pytest
from PIL import Image

from course import load_scene, render
from course.engine.formats.yaml import description as d
from tests.engine.terms.lights.test_weights import (
    ACROSS,
    GRID,
    Array,
    Seen,
    around,
    directions,
    expected,
    meets,
    reflected,
)
from tests.estimates import fresnel
from tests.lengths import share

SEEN = Seen()
DISTANCE, RADIUS, SMALL, SPEED = 2.8, 0.6, 0.01, 0.8
PLATE = 1e-3
"""Width of a plate: so small that all of them are seen, and lit, at one angle."""

METAL = {"refraction_index": 0, "absorption_index": 1}
ALPHA, EXPONENT = 0.15, 30.0

MATERIALS: dict[str, dict[str, Any]] = {
    "diffuse": {"color": 1},
    "mirror": {"mirror": 1},
    "smooth metal": {"mirror": 1, "conductor": METAL},
    "lobe ball": {"mirror": 1, "gloss": {"lobe": "ball", "glossiness": 0.1}},
    "lobe plane": {"mirror": 1, "gloss": {"lobe": "plane", "roughness": 0.1}},
    "lobe phong": {"mirror": 1, "gloss": {"lobe": "phong", "exponent": EXPONENT}},
    "metal ggx": {"mirror": 1, "conductor": METAL | {"roughness": ALPHA}},
    "glass": {"dielectric": {}},
    "glass square": {"dielectric": {"roughness": 0.1, "distribution": "square"}},
    "glass ggx": {"dielectric": {"roughness": ALPHA, "distribution": "ggx"}},
}
GLASS = [name for name in MATERIALS if name.startswith("glass")]
OPAQUE = [name for name in MATERIALS if name not in GLASS]


def literals(struct: type, key: str) -> tuple[str, ...]:
    return get_args(get_type_hints(struct)[key])


def tags(union: Any) -> set[str]:
    return {struct.__struct_config__.tag for struct in get_args(union)}


@dataclass(frozen=True)
class Row:
    """A light: ``met`` is what rays meet of it, ``points`` what its points send if rays meet none.

    Attributes
    ----------
    parts : of the scene file
    met : "sphere", "rectangle" or "sky"; empty where rays meet nothing
    points : "lamp" of radiance 1, or "intensity" 1, or "far" for an irradiance of 1; empty where there are none
    matt : what a matt plate has of it; None where it follows from the others
    """

    parts: dict[str, Any]
    met: str = ""
    points: str = ""
    moving: bool = False
    matt: float | None = None


def of_light(light: dict[str, Any], **known: Any) -> Row:
    return Row({"lights": [light]}, **known)


CENTER = SEEN.axis * DISTANCE
VELOCITY = {"velocity": (SEEN.axis * SPEED).tolist()}


def motions(light: dict[str, Any], **known: Any) -> Iterator[tuple[str, Row]]:
    yield "still", of_light(light, **known)
    yield "moving", of_light(light | {"motion": VELOCITY}, moving=True, **known)


def ambient() -> Iterator[tuple[str, Row]]:
    yield "", of_light({"type": "ambient", "radiance": 1}, matt=1.0)


def point(kind: str = "point", **keys: Any) -> Iterator[tuple[str, Row]]:
    light = {"type": kind, "position": CENTER.tolist(), "intensity": 1} | keys
    for rays in literals(d.PointLight, "shadow_rays"):
        for name, row in motions(light | {"shadow_rays": rays}, points="intensity"):
            yield f"{rays} {name}", row


def spot() -> Iterator[tuple[str, Row]]:
    yield from point("spot", direction=(-SEEN.axis).tolist())


def directional() -> Iterator[tuple[str, Row]]:
    light = {"type": "directional", "direction": (-SEEN.axis).tolist(), "irradiance": 1}
    yield "", of_light(light, points="far")


def rectangle() -> Iterator[tuple[str, Row]]:
    for samples in ("point", "grid 8"):
        for emits in ("intensity", "visible", "unseen", "two-sided"):
            size = SMALL if emits == "intensity" else RADIUS
            u, v = 2 * size * np.cross(SEEN.axis, ACROSS), 2 * size * ACROSS
            light: dict[str, Any] = {"type": "rectangle", "samples": samples}
            light |= {"corner": (CENTER - (u + v) / 2).tolist()}
            light |= {"edge_u": u.tolist(), "edge_v": v.tolist()}
            if emits == "intensity":
                rows = motions(light | {"intensity": 1}, points="intensity")
            elif emits == "visible":
                rows = motions(light | {"radiance": 1}, met="rectangle")
            else:
                light |= {"radiance": 1, "visible": False, "two_sided": emits == "two-sided"}
                rows = motions(light, points="lamp")
            for name, row in rows:
                yield f"{samples} {emits} {name}", row


def sphere() -> Iterator[tuple[str, Row]]:
    for samples in literals(d.SphereLight, "samples"):
        light = {"type": "sphere", "center": CENTER.tolist(), "samples": samples}
        if samples != "visible":
            for name, row in motions(light | {"radius": SMALL, "intensity": 1}, points="intensity"):
                yield f"{samples} intensity {name}", row
        if samples in ("visible", "sphere", "sphere by polar"):
            for name, row in motions(light | {"radius": RADIUS, "radiance": 1}, met="sphere"):
                yield f"{samples} radiance {name}", row


def of_object() -> Iterator[tuple[str, Row]]:
    for moving in (False, True):
        ball = {"shape": "sphere", "radius": RADIUS, "material": "glow", "name": "bulb"}
        ball |= {"transform": [{"translate": CENTER.tolist()}]}
        ball |= {"motion": VELOCITY} if moving else {}
        parts = {"lights": [{"type": "object", "object": "bulb"}], "objects": [ball]}
        yield ("moving" if moving else "still"), Row(parts, met="sphere", moving=moving)


LIGHTS = {
    "ambient": ambient,
    "point": point,
    "spot": spot,
    "directional": directional,
    "rectangle": rectangle,
    "sphere": sphere,
    "object": of_object,
}
PICTURES: dict[str, dict[str, Any]] = {
    "constant": {"radiance": 1},
    "cube": {"faces": ["square.png"] * 6},
    "lat_long": {"image": "wide.png"},
    "angular": {"image": "square.png"},
    "backdrop": {"image": "wide.png"},
}


def environments() -> Iterator[tuple[str, Row]]:
    for kind, keys in PICTURES.items():
        sky = {"type": kind} | keys
        if kind == "backdrop":
            yield kind, Row({"environment": sky}, matt=0.0)
            continue
        for seen_by in literals(d.ConstantEnvironment, "seen_by"):
            met = "sky" if seen_by == "all" else ""
            rest = sky | {"seen_by": seen_by}
            yield f"{kind} {seen_by}", Row({"environment": rest}, met=met, matt=0.0)
            for sampling in literals(d.ConstantEnvironment, "sampling"):
                parts = {"environment": rest | {"lights": True, "sampling": sampling}}
                yield f"{kind} {seen_by} {sampling}", Row(parts, met=met, matt=1.0)


ROWS = {f"{kind} {name}": row for kind, rows in LIGHTS.items() for name, row in rows()}
ROWS |= dict(environments())


def test_the_rows_are_all_that_a_scene_file_can_name() -> None:
    """Who adds a type, a key or a value to lights, lobes or weights adds a row here."""
    assert tags(d.Light) == set(LIGHTS)
    assert tags(d.Environment) == set(PICTURES)
    assert {f"lobe {name}" for name in tags(d.Gloss)} <= set(MATERIALS)
    for struct, word in ((d.Conductor, "metal"), (d.Dielectric, "glass")):
        assert {f"{word} {name}" for name in literals(struct, "distribution")} <= set(MATERIALS)
    keys = {
        "ambient": "radiance",
        "point": "position intensity shadow_rays motion",
        "spot": "position intensity shadow_rays motion direction inner_angle outer_angle",
        "directional": "direction irradiance",
        "rectangle": "corner edge_u edge_v intensity radiance samples two_sided visible motion",
        "sphere": "center radius intensity radiance samples motion",
        "object": "object",
    }
    for struct in get_args(d.Light):
        assert set(struct.__struct_fields__) == set(keys[struct.__struct_config__.tag].split())
    samples = get_type_hints(d.RectangleLight, include_extras=True)["samples"]
    assert get_args(samples)[1].pattern == "^(point|grid [1-9][0-9]?)$"


def narrow(material: str) -> bool:
    """Whether a plate shows all of its lobe, or of what it mirrors, within the light."""
    return material in (
        "mirror",
        "smooth metal",
        "lobe ball",
        "lobe plane",
        "glass",
        "glass square",
    )


def of_facets(met: Any) -> float:
    """What frosted glass shows: over its microfacets, as dense as they are, mirrored and refracted directions."""
    u, phi = GRID[0], 2 * math.pi * GRID[1]
    tangent = ALPHA * np.sqrt(u / (1 - u))
    cosine = 1 / np.sqrt(1 + tangent**2)
    up = np.array([0.0, 1, 0])
    wm = around(up, tangent * cosine * np.cos(phi), tangent * cosine * np.sin(phi), cosine)
    facing = SEEN.view @ wm
    mirrored, bent = fresnel(np.maximum(facing, 0), 1 / 1.5)
    back = 2 * facing * wm - SEEN.view[:, None]
    through = (facing / 1.5 - bent) * wm - SEEN.view[:, None] / 1.5
    one, two, three = (
        (np.sqrt(1 + ALPHA**2 * (1 / np.maximum(cos, 1e-9) ** 2 - 1)) - 1) / 2
        for cos in (np.full_like(u, SEEN.sine), back[1], -through[1])
    )
    total = mirrored / (1 + one + two) * met(back) * (back[1] > 0)
    total += (1 - mirrored) / (1 + one) / (1 + three) * met(through) * (through[1] < 0)
    return float((total * np.maximum(facing, 0) / (SEEN.sine * wm[1])).mean())


def right(row: Row, material: str, distance: float) -> float:
    """What a plate shows of a light at that distance."""
    lobe = {"diffuse": {}, "metal ggx": {"alpha": ALPHA}, "lobe phong": {"exponent": EXPONENT}}
    mirrored = float(fresnel(SEEN.sine, 1 / 1.5)[0])
    if material == "diffuse" and row.matt is not None:
        return row.matt

    def met(way: Array) -> Array:
        return np.ones(way.shape[1]) if row.met == "sky" else meets(row.met, way, distance, RADIUS)

    if row.met == "sky":
        if material == "glass ggx":
            return of_facets(met)
        return float(directions(lobe[material])[1].mean()) if material == "metal ggx" else 1.0
    if row.met:
        if narrow(material):
            return mirrored if material in GLASS else 1.0
        if material == "glass ggx":
            return of_facets(met)
        if material != "diffuse":
            way, count = directions(lobe[material])
            return float((count * met(way)).mean())
        return expected({}, row.met, distance, RADIUS)
    if not row.points or material not in ("diffuse", "metal ggx"):
        return 0.0
    if row.points == "lamp":
        return expected(lobe[material], "rectangle", distance, RADIUS)
    along = float(reflected(lobe[material], SEEN.axis[:, None])[0])
    return along if row.points == "far" else along / distance**2


def shown(folder: Path, row: Row, plates: list[str], way: str, integrator: str) -> dict[str, float]:
    """What the plates show; the camera sees them from below to above."""
    count = len(plates)
    half = PLATE / 2
    parts = row.parts | {
        "camera": {
            "eye": [1, 1, 0],
            "look_at": [0, 0, 0],
            "up": [0, 0, 1],
            "image_plane": {
                "distance": math.sqrt(2),
                "left": -half / 4,
                "right": half / 4,
                "bottom": -half * count,
                "top": half * count,
            },
        },
        "film": {"width": 8, "height": 8 * count},
        "sampler": {"type": "sobol", "samples": 8},
        "materials": {name: {"color": 0} | MATERIALS[name] for name in plates}
        | ({"glow": {"color": 0, "emission": 1}} if "objects" in row.parts else {}),
        "objects": [
            {"shape": "quad", "material": name, "width": 2 * PLATE, "depth": PLATE}
            | {"transform": [{"translate": [0, 0, PLATE * (k - (count - 1) / 2)]}]}
            for k, name in enumerate(plates)
        ]
        + row.parts.get("objects", []),
        "integrator": {"type": integrator, "max_depth": 1, "gloss_sampling": way},
    }
    path = folder / "scene.yaml"
    path.write_text(json.dumps(parts), encoding="utf-8")
    picture = render(load_scene(path), compiled=False).linear[::-1]
    means = picture.reshape(count, 8, 8, 3).mean(axis=(1, 2, 3), dtype=np.float64)
    return dict(zip(plates, means.tolist(), strict=True))


@pytest.mark.parametrize("name", share([*ROWS], 3))
def test_a_light_is_found_once(tmp_path: Path, name: str) -> None:
    """Integrators take turns, and so does glass, with which the distribution ray tracer leaves all to lobes.

    Skies and what moves, of which weights know nothing, try two ways in turn; all others try all.
    """
    row, number = ROWS[name], list(ROWS).index(name)
    for file, size in (("square.png", (8, 8)), ("wide.png", (16, 8))):
        Image.new("RGB", size, (255, 255, 255)).save(tmp_path / file)
    moments = DISTANCE + SPEED * (np.arange(8) + 0.5) / 8 if row.moving else np.array([DISTANCE])
    wanted = {
        material: float(np.mean([right(row, material, each) for each in moments]))
        for material in MATERIALS
    }
    ways = literals(d.IntegratorDescription, "gloss_sampling")
    kinds = literals(d.IntegratorDescription, "type")
    some = 2 if row.moving or "environment" in row.parts else len(ways)
    for turn in range(number, number + some):
        way, integrator = ways[turn % len(ways)], kinds[turn % len(kinds)]
        plates = list(MATERIALS) if turn % 3 == 0 else OPAQUE
        for material, found in shown(tmp_path, row, plates, way, integrator).items():
            # Paths seldom choose what glass mirrors.
            near = pytest.approx(wanted[material], rel=0.4 if material in GLASS else 0.1, abs=4e-3)
            assert found == near, (material, way, integrator)
