"""One lamp for each hit by a light tree, whose functions are those of the module `many_lights`.

Lamps that have a place are in the tree. Suns have none, and lamps that move have several: all of these stand beside the
tree, and the tree's total power beside theirs, when ``power_choice`` chooses among them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from course.engine.core.hits import Hits
from course.engine.core.lights.point import PointLight
from course.engine.core.lights.rectangle import RectangleLight
from course.engine.core.lights.sample import Light
from course.engine.core.lights.sphere import SphereLight
from course.engine.core.types import Floats32, Functions, Indices
from course.engine.terms.lights.light_choice import LightChoice, power_of
from course.engine.terms.lights.mesh_light import MeshLight
from course.engine.terms.lights.visible_sphere import VisibleSphereLight

Tree = tuple[Floats32, Floats32, Floats32, Floats32, Floats32, Indices]
"""As ``many_lights.light_tree`` returns it."""

Walk = Callable[[Floats32, Floats32, Floats32, Indices | None], tuple[Indices, Floats32]]
"""Takes points (3, n), normals (3, n), u (n,) and which hits these are (None: all): lamps (n,) of the tree, and their
probability (n,) float32."""

Bounds = tuple[Floats32, Floats32, Floats32, float]
"""Corners of a lamp's box (3,), and axis (3,) and angle of the cone of its normals."""

TOGETHER = 8192
"""Hits that walk down together: the arrays of one step then stay in the processor's nearer cache."""

ALL_SIDES = np.array([0, 1, 0], np.float32), float(np.pi)


@dataclass(frozen=True, kw_only=True)
class TreeChoice(LightChoice):
    """Chooses by a walk down a tree.

    Attributes
    ----------
    many_lights : functions of the module
    tree : over the lamps (T,) of ``inside``; None if there are none
    inside, outside : numbers of the lights in the tree, (T,), and of the others, (S,)
    powers : (S,) of the others, or (S + 1,) with that of the tree at the end, float32, the largest is 1
    walk : walks down the tree: the course's function, or a compiled form of it; None where there is none
    """

    many_lights: Functions
    tree: Tree | None
    inside: Indices
    outside: Indices
    powers: Floats32
    walk: Walk | None = None

    def choose(self, hits: Hits, u: Floats32) -> tuple[Indices, Floats32]:
        """See ``LightChoice``."""
        if self.tree is None:
            number, probability = self._by_power(u)
        elif not len(self.outside):
            number, probability = self._walked(hits.near_origin, hits.ns, u, None)
        else:
            number, probability = self._by_power(u)
            walks = np.flatnonzero(number < 0)
            # The last part of [0, 1) is the tree's: what is left of the number decides about the walk.
            share = self.powers[-1] / self.powers.sum()
            left = np.clip((u.take(walks) - (1 - share)) / share, 0, 1 - np.float32(2.0**-24))
            found = self._walked(
                hits.near_origin.take(walks, axis=1), hits.ns.take(walks, axis=1), left, walks
            )
            number[walks] = found[0]
            probability[walks] *= found[1]
        # Of a function that is wrong no picture is to hold a NaN.
        weight = np.divide(np.float32(1), probability, where=probability > 0, out=0 * probability)
        return number, weight

    def _by_power(self, u: Floats32) -> tuple[Indices, Floats32]:
        """Numbers (n,) of lights beside the tree, or -1 for it, and their probability."""
        number, probability = self.many_lights.power_choice(self.powers, u)
        lights = self.outside if self.tree is None else np.append(self.outside, -1)
        return lights.take(number, mode="clip"), np.array(probability, np.float32)

    def _walked(
        self, p: Floats32, n: Floats32, u: Floats32, which: Indices | None
    ) -> tuple[Indices, Floats32]:
        """Numbers (n,) of lights in the tree, and their probability, for the hits ``which``, None for all."""
        assert self.walk is not None
        lamp, probability = self.walk(p, n, u, which)
        return self.inside.take(lamp, mode="clip"), probability


def walk_of(tree: Tree, many_lights: Functions) -> Walk:
    """The walk by ``tree_choice``, which may be a student's."""

    def walk(
        p: Floats32, n: Floats32, u: Floats32, _which: Indices | None
    ) -> tuple[Indices, Floats32]:
        lamp, probability = np.empty(len(u), np.intp), np.empty(len(u), np.float32)
        for first in range(0, len(u), TOGETHER):
            some = slice(first, first + TOGETHER)
            where = (np.ascontiguousarray(vectors[:, some]) for vectors in (p, n))
            lamp[some], probability[some] = many_lights.tree_choice(tree, *where, u[some])
        return lamp, probability

    return walk


def functions_for(lights: Sequence[Light]) -> tuple[str, ...]:
    """Functions of the module that a choice among lights calls."""
    placed = {bounds_of(light) is not None for light in lights}
    return (("power_choice",) if False in placed else ()) + (
        ("light_tree", "tree_choice") if True in placed else ()
    )


def tree_choice(lights: tuple[Light, ...], many_lights: Functions) -> TreeChoice:
    """A choice among lights, with a tree over those that have a place."""
    bounds = [bounds_of(light) for light in lights]
    inside = np.array([k for k, bound in enumerate(bounds) if bound], np.intp)
    outside = np.array([k for k, bound in enumerate(bounds) if not bound], np.intp)
    power = np.array([power_of(light) for light in lights])
    # Where all colours are lost to float32, all lights are alike.
    power = power / power.max() if power.max() > 0 else np.ones(len(power))
    tree = None
    powers = power[outside]
    if len(inside):
        lo, hi, axis = (
            np.array([bound[part] for bound in bounds if bound], np.float32).T for part in range(3)
        )
        angle = np.array([bound[3] for bound in bounds if bound], np.float32)
        lamps = (np.ascontiguousarray(part) for part in (lo, hi, axis))
        tree = many_lights.light_tree(
            *lamps, np.minimum(angle, np.float32(np.pi)), power[inside].astype(np.float32)
        )
        powers = np.append(powers, power[inside].sum())
    return TreeChoice(
        lights=lights,
        many_lights=many_lights,
        tree=tree,
        inside=inside,
        outside=outside,
        powers=(powers / powers.max()).astype(np.float32),
        walk=None if tree is None else walk_of(tree, many_lights),
    )


def bounds_of(light: Light) -> Bounds | None:
    """Where a light lies and shines to; None of a sun, and of a light that moves."""
    if light.velocity is not None:
        return None
    cone: tuple[Floats32, float] = ALL_SIDES
    match light:
        case PointLight():
            corners = light.position[None]
        case RectangleLight():
            u, v = light.edge_u, light.edge_v
            corners = light.corner + np.stack((0 * u, u, v, u + v))
        case SphereLight() | VisibleSphereLight():
            corners = light.center + np.float32(light.radius) * np.array([[-1], [1]], np.float32)
        case MeshLight():
            first, edges = light.planes[:, :3], light.edges
            corners = np.concatenate((first, first + edges[:, :3], first + edges[:, 3:6]))
        case _:
            return None
    if isinstance(light, PointLight | RectangleLight) and light.normal is not None:
        cone = ALL_SIDES if light.two_sided else (light.normal.astype(np.float32), 0.0)
    return corners.min(axis=0), corners.max(axis=0), *cone
