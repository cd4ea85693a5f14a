"""Your voids are filled from an empty mask, with none of the points of the first pattern."""

import numpy as np

FUNCTION = "void_and_cluster"
CAUGHT_BY = "voids"
MISTAKE = "pattern-not-restored"
SAYS = "Your voids are filled from an empty mask, with none of the points of the first pattern."


def void_and_cluster(u, sigma):
    """With a mistake."""
    _check_picture("u", u)
    _check_sigma(sigma)
    height, width = u.shape
    count = max(1, u.size // 10)
    kernel = _gaussian(height, width, sigma)
    # Four kernels side by side: each shift of the torus is a view.
    tiled = np.tile(kernel, (2, 2))
    points = np.zeros(u.size, bool)
    points[np.argsort(u, axis=None)[:count]] = True
    crowd = np.zeros(u.shape)

    def change(place, sign):
        row, column = divmod(place, width)
        crowd[:] += sign * tiled[height - row :, width - column :][:height, :width]
        points[place] = sign > 0

    def tightest():
        return int(np.where(points, crowd.ravel(), -np.inf).argmax())

    def largest():
        return int(np.where(points, np.inf, crowd.ravel()).argmin())

    for place in np.flatnonzero(points):
        change(place, 1)
    while True:
        cluster = tightest()
        change(cluster, -1)
        void = largest()
        if not crowd.flat[void] < crowd.flat[cluster] - 1e-9:
            change(cluster, 1)
            break
        change(void, 1)
    ranks = np.zeros(u.size, np.int64)
    first, sums = points.copy(), crowd.copy()
    for rank in reversed(range(count)):
        place = tightest()
        change(place, -1)
        ranks[place] = rank
    for rank in range(count, u.size):
        place = largest()
        change(place, 1)
        ranks[place] = rank
    return ranks.reshape(u.shape)
