"""Array types that the whole course shares, and the type of a module's functions."""

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]
"""A float32 or float64 array; functions keep the caller's dtype."""

Floats32 = NDArray[np.float32]
Floats64 = NDArray[np.float64]
Words = NDArray[np.uint32]
Indices = NDArray[np.intp]
Mask = NDArray[np.bool_]

Numbers = NDArray[np.int32]
"""Triangle numbers, as Embree returns them."""

Materials = NDArray[np.uint16]
"""Material numbers."""

Media = NDArray[np.int16]
"""Material numbers of the media that rays travel in; -1 outside all media."""

Functions = SimpleNamespace
"""Functions of one module of the course, called by their own names: ``glossy.keep_above``."""
