"""The tree of a glTF file's nodes: where each is, and which of them the scene shows."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from course.engine.core.types import Floats, Floats64, Indices, Mask
from course.engine.formats.meshes.gltf_json import Node, Root

DEEPEST: Final = 4096
"""Levels of a tree."""


@dataclass(frozen=True)
class Tree:
    """Where nodes are.

    Attributes
    ----------
    matrices : (N, 4, 4) float64, from each node's frame to the file's
    shown : (N,) which are in the scene
    """

    matrices: Floats64
    shown: Mask


def tree_of(root: Root) -> tuple[Tree, list[str]]:
    """Return the nodes of a file in their places, and what is to be told of its scenes.

    Raises ValueError for nodes that have two parents, lie in themselves, or more than DEEPEST levels deep.
    """
    nodes = root.nodes
    parent, children = _parents(nodes)
    notes = []
    begin: Sequence[int]
    if root.scenes:
        number = root.scene or 0
        if number >= len(root.scenes):
            raise ValueError(f"its scene is {number}, and it has {len(root.scenes)}")
        begin = root.scenes[number].nodes
        if len(root.scenes) > 1:
            notes.append(f"of its {len(root.scenes)} scenes number {number} is shown")
    else:
        begin = np.flatnonzero(parent < 0).tolist()
        if nodes:
            notes.append("it has no scene: all its nodes are shown")
    if begin and max(begin) >= len(nodes):
        raise ValueError(f"its scene refers to node {max(begin)}, and it has {len(nodes)}")
    shown, hidden = np.zeros(len(nodes), bool), _hidden(nodes)
    shown[list(begin)] = True
    matrices = _own(nodes)
    level, depth, reached = np.flatnonzero(parent < 0), 0, 0
    while level.size:
        if depth:
            above = parent[level]
            matrices[level] = matrices[above] @ matrices[level]
            shown[level] |= shown[above]
            hidden[level] |= hidden[above]
        depth, reached = depth + 1, reached + len(level)
        if depth > DEEPEST:
            raise ValueError(f"its nodes lie more than {DEEPEST} levels deep in each other")
        level = np.concatenate(
            [np.array(children[k], np.intp) for k in level.tolist() if children[k]] or [level[:0]]
        )
    if reached < len(nodes):
        raise ValueError("some of its nodes lie in themselves")
    return Tree(matrices, shown & ~hidden), notes


def _parents(nodes: list[Node]) -> tuple[Indices, list[list[int]]]:
    """The parent of each node, -1 for none, and its children."""
    parent = [-1] * len(nodes)
    for number, node in enumerate(nodes):
        for child in node.children:
            if child >= len(nodes):
                raise ValueError(f"node {number} has a child {child}, and there are {len(nodes)}")
            if parent[child] >= 0:
                raise ValueError(f"node {child} lies both in node {parent[child]} and in {number}")
            parent[child] = number
    return np.array(parent, np.intp), [node.children for node in nodes]


def _hidden(nodes: list[Node]) -> Mask:
    hidden = np.zeros(len(nodes), bool)
    for number, node in enumerate(nodes):
        if node.extensions:
            visible = node.extensions.get("KHR_node_visibility")
            hidden[number] = isinstance(visible, dict) and visible.get("visible") is False
    return hidden


def _own(nodes: list[Node]) -> Floats64:
    """Matrices (N, 4, 4) of nodes in their parents."""
    matrices = np.tile(np.eye(4), (len(nodes), 1, 1))
    moved = [k for k, n in enumerate(nodes) if n.translation or n.rotation or n.scale]
    if moved:
        some = [nodes[k] for k in moved]
        matrices[moved] = placed(
            np.array([n.translation or (0, 0, 0) for n in some], np.float64),
            np.array([n.rotation or (0, 0, 0, 1) for n in some], np.float64),
            np.array([n.scale or (1, 1, 1) for n in some], np.float64),
        )
    given = [k for k, n in enumerate(nodes) if n.matrix is not None]
    if given:
        columns = np.array([nodes[k].matrix for k in given], np.float64).reshape(-1, 4, 4)
        matrices[given] = np.swapaxes(columns, 1, 2)
    return matrices


def placed(translation: Floats, rotation: Floats, scale: Floats) -> Floats64:
    """Matrices (N, 4, 4) that scale (N, 3), turn by quaternions (N, 4), x y z w, and move (N, 3), in this order."""
    length = np.linalg.norm(rotation, axis=1, keepdims=True)
    if not length.all():
        raise ValueError("a rotation is 0 0 0 0: expected a quaternion")
    x, y, z, w = (rotation / length).T
    matrices = np.zeros((len(rotation), 4, 4))
    matrices[:, 0, :3] = np.stack(
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)], 1
    )
    matrices[:, 1, :3] = np.stack(
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)], 1
    )
    matrices[:, 2, :3] = np.stack(
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], 1
    )
    matrices[:, :3, :3] *= scale[:, None, :]
    matrices[:, :3, 3] = translation
    matrices[:, 3, 3] = 1
    return matrices
