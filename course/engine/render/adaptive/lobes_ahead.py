"""What becomes of a ray that is sent ahead at a surface: which ways it goes on, how brightly and how blurred."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from course.engine.core.gloss import Lobe
from course.engine.core.types import Floats64, Indices, Mask
from course.engine.terms.scattering.conductors import conductor_reflectance
from course.engine.terms.scattering.materials import FullMaterials
from course.engine.terms.world import FullWorld


@dataclass(frozen=True)
class Onward:
    """Ways on from some hits.

    Attributes
    ----------
    way : (3, n) unit vectors
    square : (n,) mean square of what of the light a sample brings: T^2 / q where T is brought with chance q
    alpha : (n,) roughness of microfacets, 0 where there are none
    blur : (n,) variance of the angle in each of two directions, of other lobes [rad^2]
    """

    way: Floats64
    square: Floats64
    alpha: Floats64
    blur: Floats64


class Surfaces:
    """The materials of a world that send rays on in a few directions."""

    def __init__(self, world: FullWorld) -> None:
        materials = world.materials
        count = materials.exponent.size
        self._mirror = materials.mirror.astype(np.float64).mean(axis=0)
        self._index = materials.refraction_index.astype(np.float64)
        self._diffuse = materials.diffuse.astype(np.float64).max(axis=0)
        self._conductors = materials.conductors if isinstance(materials, FullMaterials) else None
        self._paths = world.paths is not None
        self._alpha, self._blur = np.zeros(count), np.zeros(count)
        for one in world.microfacets:
            self._alpha[one.material] = one.alpha
        for lobe in world.lobes:
            self._blur[lobe.material] = _variance(lobe)
        for rough in world.rough:
            self._blur[rough.material] = rough.roughness**2 / 12
        self.sends_on: Mask = (self._mirror > 0) | (self._index > 0)
        """(M,) which materials mirror or refract"""

    def onward(
        self, material: Indices, way: Floats64, normal: Floats64, entering: Mask
    ) -> Iterator[Onward]:
        """The mirrored rays of hits (n,) and, where any of them refracts, the refracted ones.

        Parameters
        ----------
        way : (3, n) unit vectors of the rays
        normal : (3, n) unit shading normals on their side
        """
        cos = np.clip(-(way * normal).sum(axis=0), 0, 1)
        index = self._index.take(material)
        glass = index > 0
        eta = np.where(entering, 1 / np.where(glass, index, 1), np.where(glass, index, 1))
        inside = 1 - eta**2 * (1 - cos**2)
        cos_t = np.sqrt(np.maximum(inside, 0))
        s = (eta * cos - cos_t) / np.maximum(eta * cos + cos_t, 1e-12)
        p = (cos - eta * cos_t) / np.maximum(cos + eta * cos_t, 1e-12)
        fresnel = np.where(glass, np.where(inside > 0, (s * s + p * p) / 2, 1), 0)
        reflected = np.minimum(self._metal(material, cos) + fresnel, 1)
        alpha, blur = self._alpha.take(material), self._blur.take(material)
        # Of a path's ways on one is chosen, in proportion to what each brings.
        refracted = np.where(glass, 1 - fresnel, 0)
        total = np.maximum(reflected + refracted + self._diffuse.take(material), 1e-12)
        mirrored = way + 2 * cos * normal
        yield Onward(mirrored, reflected * (total if self._paths else reflected), alpha, blur)
        if glass.any():
            bent = eta * way + (eta * cos - cos_t) * normal
            square = refracted * (total if self._paths else refracted)
            yield Onward(np.where(inside > 0, bent, way), square, 0 * alpha, blur + alpha**2 / 4)

    def _metal(self, material: Indices, cos: Floats64) -> Floats64:
        mirror: Floats64 = self._mirror.take(material)
        if self._conductors is None:
            return mirror
        n, k = (
            x.astype(np.float64).take(material, axis=1)
            for x in (self._conductors.n, self._conductors.k)
        )
        share = conductor_reflectance(cos, n, k).mean(axis=0)  # type: ignore[arg-type]
        result: Floats64 = np.where(self._conductors.metal.take(material), mirror * share, mirror)
        return result


def _variance(lobe: Lobe) -> float:
    """Of the angle in each of two directions, about [rad^2]."""
    match lobe.kind:
        case "plane":
            return lobe.parameter**2 / 12
        case "ball":
            return lobe.parameter**2 / 5
        case _:
            return 1 / (lobe.parameter + 1)


def facets_density(way: Floats64, onward: Floats64, normal: Floats64, alpha: Floats64) -> Floats64:
    """How dense the directions are to which microfacets by GGX mirror rays, (n,) [1/sr].

    Parameters
    ----------
    way : (3, n) unit vectors of the rays
    onward : (3, n) unit vectors to where the density is wanted
    normal : (3, n)
    alpha : (n,)
    """
    half = onward - way
    half /= np.maximum(np.sqrt((half * half).sum(axis=0)), 1e-12)
    cos_h = np.clip((half * normal).sum(axis=0), 1e-6, 1)
    cos_o = np.clip(-(way * normal).sum(axis=0), 1e-6, 1)
    tan2 = (1 - cos_h**2) / cos_h**2
    dense = alpha**2 / (np.pi * cos_h**4 * (alpha**2 + tan2) ** 2)
    masked = 2 / (1 + np.sqrt(1 + alpha**2 * (1 - cos_o**2) / cos_o**2))
    above = (onward * normal).sum(axis=0) > 0
    result: Floats64 = np.where(above, masked * dense / (4 * cos_o), 0)
    return result
