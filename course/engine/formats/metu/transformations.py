"""`Transformations`: named steps, and the lists by which objects ask for them."""

from typing import Any

import numpy as np

from course.engine.core.types import Floats64
from course.engine.formats.meshes import transforms
from course.engine.formats.metu.element import MetuElement
from course.engine.formats.yaml.consistency import flattens
from course.engine.formats.yaml.suggestions import suggest

Steps = list[dict[str, Any]]
"""Steps of `transform` in the project's own scene files."""

KINDS = {"Translation": "t", "Scaling": "s", "Rotation": "r", "Composite": "c"}
"""Each kind of step, and the letter by which objects ask for it."""

IDENTITY = "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1"


def read_steps(scene: MetuElement) -> dict[str, dict[str, Any]]:
    """The steps of a scene by letter and id, such as t1."""
    parent = scene.maybe("Transformations")
    steps: dict[str, dict[str, Any]] = {}
    for kind, letter in KINDS.items() if parent else ():
        assert parent is not None
        own: dict[str, dict[str, Any]] = {}
        for element in parent.all(kind):
            own[element.id(own)] = _step(kind, element)
        steps |= {letter + number: step for number, step in own.items()}
    return steps


def transform_of(thing: MetuElement, steps: dict[str, dict[str, Any]]) -> Steps:
    """The steps of an object, the first one first."""
    element = thing.maybe("Transformations")
    if element is None:
        return []
    chosen = []
    for name in element.words():
        if name not in steps:
            raise element.unexpected(
                "names such as t1, s1, r1 or c1 of a Translation, Scaling, Rotation or Composite;"
                f" {name}: {suggest(name, steps)}"
            )
        chosen.append(steps[name])
    return chosen


def matrix_of(thing: MetuElement, steps: dict[str, dict[str, Any]]) -> Floats64:
    """All steps of a thing as one matrix, (4, 4) float64, that acts on columns."""
    return matrix_of_steps(transform_of(thing, steps))


def matrix_of_steps(chosen: Steps) -> Floats64:
    """The same of steps that have been looked up."""
    return transforms.compose(map(transforms.of_step, chosen))


def point(matrix: Floats64, position: Floats64) -> Floats64:
    """The transformed point, (3,)."""
    moved: Floats64 = matrix[:3, :3] @ position + matrix[:3, 3]
    return moved


def normal(matrix: Floats64, direction: Floats64) -> Floats64:
    """The transformed normal of a surface, (3,) of any length."""
    linear = matrix[:3, :3] / np.abs(matrix[:3, :3]).max()
    turned: Floats64 = np.linalg.inv(linear).T @ direction
    return turned


def _step(kind: str, element: MetuElement) -> dict[str, Any]:
    if kind == "Translation":
        return {"translate": list(element.vector())}
    if kind == "Scaling":
        factors = element.vector()
        if 0 in factors:
            raise element.unexpected("3 factors that are not 0, such as 1 2 1")
        return {"scale": list(factors)}
    if kind == "Composite":
        return {"matrix": _rows(element)}
    degrees, *axis = element.numbers(4, "90 0 1 0")
    if not any(axis):
        raise element.unexpected("degrees, and an axis that is not 0 0 0, such as 90 0 1 0")
    return {"rotate": {"axis": axis, "degrees": degrees}}


def _rows(element: MetuElement) -> list[list[float]]:
    """The rows of a matrix that acts on columns."""
    matrix = np.array(element.numbers(16, IDENTITY)).reshape(4, 4)
    if matrix[3].tolist() != [0, 0, 0, 1]:
        raise element.unexpected(f"a last row of 0 0 0 1, as in {IDENTITY}")
    if flattens(matrix):
        raise element.unexpected("a matrix that can be inverted; this one flattens what it maps")
    rows: list[list[float]] = matrix.tolist()
    return rows
