"""The variance of a pixel's mean, estimated from the differences between its parts.

With independent samples the variance of a mean of n falls as 1 / n. With a (0, 2)-sequence it falls faster, as
n^-2a with an order a between 1/2 and about 3/4 on edges and up to 1 on smooth ground, because later samples fill the
gaps that earlier ones have left: their errors are correlated negatively. Two parts of a pixel's samples then lie
further apart than independent ones would, and the usual estimate s^2 / n is too large. Here the order is measured
from the picture itself, and what follows from it for two parts of n and m samples is computed:

    V(n) = v n^-2a                                      variance of a mean of n
    2 n m C = (n + m)^2 V(n + m) - n^2 V(n) - m^2 V(m)  covariance of two parts, since together they make n + m
    E (A - B)^2 = V(n) + V(m) - 2 C                     what is seen
"""

import math

INDEPENDENT = 0.5
"""Order of independent samples."""

EXPECTED, DEVIATION = 0.62, 0.12
"""Mean and standard deviation of the order over scenes, by Sobol points."""

BLUR = 1.2
"""Standard deviation of an order that is measured on one pixel."""

BELIEVED = 0.9
"""Share of a measured order's excess over INDEPENDENT that is used. The order falls with the number of samples: small
nets reduce the error of the smooth part of a pixel, and that of its edges in many dimensions remains. So the order that
few samples show is too good for many."""


def variance_share(n: int, m: int, total: int, order: float) -> float:
    """Ratio of the variance of a mean of ``total`` samples and the squared difference of means of n and m samples.

    Returns
    -------
    float
        V(total) / E (A - B)^2; with independent samples (1 / total) / (1 / n + 1 / m).
    """
    power = 2.0 - 2.0 * order

    def variance(k: int) -> float:
        return math.pow(k, power - 2.0)

    covariance = (math.pow(n + m, power) - math.pow(n, power) - math.pow(m, power)) / (2.0 * n * m)
    return variance(total) / (variance(n) + variance(m) - 2.0 * covariance)


def measured_order(of_halves: float, of_quarters: float, pixels: float) -> float:
    """Order of convergence from squared differences, summed over the same pixels.

    Their ratio is 2^-2a. If few pixels have most of the sums, the ratio is nearly chance, and the expected order has
    more weight.

    Parameters
    ----------
    of_halves : between two parts of 2 n samples each
    of_quarters : between two parts of n samples each
    pixels : by how many the sums are made up, effectively

    Returns
    -------
    float
        BELIEVED of it, between INDEPENDENT and 1; INDEPENDENT where nothing differs.
    """
    if of_halves <= 0.0 or of_quarters <= 0.0:
        return INDEPENDENT
    share = 1 / (1 + BLUR**2 / (pixels * DEVIATION**2))
    order = share * -0.5 * math.log2(of_halves / of_quarters) + (1 - share) * EXPECTED
    return INDEPENDENT + BELIEVED * min(max(order - INDEPENDENT, 0.0), INDEPENDENT)
