"""The renderer's two forms as parameters of tests: passes over arrays, and compiled loops where Numba is installed."""

import pytest

from course.engine.loops import embree_device

needs_numba = pytest.mark.skipif(
    not embree_device.available(), reason="Numba is not installed (pip install .[fast])"
)
FORMS = [pytest.param(False, id="NumPy"), pytest.param(True, marks=needs_numba, id="compiled")]
in_both_forms = pytest.mark.parametrize("compiled", FORMS)
