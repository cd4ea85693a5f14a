"""The choice among many lights by a compiled walk, if the walk is the course's own."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from course.core.types import Floats32, Indices
from course.extras.light_choice import LightChoice
from course.extras.light_tree import Tree, TreeChoice
from course.extras.own import courses_own
from course.extras.plan import same_fields

KEPT = "compiled choice"


@dataclass(frozen=True, kw_only=True)
class CompiledTreeChoice(TreeChoice):
    """Chooses by a walk down a tree of float32 numbers, which may be a student's."""

    @cached_property
    def _table(self) -> Floats32:
        """What the walk asks of the nodes, (M, 14); see ``light_tree_kernels``."""
        assert self.tree is not None
        lo, hi, axis, angle, power, _ = self.tree
        half = (hi - lo) / 2
        radius = np.sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2])
        cone = *axis, radius, radius / 20, np.cos(angle), np.sin(angle)
        return np.stack((*(lo + half), *half, *cone, power), axis=1)

    def _walk(
        self, p: Floats32, n: Floats32, u: Floats32, _which: Indices | None
    ) -> tuple[Indices, Floats32]:
        from course.compiled.light_tree_kernels import walk

        assert self.tree is not None
        lamp, probability = np.empty(len(u), np.int64), np.empty(len(u), np.float32)
        order = np.ascontiguousarray(self.tree[5], np.int64)
        walk(self._table, order, *map(np.ascontiguousarray, (p, n, u)), lamp, probability)
        return self.inside.take(lamp, mode="clip"), probability


def compiled_choice(choice: LightChoice | None) -> LightChoice | None:
    """The choice with a compiled walk, where the course's function walks down a tree of float32."""
    if not isinstance(choice, TreeChoice) or choice.tree is None:
        return choice
    if not courses_own(choice.many_lights.tree_choice) or not _single(choice.tree):
        return choice
    # Kept beside the choice, as cached properties are: what is worked out of all lights is worked out once for a scene.
    kept = vars(choice)
    if KEPT not in kept:
        kept[KEPT] = CompiledTreeChoice(**same_fields(choice))
    found: CompiledTreeChoice = kept[KEPT]
    return found


def _single(tree: Tree) -> bool:
    return all(part.dtype == np.float32 for part in tree[:5])
