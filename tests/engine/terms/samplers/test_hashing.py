"""Hashing: every bit of the input reaches every bit of the output, and salts give independent words."""

import numpy as np

from course.engine.terms.samplers.hashing import combine, hash_words, mix

N = 1 << 16


def test_mix_is_splitmix64() -> None:
    # The first outputs of the published generator for state 0: it adds the golden gamma, then mixes.
    gamma = 0x9E3779B97F4A7C15
    found = [mix(i * gamma & (1 << 64) - 1) for i in range(3)]
    assert found == [0xE220A8397B1DCDAF, 0x6E789E6AA1B965F4, 0x06C45D188009454F]


def test_combine_depends_on_every_key_and_on_their_order() -> None:
    keys = [(0,), (0, 0), (1, 0), (0, 1), (1, 2), (2, 1), (1, 2, 0), (1, 2, 3)]
    assert len({combine(*key) for key in keys}) == len(keys)
    assert all(0 <= combine(*key) < 1 << 64 for key in keys)


def test_different_keys_collide_no_more_often_than_random_words() -> None:
    (words,) = hash_words(np.arange(N, dtype=np.uint32), combine(3, 1))
    # Expected: N^2 / 2 / 2^32 = 0.5 collisions; 8 or more by chance in 1 of 10^7 seeds.
    assert N - len(np.unique(words)) < 8


def test_one_bit_of_the_key_changes_half_of_the_bits() -> None:
    keys = np.arange(N, dtype=np.uint32)
    salt = combine(0, 0)
    plain = hash_words(keys, salt)[0]
    for bit in (0, 1, 7, 15, 16, 31):
        changed = plain ^ hash_words(keys ^ np.uint32(1 << bit), salt)[0]
        for place in range(32):
            share = np.mean((changed >> np.uint32(place)) & np.uint32(1))
            # Pairs k, k ^ bit are counted twice, so sigma is 0.5 / sqrt(N / 2) = 0.0028; 192 checks at
            # 6 sigma fail falsely once in 2 million seeds.
            assert abs(share - 0.5) < 0.017, (bit, place)


def test_neighbouring_pixels_are_uncorrelated() -> None:
    words = hash_words(np.arange(N, dtype=np.uint32), combine(0, 0))[0] / 2.0**32 - 0.5
    for step in (1, 2, 64, 640):
        correlation = np.mean(words[:-step] * words[step:]) * 12
        # sigma = 1 / sqrt(N) = 0.0039
        assert abs(correlation) < 0.024, step


def test_salts_are_uncorrelated() -> None:
    keys = np.arange(N, dtype=np.uint32)
    salts = [combine(seed, dimension) for seed in (0, 1) for dimension in range(4)]
    correlation = np.corrcoef(hash_words(keys, *salts))
    np.fill_diagonal(correlation, 0)
    assert np.abs(correlation).max() < 0.024


def test_words_are_uniform() -> None:
    (words,) = hash_words(np.arange(N, dtype=np.uint32), combine(9, 4))
    count = np.bincount(words >> np.uint32(24), minlength=256)
    expected = N / 256
    chi_squared = ((count - expected) ** 2 / expected).sum()
    # 255 degrees of freedom, sigma = sqrt(510) = 22.6: 6 sigma on either side.
    assert 120 < chi_squared < 391


def test_a_key_has_one_word_wherever_it_stands() -> None:
    keys = np.arange(1000, dtype=np.uint32)
    salts = combine(5), combine(6)
    whole = hash_words(keys, *salts)
    assert whole.shape == (2, 1000)
    assert np.array_equal(hash_words(keys[137:731], *salts), whole[:, 137:731])
    assert np.array_equal(hash_words(keys[::-1], *salts[::-1]), whole[::-1, ::-1])
    assert keys[3] == 3, "keys are not written to"
    assert whole.dtype == np.uint32
