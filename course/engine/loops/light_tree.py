"""The walk down a tree of lights, compiled, if the walk is the course's own."""

from dataclasses import replace

import numpy as np

from course.engine.core.types import Floats32, Indices
from course.engine.functions.own import courses_own
from course.engine.terms.lights.light_choice import LightChoice
from course.engine.terms.lights.light_tree import Tree, TreeChoice, Walk

KEPT = "compiled choice"


def compiled_walk(tree: Tree) -> Walk:
    """The walk down a tree of float32 numbers, which may be a student's."""
    lo, hi, axis, angle, power, order = tree
    half = (hi - lo) / 2
    radius = np.sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2])
    cone = *axis, radius, radius / 20, np.cos(angle), np.sin(angle)
    # What the walk asks of the nodes, (M, 14); see ``light_tree_kernels``.
    table = np.stack((*(lo + half), *half, *cone, power), axis=1)
    order = np.ascontiguousarray(order, np.int64)

    def walk_down(
        p: Floats32, n: Floats32, u: Floats32, _which: Indices | None
    ) -> tuple[Indices, Floats32]:
        # Compiled when it is imported: no other scene waits for it.
        from course.engine.loops.light_tree_kernels import walk

        lamp, probability = np.empty(len(u), np.int64), np.empty(len(u), np.float32)
        walk(table, order, *map(np.ascontiguousarray, (p, n, u)), lamp, probability)
        return lamp, probability

    return walk_down


def compiled_choice(choice: LightChoice | None) -> LightChoice | None:
    """The choice with a compiled walk, where the course's function walks down a tree of float32."""
    if not isinstance(choice, TreeChoice) or choice.tree is None:
        return choice
    if not courses_own(choice.many_lights.tree_choice) or not _single(choice.tree):
        return choice
    # Kept beside the choice, as cached properties are: what is worked out of all lights is worked out once for a scene.
    kept = vars(choice)
    if KEPT not in kept:
        kept[KEPT] = replace(choice, walk=compiled_walk(choice.tree))
    found: TreeChoice = kept[KEPT]
    return found


def _single(tree: Tree) -> bool:
    return all(part.dtype == np.float32 for part in tree[:5])
