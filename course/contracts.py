"""The kind of value that each function the renderer calls must return.

A contract is written "arguments -> results", separated by commas. An argument is its name and its shape, as in
``u: 2 N``; the shape of a number is empty. A word in a shape that is no number is a size: what the arguments of a call
don't say of it, the results may choose, and ``k*k`` and ``k/2`` are computed. ``*`` stands for a list of arrays.

A result is its shape, after what its numbers are: floating and finite where nothing is said, ``unit`` for directions of
length 1, ``infinite`` where infinity is a legal value, ``whole`` or ``bool``.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from math import prod
from typing import Any

import numpy as np

CONTRACTS = {
    "supersampling.regular": "k, n -> 2 n k*k",
    "supersampling.random": "k, n, rng -> 2 n k*k",
    "supersampling.jittered": "k, n, rng -> 2 n k*k",
    "supersampling.gaussian_weights": "offsets: 2 n s, sigma -> n s",
    "supersampling.resolve": "radiance: 3 n s, weights: n s -> 3 n",
    "soft_shadows.light_grid": "corner: 3, edge_u: 3, edge_v: 3, k -> 3 k*k",
    "soft_shadows.point_on_rectangle": "corner: 3, edge_u: 3, edge_v: 3, u: 2 N -> 3 N",
    "soft_shadows.point_on_sphere": "center: 3, radius, u: 2 N -> 3 N",
    "soft_shadows.point_in_ball": "center: 3, radius, u: 3 N -> 3 N",
    "soft_shadows.point_on_facing_disk": "center: 3, radius, point: 3 N, u: 2 N -> 3 N",
    "glossy.jitter_on_plane": "direction: 3 N, roughness, u: 2 N -> unit 3 N",
    "glossy.jitter_in_ball": "direction: 3 N, glossiness, u: 3 N -> unit 3 N",
    "glossy.sample_phong_lobe": "direction: 3 N, exponent, u: 2 N -> unit 3 N",
    "glossy.keep_above": "direction: 3 N, normal: 3 N -> unit 3 N",
    "thin_lens.point_on_disk": "u: 2 N -> 2 N",
    "thin_lens.lens_rays": "origin: 3, right: 3, up: 3, forward: 3, directions: 3 N, lens_points: 2 N, focus_distance"
    " -> 3 N, unit 3 N",
    "motion_blur.shutter_times": "open, close, u: N -> N",
    "motion_blur.displacement": "velocity: 3, time: N -> 3 N",
    "motion_blur.to_object_space": "origins: 3 N, velocity: 3, time: N -> 3 N",
    "cube_map.lookup": "faces, direction: 3 N -> 3 N",
    "cube_map.lookup_seamless": "faces, direction: 3 N -> 3 N",
    "sampling.disk_by_rejection": "n, rng -> 2 n",
    "sampling.disk_by_polar": "u: 2 N -> 2 N",
    "sampling.ball_by_rejection": "n, rng -> 3 n",
    "sampling.ball_by_polar": "u: 3 N -> 3 N",
    "sampling.sphere_by_polar": "u: 2 N -> 3 N",
    "sampling.xorshift32": "state: N -> whole N, N",
    "importance_sampling.uniform_hemisphere": "u: 2 N -> unit 3 N",
    "importance_sampling.cosine_hemisphere": "u: 2 N -> unit 3 N",
    "importance_sampling.cosine_hemisphere_pdf": "cos: N -> N",
    "importance_sampling.phong_lobe_pdf": "cos: N, exponent -> N",
    "importance_sampling.power_heuristic": "a: N, b: N -> N",
    "blurred_transparency.refract": "direction: 3 N, normal: 3 N, eta: N -> unit 3 N, bool N",
    "blurred_transparency.jitter_refraction": "direction: 3 N, normal: 3 N, roughness, u: 2 N -> unit 3 N",
    "blurred_transparency.fresnel": "cos_i: N, eta: N -> N",
    "adaptive_sampling.needs_subdivision": "corners: 3 4 n, threshold -> bool n",
    "adaptive_sampling.subdivide": "x0: n, y0: n, x1: n, y1: n -> 4 n, 4 n, 4 n, 4 n",
    "textures.rectangle_uv": "p: 3 N, p1: 3, p2: 3, p3: 3 -> 2 N",
    "textures.sphere_uv": "p: 3 N, center: 3 -> 2 N",
    "textures.triangle_uv": "barycentric: 3 N, uv0: 2 N, uv1: 2 N, uv2: 2 N -> 2 N",
    "textures.texture_lookup": "image, uv: 2 N -> 3 N",
    "bounding_volumes.build": "lo: 3 T, hi: 3 T, leaf_size -> 3 M, 3 M, whole M, whole M, whole T",
    "bounding_volumes.traverse": "hierarchy, p0: 3 T, p1: 3 T, p2: 3 T, origins: 3 N, directions: 3 N"
    " -> whole N, infinite N, whole N, whole N",
    "quasi_monte_carlo.halton": "i: S, dims -> dims S",
    "quasi_monte_carlo.hammersley": "n, dims -> dims n",
    "quasi_monte_carlo.chain": "patterns: *, ids: S, rng -> * D S",
    "path_tracing.diffuse_bounce": "normal: 3 N, u: 2 N -> unit 3 N",
    "path_tracing.throughput": "beta: 3 N, albedo: 3 N -> 3 N",
    "path_tracing.russian_roulette": "beta: 3 N, u: N -> bool N, 3 N",
    "radiosity.hemicube_form_factors": "k -> k k, k/2 k",
    "radiosity.gather": "radiosity: 3 P, emission: 3 P, reflectance: 3 P, form_factors: P P -> 3 P",
    "radiosity.shoot": "radiosity: 3 P, unshot: 3 P, reflectance: 3 P, areas: P, form_factors: P, shooter -> 3 P, 3 P",
    "radiosity.needs_split": "patch_radiosity: 3 4 n, threshold -> bool n",
}
"""Every function that the renderer calls, "module.function", and its contract."""

KINDS = {"unit", "infinite", "whole", "bool"}


Size = int | str | tuple[tuple[str, ...], int]
"""A number, a word, or words whose sizes are multiplied and then divided by a number."""


@dataclass(frozen=True)
class Result:
    """One result.

    Attributes
    ----------
    kind : "" (floating and finite), "unit", "infinite", "whole" or "bool"
    sizes : of each axis
    """

    kind: str
    sizes: tuple[Size, ...]

    def shape(self, known: dict[str, int]) -> tuple[int | str, ...]:
        """Its shape; sizes that nobody knows stay words."""
        return tuple([_known(size, known) for size in self.sizes])


@dataclass(frozen=True)
class Contract:
    """Names and shapes of the arguments, and the results.

    Attributes
    ----------
    arguments : names, and words for their axes; numbers have none
    several : whether the one result is a list of arrays, as many as the argument's with a ``*``
    """

    arguments: tuple[tuple[str, tuple[str, ...]], ...]
    results: tuple[Result, ...]
    several: bool

    def sizes(self, values: Iterable[Any]) -> dict[str, int]:
        """The sizes that the arguments of a call say, by their words."""
        known: dict[str, int] = {}
        for (name, words), value in zip(self.arguments, values, strict=False):
            if not words:
                if isinstance(value, (int, np.integer)):
                    known[name] = int(value)
            elif words == ("*",):
                known["*"] = len(value)
            else:
                for word, size in zip(words, np.shape(value), strict=False):
                    # A single column stands for as many as there are.
                    if known.get(word, 1) == 1:
                        known[word] = size
        return known


@cache
def contract(function: str) -> Contract:
    """The contract of a function, "module.function"."""
    before, _, after = CONTRACTS[function].partition("->")
    arguments = []
    for part in before.split(","):
        name, _, shape = part.partition(":")
        arguments.append((name.strip(), tuple(shape.split())))
    results = []
    several = False
    for part in after.split(","):
        words = part.split()
        several = words[0] == "*"
        kind = words[0] if words[0] in KINDS else ""
        results.append(Result(kind, tuple(map(_size, words[bool(kind) or several :]))))
    return Contract(tuple(arguments), tuple(results), several)


def _size(word: str) -> Size:
    product, _, divisor = word.partition("/")
    if product.isdigit():
        return int(product)
    return (tuple(product.split("*")), int(divisor or 1)) if {"*", "/"} & set(word) else word


def _known(size: Size, known: dict[str, int]) -> int | str:
    if isinstance(size, int):
        return size
    if isinstance(size, str):
        return known.get(size, size)
    words, divisor = size
    return prod(known[word] for word in words) // divisor
