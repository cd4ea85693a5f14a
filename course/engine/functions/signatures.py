"""Contracts of the functions that the renderer calls: arguments, results and their shapes.

A contract is written "arguments -> results", separated by commas. An argument is its name and its shape, as in
``u: 2 N``; the shape of a number is empty. A word in a shape that is no number is a size, ``N`` that of the columns:
what the arguments of a call don't say of it, the results may choose, and ``k*k`` and ``k/2`` are computed. ``*`` stands
for a list of arrays.

A result is what it is called, and its shape, after what its numbers are: floating, of the batch arguments' dtype, and
finite where nothing is said; ``unit`` for directions of length 1, ``infinite`` where infinity is legal, ``unbounded``
where both infinities are, ``whole`` or ``bool``, or the very dtype that the checks ask for. To the renderer a dtype is
floating, or whole. Whole numbers with ``below:K`` are at least 0 and less than K, a size or a number; an argument that
is several arrays stands for the length of the last.
"""

from course.engine.functions.further import further_contracts

CONTRACTS = {
    "supersampling.regular": "k, n -> the points: float32 2 n k*k",
    "supersampling.random": "k, n, rng -> the points: float32 2 n k*k",
    "supersampling.jittered": "k, n, rng -> the points: float32 2 n k*k",
    "supersampling.gaussian_weights": "offsets: 2 N s, sigma -> the weights: N s",
    "supersampling.resolve": "radiance: 3 N s, weights: N s -> the colours: 3 N",
    "soft_shadows.light_grid": "corner: 3, edge_u: 3, edge_v: 3, k -> the grid: 3 k*k",
    "soft_shadows.point_on_rectangle": "corner: 3, edge_u: 3, edge_v: 3, u: 2 N -> the points: 3 N",
    "soft_shadows.point_on_sphere": "center: 3, radius, u: 2 N -> the points: 3 N",
    "soft_shadows.point_in_ball": "center: 3, radius, u: 3 N -> the points: 3 N",
    "soft_shadows.point_on_facing_disk": "center: 3, radius, point: 3 N, u: 2 N -> the points: 3 N",
    "glossy.jitter_on_plane": "direction: 3 N, roughness, u: 2 N -> the directions: unit 3 N",
    "glossy.jitter_in_ball": "direction: 3 N, glossiness, u: 3 N -> the directions: unit 3 N",
    "glossy.sample_phong_lobe": "direction: 3 N, exponent, u: 2 N -> the directions: unit 3 N",
    "glossy.keep_above": "direction: 3 N, normal: 3 N -> the directions: unit 3 N",
    "thin_lens.point_on_disk": "u: 2 N -> the points: 2 N",
    "thin_lens.lens_rays": "origin: 3, right: 3, up: 3, forward: 3, directions: 3 N, lens_points: 2 N, focus_distance"
    " -> origins: 3 N, directions: unit 3 N",
    "motion_blur.shutter_times": "open, close, u: N -> the times: N",
    "motion_blur.displacement": "velocity: 3, time: N -> the ways: 3 N",
    "motion_blur.to_object_space": "origins: 3 N, velocity: 3, time: N -> the origins: 3 N",
    "cube_map.lookup": "faces: 6 S S 3, direction: 3 N -> the colours: 3 N",
    "cube_map.lookup_seamless": "faces: 6 S S 3, direction: 3 N -> the colours: 3 N",
    "sampling.disk_by_rejection": "n, rng -> the points: 2 n",
    "sampling.disk_by_polar": "u: 2 N -> the points: 2 N",
    "sampling.ball_by_rejection": "n, rng -> the points: 3 n",
    "sampling.ball_by_polar": "u: 3 N -> the points: 3 N",
    "sampling.sphere_by_polar": "u: 2 N -> the points: 3 N",
    "sampling.xorshift32": "state: N -> the new state: uint32 N, the random numbers: float32 N",
    "importance_sampling.uniform_hemisphere": "u: 2 N -> the directions: unit 3 N",
    "importance_sampling.cosine_hemisphere": "u: 2 N -> the directions: unit 3 N",
    "importance_sampling.cosine_hemisphere_pdf": "cos: N -> the density: N",
    "importance_sampling.phong_lobe_pdf": "cos: N, exponent -> the density: N",
    "importance_sampling.power_heuristic": "a: N, b: N -> the weights: N",
    "multiple_importance.area_density": "area, distance: N, cos: N -> the density: N",
    "multiple_importance.cone_density": "radius, distance: N -> the density: N",
    "multiple_importance.heuristic_weights": "counts: S, densities: S N, exponent -> the weights: S N",
    "environment_light.texel_weights": "image: H W 3 -> the weights: H W",
    "environment_light.cumulate": "weights: H W -> rows: float64 H, columns: float64 H W",
    "environment_light.sample_direction": "rows: H, columns: H W, u: 2 N -> the directions: unit 3 N",
    "environment_light.density": "weights: H W, direction: 3 N -> the density: N",
    "environment_light.alias_table": "weights: K -> probability: float64 K, alias: whole K below:K",
    "environment_light.draw_alias": "probability: K, alias: K, u: N -> outcome: whole N below:K, rest: N",
    "microfacets.smith_g1": "cos: N, alpha -> the shares: N",
    "microfacets.smith_g2": "cos_o: N, cos_i: N, alpha -> the shares: N",
    "microfacets.sample_visible_normal": "wo: 3 N, alpha, u: 2 N -> the normals: unit 3 N",
    "microfacets.visible_normal_pdf": "wo: 3 N, wm: 3 N, alpha -> the density: N",
    "microfacets.fresnel_complex": "cos: N, n: 3, k: 3 -> the reflectance: 3 N",
    "microfacets.brdf": "wo: 3 N, wi: 3 N, alpha, n: 3, k: 3 -> the values: 3 N",
    "blurred_transparency.refract": "direction: 3 N, normal: 3 N, eta: N -> directions: unit 3 N, total: bool N",
    "blurred_transparency.jitter_refraction": "direction: 3 N, normal: 3 N, roughness, u: 2 N"
    " -> the directions: unit 3 N",
    "blurred_transparency.fresnel": "cos_i: N, eta: N -> the reflectance: N",
    "adaptive_sampling.needs_subdivision": "corners: 3 4 N, threshold -> the decisions: bool N",
    "adaptive_sampling.subdivide": "x0: N, y0: N, x1: N, y1: N -> x0: 4 N, y0: 4 N, x1: 4 N, y1: 4 N",
    "textures.rectangle_uv": "p: 3 N, p1: 3, p2: 3, p3: 3 -> u and v: 2 N",
    "textures.sphere_uv": "p: 3 N, center: 3 -> u and v: 2 N",
    "textures.triangle_uv": "barycentric: 3 N, uv0: 2 N, uv1: 2 N, uv2: 2 N -> u and v: 2 N",
    "textures.texture_lookup": "image: H W 3, uv: 2 N -> the colours: 3 N",
    "bounding_volumes.build": "lo: 3 T, hi: 3 T, leaf_size"
    " -> lo: 3 M, hi: 3 M, first: whole M, count: whole M, order: whole T below:T",
    "bounding_volumes.traverse": "hierarchy, p0: 3 T, p1: 3 T, p2: 3 T, origins: 3 N, directions: 3 N"
    " -> triangle: int32 N, t: infinite N, box_tests: whole N, triangle_tests: whole N",
    "quasi_monte_carlo.halton": "i: N, dims -> the points: float32 dims N",
    "quasi_monte_carlo.hammersley": "n, dims -> the points: float32 dims n",
    "quasi_monte_carlo.chain": "patterns: *, ids: N, rng -> the samples: * D N",
    "blue_noise.shuffled_z_order": "x: N, y: N, levels, seed -> the order: whole N",
    "blue_noise.void_and_cluster": "u: H W, sigma -> the ranks: whole H W",
    "blue_noise.dithered_points": "points: 2 s, masks: 2 H W, x: N, y: N -> the points: 2 N s",
    "many_lights.power_choice": "power: L, u: N -> lamp: whole N below:L, probability: N",
    "many_lights.light_tree": "lo: 3 L, hi: 3 L, axis: 3 L, angle: L, power: L"
    " -> lo: 3 M, hi: 3 M, axis: unit 3 M, angle: M, power: M, order: whole L below:L",
    "many_lights.tree_choice": "tree, p: 3 N, n: 3 N, u: N -> lamp: whole N below:tree, probability: N",
    "path_tracing.diffuse_bounce": "normal: 3 N, u: 2 N -> the directions: unit 3 N",
    "path_tracing.throughput": "beta: 3 N, albedo: 3 N -> the throughput: 3 N",
    "path_tracing.russian_roulette": "beta: 3 N, u: N -> survives: bool N, the throughput: 3 N",
    "radiosity.hemicube_form_factors": "k -> top: float32 k k, side: float32 k/2 k",
    "radiosity.gather": "radiosity: 3 P, emission: 3 P, reflectance: 3 P, form_factors: P P -> the radiosity: 3 P",
    "radiosity.shoot": "radiosity: 3 P, unshot: 3 P, reflectance: 3 P, areas: P, form_factors: P, shooter"
    " -> the radiosity: 3 P, the unshot radiosity: 3 P",
    "radiosity.needs_split": "patch_radiosity: 3 K N, threshold -> the decisions: bool N",
    "denoising.welch_t": "mean_a: 3 N, variance_a: 3 N, count_a: N, mean_b: 3 N, variance_b: 3 N, count_b: N"
    " -> the statistics: unbounded 3 N",
    "denoising.degrees_of_freedom": "variance_a: 3 N, count_a: N, variance_b: 3 N, count_b: N -> the degrees: 3 N",
    "denoising.critical_value": "degrees: N, level -> the critical values: N",
    "denoising.pair_weights": "t: 3 N, critical: 3 N, distance: N, sigma -> the weights: N",
    "denoising.weighted_mean": "means: 3 N k, variances: 3 N k, weights: N k -> mean: 3 N, variance: 3 N",
    "denoising.squared_bias": "filtered: 3 N, filtered_variance: 3 N, mean: 3 N, variance: 3 N, share: N"
    " -> the squared bias: 3 N",
    "film.expose": "radiance: 3 N, stops -> the radiance: 3 N",
    "film.photographic": "radiance: 3 N, key, burn, saturation -> the colours: 3 N",
    "film.encode_srgb": "linear: 3 N -> the encoded colours: 3 N",
    "film.convert_gamut": "rgb: 3 N, source: 2 4, target: 2 4 -> the colours: 3 N",
    "film.quantize": "encoded: 3 N, u: 3 N -> the codes: whole 3 N below:256",
} | further_contracts()
"""Every function that the renderer calls, "module.function", and its contract."""
