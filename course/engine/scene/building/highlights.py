"""From material descriptions to highlights by other models than Blinn's: one function a model, listed at the end."""

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from course.engine.core.types import Mask
from course.engine.formats.yaml.description import MaterialDescription, rgb
from course.engine.terms.scattering.facet_highlights import FacetHighlights
from course.engine.terms.scattering.highlight import Highlight
from course.engine.terms.scattering.phong_highlights import PhongHighlights

Described = Mapping[str, MaterialDescription]
"""Materials by their names, in the order of their numbers."""


def plain_highlights(materials: Described, count: int) -> Mask | None:
    """(count,) bool, materials whose highlights lack the cosine; None where there are none."""
    return _those(
        materials, count, lambda each: _shines(each) and each.highlight in ("plain", "plain_phong")
    )


def compile_highlights(materials: Described, count: int) -> tuple[Highlight, ...]:
    """Highlights by other models than Blinn's; ``count`` is the number of all materials."""
    found = (compile_one(materials, count) for compile_one in MODELS)
    return tuple(model for model in found if model is not None)


def _phong(materials: Described, count: int) -> Highlight | None:
    mirrored = _those(
        materials,
        count,
        lambda each: _shines(each) and each.highlight in ("phong", "plain_phong"),
    )
    return None if mirrored is None else PhongHighlights(mirrored)


def _facets(materials: Described, count: int) -> Highlight | None:
    facets = _those(materials, count, lambda each: _shines(each) and each.facets is not None)
    if facets is None:
        return None
    straight = np.zeros(count, np.float32)
    for column, material in enumerate(materials.values()):
        if facets[column] and material.facets is not None:
            n, k = material.facets.refraction_index, material.facets.absorption_index
            straight[column] = ((n - 1) ** 2 + k * k) / ((n + 1) ** 2 + k * k)
    covers = _those(materials, count, lambda each: bool(each.facets and each.facets.covers))
    return FacetHighlights(facets, straight, covers)


MODELS: Iterable[Callable[[Described, int], Highlight | None]] = (_phong, _facets)


def _shines(material: MaterialDescription) -> bool:
    covered = material.facets is not None and material.facets.covers
    return covered or bool(rgb(material.specular).any())


def _those(
    materials: Described, count: int, chosen: Callable[[MaterialDescription], bool]
) -> Mask | None:
    """(count,) bool, materials that are chosen; None where there are none."""
    mask = np.zeros(count, np.bool_)
    mask[: len(materials)] = [chosen(each) for each in materials.values()]
    return mask if mask.any() else None
