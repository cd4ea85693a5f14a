"""photon_mapping - light that is followed from the lamps: caustics, and light that comes by way of walls.

A photon is a ray from a lamp that carries some of its power. Where it meets a matte surface it is kept, and goes on by
chance. Afterwards the photons that lie around a point say how much light arrives there. Powers are red, green and blue
[W]. ValueError is raised for arrays of other shapes and for numbers out of range.
"""

import numpy as np


def emit_cone(axis, cos_edge, intensity, count, u):
    """Photons of a lamp that is a point and shines alike into all directions of a cone.

    Parameters
    ----------
    axis : (3,) floating, unit vector: the middle of the cone
    cos_edge : float, -1 <= cos_edge < 1: cosine of the angle from the axis to the edge. At -1 the cone is everything
    intensity : (3,) floating >= 0 [W/sr], in each direction of the cone
    count : int >= 1, how many photons leave the lamp in all; N of them are made here
    u : (2, N) floating in [0, 1)

    Returns
    -------
    direction : (3, N) unit vectors, of the dtype of u, uniform over the solid angle of the cone
        How u leads to them is free, as long as small steps within [0, 1) x [0, 1) are small steps of them.
    power : (3, N) [W], of the same dtype: count photons together have the power of the lamp

    Task: photon_mapping.emit_cone. Source: Jensen, "Global illumination using photon maps", 1996.
    """
    _check_arrays(axis=(axis, 3), intensity=(intensity, 3), u=(u, 2, "N"))
    _check_at_least_one(count)
    if not -1 <= cos_edge < 1:
        raise ValueError(f"cos_edge must be >= -1 and < 1, got {cos_edge}")
    # TODO photon_mapping.emit_cone: write your solution here
    raise NotImplementedError("photon_mapping.emit_cone: not written yet")


def emit_area(normal, radiance, area, count, u):
    """Photons of a lamp with an area, which leave from points that are uniform over it.

    A surface that looks equally bright from everywhere sends more light along its normal than to the side.

    Parameters
    ----------
    normal : (3, N) floating, unit vectors at the points where photons leave
    radiance : (3,) floating >= 0 [W/m^2/sr], of the lamp
    area : float > 0 [m^2], of the whole lamp
    count : int >= 1, how many photons leave the lamp in all; N of them are made here
    u : (2, N) floating in [0, 1)

    Returns
    -------
    direction : (3, N) unit vectors, of the dtype of normal and u, or NumPy's promotion of the two
        Their density is cos / pi. How u leads to them is free, as above.
    power : (3, N) [W], of the same dtype

    Task: photon_mapping.emit_area. Source: Jensen, 1996.
    """
    _check_arrays(normal=(normal, 3, "N"), radiance=(radiance, 3), u=(u, 2, "N"))
    _check_at_least_one(count)
    if not 0 < area < np.inf:
        raise ValueError(f"area must be > 0, got {area}")
    # TODO photon_mapping.emit_area: write your solution here
    raise NotImplementedError("photon_mapping.emit_area: not written yet")


def emit_directional(direction, irradiance, center, radius, count, u):
    """Photons of a lamp that is infinitely far away: all fly alike, from a disk that is as wide as the scene.

    Parameters
    ----------
    direction : (3,) floating, unit vector, the way of the light
    irradiance : (3,) floating >= 0 [W/m^2], on a surface that faces the light
    center : (3,) floating, of a ball around the scene
    radius : float, finite and >= 0, of that ball
    count : int >= 1, how many photons leave the lamp in all; N of them are made here
    u : (2, N) floating in [0, 1)

    Returns
    -------
    origin : (3, N), of the dtype of u
        Uniform on the disk of that radius that faces the light, before the ball, whose middle is at
        center - radius direction.
    power : (3, N) [W], of the same dtype

    Task: photon_mapping.emit_directional. Source: Jensen, 1996.
    """
    _check_arrays(
        direction=(direction, 3), irradiance=(irradiance, 3), center=(center, 3), u=(u, 2, "N")
    )
    _check_at_least_one(count)
    if not 0 <= radius < np.inf:
        raise ValueError(f"radius must be finite and >= 0, got {radius}")
    # TODO photon_mapping.emit_directional: write your solution here
    raise NotImplementedError("photon_mapping.emit_directional: not written yet")


def roulette(power, albedo, u):
    """Which photons a surface sends on, and with which power: as many survive as light does.

    A photon survives with probability q, where u < q. q is the largest channel of albedo times power, over the largest
    channel of power. So what survives is as strong as it was, and photons have about the same power.

    Parameters
    ----------
    power : (3, N) floating >= 0 [W]
    albedo : (3, N) floating in [0, 1], the share of the light that the surface returns
    u : (N,) floating in [0, 1)

    Returns
    -------
    survives : (N,) bool
    power : (3, N), of the dtype of power, albedo and u, or NumPy's promotion of these
        albedo power / q where a photon survives, and 0 where it ends. A photon without power ends.

    Task: photon_mapping.roulette. Source: Jensen, "Realistic image synthesis using photon mapping", 2001.
    """
    _check_arrays(power=(power, 3, "N"), albedo=(albedo, 3, "N"), u=(u, "N"))
    # TODO photon_mapping.roulette: write your solution here
    raise NotImplementedError("photon_mapping.roulette: not written yet")


def stored(matte, specular, diffuse):
    """Which photons are kept where they land, in two maps.

    Only matte surfaces keep photons: what a mirror or glass shows is found by rays from the eye. Light that comes
    straight from a lamp is left to shadow rays.

    Parameters
    ----------
    matte : (N,) bool, whether the surface is matte
    specular : (N,) whole numbers >= 0: how often the photon has been mirrored or refracted on its way
    diffuse : (N,) whole numbers >= 0: how often matte surfaces have sent it on

    Returns
    -------
    caustic : (N,) bool: kept in the map of caustics, of light that mirrors and glass alone have sent here
    indirect : (N,) bool: kept in the map of all light that some surface has sent here

    Task: photon_mapping.stored. Source: Jensen, 1996; the notation of ways by Heckbert, 1990.
    """
    _check_arrays(matte=(matte, "N"), specular=(specular, "N"), diffuse=(diffuse, "N"))
    # TODO photon_mapping.stored: write your solution here
    raise NotImplementedError("photon_mapping.stored: not written yet")


def density_estimate(power, direction, distance, normal):
    """The irradiance at points, from the K photons that are nearest to each.

    They lie in a disk whose radius is the distance of the farthest of them. What counts is their power over the area of
    that disk. Photons that have come from behind the surface count nothing.

    Parameters
    ----------
    power : (3, K, N) floating >= 0 [W], of K photons for each point, in any order
    direction : (3, K, N) floating, unit vectors, the ways that they came
    distance : (K, N) floating > 0, from each photon to its point
    normal : (3, N) floating, unit vectors at the points

    Returns
    -------
    (3, N) [W/m^2], of the dtype of the arguments, or NumPy's promotion of these

    Task: photon_mapping.density_estimate. Source: Jensen, 1996.
    """
    _check_arrays(
        power=(power, 3, "K", "N"),
        direction=(direction, 3, "K", "N"),
        distance=(distance, "K", "N"),
        normal=(normal, 3, "N"),
    )
    # TODO photon_mapping.density_estimate: write your solution here
    raise NotImplementedError("photon_mapping.density_estimate: not written yet")


def cone_weights(distance, radius, k):
    """Weights of Jensen's cone filter: near photons count more than far ones.

    The irradiance is the sum of power times weight over the photons of a disk, and no longer the sum of power over the
    disk's area. The weight falls in proportion to 1 - distance / (k radius) up to the radius, and is 0 beyond it.

    Parameters
    ----------
    distance : (N,) floating >= 0, of each photon
    radius : (N,) floating > 0, of the disk that it is asked for
    k : float >= 1, how flat the cone is; 1 makes it fall to 0 at the radius

    Returns
    -------
    (N,) [1/m^2], of the dtype of distance and radius, or NumPy's promotion of the two
        Over the area of the disk they integrate to 1.

    Task: photon_mapping.cone_weights. Source: Jensen, 1996.
    """
    _check_arrays(distance=(distance, "N"), radius=(radius, "N"))
    if not k >= 1:
        raise ValueError(f"k must be >= 1, got {k}")
    # TODO photon_mapping.cone_weights: write your solution here
    raise NotImplementedError("photon_mapping.cone_weights: not written yet")


def final_gather(albedo, seen, irradiance):
    """Light that a matte surface reflects, as M rays from each point have found it at other matte surfaces.

    Rays leave the points with the density cos / pi, and what they meet is as bright as photons say.

    Parameters
    ----------
    albedo : (3, N) floating in [0, 1], of the surface that gathers
    seen : (3, M, N) floating in [0, 1], albedo of what each ray meets
    irradiance : (3, M, N) floating >= 0 [W/m^2], as photons give it there; 0 where a ray meets nothing

    Returns
    -------
    (3, N) radiance [W/m^2/sr], of the dtype of albedo, seen and irradiance, or NumPy's promotion of these

    Task: photon_mapping.final_gather. Source: Jensen, 1996.
    """
    _check_arrays(
        albedo=(albedo, 3, "N"), seen=(seen, 3, "M", "N"), irradiance=(irradiance, 3, "M", "N")
    )
    # TODO photon_mapping.final_gather: write your solution here
    raise NotImplementedError("photon_mapping.final_gather: not written yet")


def shrunk_radius(radius, i, alpha):
    """The radius of the next pass of progressive photon mapping.

    In each pass photons are new, and the mean over all passes is the picture. The radius falls so slowly that noise
    falls to 0 as well: r_(i+1)^2 / r_i^2 = (i + alpha) / (i + 1).

    Parameters
    ----------
    radius : (N,) floating >= 0, of pass i
    i : (N,) whole numbers >= 1, the first pass is 1
    alpha : float, 0.001 to 1; at 1 the radius stays as it is

    Returns
    -------
    (N,), of the dtype of radius

    Task: photon_mapping.shrunk_radius. Source: Knaus and Zwicker, "Progressive photon mapping: a probabilistic
    approach", 2011.
    """
    _check_arrays(radius=(radius, "N"), i=(i, "N"))
    if not 0.001 <= alpha <= 1:
        raise ValueError(f"alpha must be from 0.001 to 1, got {alpha}")
    # TODO photon_mapping.shrunk_radius: write your solution here
    raise NotImplementedError("photon_mapping.shrunk_radius: not written yet")


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


def _check_at_least_one(count):
    if not count >= 1:
        raise ValueError(f"count must be >= 1, got {count}")
