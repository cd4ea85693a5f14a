"""The kinds of value a scene file is made of: numbers with a unit and a range, vectors, colours."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

import msgspec
import numpy as np
from numpy.typing import NDArray


class Map(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A map of a scene file: a misspelt key is never passed over."""


Vector: TypeAlias = tuple[float, float, float]

_Fraction: TypeAlias = Annotated[float, msgspec.Meta(ge=0, le=1)]
_NotNegative: TypeAlias = Annotated[float, msgspec.Meta(ge=0)]

_ThreeFractions: TypeAlias = Annotated[
    tuple[_Fraction, ...], msgspec.Meta(min_length=3, max_length=3)
]
_ThreeNotNegative: TypeAlias = Annotated[
    tuple[_NotNegative, ...], msgspec.Meta(min_length=3, max_length=3)
]

# A colour is a number, for grey, or red, green and blue; linear light, not sRGB. The three are a
# tuple bounded in length, not tuple[F, F, F]: msgspec 0.22 crashes in the garbage collector on a
# union of a bounded number and a tuple of fixed length.
Reflectance: TypeAlias = _Fraction | _ThreeFractions
Color: TypeAlias = _NotNegative | _ThreeNotNegative


def about(description: str, unit: str | None = None, **bounds: Any) -> msgspec.Meta:
    """Describe a key of the scene format, for the checks and for the JSON schema.

    Parameters
    ----------
    description : one line, as the reference page shows it
    unit : written as ``x-unit`` in the schema; "world unit" is the scene's own unit of length
    bounds : gt, ge, lt, le, min_length or pattern, as `msgspec.Meta` has them
    """
    extra = None if unit is None else {"x-unit": unit}
    return msgspec.Meta(description=description, extra_json_schema=extra, **bounds)


def rgb(color: float | tuple[float, ...]) -> NDArray[np.float64]:
    """Red, green and blue of a colour that may be given as one number.

    Returns
    -------
    (3,) float64
        In the colour's own unit; a number is repeated in all three channels.
    """
    return np.array(np.broadcast_to(np.asarray(color, dtype=np.float64), (3,)))
