"""photon_mapping: light that is followed from the lamps."""

AFTER = "media"

FUNCTIONS = (
    "emit_cone emit_area emit_directional roulette stored density_estimate cone_weights final_gather"
    " shrunk_radius"
)

_LEAVES = "direction: unit 3 N, power: 3 N"

CONTRACTS = {
    "emit_cone": f"axis: 3, cos_edge, intensity: 3, count, u: 2 N -> {_LEAVES}",
    "emit_area": f"normal: 3 N, radiance: 3, area, count, u: 2 N -> {_LEAVES}",
    "emit_directional": "direction: 3, irradiance: 3, center: 3, radius, count, u: 2 N -> origin: 3 N, power: 3 N",
    "roulette": "power: 3 N, albedo: 3 N, u: N -> survives: bool N, power: 3 N",
    "stored": "matte: N, specular: N, diffuse: N -> caustic: bool N, indirect: bool N",
    "final_gather": "albedo: 3 N, seen: 3 M N, irradiance: 3 M N -> the radiance: 3 N",
    "density_estimate": "power: 3 K N, direction: 3 K N, distance: K N, normal: 3 N -> the irradiance: 3 N",
    "cone_weights": "distance: N, radius: N, k -> the weights: N",
    "shrunk_radius": "radius: N, i: N, alpha -> the radius: N",
}
