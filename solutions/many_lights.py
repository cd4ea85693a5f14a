"""many_lights - one lamp for each shading point, chosen by a bound of the light that it can send there.

A light tree is a binary tree over L lamps with M = 2 L - 1 nodes, numbered from the root, 0. Node k < L - 1 has the
children 2 k + 1 and 2 k + 2. The nodes from L - 1 to M - 1 are leaves of one lamp each. A node bounds the lamps below
it by a box, by a cone of their normals, and by the sum of their powers. A lamp sends light up to 90 degrees from its
normals. One that sends light in all directions has the cone of all normals, whose angle is pi.
"""

import numpy as np


def power_choice(power, u):
    """Random lamps in proportion to their power.

    The lamps divide [0, 1) among themselves, in their order. The number u chooses the lamp in whose part it falls. One
    without power is never chosen, whatever sums are rounded to.

    Parameters
    ----------
    power : (L,) floating >= 0, not all 0 [W]
    u : (N,) floating in [0, 1)

    Returns
    -------
    lamp : (N,) whole, from 0 to L - 1
    probability : (N,) > 0, of the dtype of u
        Probability of the lamp that was chosen.

    Raises
    ------
    ValueError
        An argument has another shape, or power is negative somewhere, or 0 everywhere.

    Task: many_lights.power_choice. Source: Shirley, Wang and Zimmerman, "Monte Carlo techniques for direct lighting
    calculations", 1996.
    """
    _check("power", power, "L")
    if not (np.asarray(power) >= 0).all() or not np.any(power):
        raise ValueError("power must be >= 0, and not 0 everywhere")
    _check("u", u, "N")
    ### BEGIN SOLUTION
    ends = np.cumsum(power, dtype=np.float64)
    # A number that is rounded up to the last sum still belongs to the last lamp that has power.
    last = np.flatnonzero(power)[-1]
    lamp = np.minimum(np.searchsorted(ends, u * ends[-1], side="right"), last)
    return lamp, (power[lamp] / ends[-1]).astype(u.dtype)
    ### END SOLUTION


def merge_cones(axis_a, angle_a, axis_b, angle_b):
    """The narrowest cone around two cones.

    Parameters
    ----------
    axis_a, axis_b : (3, N) floating
        Unit vectors.
    angle_a, angle_b : (N,) floating in [0, pi] [rad]
        Between the axis and the cone's side: 0 for one direction, pi for all of them.

    Returns
    -------
    axis : (3, N) unit vectors, of the dtype of the arguments, or NumPy's promotion of them
        Where all directions are in the cone, any.
    angle : (N,) in [0, pi], of the same dtype
        It keeps its digits where the axes are nearly the same, in float32, too.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: many_lights.merge_cones. Source: Conty Estevez and Kulla, "Importance sampling of many lights with adaptive
    tree splitting", 2018, algorithm 1.
    """
    _check("axis_a", axis_a, 3, "N")
    count = np.shape(axis_a)[1]
    _check("angle_a", angle_a, count)
    _check("axis_b", axis_b, 3, count)
    _check("angle_b", angle_b, count)
    ### BEGIN SOLUTION
    dtype = np.result_type(axis_a, angle_a, axis_b, angle_b)
    a, b = axis_a.astype(np.float64), axis_b.astype(np.float64)
    swap = angle_b > angle_a
    a, b = np.where(swap, b, a), np.where(swap, a, b)
    wide, narrow = np.maximum(angle_a, angle_b), np.minimum(angle_a, angle_b)
    # Between the axes; exact next to 0 and pi, as the arccosine isn't.
    across = b - _dot(a, b) * a
    sine = np.sqrt(_dot(across, across))
    apart = np.arctan2(sine, _dot(a, b))
    inside = np.minimum(apart + narrow, np.pi) <= wide
    angle = np.where(inside, wide, np.minimum((apart + wide + narrow) / 2, np.pi))
    # Of opposite axes any plane will do: that of the coordinate axis along which a is least.
    other = np.eye(3)[:, np.abs(a).argmin(axis=0)]
    other = other - _dot(a, other) * a
    across = np.where(sine > 1e-9, across, other)
    across = across / np.sqrt(_dot(across, across))
    turn = np.where(inside | (angle >= np.pi), 0, angle - wide)
    axis = np.cos(turn) * a + np.sin(turn) * across
    axis /= np.sqrt(_dot(axis, axis))
    return axis.astype(dtype), np.minimum(angle.astype(dtype), dtype.type(np.pi))
    ### END SOLUTION


def light_tree(lo, hi, axis, angle, power):
    """The light tree of L lamps.

    Which lamps lie together is up to you, but small nodes have tight bounds. A tree's measure is the sum over all inner
    nodes of the power times the squared diagonal of the box. It may be up to twice that of the tree in which each node
    divides its lamps along the axis on which their centres lie farthest apart.

    Parameters
    ----------
    lo, hi : (3, L) floating, L >= 1 [m]
        Opposite corners of the lamps' boxes, lo <= hi.
    axis : (3, L) floating
        Unit vectors, the axes of the cones of the lamps' normals.
    angle : (L,) floating in [0, pi] [rad]
        Of these cones.
    power : (L,) floating >= 0 [W]

    Returns
    -------
    lo, hi : (3, M) each, of the dtype of the arguments, or NumPy's promotion of them
        Of each node the smallest box around those of its lamps, bit for bit.
    axis, angle : (3, M) and (M,), of the same dtype
        A leaf has its lamp's cone, an inner node the narrowest one around those of its two children.
    power : (M,), of the same dtype
        Sum over the lamps.
    order : (L,) whole
        The lamp of each leaf, from node L - 1 on.

    Raises
    ------
    ValueError
        An argument has another shape, or there are no lamps.

    Task: many_lights.light_tree. Source: Conty Estevez and Kulla, 2018; Walter et al., "Lightcuts", 2005.
    """
    _check("lo", lo, 3, "L")
    lamps = np.shape(lo)[1]
    if lamps == 0:
        raise ValueError(f"lo must have one column or more, got {np.shape(lo)}")
    _check("hi", hi, 3, lamps)
    _check("axis", axis, 3, lamps)
    _check("angle", angle, lamps)
    _check("power", power, lamps)
    ### BEGIN SOLUTION
    dtype = np.result_type(lo, hi, axis, angle, power)
    inner = lamps - 1
    leaves = np.ones(inner + lamps, int)
    for k in reversed(range(inner)):
        leaves[k] = leaves[2 * k + 1] + leaves[2 * k + 2]
    middle, order = (lo + hi) / 2, np.empty(lamps, int)
    todo = [(0, np.arange(lamps))]
    while todo:
        k, own = todo.pop()
        if k >= inner:
            order[k - inner] = own[0]
            continue
        longest = np.ptp(middle[:, own], axis=1).argmax()
        own = own[middle[longest, own].argsort(kind="stable")]
        cut = leaves[2 * k + 1]
        todo += [(2 * k + 1, own[:cut]), (2 * k + 2, own[cut:])]
    # From the leaves up, level by level; what the inner nodes hold until then doesn't count.
    places = np.concatenate((order[:1].repeat(inner), order))
    lo, hi, axis, angle, power = (
        x[..., places].astype(dtype) for x in (lo, hi, axis, angle, power)
    )
    for level in reversed(range(inner.bit_length())):
        k = np.arange(2**level - 1, min(2 ** (level + 1) - 1, inner))
        one, two = 2 * k + 1, 2 * k + 2
        lo[:, k] = np.minimum(lo[:, one], lo[:, two])
        hi[:, k] = np.maximum(hi[:, one], hi[:, two])
        axis[:, k], angle[k] = merge_cones(axis[:, one], angle[one], axis[:, two], angle[two])
        power[k] = power[one] + power[two]
    return lo, hi, axis, angle, power, order
    ### END SOLUTION


def importance(lo, hi, axis, angle, power, p, n):
    """What the lamps of a node can send to a surface: power times two cosines, over the product of two distances.

    All lamps are thought to lie in the sphere around the node's box. Seen from p, its radius has the angle alpha, which
    is pi if p is inside. Both cosines are as large as they can be for a lamp in the sphere. One is of the angle at the
    surface between n and the sphere's centre, less alpha. The other is of the angle at the lamps between the axis and
    p, less the cone's angle and alpha. Angles below 0 count as 0, and so do cosines.

    One distance is that of the sphere's centre, but at least its radius; the other that of the box's nearest point, but
    at least a twentieth of the radius. For a lamp without size they are the same.

    Parameters
    ----------
    lo, hi : (3, N) floating [m]
        Corners of the boxes.
    axis, angle, power : (3, N), (N,) [rad] and (N,) [W], floating
        The cones and the powers.
    p, n : (3, N) floating
        Points [m] of surfaces, and their normals, unit vectors.

    Returns
    -------
    (N,) >= 0 [W/m^2], of the dtype of the arguments, or NumPy's promotion of them
        0 for a lamp without size that p lies on.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: many_lights.importance. Source: Conty Estevez and Kulla, 2018, section 5, with a distance that tells whether
    lamps may be next to p.
    """
    _check("lo", lo, 3, "N")
    count = np.shape(lo)[1]
    for name, array in (("hi", hi), ("axis", axis), ("p", p), ("n", n)):
        _check(name, array, 3, count)
    _check("angle", angle, count)
    _check("power", power, count)
    ### BEGIN SOLUTION
    half = (hi - lo) / 2
    way = lo + half - p
    radius, distance = np.sqrt(_dot(half, half)), np.sqrt(_dot(way, way))
    inverse = 1 / np.where(distance > 0, distance, 1)
    sine = np.minimum(radius * inverse, 1)
    seen = (
        np.where(distance > radius, np.sqrt(1 - sine * sine), -1),
        np.where(distance > radius, sine, 0),
    )
    at_surface = _less(*_cos_sin(_dot(n, way) * inverse), *seen)
    cosine, sine = _cos_sin(-_dot(axis, way) * inverse)
    # Less alpha, and then less the cone's angle.
    turned = _less(cosine, sine, *seen)
    sine = np.where(turned < 1, sine * seen[0] - cosine * seen[1], 0)
    at_lamps = _less(turned, sine, np.cos(angle), np.sin(angle))
    gap = np.maximum(np.abs(way) - half, 0)
    near = np.maximum(np.sqrt(_dot(gap, gap)), radius / 20)
    squared = np.maximum(distance, radius) * near
    sent = power * np.maximum(at_surface, 0) * np.maximum(at_lamps, 0)
    return np.where(squared > 0, sent / np.where(squared > 0, squared, 1), 0).astype(sent.dtype)
    ### END SOLUTION


def tree_choice(tree, p, n, u):
    """A random lamp for each point, by a walk from the root to a leaf.

    Each step takes one of two children, in proportion to their importance. Where both have none, both are as probable.
    u decides about the first step: the left child is taken where u is below its probability. The place of u within the
    part of [0, 1) that was taken is a number again, which decides about the next step.

    Parameters
    ----------
    tree : tuple of six arrays
        As `light_tree` returns them, though not all made by it.
    p, n : (3, N) floating
        Points [m] of surfaces, and their normals, unit vectors.
    u : (N,) floating in [0, 1)

    Returns
    -------
    lamp : (N,) whole
    probability : (N,) > 0, of the dtype of p, n and u, or NumPy's promotion of them
        Probability of the lamp that was chosen: the product over the steps.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: many_lights.tree_choice. Source: Conty Estevez and Kulla, 2018, algorithm 2.
    """
    _check_tree(tree)
    _check("p", p, 3, "N")
    _check("n", n, 3, np.shape(p)[1])
    _check("u", u, np.shape(p)[1])
    ### BEGIN SOLUTION
    dtype, order = np.result_type(p, n, u), tree[5]
    inner = len(order) - 1
    node, probability = np.zeros(len(u), int), np.ones(len(u))
    # Numbers that were rounded to 1 in float32, too.
    u = np.minimum(u.astype(np.float64), 1 - 2.0**-53)
    for level in reversed(range(inner.bit_length())):
        # Leaves lie on two levels: some walks end a step before the others.
        on = slice(None) if level else np.flatnonzero(node < inner)
        share = _left_share(tree, node[on], p[:, on], n[:, on])
        v = u[on]
        left = v < share
        taken = np.where(left, share, 1 - share)
        # Below 1, whatever the division is rounded to: else a child of no importance could be taken next.
        u[on] = np.minimum(np.where(left, v, v - share) / taken, 1 - 2.0**-53)
        probability[on] *= taken
        node[on] = 2 * node[on] + np.where(left, 1, 2)
    return order[node - inner], probability.astype(dtype)
    ### END SOLUTION


def tree_probability(tree, p, n, lamp):
    """Probability with which `tree_choice` chooses a given lamp for each point.

    Parameters
    ----------
    tree : tuple of six arrays
        As `light_tree` returns them, though not all made by it.
    p, n : (3, N) floating
        Points [m] of surfaces, and their normals, unit vectors.
    lamp : (N,) whole, from 0 to L - 1

    Returns
    -------
    (N,) in [0, 1], of the dtype of p and n, or NumPy's promotion of them
        Over all lamps of a tree they add up to 1.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: many_lights.tree_probability.
    """
    _check_tree(tree)
    _check("p", p, 3, "N")
    _check("n", n, 3, np.shape(p)[1])
    _check("lamp", lamp, np.shape(p)[1])
    ### BEGIN SOLUTION
    order = tree[5]
    inner = len(order) - 1
    # From the leaf up: the parent of node k is (k - 1) // 2, and left children are odd.
    node, probability = inner + np.argsort(order)[lamp], np.ones(len(lamp))
    for _ in range(inner.bit_length()):
        on = np.flatnonzero(node > 0)
        parent = (node[on] - 1) // 2
        share = _left_share(tree, parent, p[:, on], n[:, on])
        probability[on] *= np.where(node[on] % 2 == 1, share, 1 - share)
        node[on] = parent
    return probability.astype(np.result_type(p, n))
    ### END SOLUTION


### BEGIN SOLUTION
def _left_share(tree, node, p, n):
    """Probability of the left child, for walks that are at inner nodes."""
    parts, left = tree[:5], 2 * node + 1
    one, two = (
        importance(*(part.take(k, axis=-1) for part in parts), p, n) for k in (left, left + 1)
    )
    both = one + two
    return np.where(both > 0, one / np.where(both > 0, both, 1), 0.5).astype(np.float64)


def _cos_sin(cosine):
    """Cosine and sine of an angle from 0 to pi."""
    return cosine, np.sqrt(np.maximum(1 - cosine * cosine, 0))


def _less(cos_a, sin_a, cos_b, sin_b):
    """Cosine of the angle a - b, or of 0 where b is larger; both lie from 0 to pi."""
    return np.where(cos_a >= cos_b, 1, cos_a * cos_b + sin_a * sin_b)


def _dot(a, b):
    """Dot product of each column, rounded alike whatever the memory's layout is."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


### END SOLUTION


def _check(name, array, *sizes):
    """The array has the shape; a letter stands for any size."""
    shape = np.shape(array)
    if len(shape) != len(sizes) or any(
        isinstance(size, int) and own != size for own, size in zip(shape, sizes, strict=False)
    ):
        expected = ", ".join(map(str, sizes)) + ("," if len(sizes) == 1 else "")
        raise ValueError(f"{name} must have shape ({expected}), got {shape}")


def _check_tree(tree):
    shapes = [np.shape(array) for array in tree]
    lamps = shapes[-1] if shapes else ()
    nodes = (2 * lamps[0] - 1,) if len(lamps) == 1 else ()
    if not nodes or shapes != [(3, *nodes), (3, *nodes), (3, *nodes), nodes, nodes, lamps]:
        raise ValueError(
            "tree must have shapes (3, M), (3, M), (3, M), (M,), (M,) and (L,) with M = 2 L - 1, "
            f"got {shapes}"
        )
