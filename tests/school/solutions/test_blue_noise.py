"""Blue noise: orders, masks, moved points, spectra and blurred errors against what is known of them."""

import numpy as np
import pytest

from tests.school.solutions.contract import SOLUTIONS, frozen

NAMES = (
    *("z_order", "shuffled_z_order", "void_and_cluster", "dithered_points", "radial_spectrum"),
    "perceptual_rmse",
)
z_order, shuffled_z_order, void_and_cluster, dithered_points, radial_spectrum, perceptual_rmse = (
    SOLUTIONS.function("blue_noise", name) for name in NAMES
)


def square(side: int) -> tuple[np.ndarray, np.ndarray]:
    y, x = np.divmod(np.arange(side * side), side)
    return x, y


def noise(side: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=(side, side))


def test_the_curve_of_the_first_sixteen_pixels() -> None:
    expected = [[0, 1, 4, 5], [2, 3, 6, 7], [8, 9, 12, 13], [10, 11, 14, 15]]
    assert z_order(*square(4)).reshape(4, 4).tolist() == expected


def test_the_last_pixel_has_the_last_number() -> None:
    last = frozen(np.array([65535], np.uint16))
    assert z_order(last, last).tolist() == [2**32 - 1]


@pytest.mark.parametrize("levels", [0, 1, 4, 6])
def test_a_shuffled_curve_visits_every_pixel_once(levels: int) -> None:
    order = shuffled_z_order(*square(2**levels), levels, 7)
    assert np.array_equal(np.sort(order), np.arange(4**levels))


def test_a_part_of_a_larger_square_has_the_same_parts_in_a_stretch() -> None:
    order = shuffled_z_order(*square(64), 6, 3).reshape(64, 64)
    for row, column in ((0, 0), (16, 48), (32, 16)):
        part = order[row : row + 16, column : column + 16]
        assert part.max() - part.min() == 255


def test_a_mask_has_next_to_no_low_frequencies() -> None:
    u = np.random.default_rng(2).random((32, 32))
    mask, white = (a / 1024 for a in (void_and_cluster(u, 1.9), u * 1024))
    low, own = (radial_spectrum(m - m.mean(), 8)[:2].mean() for m in (white, mask))
    # Measured: a thousandth; one in 50 would be another mask.
    assert own < low / 50


def test_any_number_of_first_pixels_is_spread_evenly() -> None:
    ranks = void_and_cluster(np.random.default_rng(4).random((24, 24)), 1.5)
    for count in (58, 144, 288):
        blocks = (ranks < count).reshape(4, 6, 4, 6).sum(axis=(1, 3))
        assert abs(blocks - count / 16).max() < 3


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (3, 2), (5, 9)])
def test_small_masks_have_every_rank(shape: tuple[int, int]) -> None:
    ranks = void_and_cluster(np.random.default_rng(0).random(shape), 1.5)
    assert np.array_equal(np.sort(ranks, axis=None), np.arange(ranks.size))


def test_equal_numbers_are_no_endless_loop() -> None:
    ranks = void_and_cluster(np.zeros((16, 16)), 1.5)
    assert np.array_equal(np.sort(ranks, axis=None), np.arange(256))


def test_moved_points_of_all_ranks_are_even() -> None:
    mask = np.stack((np.arange(16), np.arange(16)[::-1])).reshape(2, 4, 4)
    x, y = square(4)
    moved = dithered_points(np.array([[0.0, 0.5], [0.0, 0.5]]), mask, x + 8, y + 4)
    assert moved[0, :, 0] == pytest.approx((np.arange(16) + 0.5) / 16)
    assert moved[1, ::-1, 0] == pytest.approx((np.arange(16) + 0.5) / 16)
    assert moved[0, :, 1] == pytest.approx(((np.arange(16) + 0.5) / 16 + 0.5) % 1)


def test_white_noise_has_its_variance_at_every_frequency() -> None:
    spectrum = np.mean([radial_spectrum(noise(64, seed), 8) for seed in range(30)], axis=0)
    # The mean of 30 times 40 or more powers, each with a standard deviation of 1 (and half of them independent): 0.041;
    # 8 of these once in 1e15 times.
    assert spectrum == pytest.approx(np.ones(8), abs=0.33)


def test_a_wave_on_the_border_of_a_bin_is_in_the_lower_one() -> None:
    wave = np.tile(np.cos(np.pi / 2 * np.arange(32)), (32, 1))
    spectrum = radial_spectrum(wave, 4)
    assert np.flatnonzero(spectrum > 1e-9).tolist() == [1]


def test_a_blur_keeps_the_mean_and_cancels_a_chessboard() -> None:
    x, y = square(16)
    board = np.where((x + y) % 2, 1.0, -1.0).reshape(16, 16)
    assert perceptual_rmse(board, 1.5) < 1e-8
    assert perceptual_rmse(board + 3, 1.5) == pytest.approx(3)


def test_white_noise_is_seen_as_by_the_sum_of_squared_weights() -> None:
    # The sum of squared weights of a wide Gaussian is 1 / (4 pi sigma^2).
    seen = np.sqrt(np.mean([perceptual_rmse(noise(64, s), 2.0) ** 2 for s in range(40)]))
    # Some 40 * 64^2 / (8 pi 2^2) independent values: 1.75% of the root; 8 of these once in 1e15 times.
    assert seen == pytest.approx(1 / np.sqrt(16 * np.pi), rel=0.14)


@pytest.mark.parametrize(
    ("call", "told"),
    [
        (lambda: z_order(np.zeros(3), np.zeros(3, int)), "x must be an array of integers"),
        (lambda: z_order(np.zeros(3, int), np.zeros(4, int)), r"y must have shape \(3,\)"),
        (lambda: z_order(np.array([1 << 16]), np.array([0])), r"x must be in \[0, 65536\)"),
        (lambda: shuffled_z_order(np.array([4]), np.array([0]), 2, 0), r"x must be in \[0, 4\)"),
        (lambda: shuffled_z_order(np.array([0]), np.array([0]), 16, 0), "levels must be"),
        (lambda: shuffled_z_order(np.array([0]), np.array([0]), 2, -1), "seed must be"),
        (lambda: void_and_cluster(np.zeros((0, 2)), 1.5), "u must have shape"),
        (lambda: void_and_cluster(np.zeros((2, 2)), 0), "sigma must be > 0"),
        (lambda: radial_spectrum(np.zeros((4, 8)), 3), "bins must be an integer from 1"),
        (lambda: perceptual_rmse(np.zeros(4), 1), "error must have shape"),
    ],
)
def test_what_is_not_legal_is_refused(call, told: str) -> None:
    with pytest.raises(ValueError, match=told):
        call()
