#!/usr/bin/env bash
# scikit-image 0.26.0: with Gaussian weights, structural_similarity takes a win_size and smooths as it would without:
# the size only decides how wide a border is left out of the mean. The window is set by sigma alone.
# Seen: maps for win_size 3, 7 and 31 are equal to the last bit, and their means differ in the fourth place.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 scikit-image==0.26.0
venv/bin/python - <<'PYTHON'
import numpy as np
import skimage
from skimage.metrics import structural_similarity

rng = np.random.default_rng(0)
one = rng.random((64, 64))
other = one + 0.1 * rng.standard_normal(one.shape)
options = {"data_range": 1, "gaussian_weights": True, "use_sample_covariance": False, "full": True}
means, maps = zip(*(structural_similarity(one, other, win_size=size, **options) for size in (3, 7, 31)))
print("scikit-image", skimage.__version__, "means", [round(float(mean), 4) for mean in means])
assert all((each == maps[0]).all() for each in maps), "win_size changes the window now"
assert len(set(means)) == 3, "win_size changes no mean now"
PYTHON
