"""A METU scene in which every rule of these scenes shows, from XML to picture, held against a tracer of its own.

The tracer below is written from the rules, in float64, and shares no code with the engine. Each rule can be left out of
it: then another picture comes out, which shows that the scene would find out if the engine left it out.
"""

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from course import render
from tests.engine.formats.metu.conftest import Metu, Tree, tree

Array = NDArray[np.float64]

EPSILON = 0.004
RULES = (
    *("offset", "light at the surface", "whole shadow rays", "no near plane"),
    *("backs unseen", "normals kept", "approximate metals"),
)
EYE, NEAR = np.array([0.01, 0.02, 0.4]), 0.35
LIGHTS = (
    (np.array([0.03, 0.16, 0.09]), 2.0),
    # In the left wall, but not where its two triangles meet, between which a ray may slip.
    (np.array([-0.1, 0.05, 0.03]), 1.5),
)
AMBIENT = 20.0
N, K = 0.6, 0.7


@dataclass(frozen=True)
class Thing:
    """A mesh: corners (T, 3, 3), normals at the corners or None where it is flat, and its material."""

    corners: Array
    normals: Array | None
    diffuse: float
    mirror: float = 0.0
    metal: bool = False
    exponent: float = 0.0


def quad(*corners: tuple[float, float, float]) -> Array:
    a, b, c, d = np.array(corners)
    return np.array([[a, b, c], [a, c, d]])


def tent() -> tuple[Array, Array]:
    """Two squares about a ridge that runs along x, seen by the camera from below and behind; smooth."""
    left, ridge, right = (
        np.array([[x, y, z] for x in (-0.06, 0.06)])
        for y, z in ((0.075, -0.04), (0.095, 0), (0.075, 0.04))
    )
    corners = np.concatenate(
        (quad(left[0], left[1], ridge[1], ridge[0]), quad(ridge[0], ridge[1], right[1], right[0]))
    )
    weighted = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(corners)
    for place in np.unique(corners.reshape(-1, 3), axis=0):
        here = (corners == place).all(axis=2)
        total = sum(weighted[t] for t, _ in zip(*np.nonzero(here), strict=True))
        normals[here] = total / np.linalg.norm(total)
    return corners, normals


def things() -> list[Thing]:
    floor = quad((-0.1, 0, 0.1), (0.1, 0, 0.1), (0.1, 0, -0.1), (-0.1, 0, -0.1))
    back = quad((-0.1, 0, -0.1), (0.1, 0, -0.1), (0.1, 0.2, -0.1), (-0.1, 0.2, -0.1))
    left = quad((-0.1, 0, 0.1), (-0.1, 0, -0.1), (-0.1, 0.2, -0.1), (-0.1, 0.2, 0.1))
    # Looks into the room, away from the camera; from there it is seen in the mirror.
    front = quad((0.1, 0, 0.1), (-0.1, 0, 0.1), (-0.1, 0.2, 0.1), (0.1, 0.2, 0.1))
    # Nearer than the image plane, and in front of everything.
    speck = quad((0, 0, 0.2), (0.02, 0, 0.2), (0.02, 0.02, 0.2), (0, 0.02, 0.2))
    # Lower than shadow rays start, and higher.
    low = quad((0.02, 0.003, 0.06), (0.07, 0.003, 0.06), (0.07, 0.003, 0.02), (0.02, 0.003, 0.02))
    high = quad((-0.06, 0.01, 0.07), (0, 0.01, 0.07), (0, 0.01, 0.03), (-0.06, 0.01, 0.03))
    metal = quad((0.04, 0, -0.06), (0.09, 0, -0.02), (0.09, 0.09, -0.03), (0.04, 0.09, -0.07))
    return [
        Thing(floor, None, 0.5),
        Thing(back, None, 0.1, mirror=0.8),
        Thing(left, None, 0.7, exponent=9),
        Thing(front, None, 0.9),
        Thing(speck, None, 1.0),
        Thing(low, None, 0.8),
        Thing(high, None, 0.3),
        Thing(metal, None, 0.0, mirror=1.0, metal=True),
        Thing(*tent(), 0.6),
    ]


@dataclass(frozen=True)
class Tracer:
    """Follows the rules, but for some."""

    things: list[Thing]
    without: str = ""

    def __post_init__(self) -> None:
        assert self.without in ("", *RULES)

    def nearest(
        self, origin: Array, way: Array, least: Array, camera: bool
    ) -> tuple[Array, NDArray[np.intp], Array]:
        """Of rays (n, 3) how far they go, which triangle they meet, and its barycentrics (n, 3)."""
        first = np.full(len(way), np.inf)
        number, weights = np.full(len(way), -1), np.zeros((len(way), 3))
        count = 0
        for thing in self.things:
            for corners in thing.corners:
                a, b, c = corners
                # By Cramer's rule.
                across = np.cross(way, c - a)
                determinant = across @ (b - a)
                with np.errstate(all="ignore"):
                    u = ((origin - a) * across).sum(1) / determinant
                    other = np.cross(origin - a, b - a)
                    v = (way * other).sum(1) / determinant
                    t = other @ (c - a) / determinant
                    met = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > least) & (t < first)
                if camera and thing.normals is None and self.without != "backs unseen":
                    met &= way @ np.cross(b - a, c - a) < 0
                first[met], number[met] = t[met], count
                weights[met] = np.stack((1 - u[met] - v[met], u[met], v[met]), axis=1)
                count += 1
        return first, number, weights

    def radiance(self, way: Array, depth: int) -> Array:
        """What camera rays (n, 3) bring."""
        origin = np.broadcast_to(EYE, way.shape)
        least = np.full(len(way), 1e-12)
        if self.without == "no near plane":
            least = NEAR / -way[:, 2]
        owners = [thing for thing in self.things for _ in thing.corners]
        corners = np.concatenate([thing.corners for thing in self.things])
        result, weight, paths = np.zeros(len(way)), np.ones(len(way)), np.arange(len(way))
        for bounce in range(depth + 1):
            t, number, bary = self.nearest(origin, way, least, bounce == 0)
            some = np.isfinite(t)
            t, number, bary, way, weight, paths, origin = (
                each[some] for each in (t, number, bary, way, weight, paths, origin)
            )
            point = origin + t[:, None] * way
            flat = np.cross(
                corners[number, 1] - corners[number, 0], corners[number, 2] - corners[number, 0]
            )
            flat /= np.linalg.norm(flat, axis=1)[:, None]
            smooth = np.array([owners[k].normals is not None for k in number], bool)
            normal = flat.copy()
            at = [
                thing.corners * 0 if thing.normals is None else thing.normals
                for thing in self.things
            ]
            normal[smooth] = (np.concatenate(at)[number] * bary[:, :, None]).sum(1)[smooth]
            normal /= np.linalg.norm(normal, axis=1)[:, None]
            turned = (flat * way).sum(1) > 0
            if bounce == 0 and self.without != "normals kept":
                turned &= ~smooth
            flat[turned] *= -1
            normal[turned] *= -1
            start = point + (1e-9 if self.without == "offset" else EPSILON) * flat
            of = {
                name: np.array([getattr(owners[k], name) for k in number], float)
                for name in ("diffuse", "mirror", "metal", "exponent")
            }
            np.add.at(result, paths, weight * self.shaded(point, start, normal, way, of))
            share = of["mirror"] * np.where(of["metal"] > 0, self.metal(-(way * normal).sum(1)), 1)
            weight, goes = weight * share, share > 0
            way = way - 2 * (way * normal).sum(1)[:, None] * normal
            way, weight, paths, origin = (each[goes] for each in (way, weight, paths, start))
            least = np.full(len(way), 1e-12)
        return result

    def metal(self, c: Array) -> Array:
        """Reflectance of the metal."""
        if self.without == "approximate metals":
            index = N + 1j * K
            inside = np.sqrt(1 - (1 - c**2) / index**2)
            s = (c - index * inside) / (c + index * inside)
            p = (index * c - inside) / (index * c + inside)
            return np.asarray((abs(s) ** 2 + abs(p) ** 2) / 2)
        squares = N**2 + K**2
        s = (squares - 2 * N * c + c**2) / (squares + 2 * N * c + c**2)
        p = (squares * c**2 - 2 * N * c + 1) / (squares * c**2 + 2 * N * c + 1)
        return np.asarray((s + p) / 2)

    def shaded(
        self, point: Array, start: Array, normal: Array, way: Array, of: dict[str, Array]
    ) -> Array:
        """Ambient, diffuse and specular light (n,)."""
        total = of["diffuse"] * AMBIENT
        for place, intensity in LIGHTS:
            reach = place - start
            blocked = 1 - 1e-9 if self.without == "whole shadow rays" else 1 + 1e-6
            free = self.nearest(start, reach, np.full(len(start), 1e-12), False)[0] > blocked
            to_light = place - (start if self.without == "light at the surface" else point)
            length = np.linalg.norm(to_light, axis=1)
            unit = to_light / length[:, None]
            cosine = (normal * unit).sum(1)
            half = unit - way
            half /= np.linalg.norm(half, axis=1)[:, None]
            shine = np.maximum((normal * half).sum(1), 0) ** of["exponent"] * (of["exponent"] > 0)
            lit = (of["diffuse"] * cosine + 0.4 * shine) * (cosine > 0) * free
            total = total + intensity * lit / length**2
        return total


def scene() -> Tree:
    """The same as a METU scene."""
    materials, meshes, vertices = [], [], []
    for number, thing in enumerate(things(), start=1):
        material: Tree = {"_id": str(number)}
        grey = f"{thing.diffuse} {thing.diffuse} {thing.diffuse}"
        material |= {"AmbientReflectance": grey, "DiffuseReflectance": grey}
        if thing.exponent:
            material |= {"SpecularReflectance": "0.4 0.4 0.4", "PhongExponent": str(thing.exponent)}
        if thing.mirror:
            material |= {"_type": "mirror", "MirrorReflectance": f"{thing.mirror} " * 3}
        if thing.metal:
            material |= {"_type": "conductor", "RefractionIndex": str(N), "AbsorptionIndex": str(K)}
        materials.append(material)
        places, faces = np.unique(thing.corners.reshape(-1, 3), axis=0, return_inverse=True)
        faces = faces.ravel() + len(vertices) + 1
        vertices += places.tolist()
        mesh = {"_id": str(number), "Material": str(number), "Faces": " ".join(map(str, faces))}
        meshes.append(mesh | ({} if thing.normals is None else {"_shadingMode": "smooth"}))
    camera = {
        "Position": " ".join(map(str, EYE)),
        "NearPlane": "-0.15 0.15 -0.05 0.2",
        "NearDistance": str(NEAR),
        "ImageResolution": "96 80",
    }
    points = [
        {"_id": str(number), "Position": " ".join(map(str, place)), "Intensity": f"{power} " * 3}
        for number, (place, power) in enumerate(LIGHTS, start=1)
    ]
    return tree(
        camera=camera,
        materials=materials,
        vertices=" ".join(str(x) for place in vertices for x in place),
        objects={"Mesh": meshes},
        lights={"AmbientLight": f"{AMBIENT} " * 3, "PointLight": points},
        ShadowRayEpsilon=str(EPSILON),
        MaxRecursionDepth="3",
    )


def expected(without: str = "") -> Array:
    """(80, 96) radiance through the middles of the pixels."""
    x = -0.15 + 0.3 * (np.arange(96) + 0.5) / 96
    y = 0.2 - 0.25 * (np.arange(80) + 0.5) / 80
    way = np.stack(np.broadcast_arrays(x[None, :], y[:, None], -NEAR), axis=-1).reshape(-1, 3)
    way = way / np.linalg.norm(way, axis=1)[:, None]
    return Tracer(things(), without).radiance(way, 3).reshape(80, 96)


def test_the_picture_is_that_of_the_rules(xml: Metu, compiled: bool) -> None:
    got = render(xml.load(scene()), compiled=compiled).linear[..., 0]
    assert xml.warnings == []
    right = np.isclose(got, expected(), rtol=2e-4, atol=2e-3)
    # Pixels whose rays, or shadow rays, pass within rounding of an edge.
    assert (~right).sum() <= 0.002 * right.size


@pytest.mark.parametrize("rule", RULES)
def test_every_rule_shows_in_it(rule: str) -> None:
    other = ~np.isclose(expected(rule), expected(), rtol=2e-4, atol=2e-3)
    assert other.sum() > 0.01 * other.size
