"""Phong's lobes as a plugin for Mitsuba's LLVM variant, which has none: its own integrators weigh lamps and lobes.

The lobe lies around the mirrored direction with the density (n + 1) / (2 pi) cos^n, and what falls below the surface is
mirrored out of it. A sample counts the reflectance: so the BSDF times the cosine is reflectance times density.
"""

import math
from functools import cache
from typing import Any


def register_phong_lobe() -> None:
    """Make ``phong_lobe``, with a reflectance and an exponent, a plugin of the variant that is switched on."""
    import mitsuba as mi

    _register(mi.variant())


@cache
def _register(_variant: str) -> None:
    import drjit as dr
    import mitsuba as mi

    class PhongLobe(mi.BSDF):  # type: ignore[misc,name-defined]
        """One glossy lobe, on both sides of a surface."""

        def __init__(self, properties: Any) -> None:
            super().__init__(properties)
            self._reflectance = mi.Color3f(properties["reflectance"])
            self._exponent = float(properties["exponent"])
            sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
            flags = mi.BSDFFlags.GlossyReflection | sides
            self.m_components = [flags]
            self.m_flags = flags

        def _axis(self, si: Any) -> Any:
            """The mirrored direction, as if the ray had come from the front."""
            return mi.Vector3f(-si.wi.x, -si.wi.y, dr.abs(si.wi.z))

        def _density(self, si: Any, wo: Any) -> Any:
            axis = self._axis(si)
            height = dr.mulsign(wo.z, si.wi.z)
            total = mi.Float(0)
            for way in (mi.Vector3f(wo.x, wo.y, height), mi.Vector3f(wo.x, wo.y, -height)):
                # 1 - cos without its cancellation: a narrow lobe hangs on the last digits.
                off = dr.squared_norm(way - axis) / 2
                share = dr.exp(self._exponent * _log1m(dr.minimum(off, 1 - 1e-7)))
                total += dr.select(off < 1, share, 0)
            return dr.select(height > 0, total * (self._exponent + 1) / (2 * math.pi), 0)

        def sample(self, _ctx: Any, si: Any, _sample1: Any, u: Any, active: Any = True) -> Any:
            # log(1 - u) / (n + 1) is the logarithm of the cosine.
            log_cos = _log1m(u.x) / (self._exponent + 1)
            height = dr.exp(log_cos)
            # 1 - cos^2, again without cancellation.
            ring = dr.safe_sqrt(-_expm1(2 * log_cos))
            sin, cos = dr.sincos(2 * math.pi * u.y)
            wo = mi.Frame3f(self._axis(si)).to_world(mi.Vector3f(ring * cos, ring * sin, height))
            wo.z = dr.mulsign(dr.abs(wo.z), si.wi.z)
            sampled = dr.zeros(mi.BSDFSample3f)
            sampled.wo, sampled.eta, sampled.pdf = wo, 1.0, self._density(si, wo)
            sampled.sampled_component = mi.UInt32(0)
            sampled.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
            return sampled, dr.select(mi.Bool(active) & (sampled.pdf > 0), self._reflectance, 0)

        def eval(self, _ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return dr.select(active, self._reflectance * self._density(si, wo), 0)

        def pdf(self, _ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            return dr.select(active, self._density(si, wo), 0)

        def eval_pdf(self, _ctx: Any, si: Any, wo: Any, active: Any = True) -> Any:
            density = dr.select(active, self._density(si, wo), 0)
            return self._reflectance * density, density

        def to_string(self) -> str:
            return f"PhongLobe[{self._exponent}]"

    def _log1m(x: Any) -> Any:
        """Of 1 - x, by its series where that keeps more digits."""
        small = -x * (1 + x * (1 / 2 + x * (1 / 3 + x * (1 / 4 + x / 5))))
        return dr.select(x < 0.02, small, dr.log(1 - x))

    def _expm1(x: Any) -> Any:
        small = x * (1 + x * (0.5 + x * (1 / 6 + x / 24)))
        return dr.select(dr.abs(x) < 0.02, small, dr.exp(x) - 1)

    mi.register_bsdf("phong_lobe", PhongLobe)
