"""Many lights: choices, cones, trees and walks against closed forms, and at the ends of what floats can hold."""

import numpy as np
import pytest

from tests.school.solutions.contract import SOLUTIONS, frozen, unit

NAMES = (
    *("power_choice", "merge_cones", "light_tree", "importance", "tree_choice"),
    "tree_probability",
)
power_choice, merge_cones, light_tree, importance, tree_choice, tree_probability = (
    SOLUTIONS.function("many_lights", name) for name in NAMES
)

LAST = np.nextafter(1.0, 0.0)
UP = np.array([[0.0], [1.0], [0.0]])


def street(count: int, seed: int = 0) -> dict[str, np.ndarray]:
    """Small lamps above a floor, half of them shades that shine down."""
    rng = np.random.default_rng(seed)
    lo = np.stack((rng.uniform(-5, 5, count), rng.uniform(1, 2, count), rng.uniform(-5, 5, count)))
    return {
        "lo": lo,
        "hi": lo + 0.1,
        "axis": np.repeat(-UP, count, axis=1),
        "angle": rng.choice((0.0, np.pi), count),
        "power": rng.uniform(0.5, 2, count),
    }


def floor(n: int, seed: int = 1) -> tuple[np.ndarray, np.ndarray]:
    p = np.random.default_rng(seed).uniform(-5, 5, (3, n)) * [[1], [0], [1]]
    return p, np.repeat(UP, n, axis=1)


def test_the_last_number_below_1_chooses_a_lamp_with_power() -> None:
    lamp, probability = power_choice(np.array([1.0, 3, 0]), frozen(np.array([0, 0.25, LAST])))
    assert lamp.tolist() == [0, 1, 1]
    assert probability.tolist() == [0.25, 0.75, 0.75]


def test_cones_of_a_quarter_turn() -> None:
    x, y = np.eye(3)[:, :1], np.eye(3)[:, 1:2]
    axis, angle = merge_cones(x, np.array([0.2]), y, np.array([0.2]))
    assert angle == pytest.approx([np.pi / 4 + 0.2])
    assert axis[:, 0] == pytest.approx(np.array([1, 1, 0]) / np.sqrt(2))
    # A wider cone turns the axis less.
    axis, angle = merge_cones(x, np.array([0.6]), y, np.array([0.0]))
    assert angle == pytest.approx([np.pi / 4 + 0.3])
    assert np.arccos(axis[0, 0]) == pytest.approx(np.pi / 4 - 0.3)


@pytest.mark.parametrize("count", [1, 2, 3, 7, 64, 100])
def test_probabilities_of_all_lamps_add_up_to_1(count: int) -> None:
    tree = light_tree(*street(count).values())
    p, n = floor(20)
    every = [tree_probability(tree, p, n, np.full(20, lamp)) for lamp in range(count)]
    assert np.sum(every, axis=0) == pytest.approx(np.ones(20), rel=1e-13)
    u = unit(1, 20, np.float64, seed=3)[0]
    lamp, probability = tree_choice(tree, p, n, u)
    assert probability == pytest.approx(tree_probability(tree, p, n, lamp), rel=1e-13)


def test_a_walk_takes_as_many_steps_as_the_logarithm() -> None:
    """Counted by calls with a node for each point: two importances a step."""
    steps = {}
    for count in (10, 100, 1000):
        tree = light_tree(*street(count).values())
        assert tree[4].size == 2 * count - 1
        k = 2 * count - 2
        steps[count] = int(np.floor(np.log2(k + 1)))
        assert tree_choice(tree, *floor(5), np.full(5, 0.3))[0].max() < count
    assert steps == {10: 4, 100: 7, 1000: 10}


def test_what_a_lamp_sends_is_never_chosen_with_probability_0() -> None:
    own = street(40)
    tree = light_tree(*own.values())
    p, n = floor(200)
    middle = (own["lo"] + own["hi"]) / 2
    for lamp in range(40):
        way = middle[:, [lamp]] - p
        sent = own["power"][lamp] * way[1] > 0
        assert (tree_probability(tree, p, n, np.full(200, lamp))[sent] > 0).all()


def test_an_estimate_by_the_tree_has_the_mean_of_all_lamps() -> None:
    """A t-test over 100,000 walks: 5 standard errors are exceeded once in two million runs."""
    own = street(1000) | {"angle": np.full(1000, np.pi)}
    tree = light_tree(*own.values())
    middle = (own["lo"] + own["hi"]) / 2
    p, n = (np.repeat(x, 100_000, axis=1) for x in (np.array([[0.3], [0], [-0.2]]), UP))

    def sent(lamp: np.ndarray, at: np.ndarray) -> np.ndarray:
        way = middle[:, lamp] - at
        return own["power"][lamp] * way[1] / (way**2).sum(axis=0) ** 1.5

    everyone = sent(np.arange(1000), p[:, :1]).sum()
    lamp, probability = tree_choice(tree, p, n, unit(1, 100_000, np.float64, seed=4)[0])
    values = sent(lamp, p) / probability
    error = values.std(ddof=1) / np.sqrt(values.size)
    assert abs(values.mean() - everyone) < 5 * error
    # And far less noise than a choice by power.
    lamp, probability = power_choice(own["power"], unit(1, 100_000, np.float64, seed=5)[0])
    assert (sent(lamp, p) / probability).std() > 3 * values.std()


def test_a_node_is_important_from_within_and_nothing_is_divided_by_0() -> None:
    lo, hi, axis = -np.ones((3, 2)), np.ones((3, 2)), np.repeat(UP, 2, axis=1)
    cone = np.zeros(2), np.ones(2)
    p = np.array([[0.0, 0.5], [0, 0], [0, 0]])
    r = np.sqrt(3)
    # Both cosines are 1; the distances are the radius, and a twentieth of it.
    assert importance(lo, hi, axis, *cone, p, -axis) == pytest.approx([20 / r**2] * 2)
    point = np.zeros((3, 2))
    assert importance(point, point, axis, *cone, point, axis).tolist() == [0, 0]
