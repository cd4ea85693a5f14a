"""Array types that the whole course shares, and the namespace that holds the functions of a module."""

from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.floating[Any]]
"""A float32 or float64 array; functions keep the caller's dtype."""

Floats32 = NDArray[np.float32]
Floats64 = NDArray[np.float64]
Indices = NDArray[np.intp]
Mask = NDArray[np.bool_]

Words = NDArray[np.uint32]
"""Indices of pixels in the picture, and words of random bits."""

Numbers = NDArray[np.int32]
"""Indices of triangles, as Embree returns them, and counts of samples."""

Materials = NDArray[np.uint16]
"""Indices of materials."""

Media = NDArray[np.int16]
"""Material numbers of the media that rays travel in; -1 outside all media."""

Functions = SimpleNamespace
"""Functions of one module of the course, called by their own names: ``glossy.keep_above``."""
