"""A ray's walk through a hierarchy, step by step: the boxes that it is tested with, its stack, and its nearest hit.

The walk is the one of the page's algorithm; a test holds that it is also the one of the course's `traverse`.
"""

from dataclasses import dataclass

import numpy as np

from sitebuild.diagrams import bounding_volumes as scene
from sitebuild.diagrams.canvas import Canvas, unit
from sitebuild.diagrams.figure import Panel
from solutions import bounding_volumes

ORIGIN, TARGET = np.array([-0.95, 0.5]), np.array([2.4, 0.7])

NAMES = "ABCDEFGH"


@dataclass(frozen=True)
class Step:
    """What a step has done.

    Attributes
    ----------
    node : that was taken, -1 before the first
    now : nodes whose boxes were tested in this step
    asked, met : all nodes that were tested so far, and those of them that the ray meets
    stack : nodes that wait, the top one last
    triangles : that were tested so far
    nearest, t : the nearest hit so far, -1 and infinity for none
    words : the step in a sentence
    """

    node: int
    now: tuple[int, ...]
    asked: frozenset[int]
    met: frozenset[int]
    stack: tuple[int, ...]
    triangles: tuple[int, ...]
    nearest: int
    t: float
    words: str


def walk(tree: scene.Hierarchy) -> list[Step]:
    """All steps of the ray from ORIGIN to TARGET."""
    first, count, order = tree[2:]
    enters, meets = _boxes(tree)
    times = hits()
    asked, met, triangles = {0}, {0}, list[int]()
    stack, nearest, t = [0], -1, np.inf
    steps: list[Step] = []

    def told(node: int, now: tuple[int, ...], words: str) -> None:
        state = frozenset(asked), frozenset(met), tuple(stack), tuple(triangles)
        steps.append(Step(node, now, *state, nearest, t, words))

    told(-1, (0,), "The ray meets the root's box. The root goes onto the stack.")
    while stack:
        node = stack.pop()
        if enters[node] > t:
            told(node, (), f"Node {node} begins beyond the hit on {NAMES[nearest]}: it is skipped.")
        elif count[node]:
            inside = order[first[node] : first[node] + count[node]]
            triangles += [int(k) for k in inside]
            best = min(inside, key=lambda k: times[k])
            if times[best] < t:
                nearest, t = int(best), float(times[best])
                found = f"It hits {NAMES[nearest]}, which is the nearest so far."
            else:
                found = "It hits neither of them."
            told(
                node,
                (),
                f"Node {node} is a leaf: the ray is tested with {_listed(inside)}. {found}",
            )
        else:
            children = (int(first[node]), int(first[node]) + 1)
            asked |= set(children)
            # The nearer child is taken first, so the farther one goes onto the stack before it.
            entered = [k for k in children if meets[k] and enters[k] <= t]
            entered.sort(key=lambda k: -enters[k])
            met |= set(entered)
            stack += entered
            tested = f"Node {node} is taken, and the boxes of {children[0]} and {children[1]} are tested."
            said = {
                0: "The ray misses both.",
                1: f"The ray misses one; {entered[-1]} goes onto the stack." if entered else "",
                2: f"The ray meets both; {entered[-1]} is nearer and comes on top."
                if entered
                else "",
            }[len(entered)]
            told(node, children, f"{tested} {said}")
    return steps


def _listed(triangles: np.ndarray) -> str:
    return " and ".join(NAMES[k] for k in triangles)


def _boxes(tree: scene.Hierarchy) -> tuple[np.ndarray, np.ndarray]:
    """Where the ray enters each node, and whether it does."""
    lo, hi = tree[0], tree[1]
    origin, way = (
        np.repeat(np.append(v, 0)[:, None], lo.shape[1], axis=1)
        for v in (ORIGIN, unit(TARGET - ORIGIN))
    )
    near, far = bounding_volumes.slab_test(origin, way, lo, hi)
    return near, (near <= far) & (far > 0)


def hits() -> np.ndarray:
    """Where the ray enters each triangle of the plane, infinite where it passes."""
    way = unit(TARGET - ORIGIN)
    normal = np.array([-way[1], way[0]])
    times = np.full(scene.COUNT, np.inf)
    for k, (start, end) in crossings().items():
        sides = normal @ (np.stack((start, end), axis=1) - ORIGIN[:, None])
        at = start + (end - start) * sides[0] / (sides[0] - sides[1])
        times[k] = way @ (at - ORIGIN)
    return times


def crossings() -> dict[int, tuple[np.ndarray, np.ndarray]]:
    """The side by which the ray enters each triangle that it meets."""
    way = unit(TARGET - ORIGIN)
    normal = np.array([-way[1], way[0]])
    found = {}
    for k in range(scene.COUNT):
        corners = scene.triangles()[:, :, k]
        sides = []
        for j in range(3):
            a, b = corners[:, j], corners[:, (j + 1) % 3]
            left, right = normal @ (a - ORIGIN), normal @ (b - ORIGIN)
            if left * right < 0:
                at = a + (b - a) * left / (left - right)
                sides.append((float(way @ (at - ORIGIN)), a, b))
        if sides:
            _, a, b = min(sides, key=lambda side: side[0])
            found[k] = (a, b)
    return found


def panels(tree: scene.Hierarchy, step: Step, number: int, count: int) -> tuple[Panel, Panel]:
    """The boxes and the tree after a step."""
    plane = scene.plane_of(set(step.triangles))
    for k in sorted(step.asked):
        now = k in step.now or k == step.node
        kind = "accent" if k in step.met else "ink dashed"
        scene.box(plane, tree, k, kind + ("" if now else " thin"))
        if now and k:
            plane.label((tree[0][0, k], tree[1][1, k]), str(k), "n", 5)
    tip = TARGET if step.nearest < 0 else ORIGIN + step.t * unit(TARGET - ORIGIN)
    plane.line(ORIGIN, TARGET, "faint dashed")
    plane.arrow(ORIGIN, tip)
    plane.dot(ORIGIN)
    if step.nearest >= 0:
        plane.dot(tip, "accent", 4)
    chart = Canvas(350, 200, (0, 4, 2.75, -0.5), 4)
    places = scene.tree_places(tree)
    above = scene.parents(tree)
    for k in range(1, len(places)):
        chart.line(places[above[k]], places[k], "accent" if k in step.met else "faint")
    first, size, order = tree[2:]
    for k, place in enumerate(places):
        kind = (
            "paper accent"
            if k in step.met
            else "paper ink"
            if k in step.asked
            else "paper faint dashed"
        )
        chart.circle(place, 0.21, kind)
        if k == step.node:
            chart.circle(place, 0.27, "accent thin")
        if k in step.stack:
            chart.circle(place, 0.21, "wash accent")
        chart.label(place, str(k), "c")
        if size[k]:
            names = ", ".join(NAMES[t] for t in order[first[k] : first[k] + size[k]])
            tried = set(order[first[k] : first[k] + size[k]]) <= set(step.triangles)
            chart.label((place[0], place[1] + 0.24), names, "s", 5, "" if tried else "faint")
    said = f"Step {number} of {count}"
    return (
        Panel(plane, f"{said}: the boxes", f"A ray among eight triangles. {step.words}"),
        Panel(
            chart,
            f"{said}: the tree",
            f"The ray was tested with {len(step.asked)} boxes, and {len(step.stack)} nodes wait.",
        ),
    )
