"""film - from radiance to a picture: exposure, tone mapping, another gamut, the sRGB curve, and dithering."""

import numpy as np


def expose(radiance, stops):
    """Radiance as if the shutter had been open for longer: one stop more is twice as much light.

    Parameters
    ----------
    radiance : (3, N) floating, linear RGB
    stops : float

    Returns
    -------
    (3, N), of the dtype of radiance

    Raises
    ------
    ValueError
        radiance has another shape, or stops is not finite.

    Task: film.expose.
    """
    _check_batch("radiance", radiance, 3)
    _check_number("stops", stops, np.isfinite(stops), "finite")
    ### BEGIN SOLUTION
    return radiance * radiance.dtype.type(2.0**stops)
    ### END SOLUTION


def luminance(rgb):
    """How bright linear RGB looks: its Y, by the weights of Rec. 709, which sRGB shares.

    Parameters
    ----------
    rgb : (3, N) floating, linear RGB
        The weights of red, green and blue are 0.2126, 0.7152 and 0.0722.

    Returns
    -------
    (N,), of the dtype of rgb

    Raises
    ------
    ValueError
        rgb has another shape.

    Task: film.luminance. Source: ITU-R BT.709.
    """
    _check_batch("rgb", rgb, 3)
    ### BEGIN SOLUTION
    return np.array([0.2126, 0.7152, 0.0722], rgb.dtype) @ rgb
    ### END SOLUTION


def photographic(radiance, key, burn, saturation):
    """Reinhard's photographic tone mapping: a picture of any range, brought to what a screen shows.

    Luminances are scaled so that their logarithmic mean, exp(mean(log Y)) over all pixels with Y > 0, becomes key:
    L = key Y / mean. White is the percentile 100 - burn of L, over all pixels, interpolated linearly. The display's
    luminance is D = L (1 + L / white^2) / (1 + L), and 1 where L = white. A channel C becomes D (C / Y)^saturation.

    Parameters
    ----------
    radiance : (3, N) floating, linear RGB of a whole picture, 0 or more
    key : float, over 0; 0.18 is usual
    burn : float, from 0 to 100, the percentage of pixels that may burn out to white
    saturation : float, 0 or more; 1 keeps the ratios of the channels, 0 makes the picture grey

    Returns
    -------
    (3, N), of the dtype of radiance
        Pixels of luminance 0 are black, and so are all where white is 0.

    Raises
    ------
    ValueError
        radiance has another shape, or a number is out of range.

    Task: film.photographic. Source: Reinhard et al., "Photographic tone reproduction for digital images", 2002.
    """
    _check_batch("radiance", radiance, 3)
    _check_number("key", key, 0 < key < np.inf, "finite and > 0")
    _check_number("burn", burn, 0 <= burn <= 100, "from 0 to 100")
    _check_number("saturation", saturation, 0 <= saturation < np.inf, "finite and >= 0")
    ### BEGIN SOLUTION
    y, mapped = luminance(radiance.astype(np.float64)), np.zeros_like(radiance)
    lit, white = y > 0, np.percentile(y, 100 - burn) if y.size else 0
    if white > 0:
        scale = key / np.exp(np.log(y[lit]).mean())
        tone = scale * y[lit]
        shown = tone * (1 + tone / (scale * white) ** 2) / (1 + tone)
        mapped[:, lit] = shown * (radiance[:, lit] / y[lit]) ** saturation
    return mapped
    ### END SOLUTION


def encode_srgb(linear):
    """The curve of sRGB: equal steps of its result look like equal steps of brightness.

    12.92 x up to 0.0031308, and 1.055 x^(1 / 2.4) - 0.055 from there on.

    Parameters
    ----------
    linear : (3, N) floating, linear RGB
        What is below 0 counts as 0, what is above 1 as 1.

    Returns
    -------
    (3, N) in [0, 1], of the dtype of linear

    Raises
    ------
    ValueError
        linear has another shape.

    Task: film.encode_srgb. Source: IEC 61966-2-1.
    """
    _check_batch("linear", linear, 3)
    ### BEGIN SOLUTION
    # In single precision white would end next to 1, and be dithered.
    x = np.clip(linear.astype(np.float64), 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055).astype(linear.dtype)
    ### END SOLUTION


def convert_gamut(rgb, source, target):
    """Linear RGB of one gamut in the primaries of another: the same light, by other numbers.

    In XYZ, chromaticities x and y are a multiple of (x, y, 1 - x - y). RGB (1, 1, 1) is the white, with Y = 1.

    Parameters
    ----------
    rgb : (3, N) floating, linear RGB of the source
    source, target : (2, 4)
        Chromaticities x (row 0) and y (row 1) of red, green, blue and white. Both have the same white.

    Returns
    -------
    (3, N), of the dtype of rgb
        Colours outside of the target's gamut have a channel below 0.

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: film.convert_gamut. Source: SMPTE RP 177.
    """
    _check_batch("rgb", rgb, 3)
    for name, gamut in (("source", source), ("target", target)):
        if np.shape(gamut) != (2, 4):
            raise ValueError(f"{name} must have shape (2, 4), got {np.shape(gamut)}")
    ### BEGIN SOLUTION
    colors = [np.stack((x, y, 1 - x - y)) / y for x, y in np.array((source, target), float)]
    first, second = (c[:, :3] * np.linalg.solve(c[:, :3], c[:, 3]) for c in colors)
    return np.linalg.solve(second, first).astype(rgb.dtype) @ rgb
    ### END SOLUTION


def quantize(encoded, u):
    """Codes of 8 bits, dithered: by chance one of the two neighbours, so that the mean is the value itself.

    255 encoded lies at a fraction f between two codes. The upper one comes where u is at least 1 - f.

    Parameters
    ----------
    encoded : (3, N) floating in [0, 1]
    u : (3, N) floating in [0, 1)

    Returns
    -------
    (3, N) of an integer dtype, from 0 to 255

    Raises
    ------
    ValueError
        An argument has another shape.

    Task: film.quantize. Source: Roberts, "Picture coding using pseudo-random noise", 1962.
    """
    _check_batch("encoded", encoded, 3)
    _check_batch("u", u, 3)
    if len(u[0]) != len(encoded[0]):
        raise ValueError(f"u must have shape {np.shape(encoded)}, got {np.shape(u)}")
    ### BEGIN SOLUTION
    # In single precision, 254 + the largest u would be 255.
    return np.minimum(np.floor(255 * encoded.astype(np.float64) + u), 255).astype(np.uint8)
    ### END SOLUTION


def _check_batch(name, array, rows, columns=None):
    shape = np.shape(array)
    if len(shape) != 2 or shape[0] != rows or (columns is not None and shape[1] != columns):
        expected = f"({rows}, {'N' if columns is None else columns})"
        raise ValueError(f"{name} must have shape {expected}, got {shape}")


def _check_number(name, value, legal, what):
    if not legal:
        raise ValueError(f"{name} must be {what}, got {value}")
