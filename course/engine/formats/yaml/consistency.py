"""Checks that take more than one key: each names the key to change.

Every value is of the right type and within its own range by now.
"""

import math
from typing import Final

import numpy as np

from course.engine.core.types import Floats64
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import MOST_KNOT_SEGMENTS, Vector, rgb
from course.engine.formats.yaml.document import Document, Place
from course.engine.formats.yaml.suggestions import suggest
from course.engine.formats.yaml.surroundings import in_its_surroundings

# Below these sines two directions are held to be one: a picture turned by a rounding error, or a
# light without area.
_PARALLEL_UP: Final = 1e-6
_PARALLEL_EDGES: Final = 1e-9
# Of the distance from the origin; float64 keeps 16 digits, and a view needs some of them.
_SAME_POINT: Final = 1e-12
# Of a highlight's colour: times the brightest light it stays within float32.
_SHARPEST: Final = 1e6


def check_consistency(description: d.SceneDescription, document: Document) -> None:
    """Check the values of a scene against each other.

    Raises SceneError for the first contradiction, by file, line, key path and value.
    """
    scene = Place(document)
    _check_camera(description.camera, scene.at("camera"))
    squares = nearest_squares(description.sampler.samples)
    kind = description.sampler.type
    scene.at("sampler").check(
        len(squares) == 1 or kind not in {"regular", "jittered"},
        "samples",
        f"a square number for the {kind} sampler, such as {' or '.join(map(str, filter(None, squares)))}",
    )
    for name, material in description.materials.items():
        here = scene.at("materials", name)
        sharp = max(rgb(material.specular)) > _SHARPEST
        here.check(not sharp, "specular", f"numbers of at most {_SHARPEST:g}")
        if material.facets is not None:
            here.check(material.highlight == "cosine", "highlight", "cosine beside facets")
            here.check(
                material.exponent <= _SHARPEST, "exponent", f"at most {_SHARPEST:g} of facets"
            )
        lit = material.dielectric is None or not any(rgb(material.unlit))
        here.check(lit, "unlit", "0 of a dielectric")
        if (bump := material.bump) is not None:
            if material.normal_map is not None:
                raise here.error("both normal_map and bump are given: expected one of them")
            if (bump.image is None) == (bump.noise is None):
                raise here.at("bump").error("give exactly one of image and noise")
        if material.texture is not None and material.noise is not None:
            raise here.error("both texture and noise are given: expected one of them")
        if material.dielectric is not None and material.conductor is not None:
            raise here.error("both dielectric and conductor are given: expected one of them")
        _check_microfacets(material, here)
    for index, light in enumerate(description.lights):
        _check_light(light, scene.at("lights", index))
    for index, thing in enumerate(description.objects):
        _check_object(thing, scene.at("objects", index), description)
    _check_object_lights(description, scene)
    _check_surroundings(description, scene)
    for name, material in description.materials.items():
        glass = in_its_surroundings(material, description.materials).dielectric
        scene.at("materials", name, "dielectric").check(
            glass is None or not glass.roughness or 0.1 < glass.refraction_index < 10,
            "refraction_index",
            "a number between 0.1 and 10 for rough glass, against what surrounds it",
        )


def _check_microfacets(material: d.MaterialDescription, here: Place) -> None:
    """A roughness of microfacets is at most 1, and blurs by itself."""
    glass, metal = material.dielectric, material.conductor
    drawn = glass is not None and glass.distribution == "ggx" and glass.roughness > 0
    if drawn and glass is not None:
        small = glass.roughness <= 1
        here.at("dielectric").check(
            small, "roughness", "a number of at most 1 with distribution ggx"
        )
    if (drawn or (metal is not None and metal.roughness > 0)) and material.gloss is not None:
        raise here.error(
            "both gloss and a roughness of microfacets are given: expected one of them"
        )
    if metal is not None and metal.roughness > 0 and metal.fresnel == "approximate":
        raise here.at("conductor").error(
            "a rough conductor has the exact Fresnel equations: leave fresnel out"
        )


def _check_not_zero(vector: Vector, key: str, here: Place) -> None:
    here.check(any(vector), key, "a vector that is not zero")


def nearest_squares(samples: int) -> tuple[int, ...]:
    """Return the one or two square numbers nearest to a number of samples, itself if it is one."""
    root = math.isqrt(samples)
    return (samples,) if root * root == samples else (root * root, (root + 1) ** 2)


def _check_camera(camera: d.CameraDescription, here: Place) -> None:
    eye, look_at = np.array(camera.eye), np.array(camera.look_at)
    view = look_at - eye
    farthest = max(np.abs(eye).max(), np.abs(look_at).max())
    apart = np.abs(view).max() > _SAME_POINT * farthest
    here.check(apart, "look_at", "another point than camera.eye, to look towards")
    _check_not_zero(camera.up, "up", here)
    here.check(
        sine(view, np.array(camera.up)) >= _PARALLEL_UP,
        "up",
        "a direction that is not parallel to the view from eye to look_at",
    )
    if (plane := camera.image_plane) is not None:
        edges = here.at("image_plane")
        for low, high in (("left", "right"), ("bottom", "top")):
            least = getattr(plane, low)
            expected = f"a number > {low}, {least:g} [world unit]"
            edges.check(least < getattr(plane, high), high, expected)


def _check_light(light: d.Light, here: Place) -> None:
    if (direction := getattr(light, "direction", None)) is not None:
        _check_not_zero(direction, "direction", here)
    if isinstance(light, d.SpotLight):
        expected = f"an angle of at least inner_angle, {light.inner_angle:g} [degree]"
        here.check(light.inner_angle <= light.outer_angle, "outer_angle", expected)
    if isinstance(light, d.RectangleLight | d.SphereLight):
        given = [light.intensity is not None, light.radiance is not None]
        if all(given):
            raise here.error("both intensity and radiance are given: expected one of them")
        if not any(given):
            raise here.error(
                "intensity or radiance is missing: expected one of them, in W/sr or W/(m^2 sr)"
            )
    if isinstance(light, d.SphereLight):
        _check_sphere(light, here)
    if isinstance(light, d.RectangleLight):
        _check_not_zero(light.edge_u, "edge_u", here)
        _check_not_zero(light.edge_v, "edge_v", here)
        open_angle = sine(np.array(light.edge_u), np.array(light.edge_v)) >= _PARALLEL_EDGES
        here.check(open_angle, "edge_v", "an edge that is not parallel to edge_u")
        here.check(
            light.radiance is None or not (light.two_sided and light.visible),
            "visible",
            "false for a two-sided light by radiance; for one that is seen, give two lights, one a side",
        )


def _check_sphere(light: d.SphereLight, here: Place) -> None:
    if light.radiance is None:
        here.check(
            light.samples != "visible",
            "samples",
            '"sphere", "ball" or "facing disk" (or "sphere by polar", "ball by polar", "ball by rejection") for a'
            " light by intensity: all of it shines everywhere, and only a light by radiance has a side that can't"
            " be seen",
        )
        return
    here.check(
        light.radius > 0,
        "radius",
        "a number > 0 [world unit] for a light by radiance; a point has no area to emit from",
    )
    here.check(
        light.samples in ("sphere", "sphere by polar", "visible"),
        "samples",
        '"sphere", "sphere by polar" or "visible" for a light by radiance, which shines from its surface; by'
        " intensity it may be a ball or a facing disk",
    )


def _check_object(thing: d.Object, here: Place, description: d.SceneDescription) -> None:
    if thing.material not in description.materials:
        hint = suggest(thing.material, description.materials)
        here.check(False, "material", f"the name of one of the materials; {hint}")
    named = thing.materials if isinstance(thing, d.MeshFile) else {}
    for name, material in named.items():
        if material not in description.materials:
            hint = suggest(material, description.materials)
            expected = f"the name of one of the materials; {hint}"
            here.at("materials").check(False, name, expected)
    if thing.from_behind == "kept":
        used = (description.materials[name] for name in (thing.material, *named.values()))
        opaque = all(material.dielectric is None for material in used)
        expected = "turned for glass, whose inside is another than its outside"
        here.check(opaque, "from_behind", expected)
        Place(here.document, ("integrator",)).check(
            description.integrator.shading_normals == "interpolated",
            "shading_normals",
            f"interpolated, as objects[{here.path[-1]}].from_behind is kept",
        )
    match thing:
        case d.Torus():
            _check_less(("tube", thing.tube), ("radius", thing.radius), here)
        case d.DisplacedSphere():
            _check_less(("amplitude", thing.amplitude), ("radius", thing.radius), here)
        case d.TorusKnot():
            _check_knot(thing, here)
    for index, step in enumerate(thing.transform):
        _check_step(step, here.at("transform", index))


def _check_object_lights(description: d.SceneDescription, scene: Place) -> None:
    """Every light of type object names one object of its own, which emits."""
    names = [thing.name for thing in description.objects if thing.name]
    lit: dict[str, int] = {}
    for index, light in enumerate(description.lights):
        if not isinstance(light, d.ObjectLight):
            continue
        here = scene.at("lights", index)
        if light.object not in names:
            hint = suggest(light.object, dict.fromkeys(names))
            here.check(False, "object", f"the name of one of the objects; {hint}")
        earlier = lit.setdefault(light.object, index)
        expected = f"another object than that of lights[{earlier}]: one light is enough"
        here.check(earlier == index, "object", expected)
        first, *others = (n for n, o in enumerate(description.objects) if o.name == light.object)
        scene.at("objects", *others[:1]).check(
            not others,
            "name",
            f"another name than that of objects[{first}], for lights[{index}] means one of them",
        )
        thing = description.objects[first]
        material = thing.material
        if isinstance(thing, d.MeshFile) and thing.materials:
            raise scene.at("objects", first, "materials").error(
                f"lights[{index}] is this object, and a light has one material: make its faces an object of their own,"
                " by only"
            )
        here.check(
            rgb(description.materials[material].emission).any(),
            "object",
            f'an object that shines; give its material an emission, such as "{material}: {{emission: 5}}"',
        )


def _check_surroundings(description: d.SceneDescription, scene: Place) -> None:
    """What surrounds a dielectric is another one."""
    glasses = {name: m.dielectric for name, m in description.materials.items() if m.dielectric}
    for name, glass in glasses.items():
        here = scene.at("materials", name, "dielectric")
        met, outer = [name], glass.surrounded_by
        while outer is not None:
            if outer not in glasses:
                hint = suggest(outer, [each for each in glasses if each != name])
                here.check(False, "surrounded_by", f"the name of a dielectric; {hint}")
            expected = f"another medium: {name} would lie in itself"
            here.check(outer not in met, "surrounded_by", expected)
            met.append(outer)
            outer = glasses[outer].surrounded_by


def _check_less(small: tuple[str, float], large: tuple[str, float], here: Place) -> None:
    """Check that one key of an object is less than another; each may be a default."""
    (name, value), (bound_name, bound) = small, large
    if name in here.document.value(here.path):
        here.check(value < bound, name, f"a number < {bound_name}, {bound:g} [world unit]")
    expected = f"a number > {name}, {value:g} where it is not given [world unit]"
    here.check(value < bound, bound_name, expected)


def _check_knot(knot: d.TorusKnot, here: Place) -> None:
    if (divisor := math.gcd(knot.p, knot.q)) > 1:
        raise here.error(
            f"p is {knot.p} and q is {knot.q}: expected numbers without a common divisor; "
            f"these wind {divisor} times over the same curve"
        )
    fewest = 8 * (knot.p + knot.q)
    expected = f"a whole number from {fewest}, which is 8 (p + q), to {MOST_KNOT_SEGMENTS}"
    here.check(knot.segments >= fewest, "segments", expected)


def _check_step(step: d.Transform, here: Place) -> None:
    match step:
        case d.Rotate():
            _check_not_zero(step.rotate.axis, "axis", here.at("rotate"))
        case d.Scale():
            here.check(np.all(step.scale), "scale", "factors that are not 0")
        case d.Affine():
            last = step.matrix[3] == (0.0, 0.0, 0.0, 1.0)
            here.at("matrix").check(last, 3, "[0, 0, 0, 1], the last row of any affine map")
            expected = "rows that are independent; this matrix flattens what it maps"
            here.check(not flattens(np.array(step.matrix)), "matrix", expected)


def flattens(matrix: Floats64) -> bool:
    """True if an affine map (4, 4) has no inverse."""
    linear = matrix[:3, :3]
    largest = np.abs(linear).max()
    # By the largest component first, so that no product underflows or overflows.
    return bool(largest == 0 or np.linalg.matrix_rank(linear / largest) < 3)


def sine(a: Floats64, b: Floats64) -> float:
    """Sine of the angle between two vectors, neither of them zero."""
    # Divided by the largest component first, so that no square underflows or overflows.
    a, b = a / np.abs(a).max(), b / np.abs(b).max()
    return float(np.linalg.norm(np.cross(a, b)) / (np.linalg.norm(a) * np.linalg.norm(b)))
