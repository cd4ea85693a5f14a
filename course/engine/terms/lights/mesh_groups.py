"""Triangles of a light in groups; groups that send much light to a point are sampled often.

At least half of a closed surface faces away from any point, and other parts are far away or seen at a grazing angle. So
the triangles are divided into groups of neighbours that face in similar directions. For each point, a group is chosen
with a probability in proportion to its area times the root mean square, over the group, of

    cos / d^2 = height / d^3

where d is the distance and the height is that above the triangle's plane. If a group is chosen first, and then a
uniform point in it, these probabilities have the least variance, as far as nothing is hidden. In a closed body, backs
are chosen less often than that (``TRUST``). The mean square is estimated from the moments of the
group. The result is still unbiased, for each sample is divided by the probability that was used. (Light trees do this
level by level: Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018. Our
groups are so few that all can be evaluated.)
"""

from dataclasses import dataclass

import numpy as np

from course.engine.core.lights.sample import CLOSEST
from course.engine.core.types import Floats32, Floats64, Indices
from course.engine.core.vectors import dot

GROUPS = 32
"""Largest number of groups. Each group costs every sample about 10 ns in NumPy, and 3 ns in a compiled loop."""

TRUST = 15 / 16
"""Trust that a closed body hides its own back: a back is chosen (1 - TRUST) / (1 + TRUST) times as often as a front in
the same position. It is chosen sometimes, for surfaces may intersect, or be seen from inside."""

LEAK = 1e-3
"""Circulation around the edges of a closed body, of fields of about 1 and in units of its radius, is below this."""

BATCH = 512
"""Points that NumPy computes together: arrays of GROUPS x BATCH fit the cache (measured: a point takes .43 us in
batches of 65,536, and .30 us in batches of 512)."""

_LEAST = CLOSEST * CLOSEST


@dataclass(frozen=True)
class TriangleGroups:
    """G groups of T triangles.

    Attributes
    ----------
    triangle : (T,) the triangles, group by group
    shares : (T - 1,) float32, of the area, in that order: all up to each triangle but the last
    share : (G,) float32, of each group
    start, last : (G,) float32, shares before each group, and the largest number below those up to its end
    moments : (10, G) float32
        The mean point c (3 rows), the mean normal m (3), the mean height of c above the triangles, the variance of the
        normals along one axis, that of the height, and the mean squared distance from c.
    trust : float32, how much rather fronts than backs are chosen, in (-1, 1); 0 where both may be seen
    """

    triangle: Indices
    shares: Floats32
    share: Floats32
    start: Floats32
    last: Floats32
    moments: Floats32
    trust: np.float32

    def choose(self, points: Floats32, number: Floats32) -> tuple[Floats32, Floats32]:
        """A place in the order of the triangles for each point.

        Parameters
        ----------
        points : (3, n) float32
        number : (n,) float32 in [0, 1)

        Returns
        -------
        place : (n,) float32 in [0, 1), to be looked up in ``shares``
        weight : (n,) float32, the density of uniform places over the density of these
        """
        place, weight = np.empty_like(number), np.empty_like(number)
        for first in range(0, len(number), BATCH):
            part = slice(first, first + BATCH)
            place[part], weight[part] = self._chosen(points[:, part], number[part])
        return place, weight

    def _chosen(self, points: Floats32, number: Floats32) -> tuple[Floats32, Floats32]:
        strength = self._strength(points)
        total = np.zeros((len(strength) + 1, len(number)), np.float32)
        np.multiply(strength, self.share[:, None], out=total[1:])
        for group in range(1, len(total)):
            total[group] += total[group - 1]
        wanted = number * total[-1]
        group = (total[1:] <= wanted).sum(axis=0)
        # Only a number that is 1 after all is beyond the last group.
        np.minimum(group, len(strength) - 1, out=group)
        column = np.arange(len(number))
        own = strength[group, column]
        place = (wanted - total[group, column]) / own
        place += self.start[group]
        np.minimum(place, self.last[group], out=place)
        return place, total[-1] / own

    def _strength(self, points: Floats32) -> Floats32:
        """Root mean square (G, n) of what a place in each group sends to points (3, n); more than 0."""
        cx, cy, cz, mx, my, mz, above, turn, rough, spread = self.moments[:, :, None]
        x, y, z = points[0] - cx, points[1] - cy, points[2] - cz
        height = mx * x
        height += my * y
        height += mz * z
        height += above
        x *= x
        y *= y
        z *= z
        squared = x
        squared += y
        squared += z
        cubed = squared + spread
        cubed *= np.sqrt(cubed)
        squared *= turn
        squared += height * height
        squared += rough
        strength: Floats32 = np.sqrt(squared, out=squared)
        height *= self.trust
        strength += height
        strength /= cubed
        return strength


def make_groups(shares: Floats32, planes: Floats32, edges: Floats32) -> TriangleGroups:
    """Groups of T triangles.

    Parameters
    ----------
    shares : (T - 1,) float32, see ``MeshLight``
    planes, edges : (T, 8) float32, see ``MeshLight``
    """
    share = np.diff(shares.astype(np.float64), prepend=0, append=1)
    p0, normal = np.ascontiguousarray(planes[:, :6].T, np.float64).reshape(2, 3, -1)
    e1, e2 = np.ascontiguousarray(edges[:, :6].T, np.float64).reshape(2, 3, -1)
    corners = np.stack((p0, p0 + e1, p0 + e2))
    center = _mean(corners.mean(axis=0), share)
    corners -= center[:, None]
    middle = corners.mean(axis=0)
    radius = float(np.sqrt((dot(middle, middle) * share).sum())) or 1.0
    groups = _split(np.concatenate((middle / radius, normal)), share)
    triangle = np.concatenate(groups)
    ends = np.cumsum(share[triangle])
    ends /= ends[-1]
    of_groups = ends[np.cumsum([len(group) for group in groups]) - 1]
    # In float32 first, so that a group has as much of [0, 1) as its share says.
    bounds = np.concatenate(([0], of_groups)).astype(np.float32)
    moments = np.array(
        [_moments(corners.take(g, axis=2), normal.take(g, axis=1), share[g]) for g in groups]
    ).T
    moments[:3] += center[:, None]
    outside = np.sign((dot(middle, normal) * share).sum())
    return TriangleGroups(
        triangle,
        ends[:-1].astype(np.float32),
        np.diff(bounds),
        bounds[:-1],
        np.nextafter(bounds[1:], np.float32(0)),
        np.ascontiguousarray(moments, np.float32),
        np.float32(TRUST * outside if _closed(corners / radius) else 0),
    )


def _split(places: Floats64, share: Floats64) -> list[Indices]:
    """Groups of triangles that are near each other in 6 dimensions (6, T), where they lie and how they face.

    The group that varies most, times its area, is cut at its mean, across the dimension in which it varies most.
    """
    groups: list[Indices] = [np.arange(len(share))]
    means, variances = ([value] for value in _scatter(places, share))
    while len(groups) < GROUPS:
        widest = int(np.argmax([variance.sum() for variance in variances]))
        group, axis = groups[widest], int(variances[widest].argmax())
        below = places[axis, group] < means[widest][axis]
        if below.all() or not below.any():
            break
        parts = [group[below], group[~below]]
        groups[widest : widest + 1] = parts
        found = [_scatter(places.take(part, axis=1), share[part]) for part in parts]
        means[widest : widest + 1] = [mean for mean, _ in found]
        variances[widest : widest + 1] = [variance for _, variance in found]
    return groups


def _scatter(places: Floats64, share: Floats64) -> tuple[Floats64, Floats64]:
    """Mean of places (6, T), and variance times share, (6,) each."""
    mean = _mean(places, share)
    away = places - mean[:, None]
    return mean, np.einsum("ij,ij,j->i", away, away, share)


def _mean(values: Floats64, share: Floats64) -> Floats64:
    """Weighted by shares (T,), of values (k, T)."""
    whole = share.sum()
    if not whole > 0:
        return np.asarray(values.mean(axis=1))
    # Not by a matrix product: its last bits depend on the processor, and with them, at a tie, the groups.
    mean: Floats64 = np.einsum("ij,j->i", values, share) / whole
    return mean


def _moments(corners: Floats64, normal: Floats64, share: Floats64) -> Floats64:
    """A column of ``TriangleGroups.moments`` from corners (3, 3, t), each a (3, t), normals (3, t) and shares (t,)."""
    middle = corners.mean(axis=0)
    center, facing = _mean(middle, share), _mean(normal, share)
    # Mean square of a triangle's points: a twelfth of the sum of its corners' squares and nine times its centre's.
    out, far = corners - center[:, None], middle - center[:, None]
    around = np.einsum("kij,kij->j", out, out) + 9 * dot(far, far)
    height = -dot(far, normal)
    above, spread = _mean(np.stack((height, around / 12)), share)
    (rough,) = _mean((height - above)[None] ** 2, share)
    # Normals that differ little differ across their mean, along two axes.
    turn = (1 - min(float((facing**2).sum()), 1.0)) / 2
    return np.array([*center, *facing, above, turn, rough + _LEAST, spread + _LEAST])


def _closed(corners: Floats64) -> bool:
    """True if triangles with corners (3, 3, T), of about unit size, enclose a volume.

    Around a closed surface every edge is passed once in either direction, so the integrals of any field along the edges
    of all triangles cancel. For an open surface, the integral along its rim remains (Stokes). Only a hole that is too
    small to matter leaves so little of four waves in different directions. Corners need not be equal to the last bit.
    """
    waves = np.array([[1.9, 0.7, -1.1], [-0.6, 2.2, 0.9], [1.2, -0.8, 1.8], [0.4, 1.3, -2.1]])
    total = np.zeros((len(waves), 3))
    for start, end in ((0, 1), (1, 2), (2, 0)):
        phase = waves / 2 @ (corners[start] + corners[end]) + 1
        total += np.cos(phase, out=phase) @ (corners[end] - corners[start]).T
    return bool(np.abs(total).max() < LEAK)
