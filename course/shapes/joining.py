"""Several meshes as one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from course.core.triangles import Mesh


def join(parts: Sequence[Mesh]) -> Mesh:
    """Return one mesh of all `parts` in order; no vertex is merged with another.

    Parts without uv get (0, 0) where others have some.

    Raises
    ------
    ValueError
        For no parts at all, or when only some of them have normals.
    """
    if not parts:
        raise ValueError("no meshes to join")
    if len(parts) == 1:
        return parts[0]
    first: NDArray[np.int64] = np.cumsum([0, *(len(part.vertices) for part in parts)])
    normals = [part.normals for part in parts if part.normals is not None]
    if normals and len(normals) != len(parts):
        raise ValueError("some of the meshes to join have normals, some have none")
    uv = None
    if any(part.uv is not None for part in parts):
        uv = np.concatenate(
            [np.zeros((len(p.vertices), 2)) if p.uv is None else p.uv for p in parts]
        )
    # int64 only where it is needed: it doubles the memory of the triangles.
    index = np.dtype(np.int32 if first[-1] <= np.iinfo(np.int32).max else np.int64)
    triangles: NDArray[np.integer] = np.concatenate(
        [(p.triangles + k).astype(index) for p, k in zip(parts, first[:-1], strict=True)]
    )
    return Mesh(
        vertices=np.concatenate([part.vertices for part in parts]),
        triangles=triangles,
        normals=np.concatenate(normals) if normals else None,
        uv=uv,
    )
