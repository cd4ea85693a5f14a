#!/usr/bin/env bash
# numba 0.68.1 beside numpy 2.4.6: a float32 times a Python number is float32 in NumPy and float64 in a compiled
# function, for arrays too; what is stored in float32 is then rounded once instead of twice.
# Seen: types float32 and float64; of 1,000 values of a * 0.1 + 0.2 in float32, 160 have other bits when compiled.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv
venv/bin/pip install --quiet --disable-pip-version-check numpy==2.4.6 numba==0.68.1
venv/bin/python - <<'PYTHON'
import numba
import numpy as np


def scaled(a):
    return a * 0.1


def moved(a):
    result = np.empty_like(a)
    for i in range(len(a)):
        result[i] = a[i] * 0.1 + 0.2
    return result


compiled = numba.njit(scaled)
one, many = np.float32(3.3), np.random.default_rng(0).random(1000, np.float32)
types = [str(f(v).dtype) for v in (one, many) for f in (scaled, lambda v: np.asarray(compiled(v)))]
others = int((moved(many) != numba.njit(moved)(many)).sum())
print("numba", numba.__version__, "numpy", np.__version__, types, "other bits:", others)
assert types == ["float32", "float64", "float32", "float64"], "both promote alike now"
assert others > 100, "compiled loops round as NumPy does now"
PYTHON
