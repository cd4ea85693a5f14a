"""media - light through fog: what is lost on the way, where light is scattered, and where it goes from there.

A medium takes sigma_t of the light on each unit of length, its extinction, of which sigma_s goes on in other
directions; both are red, green and blue. ValueError is raised for arrays of other shapes and for numbers out of range.
"""

import numpy as np


def transmittance(sigma_t, distance):
    """The share of the light that is left after a way through an even medium: exp(-sigma_t distance).

    Parameters
    ----------
    sigma_t : (3,) floating >= 0 [1/length]
    distance : (N,) floating >= 0

    Returns
    -------
    (3, N) in [0, 1], of the dtype of distance

    Task: media.transmittance. Source: Bouguer, 1729; Lambert, 1760; Beer, 1852.
    """
    _check_arrays(sigma_t=(sigma_t, 3), distance=(distance, "N"))
    _check_not_below_zero(sigma_t=sigma_t)
    # TODO media.transmittance: write your solution here
    raise NotImplementedError("media.transmittance: not written yet")


def free_flight(sigma_t, weights, u):
    """Random distances to the next place where light is stopped, as dense as one channel of it is stopped.

    Parameters
    ----------
    sigma_t : (3,) floating >= 0 [1/length]
    weights : (3,) floating >= 0 that add up to 1: how probable each channel is
    u : (2, N) floating in [0, 1)
        u[0] chooses the channel: red below the first weight, green below the first two, else blue. u[1] is the share of
        this channel's light that is stopped before.

    Returns
    -------
    (N,) of the dtype of u; infinite where the channel isn't stopped at all

    Task: media.free_flight. Source: Pharr, Jakob and Humphreys, "Physically based rendering", 2016, 15.2.
    """
    _check_arrays(sigma_t=(sigma_t, 3), weights=(weights, 3), u=(u, 2, "N"))
    _check_not_below_zero(sigma_t=sigma_t, weights=weights)
    # TODO media.free_flight: write your solution here
    raise NotImplementedError("media.free_flight: not written yet")


def free_flight_pdf(sigma_t, weights, distance):
    """The density of the distances of free_flight, whichever channel has been chosen.

    Parameters
    ----------
    sigma_t : (3,) floating >= 0 [1/length]
    weights : (3,) floating >= 0 that add up to 1
    distance : (N,) floating >= 0

    Returns
    -------
    (N,) [1/length], of the dtype of distance
        The mean over the channels, by their weights, of sigma_t exp(-sigma_t distance).

    Task: media.free_flight_pdf. Source: Pharr, Jakob and Humphreys, 2016, 15.2.
    """
    _check_arrays(sigma_t=(sigma_t, 3), weights=(weights, 3), distance=(distance, "N"))
    _check_not_below_zero(sigma_t=sigma_t, weights=weights)
    # TODO media.free_flight_pdf: write your solution here
    raise NotImplementedError("media.free_flight_pdf: not written yet")


def henyey_greenstein(cos, g):
    """Henyey and Greenstein's phase function: (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)).

    Parameters
    ----------
    cos : (N,) floating in [-1, 1], of the angle between the ways of the light before and after: 1 is straight on
    g : float, -0.99 to 0.99: the mean of cos. Above 0 light goes on forwards, below 0 it turns back

    Returns
    -------
    (N,) [1/sr], of the dtype of cos; over all directions it integrates to 1

    Task: media.henyey_greenstein. Source: Henyey and Greenstein, "Diffuse radiation in the galaxy", 1941.
    """
    _check_arrays(cos=(cos, "N"))
    _check_g(g)
    # TODO media.henyey_greenstein: write your solution here
    raise NotImplementedError("media.henyey_greenstein: not written yet")


def sample_henyey_greenstein(direction, g, u):
    """Random directions in which scattered light goes on, as dense as henyey_greenstein, and that density.

    Parameters
    ----------
    direction : (3, N) floating, unit vectors: the way that the light went before
    g : float, -0.99 to 0.99
    u : (2, N) floating in [0, 1)

    Returns
    -------
    directions : (3, N) unit vectors, of the dtype of direction and u, or NumPy's promotion of the two
        How u leads to them is free, as long as small steps within [0, 1) x [0, 1) are small steps of them.
    density : (N,) [1/sr], of the same dtype

    Task: media.sample_henyey_greenstein. Source: Witt, "Multiple scattering in reflection nebulae", 1977.
    """
    _check_arrays(direction=(direction, 3, "N"), u=(u, 2, "N"))
    _check_g(g)
    # TODO media.sample_henyey_greenstein: write your solution here
    raise NotImplementedError("media.sample_henyey_greenstein: not written yet")


def delta_tracking(grid, majorant, origin, direction, limit, u):
    """Distances to where a medium of uneven density stops light, by steps through an even one that is as dense as any.

    Step k goes on by -ln(1 - u[0, k]) / majorant. Where it ends, u[1, k] says whether the medium is really there: with
    the probability density / majorant light is stopped; else it goes on as if nothing had been there.

    Parameters
    ----------
    grid : (X, Y, Z) floating >= 0 densities, from cell to cell of the unit cube; `density` reads them [1/distance]
    majorant : float > 0, no density is larger
    origin, direction : (3, N) floating, where rays start and what they go for a distance of 1; of any length
    limit : (N,) floating >= 0, the distance where the medium ends
    u : (2, K, N) floating in [0, 1), two numbers for each of K steps

    Returns
    -------
    distance : (N,) where light is stopped; limit where it isn't; and where all steps are used up before, the distance
        that they have come. Of the dtype of origin, direction, limit and u, or NumPy's promotion of these
    collided : (N,) bool, whether it is stopped there

    Task: media.delta_tracking. Source: Woodcock et al., 1965; Raab, Seibert and Keller, 2008.
    """
    _check_rays(origin, direction, limit, u, 2, "K", "N")
    _check_grid(grid, majorant)

    def density(distance):
        # At a distance (N,) along each ray.
        return _density_at(grid, origin + distance * direction)

    # TODO media.delta_tracking: write your solution here
    raise NotImplementedError("media.delta_tracking: not written yet")


def ratio_tracking(grid, majorant, origin, direction, limit, u):
    """An estimate of the light that gets through a medium of uneven density: each step keeps what isn't stopped there.

    Steps are as in `delta_tracking`. No light ends by chance: where a step ends it loses the share density / majorant.

    Parameters
    ----------
    grid, majorant, origin, direction, limit : as for `delta_tracking`
    u : (K, N) floating in [0, 1), a number for each of K steps

    Returns
    -------
    share : (N,) in [0, 1], of the dtype of origin, direction, limit and u, or NumPy's promotion of these
        Its mean over many u is the transmittance up to the distance that the steps have come.
    distance : (N,), of the same dtype: limit, or where all steps are used up before, the distance that they have come

    Task: media.ratio_tracking. Source: Novak, Selle and Jarosz, "Residual ratio tracking", 2014.
    """
    _check_rays(origin, direction, limit, u, "K", "N")
    _check_grid(grid, majorant)

    def density(distance):
        # At a distance (N,) along each ray.
        return _density_at(grid, origin + distance * direction)

    # TODO media.ratio_tracking: write your solution here
    raise NotImplementedError("media.ratio_tracking: not written yet")


def equiangular(origin, direction, light, limit, u):
    """Random distances along rays, dense where a lamp is near: the lamp sees equal angles of them equally often.

    Parameters
    ----------
    origin, direction : (3, N) floating, of the rays; unit vectors
    light : (3, N) floating, a point on the lamp for each ray
    limit : (N,) floating > 0, distances are from 0 to limit
    u : (N,) floating in [0, 1)

    Returns
    -------
    distance : (N,) that rises with u, of the dtype of the arguments, or NumPy's promotion of these
    density : (N,) [1/length], of the same dtype
        With D from the lamp to the line of the ray, and t from the nearest point of the line: D / (A (D^2 + t^2)),
        where A is the angle that the lamp sees from 0 to limit. D counts as at least a millionth of limit.

    Task: media.equiangular. Source: Kulla and Fajardo, "Importance sampling techniques for path tracing in
    participating media", 2012.
    """
    _check_rays(origin, direction, limit, u, "N")
    _check_arrays(origin=(origin, 3, "N"), light=(light, 3, "N"))
    # TODO media.equiangular: write your solution here
    raise NotImplementedError("media.equiangular: not written yet")


def in_scattering(sigma_s, sigma_t, distance, beyond, phase, density):
    """An estimate of the light that an even medium scatters into a ray, by one place on it.

    Parameters
    ----------
    sigma_s : (3,) floating >= 0 [1/length], what is scattered
    sigma_t : (3,) floating >= 0 [1/length], what is lost
    distance : (N,) floating >= 0, from the eye to the place, all of it through the medium
    beyond : (N,) floating >= 0, from the place to the lamp, all of it through the medium
    phase : (N,) floating [1/sr], the phase function from the lamp to the eye
    density : (N,) floating > 0 [1/length], of the place among all of the ray

    Returns
    -------
    (3, N), of the dtype of distance, beyond, phase and density, or NumPy's promotion of these
        Radiance for light of which 1 would arrive at the place without the medium.

    Task: media.in_scattering. Source: Kulla and Fajardo, 2012.
    """
    _check_arrays(
        sigma_s=(sigma_s, 3),
        sigma_t=(sigma_t, 3),
        distance=(distance, "N"),
        beyond=(beyond, "N"),
        phase=(phase, "N"),
        density=(density, "N"),
    )
    _check_not_below_zero(sigma_s=sigma_s, sigma_t=sigma_t)
    # TODO media.in_scattering: write your solution here
    raise NotImplementedError("media.in_scattering: not written yet")


def _density_at(grid, points):
    """Densities (N,) of a grid (X, Y, Z) at points (3, N): its cells fill the cube from 0 to 1, and each value is in
    the middle of its cell. Between them it is trilinear, and beyond the outermost as there.
    """
    size = np.array(grid.shape)[:, None]
    place = np.clip(points * size - 0.5, 0, size - 1)
    low = np.minimum(place.astype(np.int64), np.maximum(size - 2, 0))
    high = np.minimum(low + 1, size - 1)
    found = 0
    for corner in np.ndindex(2, 2, 2):
        upper = np.array(corner)[:, None] == 1
        share = np.where(upper, place - low, 1 - (place - low)).prod(axis=0)
        found = found + share * grid[tuple(np.where(upper, high, low))]
    return found


def _check_arrays(**arrays):
    known = {}
    for name, (array, *sizes) in arrays.items():
        got = np.shape(array)
        wanted = tuple(known.get(size, size) for size in sizes)
        right = len(got) == len(sizes)
        if not right or any(
            isinstance(a, int) and a != b for a, b in zip(wanted, got, strict=True)
        ):
            text = ", ".join(map(str, wanted)) + "," * (len(sizes) == 1)
            raise ValueError(f"{name} must have shape ({text}), got {got}")
        known.update({size: n for size, n in zip(sizes, got, strict=True) if isinstance(size, str)})


def _check_rays(origin, direction, limit, u, *sizes):
    _check_arrays(
        origin=(origin, 3, "N"), direction=(direction, 3, "N"), limit=(limit, "N"), u=(u, *sizes)
    )


def _check_not_below_zero(**colors):
    for name, color in colors.items():
        if not (np.asarray(color) >= 0).all():
            raise ValueError(f"{name} must be >= 0, got {color}")


def _check_g(g):
    if not -0.99 <= g <= 0.99:
        raise ValueError(f"g must be from -0.99 to 0.99, got {g}")


def _check_grid(grid, majorant):
    if np.ndim(grid) != 3:
        raise ValueError(f"grid must have shape (X, Y, Z), got {np.shape(grid)}")
    if not 0 < majorant < np.inf:
        raise ValueError(f"majorant must be finite and > 0, got {majorant}")
