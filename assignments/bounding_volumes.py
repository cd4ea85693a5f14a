"""bounding_volumes - boxes around triangles, boxes around boxes: which triangles a ray need not be tested with.

A ray that misses a box misses everything in it. So triangles are put into boxes, those into larger ones, and so on up
to the root, whose box holds all; a ray goes down only into boxes that it meets. Of thousands of triangles it is
tested with a handful. Embree, which the renderer stands on, does the same, with more cunning and for one machine.
"""

import numpy as np


def slab_test(origins, directions, lo, hi):
    """Where lines enter and leave boxes with sides along the axes: o + t d is in the box for t_near <= t <= t_far.

    Parameters
    ----------
    origins : (3, N) floating
    directions : (3, N) floating
        Not zero; t is measured in lengths of them. A component may be +0 or -0: such a line runs along two of the
        box's faces, and is between them for all t or for none. On a face counts as between.
    lo, hi : (3,), or (3, N) floating
        Two opposite corners of the box, lo <= hi, equal ones included; (3, N) where each ray has a box of its own,
        and a batch argument then.

    Returns
    -------
    t_near, t_far : (N,) each, of the dtype of the batch arguments, or NumPy's promotion of them
        Negative behind the origin, infinite where a division overflows, never NaN. Where the line misses the box,
        t_near > t_far, and nothing else is promised.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: bounding_volumes.slab_test. Source: Kay and Kajiya, "Ray tracing complex scenes", 1986; zeros as in Williams
    et al., "An efficient and robust ray-box intersection algorithm", 2005.
    """
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    for name, corner in (("lo", lo), ("hi", hi)):
        _check_corner(name, corner, np.shape(origins)[1])
    # TODO bounding_volumes.slab_test: write your solution here
    raise NotImplementedError("bounding_volumes.slab_test: not written yet")


def build(lo, hi, leaf_size):
    """A hierarchy over boxes, as five flat arrays.

    Which boxes lie together is up to you, but a random line meets a box as often as its surface is large. By that
    measure rays may need up to twice the tests that they need where nodes are halved along their longest axis.

    Node 0 is the root. A leaf k has count[k] >= 1 and holds the boxes order[first[k] : first[k] + count[k]]. An inner
    node k has count[k] = 0 and two children, the nodes first[k] and first[k] + 1. Every node but the root is the
    child of one node, and every box is in one leaf.

    Parameters
    ----------
    lo, hi : (3, T) floating, T >= 1
        Opposite corners of the boxes, lo <= hi, in any order; many may be the same.
    leaf_size : int >= 1
        Most boxes that a leaf may hold. Nodes of more boxes are inner ones.

    Returns
    -------
    lo, hi : (3, M) each, of the dtype of the arguments, or NumPy's promotion of them
        Of each node the smallest box around all that is below it, bit for bit.
    first, count : (M,) integer each
    order : (T,) integer
        A permutation of 0 to T - 1.

    Raises
    ------
    ValueError
        lo or hi has another shape or no columns, or leaf_size is not an integer >= 1.

    Task: bounding_volumes.build. Source: Rubin and Whitted, "A 3-dimensional representation for fast rendering of
    complex scenes", 1980; halves along the longest axis as in Kay and Kajiya, "Ray tracing complex scenes", 1986.
    """
    _check_vectors("lo", lo)
    _check_vectors("hi", hi, np.shape(lo)[1])
    if np.shape(lo)[1] == 0:
        raise ValueError("lo must have at least one column, got none")
    if not leaf_size >= 1 or leaf_size != int(leaf_size):
        raise ValueError(f"leaf_size must be an integer >= 1, got {leaf_size}")
    # TODO bounding_volumes.build: write your solution here
    raise NotImplementedError("bounding_volumes.build: not written yet")


def traverse(hierarchy, p0, p1, p2, origins, directions):
    """The nearest triangle that each ray hits, found by way of the boxes; and how many tests that took.

    Of two children the one that the ray enters first comes first, and nodes that it enters beyond its nearest hit so
    far are skipped. A triangle counts only where the ray meets the boxes of all nodes above it.

    Parameters
    ----------
    hierarchy : tuple of five arrays
        As ``build`` describes, though not all made by it: of any depth, nodes in any order.
    p0, p1, p2 : (3, T) floating
        The triangles' corners; either side can be hit. A triangle without area never is.
    origins : (3, N) floating
    directions : (3, N) floating
        Not zero; t is measured in lengths of them.

    Returns
    -------
    triangle : (N,) int32
        -1 where the ray hits nothing. Of triangles that are hit at the same t, any.
    t : (N,), of the dtype of the rays, or NumPy's promotion of origins and directions
        > 0; infinite where the ray hits nothing.
    box_tests, triangle_tests : (N,) integer each
        How many boxes and how many triangles the ray was tested with; the root's box may count or not.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: bounding_volumes.traverse. Source: Rubin and Whitted, "A 3-dimensional representation for fast rendering of
    complex scenes", 1980; triangles by Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
    """
    _check_hierarchy(hierarchy)
    for name, corners in (("p0", p0), ("p1", p1), ("p2", p2)):
        _check_vectors(name, corners, np.shape(hierarchy[4])[0])
    _check_vectors("origins", origins)
    _check_vectors("directions", directions, np.shape(origins)[1])
    # TODO bounding_volumes.traverse: write your solution here
    raise NotImplementedError("bounding_volumes.traverse: not written yet")


def _check_vectors(name, array, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != 3 or (columns is not None and shape[1] != columns):
        expected = f"(3, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_corner(name, corner, columns):
    shape = np.shape(corner)
    if shape not in ((3,), (3, columns)):
        raise ValueError(f"{name} must have shape (3,) or (3, {columns}), got {shape}")


def _check_hierarchy(hierarchy):
    shapes = [np.shape(array) for array in hierarchy]
    nodes = shapes[2] if len(shapes) == 5 else ()
    expected = [(3, *nodes), (3, *nodes), nodes, nodes, shapes[-1] if shapes else ()]
    if len(nodes) != 1 or shapes != expected or len(shapes[4]) != 1:
        raise ValueError(
            f"hierarchy must have shapes (3, M), (3, M), (M,), (M,) and (T,), got {shapes}"
        )
