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
    ### BEGIN SOLUTION
    own = [np.asarray(corner) for corner in (lo, hi)]
    dtype = np.result_type(origins, directions, *(corner for corner in own if corner.ndim == 2))
    lo, hi = (corner.astype(dtype, copy=False).reshape(3, -1) for corner in own)
    parallel, between = directions == 0, (lo <= origins) & (origins <= hi)
    slope = np.where(parallel, 1, directions)
    # Divided, not multiplied by 1 / slope: that may overflow, and 0 times infinity is not a number.
    with np.errstate(over="ignore"):
        t_lo, t_hi = (lo - origins) / slope, (hi - origins) / slope
    always = np.where(between, dtype.type(np.inf), dtype.type(-np.inf))
    t_near = np.where(parallel, -always, np.minimum(t_lo, t_hi)).max(axis=0)
    t_far = np.where(parallel, always, np.maximum(t_lo, t_hi)).min(axis=0)
    return t_near, t_far
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    dtype = np.result_type(lo, hi)
    lo, hi = lo.astype(dtype), hi.astype(dtype)
    middle = 0.5 * (lo + hi)
    order = np.arange(lo.shape[1])
    # The runs of `order` that nodes hold, level by level; a leaf's run stays as it is on the levels below.
    sizes, new = np.array([order.size]), np.array([True])
    levels, nodes = [], 1
    while new.any():
        starts = np.cumsum(sizes) - sizes
        divide = sizes > leaf_size
        first = np.where(divide, nodes + 2 * (np.cumsum(divide) - 1), starts)
        count = np.where(divide, 0, sizes)
        box = _around(lo, hi, order, starts)
        levels.append([array[..., new] for array in (*box, first, count)])
        nodes += 2 * divide.sum()
        # Each run is sorted by the middles' coordinate on the axis where they lie farthest apart, and halved.
        low, high = _around(middle, middle, order, starts)
        run = np.repeat(np.arange(sizes.size), sizes)
        order = order[np.lexsort((middle[(high - low).argmax(axis=0)[run], order], run))]
        half = np.where(divide, sizes // 2, sizes)
        sizes, new = np.stack((half, sizes - half), axis=1).ravel(), np.repeat(divide, 2)
        sizes, new = sizes[sizes > 0], new[sizes > 0]
    boxes_lo, boxes_hi, first, count = (
        np.concatenate(arrays, axis=-1) for arrays in zip(*levels, strict=True)
    )
    return (
        boxes_lo,
        boxes_hi,
        first.astype(np.int32),
        count.astype(np.int32),
        order.astype(np.int32),
    )
    ### END SOLUTION


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
    ### BEGIN SOLUTION
    lo, hi, first, count, order = hierarchy
    dtype, n = np.result_type(origins, directions), origins.shape[1]
    o, d = origins.astype(dtype), directions.astype(dtype)
    lo, hi, *corners = (array.astype(dtype) for array in (lo, hi, p0, p1, p2))
    triangle, t = np.full(n, -1, np.int32), np.full(n, np.inf, dtype)
    box_tests, triangle_tests = np.zeros((2, n), np.int32)

    def enter(rays, nodes):
        """Where rays enter nodes, and whether they do so at all, and before their nearest hit."""
        box_tests[rays] += 1
        t_near, t_far = slab_test(o[:, rays], d[:, rays], lo[:, nodes], hi[:, nodes])
        # A little longer, so that rounding loses no ray through a box's edge (Ize 2013).
        t_far = t_far * (1 + 4 * np.finfo(dtype).eps)
        return t_near, (t_near <= t_far) & (t_far > 0) & (t_near <= t[rays])

    def hit(rays, leaves):
        """Test rays with the triangles of leaves, the first of each, then the second, and so on."""
        for k in range(count[leaves].max(initial=0)):
            rays, leaves = rays[count[leaves] > k], leaves[count[leaves] > k]
            tested = order[first[leaves] + k]
            found = _intersect(o[:, rays], d[:, rays], *(p[:, tested] for p in corners))
            triangle_tests[rays] += 1
            nearer = found < t[rays]
            t[rays[nearer]], triangle[rays[nearer]] = found[nearer], tested[nearer]

    # Each ray has a stack of nodes that it has yet to visit, with the t where it enters them.
    height = _height(first, count)
    stack, entry = np.zeros((height, n), np.int32), np.zeros((height, n), dtype)
    everyone = np.arange(n)
    entry[0], waiting = enter(everyone, np.zeros(n, np.int32))
    waiting = waiting.astype(np.int32)
    rays = np.flatnonzero(waiting)
    while rays.size:
        waiting[rays] -= 1
        top = waiting[rays]
        nodes = stack[top, rays]
        near = entry[top, rays] <= t[rays]
        going, nodes = rays[near], nodes[near]
        leaf = count[nodes] > 0
        hit(going[leaf], nodes[leaf])
        going, left = going[~leaf], first[nodes[~leaf]]
        left_at, left_met = enter(going, left)
        right_at, right_met = enter(going, left + 1)
        # The farther child goes onto the stack first, so that the nearer one is taken first.
        swap = left_at < right_at
        for is_left in (~swap, swap):
            met = np.where(is_left, left_met, right_met)
            to = going[met]
            stack[waiting[to], to] = (left + ~is_left)[met]
            entry[waiting[to], to] = np.where(is_left, left_at, right_at)[met]
            waiting[to] += 1
        rays = rays[waiting[rays] > 0]
    return triangle, t, box_tests, triangle_tests
    ### END SOLUTION


### BEGIN SOLUTION
def _around(lo, hi, order, starts):
    """The smallest boxes around runs of boxes."""
    return (
        np.minimum.reduceat(lo[:, order], starts, axis=1),
        np.maximum.reduceat(hi[:, order], starts, axis=1),
    )


def _intersect(o, d, p0, p1, p2):
    """The t of each ray at its own triangle, infinite for a miss: o + t d = p0 + u (p1 - p0) + v (p2 - p0)."""
    edge1, edge2, s = p1 - p0, p2 - p0, o - p0
    p, q = _cross(d, edge2), _cross(s, edge1)
    det = _dot(edge1, p)
    divisor = np.where(det == 0, 1, det)
    with np.errstate(invalid="ignore", over="ignore"):
        u, v, t = _dot(s, p) / divisor, _dot(d, q) / divisor, _dot(edge2, q) / divisor
        inside = (det != 0) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
    return np.where(inside, t, t.dtype.type(np.inf))


def _cross(a, b):
    return np.stack([a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))])


def _dot(a, b):
    """Dot product of each column, rounded alike whatever the memory's layout is."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _height(first, count):
    """How many levels there are: as high as a stack can get."""
    level, height = np.zeros(1, np.int64), 0
    while level.size:
        left = first[level[count[level] == 0]]
        level, height = np.concatenate((left, left + 1)), height + 1
    return height


### END SOLUTION


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
