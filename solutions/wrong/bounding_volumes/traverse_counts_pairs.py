"""Counts the boxes of two children as one test."""

FUNCTION = "traverse"
CAUGHT_BY = "counts"
MISTAKE = "pair-is-one-test"
SAYS = "The boxes of two children count as one test."

_right = traverse


def traverse(hierarchy, p0, p1, p2, origins, directions):
    """The way through it, and half of the tests."""
    triangle, t, boxes, tests = _right(hierarchy, p0, p1, p2, origins, directions)
    return triangle, t, boxes // 2 + 1, tests
