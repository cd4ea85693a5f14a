"""Rough glass: how a material scatters about the refracted direction, through the `blurred_transparency` module."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course.appearance.lobes import Lobe
from course.core.types import Floats32, Mask


@dataclass(frozen=True)
class RoughGlass(Lobe):
    """One rough dielectric: a lobe about the refracted direction, besides that about the mirrored one.

    Where the material has no gloss, ``width`` is 0, and mirrored directions stay as they are.

    Attributes
    ----------
    roughness : as ``jitter_refraction`` wants it, > 0
    refract : (direction, normal, eta) -> (3, N), and (N,) where reflection is total
    jitter_refraction : (direction, normal, roughness, u) -> (3, N)
    fresnel : (cos_i, eta) -> (N,)
    """

    roughness: float
    refract: Callable[[Floats32, Floats32, Floats32], tuple[Floats32, Mask]]
    jitter_refraction: Callable[[Floats32, Floats32, float, Floats32], Floats32]
    fresnel: Callable[[Floats32, Floats32], Floats32]
