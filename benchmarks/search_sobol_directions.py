"""Search for the direction numbers in course/core/sobol_directions.py (run by hand, minutes).

A Sobol dimension is fixed by a primitive polynomial over GF(2) of degree s and by s odd initial numbers
m_1 < 2, m_2 < 4, ..., m_s < 2^s. Any choice is a (0, 1)-sequence, but pairs of dimensions differ in how evenly they
fill the square, and a renderer takes its dimensions in pairs (a pixel, a light, a lens). The search draws the initial
numbers at random and keeps the draw with the smallest t-values of its pairs over the first 2 .. 2^MAX_LOG2 points:
its own partner counts most, then the first four dimensions, then the others near it.

    python benchmarks/search_sobol_directions.py > course/core/sobol_directions.py
"""

from __future__ import annotations

import random
import sys

DIMENSIONS = 64
BITS = 32
DRAWS = 300
PAIR_SIZES = (2, 3, 4, 5, 6, 7, 8, 9)
FOUR_SIZES = (4, 6, 8)
"""Logarithms of the numbers of points for which t-values are counted."""


def primitive_polynomials(degree: int) -> list[int]:
    """Primitive polynomials over GF(2), bit k the coefficient of x^k, found by the order of x."""
    order = (1 << degree) - 1
    factors = [
        p
        for p in range(2, order + 1)
        if order % p == 0 and all(p % q for q in range(2, int(p**0.5) + 1))
    ]

    def power_of_x(exponent: int, polynomial: int) -> int:
        result, base = 1, 2
        if degree == 1:
            base = 2 ^ polynomial if 2 & (1 << degree) else 2
        while exponent:
            if exponent & 1:
                result = multiply(result, base, polynomial)
            base = multiply(base, base, polynomial)
            exponent >>= 1
        return result

    def multiply(a: int, b: int, polynomial: int) -> int:
        product = 0
        while b:
            if b & 1:
                product ^= a
            b >>= 1
            a <<= 1
            if a >> degree & 1:
                a ^= polynomial
        return product

    found = []
    for middle in range(1 << max(degree - 1, 0)):
        polynomial = 1 << degree | middle << 1 | 1
        if power_of_x(order, polynomial) == 1 and all(
            power_of_x(order // p, polynomial) != 1 for p in factors
        ):
            found.append(polynomial)
    return found


def directions(polynomial: int, initial: list[int]) -> list[int]:
    """The BITS direction numbers, each left-aligned in BITS bits (Bratley & Fox 1988)."""
    degree = polynomial.bit_length() - 1
    m = list(initial)
    for k in range(degree, BITS):
        value = m[k - degree] ^ m[k - degree] << degree
        for j in range(1, degree):
            if polynomial >> (degree - j) & 1:
                value ^= m[k - j] << j
        m.append(value)
    return [m[k] << (BITS - 1 - k) for k in range(BITS)]


def rows(columns: list[int], log2: int) -> list[int]:
    """The first log2 output digits as linear forms in the log2 low digits of the index."""
    return [
        sum((columns[k] >> (BITS - 1 - digit) & 1) << k for k in range(log2))
        for digit in range(log2)
    ]


def t_value(forms: list[list[int]], log2: int) -> int:
    """Quality of the first 2^log2 points in some dimensions: 0 is perfect stratification in every dyadic shape.

    ``forms`` holds the ``rows`` of each dimension.
    """
    for strength in range(log2, 0, -1):
        shapes = _compositions(strength, len(forms))
        if all(
            _independent([row for rows_, n in zip(forms, shape, strict=True) for row in rows_[:n]])
            for shape in shapes
        ):
            return log2 - strength
    return log2


def _compositions(total: int, parts: int) -> list[tuple[int, ...]]:
    if parts == 1:
        return [(total,)]
    return [
        (first, *rest)
        for first in range(total + 1)
        for rest in _compositions(total - first, parts - 1)
    ]


def _independent(forms: list[int]) -> bool:
    basis: dict[int, int] = {}
    for form in forms:
        row = form
        while row:
            top = row.bit_length()
            if top not in basis:
                basis[top] = row
                break
            row ^= basis[top]
        if not row:
            return False
    return True


def cost(pair: list[list[int]], chosen: list[list[int]]) -> float:
    """Weighted sum of squared t-values of a new pair: by itself, with the pixel's pair, and with its neighbours."""
    total = 0.0
    for log2 in PAIR_SIZES:
        total += 20 * t_value([rows(c, log2) for c in pair], log2) ** 2
        for columns in pair:
            for other in chosen[:4] + chosen[4:][-6:]:
                total += t_value([rows(columns, log2), rows(other, log2)], log2) ** 2
    for log2 in FOUR_SIZES:
        total += 15 * t_value([rows(c, log2) for c in chosen[:2] + pair], log2) ** 2
    return total


def main() -> None:
    """Search, and print the module."""
    rng = random.Random(1984)
    polynomials = [p for degree in range(1, 10) for p in primitive_polynomials(degree)]
    # The first pair is a (0, 2)-sequence: the radical inverse and the polynomial x + 1.
    table: list[tuple[int, list[int]]] = [(0, []), (polynomials[0], [1])]
    chosen = [[1 << (BITS - 1 - k) for k in range(BITS)], directions(polynomials[0], [1])]
    for first in range(2, DIMENSIONS, 2):
        pair = polynomials[first - 1 : first + 1]
        best: tuple[float, list[list[int]], list[list[int]]] | None = None
        for _ in range(DRAWS):
            initial = [
                [2 * rng.randrange(1 << k) + 1 for k in range(p.bit_length() - 1)] for p in pair
            ]
            columns = [directions(p, m) for p, m in zip(pair, initial, strict=True)]
            price = cost(columns, chosen)
            if best is None or price < best[0]:
                best = (price, initial, columns)
        assert best is not None
        chosen += best[2]
        table += zip(pair, best[1], strict=True)
        print(len(chosen), best[0], file=sys.stderr, flush=True)
    print('"""Primitive polynomials and initial direction numbers, one Sobol dimension a row.\n')
    print(
        "Found by benchmarks/search_sobol_directions.py, which says how; the first dimension is the radical"
    )
    print('inverse in base 2 and has neither.\n"""\n')
    print("POLYNOMIALS_AND_INITIAL_NUMBERS: tuple[tuple[int, tuple[int, ...]], ...] = (")
    for polynomial, initial in table:
        print(f"    ({polynomial}, {tuple(initial)}),")
    print(")")


if __name__ == "__main__":
    main()
