"""The power of a described light, and a test whether any surface reflects it."""

from course.engine.core.materials import MaterialTable
from course.engine.core.types import Floats64
from course.engine.formats.yaml import description as d
from course.engine.formats.yaml.description import rgb


def given(*colors: float | tuple[float, ...] | None) -> float | tuple[float, ...]:
    """The one of two alternatives that the file gives."""
    return next(color for color in colors if color is not None)


def power(light: d.Light) -> Floats64:
    """(3,) float64 strength in the light's own unit, that of its intensity, radiance or irradiance."""
    keys = ("intensity", "radiance", "irradiance")
    return rgb(given(*(getattr(light, key, None) for key in keys)))


def why_dark(
    light: d.Light, materials: MaterialTable, by_lobes: bool = False, fills: bool = False
) -> str:
    """The reason why a light needs no samples; empty if it needs them.

    ``by_lobes`` : whether glossy surfaces look for points on lamps, too; ``fills`` : whether fog does
    """
    # An object without emission is refused as a light.
    if not isinstance(light, d.ObjectLight) and not power(light).any():
        return "it has no power"
    if not fills and not materials.shaded.any() and not (by_lobes and materials.mirror.any()):
        return "no material has a diffuse or specular term"
    return ""
