"""How many numbers a function has drawn from the generator that it was handed."""

from typing import Any

MULTIPLIER = 0x2360ED051FC65DA44385DF649FCCF645
WORD = 1 << 128


def drawn(before: Any, after: Any) -> int:
    """64-bit numbers that a PCG64 generator gave between two states of its bit generator.

    Source: Brown, "Random number generation with arbitrary strides", 1994.
    """
    state, end, plus = before["state"]["state"], after["state"]["state"], before["state"]["inc"]
    factor, bit, steps = MULTIPLIER, 1, 0
    while state != end and bit < WORD:
        if (state ^ end) & bit:
            state = (state * factor + plus) % WORD
            steps |= bit
        bit <<= 1
        plus = (factor + 1) * plus % WORD
        factor = factor * factor % WORD
    return steps
