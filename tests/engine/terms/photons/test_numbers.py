"""Numbers of photons that leave a lamp, beside SciPy's points of the same sequence."""

import numpy as np
from scipy.stats import qmc

from course.engine.terms.photons.numbers import sobol_points, spread


def test_points_are_those_of_sobol() -> None:
    """In SciPy they stand in the order of Gray's code, so that ends of powers of two hold the same ones."""
    theirs = qmc.Sobol(7, scramble=False, bits=32).random(4096).T
    ours = sobol_points(0, 4096, 7) / 2.0**32
    index = np.arange(4096)
    assert (ours[:, index ^ index >> 1] == theirs).all()
    assert (sobol_points(1000, 500, 3) / 2.0**32 == ours[:3, 1000:1500]).all()
    later = qmc.Sobol(7, scramble=False, bits=32)
    later.fast_forward(200_000)
    for index, point in enumerate(later.random(8), 200_000):
        assert (sobol_points(index ^ index >> 1, 1, 7)[:, 0] / 2.0**32 == point).all()
    pieces = [sobol_points(first, n, 7) for first, n in ((65_000, 1000), (66_000, 70_000))]
    assert (np.concatenate(pieces, axis=1) == sobol_points(65_000, 71_000, 7)).all()


def test_each_pass_has_its_own_scramble_of_them() -> None:
    """Of 2^10 photons one lies in each of 2^10 equal parts of every dimension, in stretches as in one piece."""
    one, other = (spread(3, number, 0, 1024, 7) for number in range(2))
    for u in (one, other):
        assert (np.sort((u * 1024).astype(int), axis=1) == np.arange(1024)).all()
    assert (one != other).mean() > 0.99
    parts = [spread(3, 0, first, n, 7) for first, n in ((0, 100), (100, 924))]
    assert (np.concatenate(parts, axis=1) == one).all()
