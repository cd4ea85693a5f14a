"""The sentences of the contract that hold for every function on batches, as checks of one function each."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import product
from typing import Any

import numpy as np
import pytest

from tests.solutions.contract import Array, frozen, global_random_state_untouched, scattered, unit

DTYPES = [np.float32, np.float64]

Maker = Callable[[int, type, int], Array]
"""n columns of legal numbers, from a dtype and a seed."""


def numbers(rows: int | None, low: float = 0, high: float = 1) -> Maker:
    """Uniform in [low, high); (n,) for no rows."""

    def make(n: int, dtype: type, seed: int) -> Array:
        u = unit(rows or 1, n, dtype, seed) * dtype(high - low) + dtype(low)
        return u if rows else u[0]

    return make


def directions(n: int, dtype: type, seed: int) -> Array:
    """Unit vectors, uniform on the sphere; the same for each dtype, but for rounding."""
    v = np.random.default_rng(seed).standard_normal((3, n))
    return np.ascontiguousarray(v / np.linalg.norm(v, axis=0), dtype)


def worst_directions(dtype: type) -> Array:
    """Unit vectors on and around the axes, the diagonals and the equator."""
    steep = (0.00038527316, 0.00038460016, -0.99999988079)
    offsets = [0.0, 5e-324, 1e-45, 1e-38, 1e-20, 1e-8, 3e-8, 1e-7, 1e-4, 0.01]
    vectors = [(a, b, 1.0) for a, b in product(offsets, repeat=2)]
    vectors += [(1.0, 1.0, b) for b in offsets] + [(1.0, 1.0, 1.0), (0.6, 0.0, 0.8)]
    normalised = [np.array(v) / np.linalg.norm(v) for v in vectors]
    turned = [np.roll(v, k) for v in [*normalised, np.array(steep)] for k in range(3)]
    signs = [np.array(s) for s in product((1.0, -1.0), repeat=3)]
    return np.array([v * s for v in turned for s in signs], dtype).T.copy()


def every_pair(a: Array, b: Array) -> tuple[Array, Array]:
    """Each column of a with each column of b."""
    return np.repeat(a, b.shape[1], axis=1), np.tile(b, a.shape[1])


def assert_unit(directions: Array, tolerance: float = 1e-5) -> None:
    """Unit length to 1e-5, as the contract says; which finite numbers only can be."""
    assert (np.abs(np.linalg.norm(directions.astype(float), axis=0) - 1) <= tolerance).all()


@dataclass(frozen=True)
class Call:
    """A function with arguments that are fine.

    Attributes
    ----------
    function : what is called, always by the names of its arguments
    batches : the makers of its batch arguments
    singles : points, and other arguments that have no columns
    result : shape of each result, without the columns
    tolerance : by how much rounding to float32 may change a result
    """

    function: Callable[..., Any]
    batches: dict[str, Maker]
    singles: dict[str, Any] = field(default_factory=dict)
    result: tuple[tuple[int, ...], ...] = ((3,),)
    tolerance: float = 2e-6

    def arrays(self, n: int = 50, dtype: type = np.float32) -> dict[str, Array]:
        """Batch arguments of n columns."""
        return {name: make(n, dtype, k) for k, (name, make) in enumerate(self.batches.items())}

    def __call__(self, **changed: Any) -> tuple[Array, ...]:
        """All results, as a tuple."""
        results = self.function(**{**self.singles, **changed})
        return results if isinstance(results, tuple) else (results,)


def _assert_close(results: tuple[Array, ...], expected: tuple[Array, ...], within: float) -> None:
    assert len(results) == len(expected)
    for a, b in zip(results, expected, strict=True):
        assert np.abs(a.astype(float) - b).max() <= within


def check_shape_and_dtype(call: Call) -> None:
    """The dtype of the batch arguments, or NumPy's promotion of them; never that of a single one."""
    for dtypes in product(DTYPES, repeat=len(call.batches)):
        arrays = {
            name: array.astype(dtype)
            for (name, array), dtype in zip(call.arrays().items(), dtypes, strict=True)
        }
        expected = call(**{name: array.astype(float) for name, array in arrays.items()})
        for single in (lambda x: x, np.float32, np.float64, np.longdouble, np.array):
            results = call(**arrays, **{name: single(x) for name, x in call.singles.items()})
            for result, shape in zip(results, call.result, strict=True):
                assert result.shape == (*shape, 50)
                integer = np.issubdtype(result.dtype, np.integer)
                assert integer or result.dtype == np.result_type(*dtypes)
            _assert_close(results, expected, call.tolerance)


def check_no_columns(call: Call) -> None:
    for dtype in DTYPES:
        for result, shape in zip(call(**call.arrays(0, dtype)), call.result, strict=True):
            assert result.shape == (*shape, 0)
            assert np.issubdtype(result.dtype, np.integer) or result.dtype == dtype


def check_inputs_stay_untouched(call: Call) -> None:
    """They may be read-only, and no result shares their memory."""
    given = {**call.singles, **call.arrays()}
    locked = {name: frozen(x) for name, x in given.items()}
    with global_random_state_untouched():
        results = call(**locked)
    for name, x in given.items():
        assert (locked[name] == x).all()
        assert not any(np.shares_memory(result, locked[name]) for result in results)
    _assert_close(call(**given), results, 0)


def check_any_layout(call: Call) -> None:
    arrays = call.arrays()
    singles = {k: x for k, x in call.singles.items() if np.ndim(x)}
    expected = call(**arrays)
    for layout in (scattered, np.asfortranarray):
        turned = {name: layout(np.array(x)) for name, x in {**singles, **arrays}.items()}
        _assert_close(call(**turned), expected, call.tolerance)


def check_columns_stand_for_themselves(call: Call) -> None:
    arrays = call.arrays()
    expected = tuple(result[..., ::3] for result in call(**arrays))
    _assert_close(call(**{k: x[..., ::3] for k, x in arrays.items()}), expected, call.tolerance)


def check_shapes_are_refused(call: Call) -> None:
    """With a message that names the argument, the shape expected and the shape got."""
    arrays = call.arrays(5)
    for number, (name, array) in enumerate(arrays.items()):
        wrong: list[tuple[int, ...]]
        if array.ndim == 1:
            expected, wrong = f"({'5' if number else 'N'},)", [(), (1, 5), (5, 1), (3, 5)]
        else:
            rows = len(array)
            expected = f"({rows}, {'5' if number else 'N'})"
            wrong = [(), (rows,), (5, rows), (rows + 1, 5), (rows - 1, 5), (rows, 5, 1), (0, 5)]
        if number:
            wrong += [(*array.shape[:-1], n) for n in (0, 1, 4, 6)]
        for shape in wrong:
            message = f"{name} must have shape {expected}, got {shape}"
            with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
                call(**{**arrays, name: np.ones(shape, np.float32)})
    for name in (k for k, x in call.singles.items() if np.shape(x) == (3,)):
        for shape in ((), (2,), (4,), (3, 1), (1, 3)):
            message = f"{name} must have shape (3,), got {shape}"
            with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
                call(**{**arrays, name: np.ones(shape)})


CHECKS = {
    check.__name__.removeprefix("check_"): check
    for check in (
        check_shape_and_dtype,
        check_no_columns,
        check_inputs_stay_untouched,
        check_any_layout,
        check_columns_stand_for_themselves,
        check_shapes_are_refused,
    )
}
"""Each takes a `Call`."""
