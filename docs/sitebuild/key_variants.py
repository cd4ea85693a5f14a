"""Which keys of a scene file are shown by pictures, with which values, in which small scene."""

from typing import Any

Changes = dict[str, Any]
"""From the place of a value, with dots, to the value; a place is made where there is none."""

COMMON: Changes = {
    "camera": {"eye": [0, 1.7, 5.2], "look_at": [0, 0.72, 0], "vertical_fov": 30},
    "sampler": {"samples": 16},
    "environment": {"type": "constant", "radiance": [0.3, 0.38, 0.5]},
    "materials": {
        "floor": {"texture": {"image": "textures/tiles.png", "repeat": [16, 16]}},
        "ball": {"color": [0.75, 0.25, 0.15]},
        "far": {"color": [0.2, 0.45, 0.5]},
        "near": {"color": [0.8, 0.65, 0.25]},
    },
    "lights": [
        {"type": "ambient", "radiance": 0.15},
        {"type": "sphere", "center": [-3, 4, 3], "radius": 0.4, "intensity": 60},
    ],
    "objects": [
        {"shape": "quad", "material": "floor", "width": 24, "depth": 24},
        {
            "shape": "sphere",
            "material": "ball",
            "radius": 0.7,
            "transform": [{"translate": [0, 0.7, 0]}],
        },
        {"shape": "box", "material": "far", "transform": [{"translate": [-1.6, 0.5, -1.6]}]},
        {
            "shape": "cone",
            "material": "near",
            "height": 0.9,
            "radius": 0.4,
            "transform": [{"translate": [1.3, 0.45, 0.8]}],
        },
    ],
}
"""What all pictures begin with: a tiled floor, a ball, a box behind it and a cone before it."""

BALL, LAMP = "objects.1.", "lights.1."
SHINY = {"environment": {"type": "lat_long", "image": "environments/studio.exr"}}
GLASS = {"materials.ball.color": 0, "materials.ball.dielectric": {}}
POLISHED = {"materials.ball.color": 0.1, "materials.ball.mirror": 0.8}
ALONE = {"lights.0.radiance": 0.03}
LENS = {"camera.lens": {"aperture_radius": 0.15, "focus_distance": 5}, "sampler.samples": 64}
MOVING = {"objects.1.motion": {"velocity": [1.2, 0, 0]}, "sampler.samples": 64}
SKY = {"type": "lat_long", "image": "environments/sky.exr", "lights": True}
SKYLIT = {"lights": [], "environment": SKY, **POLISHED}
OVERCAST = {
    "lights": [],
    "environment": {"type": "constant", "radiance": 0.8, "lights": True},
    "sampler": {"type": "random", "samples": 4},
}
WINDOW = {
    "type": "rectangle",
    "corner": [-2.1, 0.3, -2],
    "edge_u": [0, 1.6, 0],
    "edge_v": [0, 0, 3],
    "radiance": 6,
}
SPOT = {
    "type": "spot",
    "position": [-3, 4, 3],
    "direction": [3, -4, -3],
    "intensity": 120,
    "inner_angle": 6,
    "outer_angle": 12,
}
SCREEN = {**WINDOW, "corner": [-0.9, 0.3, -2], "radiance": 3, "visible": False}
"""Between the box and the ball."""
DARK = {**ALONE, "environment.radiance": 0.02, "sampler.samples": 64}
PLAIN = {"materials.floor": {"color": 0.5}}
GRAZED = {
    **ALONE,
    **PLAIN,
    "lights.1.center": [-2.5, 3.5, -2.5],
    "materials.ball": {"color": [0.3, 0.1, 0.06], "specular": 1, "exponent": 4},
}
"""Lit from behind: where the light grazes the ball its highlight is widest."""
LARGE = {**ALONE, **PLAIN, "lights.1.radius": 2, "sampler.samples": 1}
"""A ray for each pixel: with more of them several of the values end in the same picture."""
GLOBE = {
    "type": "sphere",
    "center": [-3, 4, 3],
    "radius": 2,
    "radiance": 5,
    "samples": "visible",
}
LANTERNS = {
    **ALONE,
    "sampler.samples": 64,
    "environment.radiance": 0,
    "objects.1.name": "ball",
    "objects.3.name": "cone",
    "materials.ball.emission": [1.6, 0.5, 0.3],
    "materials.near.emission": [4, 2.6, 0.6],
    # A lamp that stands on the floor would lie in its plane.
    "objects.3.transform": [{"translate": [1.3, 0.46, 0.8]}],
}
"""Two that glow, and either lights the others where it is one of the lights."""
COARSE = {"film.width": 66, "film.height": 44, "sampler.samples": 1, "lights.1.radius": 0, **PLAIN}
"""Pixels that can be seen, with a ray each, and neither noise nor a pattern in what they show."""
NOISY = {
    **PLAIN,
    **ALONE,
    "film.width": 66,
    "film.height": 44,
    "sampler.samples": 1000,
    "camera.lens": {"aperture_radius": 0.3, "focus_distance": 5},
    "lights.1": WINDOW,
}
WHOLE = {"left": -0.4, "right": 0.4, "bottom": -0.267, "top": 0.267}
CORNER = {
    "camera": {"eye": [0, 40, 0], "look_at": [1, 41, -1], "vertical_fov": 80},
    "environment": {**SKY, "lights": False, "size": 3},
}
"""Seen from high above: a corner of a cube whose pixels are large, and its faces are the sky."""
STRAIGHT = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
SHEARED = [[1, 0.6, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
STRETCHED = [[0.5, 0, 0, 0], [0, 1.3, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def _plane(key: str, *values: float) -> list[tuple[str, Changes]]:
    return _values(f"camera.image_plane.{key}", *values, on={"camera.image_plane": WHOLE})


def _object(shape: str, **keys: Any) -> Changes:
    """Another shape in the ball's place."""
    turned = [{"rotate": {"axis": [1, 0, 0], "degrees": 25}}, {"translate": [0, 0.75, 0]}]
    return {"objects.1": {"shape": shape, "material": "ball", "transform": turned, **keys}}


def _values(place: str, *values: Any, **rest: Any) -> list[tuple[str, Changes]]:
    """One picture for each value of the key at ``place``; the other changes are for all."""
    key = place.rpartition(".")[2]
    return [(f"{key}: {_said(value)}", {**rest.get("on", {}), place: value}) for value in values]


def _shapes(shape: str, key: str, *values: Any, **keys: Any) -> list[tuple[str, Changes]]:
    return [(f"{key}: {_said(value)}", _object(shape, **{**keys, key: value})) for value in values]


def _said(value: Any) -> str:
    """As it is written in a scene file."""
    if value is None:
        return "null"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_said(each)}" for key, each in value.items()) + "}"
    return str(value)


VARIANTS: dict[tuple[str, str], list[tuple[str, Changes]]] = {
    ("SceneDescription", "seed"): _values(
        "seed", 0, 1, on={"sampler": {"type": "random", "samples": 1}}
    ),
    ("CameraDescription", "eye"): _values("camera.eye", [0, 1.7, 5.2], [3, 2.6, 4]),
    ("CameraDescription", "look_at"): _values("camera.look_at", [0, 0.72, 0], [1.3, 0.4, 0.8]),
    ("CameraDescription", "up"): _values("camera.up", [0, 1, 0], [0.4, 1, 0]),
    ("CameraDescription", "vertical_fov"): _values("camera.vertical_fov", 15, 30, 60),
    ("CameraDescription", "handedness"): _values("camera.handedness", "right", "left"),
    ("CameraDescription", "near"): _values("camera.near", 0, 4.3, 4.9),
    ("CameraDescription", "image_plane"): _values(
        "camera.image_plane",
        WHOLE,
        {"left": -0.1, "right": 0.3, "bottom": -0.2, "top": 0.066},
    ),
    ("ImagePlaneDescription", "distance"): _plane("distance", 1, 2),
    ("ImagePlaneDescription", "left"): _plane("left", -0.4, 0),
    ("ImagePlaneDescription", "right"): _plane("right", 0.4, 0.1),
    ("ImagePlaneDescription", "bottom"): _plane("bottom", -0.267, -0.6),
    ("ImagePlaneDescription", "top"): _plane("top", 0.267, 0),
    ("LensDescription", "aperture_radius"): _values(
        "camera.lens.aperture_radius", 0.03, 0.1, 0.3, on=LENS
    ),
    ("LensDescription", "focus_distance"): _values(
        "camera.lens.focus_distance", 4.2, 5.1, 7, on=LENS
    ),
    ("LensDescription", "shape"): _values(
        "camera.lens.shape",
        "disk",
        "polygon",
        "square",
        on={
            **LENS,
            "camera.lens": {"aperture_radius": 0.3, "focus_distance": 2.4, "blades": 5},
            "objects.1.radius": 0.06,
            "materials.ball.emission": 8,
        },
    ),
    ("LensDescription", "blades"): _values(
        "camera.lens.blades",
        3,
        5,
        8,
        on={
            **LENS,
            "camera.lens": {"aperture_radius": 0.3, "focus_distance": 2.4, "shape": "polygon"},
            "objects.1.radius": 0.06,
            "materials.ball.emission": 8,
        },
    ),
    ("ShutterDescription", "close"): _values("camera.shutter.close", 0.2, 0.5, 1, on=MOVING),
    ("ShutterDescription", "open"): _values("camera.shutter.open", 0, 0.5, 0.9, on=MOVING),
    ("MotionDescription", "velocity"): _values(
        "objects.1.motion.velocity", [0, 0, 0], [1.2, 0, 0], [0, 0.6, 0], on=MOVING
    ),
    ("FilmDescription", "filter"): _values(
        "film.filter", "box", "gaussian", on={"film.width": 66, "film.height": 44}
    ),
    ("FilmDescription", "sigma"): _values(
        "film.sigma", 0.17, 0.5, on={"film.filter": "gaussian", "film.width": 66, "film.height": 44}
    ),
    ("FilmDescription", "error"): _values("film.error", 0.1, 0.03, on=NOISY),
    ("FilmDescription", "subdivision"): _values(
        "film.subdivision", None, {"threshold": 0.1, "depth": 3}, on=COARSE
    ),
    ("FilmDescription", "denoise"): _values(
        "film.denoise", None, {"level": 0.05, "sigma": 2}, on={**NOISY, "sampler.samples": 4}
    ),
    ("DenoiseDescription", "level"): _values(
        "film.denoise.level",
        0.01,
        0.5,
        on={**NOISY, "sampler.samples": 4, "film.denoise": {"sigma": 2}},
    ),
    ("DenoiseDescription", "sigma"): _values(
        "film.denoise.sigma",
        1,
        4,
        on={**NOISY, "sampler.samples": 4, "film.denoise": {"level": 0.05}},
    ),
    ("SubdivisionDescription", "threshold"): _values(
        "film.subdivision.threshold", 0.03, 0.3, on={**COARSE, "film.subdivision": {"depth": 3}}
    ),
    ("SubdivisionDescription", "depth"): _values(
        "film.subdivision.depth", 1, 4, on={**COARSE, "film.subdivision": {"threshold": 0.1}}
    ),
    ("FilmDescription", "white"): _values("film.white", 0.5, 1, 2),
    ("FilmDescription", "encoding"): _values("film.encoding", "srgb", "linear"),
    ("FilmDescription", "exposure"): _values("film.exposure", -1, 0, 1),
    ("FilmDescription", "gamut"): _values("film.gamut", "srgb", "rec2020"),
    ("FilmDescription", "tone"): _values("film.tone", None, {"key": 0.18}),
    ("ToneDescription", "key"): _values("film.tone.key", 0.09, 0.18, 0.36, on={"film.tone": {}}),
    ("ToneDescription", "burn"): _values("film.tone.burn", 0, 5, 30, on={"film.tone": {}}),
    ("ToneDescription", "saturation"): _values(
        "film.tone.saturation", 0, 0.5, 1, on={"film.tone": {}}
    ),
    ("ToneDescription", "gamma"): _values("film.tone.gamma", 1, 2.2, 3, on={"film.tone": {}}),
    ("SamplerDescription", "type"): _values(
        "sampler.type",
        "regular",
        "random",
        "jittered",
        "sobol",
        "halton",
        "hammersley",
        "chained",
        "xorshift",
        "blue_noise",
        "dithered",
        on={"sampler.samples": 4, "lights.1.radius": 1.2},
    ),
    ("SamplerDescription", "samples"): _values(
        "sampler.samples", 1, 4, 64, on={"lights.1.radius": 1.2}
    ),
    ("IntegratorDescription", "type"): _values(
        "integrator.type", "distribution", "path", on={**ALONE, "sampler.samples": 64}
    ),
    ("IntegratorDescription", "max_depth"): _values("integrator.max_depth", 0, 1, 5, on=GLASS),
    ("IntegratorDescription", "into_surface"): _values(
        "integrator.into_surface",
        "mirror",
        "keep",
        on={
            **POLISHED,
            **SHINY,
            "materials.ball.gloss": {"lobe": "phong", "exponent": 0},
            "integrator.max_depth": 1,
        },
    ),
    ("IntegratorDescription", "terminator"): _values(
        "integrator.terminator", "round", "facets", on={**ALONE, "objects.1.segments": 12}
    ),
    ("IntegratorDescription", "shading_normals"): _values(
        "integrator.shading_normals",
        "bent",
        "interpolated",
        on={**ALONE, **POLISHED, "objects.1.segments": 12},
    ),
    ("ConstantEnvironment", "radiance"): _values("environment.radiance", 0.05, [0.3, 0.38, 0.5]),
    ("ConstantEnvironment", "lights"): _values(
        "environment.lights", False, True, on={"lights": []}
    ),
    ("ConstantEnvironment", "seen_by"): _values(
        "environment.seen_by", "all", "camera", on=POLISHED
    ),
    ("ConstantEnvironment", "sampling"): _values(
        "environment.sampling", "uniform", "cosine", "power", on=OVERCAST
    ),
    ("CubeEnvironment", "cross"): [
        (
            "cross: valley.png",
            {"environment": {"type": "cube", "cross": "environments/valley.png"}, **POLISHED},
        )
    ],
    ("LatLongEnvironment", "image"): [
        (
            f"image: {name}.exr",
            {"environment": {"type": "lat_long", "image": f"environments/{name}.exr"}, **POLISHED},
        )
        for name in ("sky", "studio")
    ],
    ("BackdropEnvironment", "image"): [
        (
            f"image: {name}.png",
            {
                "environment": {"type": "backdrop", "image": f"textures/{name}.png"},
                "objects.0.material": "ball",
                **POLISHED,
            },
        )
        for name in ("weave", "globe")
    ],
    ("LatLongEnvironment", "scale"): _values("environment.scale", 0.5, 2, on=SKYLIT),
    ("LatLongEnvironment", "lights"): _values("environment.lights", False, True, on=SKYLIT),
    ("LatLongEnvironment", "size"): _values("environment.size", 4, 16, None, on=SKYLIT),
    ("LatLongEnvironment", "lookup"): _values(
        "environment.lookup", "seamless", "clamped", on=CORNER
    ),
    ("MaterialDescription", "color"): _values(
        "materials.ball.color", 0.1, [0.75, 0.25, 0.15], [0.2, 0.6, 0.3]
    ),
    ("MaterialDescription", "ambient"): _values(
        "materials.ball.ambient", 0, 1, on={"lights.0.radiance": 0.4}
    ),
    ("MaterialDescription", "diffuse"): _values("materials.ball.diffuse", 0.2, 1),
    ("MaterialDescription", "specular"): _values("materials.ball.specular", 0, 0.5),
    ("MaterialDescription", "exponent"): _values(
        "materials.ball.exponent", 8, 32, 200, on={"materials.ball.specular": 0.5}
    ),
    ("MaterialDescription", "highlight"): _values(
        "materials.ball.highlight", "cosine", "plain", "phong", "plain_phong", on=GRAZED
    ),
    ("Facets", "refraction_index"): _values(
        "materials.ball.facets.refraction_index", 1.5, 4, on=GRAZED
    ),
    ("Facets", "absorption_index"): _values(
        "materials.ball.facets.absorption_index", 0, 2, on=GRAZED
    ),
    ("Facets", "covers"): _values(
        "materials.ball.facets.covers",
        False,
        True,
        on=GRAZED | {"materials.ball.facets.refraction_index": 3},
    ),
    ("MaterialDescription", "unlit"): _values(
        "materials.ball.unlit", 0, 0.2, 1, on={"materials.ball.color": [0.75, 0.25, 0.15]}
    ),
    ("MaterialDescription", "emission"): _values("materials.ball.emission", 0, [0.9, 0.5, 0.1]),
    ("MaterialDescription", "mirror"): _values(
        "materials.ball.mirror", 0, 0.3, 0.9, on={"materials.ball.color": 0.1}
    ),
    ("PlaneLobe", "roughness"): [
        (
            f"roughness: {size}",
            {**POLISHED, **SHINY, "materials.ball.gloss": {"lobe": "plane", "roughness": size}},
        )
        for size in (0.1, 0.5, 1.2)
    ],
    ("BallLobe", "glossiness"): [
        (
            f"glossiness: {size}",
            {**POLISHED, **SHINY, "materials.ball.gloss": {"lobe": "ball", "glossiness": size}},
        )
        for size in (0.1, 0.3, 0.8)
    ],
    ("PhongLobe", "exponent"): [
        (
            f"exponent: {size}",
            {**POLISHED, **SHINY, "materials.ball.gloss": {"lobe": "phong", "exponent": size}},
        )
        for size in (1000, 100, 10)
    ],
    ("Dielectric", "refraction_index"): _values(
        "materials.ball.dielectric.refraction_index", 1.05, 1.5, 2.4, on=GLASS
    ),
    ("Dielectric", "absorption"): _values(
        "materials.ball.dielectric.absorption", 0, [1.5, 0.4, 0.2], on=GLASS
    ),
    ("Dielectric", "roughness"): _values(
        "materials.ball.dielectric.roughness", 0, 0.2, 0.6, on={**GLASS, "sampler.samples": 36}
    ),
    ("Conductor", "refraction_index"): [
        (
            said,
            {
                "materials.ball.color": 0,
                "materials.ball.mirror": 1,
                "materials.ball.conductor": {"refraction_index": n, "absorption_index": k},
                **SHINY,
            },
        )
        for said, n, k in (
            ("copper: [0.20, 0.92, 1.10]", [0.2, 0.92, 1.1], [3.91, 2.45, 2.14]),
            ("silver: [0.16, 0.14, 0.14]", [0.16, 0.14, 0.14], [3.93, 3.19, 2.38]),
        )
    ],
    ("TextureDescription", "image"): [
        (
            f"image: {name}.png",
            {
                "materials.ball.color": 1,
                "materials.ball.texture": {"image": f"textures/{name}.png"},
            },
        )
        for name in ("globe", "weave")
    ],
    ("NoiseDescription", "scale"): [
        (f"scale: {scale}", {"materials.ball.color": 1, "materials.ball.noise": {"scale": scale}})
        for scale in (2, 8)
    ],
    ("NoiseDescription", "conversion"): [
        (
            f"conversion: {conversion}",
            {
                "materials.ball.color": 1,
                "materials.ball.noise": {"scale": 4, "conversion": conversion},
            },
        )
        for conversion in ("linear", "absolute")
    ],
    ("BumpDescription", "height"): [
        (
            f"height: {height}",
            {"materials.ball.bump": {"image": "textures/bricks.png", "height": height}},
        )
        for height in (-0.2, 0.05, 0.2)
    ],
    ("BumpDescription", "repeat"): [
        (
            f"repeat: {times}",
            {"materials.ball.bump": {"image": "textures/bricks.png", "repeat": times}},
        )
        for times in ([4, 2], [8, 4])
    ],
    ("NormalMapDescription", "repeat"): [
        (
            f"repeat: {times}",
            {
                "materials.ball.normal_map": {
                    "image": "textures/bricks.png",
                    "repeat": times,
                }
            },
        )
        for times in ([4, 2], [8, 4])
    ],
    ("TextureDescription", "repeat"): _values(
        "materials.floor.texture.repeat", [4, 4], [16, 16], [16, 4]
    ),
    ("AmbientLight", "radiance"): _values("lights.0.radiance", 0, 0.15, 0.5),
    ("PointLight", "position"): [
        (f"position: {place}", {"lights.1": {"type": "point", "position": place, "intensity": 50}})
        for place in ([-3, 4, 3], [3, 3, 2])
    ],
    ("PointLight", "intensity"): [
        (
            f"intensity: {value}",
            {"lights.1": {"type": "point", "position": [-3, 4, 3], "intensity": value}},
        )
        for value in (15, 60, [60, 40, 15])
    ],
    **{
        ("SpotLight", key): [
            (f"{key}: {value}", {"lights.1": {**SPOT, key: value}}) for value in values
        ]
        for key, values in {
            "position": ([-3, 4, 3], [3, 3, 2]),
            "intensity": (60, 200, [200, 130, 40]),
            "direction": ([3, -4, -3], [2.2, -4, -3.4]),
            "inner_angle": (0, 6, 12),
            "outer_angle": (7, 12, 25),
        }.items()
    },
    ("DirectionalLight", "direction"): [
        (
            f"direction: {toward}",
            {"lights.1": {"type": "directional", "direction": toward, "irradiance": 2}},
        )
        for toward in ([1, -1.5, -1], [1, -0.4, -0.3])
    ],
    ("DirectionalLight", "irradiance"): [
        (
            f"irradiance: {value}",
            {"lights.1": {"type": "directional", "direction": [1, -1.5, -1], "irradiance": value}},
        )
        for value in (0.7, 2.5)
    ],
    ("RectangleLight", "radiance"): [
        (f"radiance: {value}", {**ALONE, "lights.1": {**WINDOW, "radiance": value}})
        for value in (2, 8)
    ],
    ("RectangleLight", "edge_u"): [
        (f"edge_u: {edge}", {**ALONE, "lights.1": {**WINDOW, "edge_u": edge}})
        for edge in ([0, 0.3, 0], [0, 1.6, 0])
    ],
    ("RectangleLight", "two_sided"): [
        (
            f"two_sided: {_said(value)}",
            {**DARK, "lights.1": {**SCREEN, "two_sided": value}},
        )
        for value in (False, True)
    ],
    ("RectangleLight", "visible"): [
        (f"visible: {_said(value)}", {**ALONE, "lights.1": {**WINDOW, "visible": value}})
        for value in (True, False)
    ],
    ("RectangleLight", "samples"): [
        (
            f"samples: {value}",
            {**ALONE, "sampler.samples": 1, "lights.1": {**WINDOW, "samples": value}},
        )
        for value in ("point", "grid 4")
    ],
    ("ObjectLight", "object"): [
        (f"object: {name}", {**LANTERNS, "lights.1": {"type": "object", "object": name}})
        for name in ("ball", "cone")
    ],
    ("SphereLight", "samples"): [
        *_values("lights.1.samples", "sphere", "ball", "facing disk", on=LARGE),
        ("samples: visible, by radiance", {**LARGE, "lights.1": GLOBE}),
        *_values(
            "lights.1.samples", "sphere by polar", "ball by polar", "ball by rejection", on=LARGE
        ),
    ],
    ("SphereLight", "radius"): _values("lights.1.radius", 0.1, 1, 2.5),
    ("SphereLight", "intensity"): _values("lights.1.intensity", 20, 60, [60, 40, 15]),
    ("Quad", "width"): _values("objects.0.width", 3, 24),
    ("Quad", "depth"): _values("objects.0.depth", 3, 24),
    ("Translate", "translate"): _values(
        "objects.1.transform.0.translate", [0, 0.7, 0], [0.8, 1.2, 0]
    ),
    ("Scale", "scale"): [
        (f"scale: {value}", {"objects.1.transform": [{"scale": value}, {"translate": [0, 0.7, 0]}]})
        for value in (0.6, [1, 0.5, 1], [0.4, 1, 1])
    ],
    ("Rotation", "degrees"): [
        (
            f"degrees: {angle}",
            {
                "objects.2.transform": [
                    {"rotate": {"axis": [0, 1, 0], "degrees": angle}},
                    {"translate": [-1.3, 0.5, 0.4]},
                ]
            },
        )
        for angle in (0, 20, 45)
    ],
    ("Rotation", "axis"): [
        (
            f"axis: {axis}",
            {
                "objects.3.transform": [
                    {"rotate": {"axis": axis, "degrees": 90}},
                    {"translate": [1.2, 0.45, 0.8]},
                ]
            },
        )
        for axis in ([0, 1, 0], [1, 0, 0], [0, 0, 1])
    ],
    ("Affine", "matrix"): [
        (
            f"matrix: {matrix}",
            {"objects.2.transform": [{"matrix": matrix}, {"translate": [-1.2, top / 2, 0.4]}]},
        )
        for matrix, top in ((STRAIGHT, 1), (SHEARED, 1), (STRETCHED, 1.3))
    ],
    ("Box", "size"): _values("objects.2.size", [1, 1, 1], [0.4, 1.8, 1]),
    ("Sphere", "radius"): _values("objects.1.radius", 0.3, 0.7),
    ("Sphere", "segments"): _values("objects.1.segments", 6, 16, 64),
    ("Sphere", "shading"): _values(
        "objects.1.shading", "smooth", "flat", on={"objects.1.segments": 10}
    ),
    ("Disk", "radius"): _shapes("disk", "radius", 0.4, 1),
    ("Cylinder", "radius"): _shapes("cylinder", "radius", 0.2, 0.6),
    ("Cylinder", "height"): _shapes("cylinder", "height", 0.5, 1.3),
    ("Cone", "radius"): _shapes("cone", "radius", 0.25, 0.7),
    ("Cone", "height"): _shapes("cone", "height", 0.5, 1.4),
    ("Torus", "radius"): _shapes("torus", "radius", 0.4, 0.8),
    ("Torus", "tube"): _shapes("torus", "tube", 0.08, 0.25, radius=0.7),
    ("TorusKnot", "p"): _shapes("torus_knot", "p", 2, 3, q=5, radius=0.6, tube=0.1, segments=256),
    ("TorusKnot", "q"): _shapes("torus_knot", "q", 3, 7, p=2, radius=0.6, tube=0.1, segments=256),
    ("DisplacedSphere", "amplitude"): _shapes(
        "displaced_sphere", "amplitude", 0.03, 0.15, radius=0.7, segments=96
    ),
    ("DisplacedSphere", "frequency"): _shapes(
        "displaced_sphere", "frequency", 3, 9, radius=0.7, segments=96
    ),
    ("HeightField", "amplitude"): _shapes("height_field", "amplitude", 0.05, 0.3, size=[2, 2]),
    ("HeightField", "frequency"): _shapes(
        "height_field", "frequency", 2, 8, size=[2, 2], amplitude=0.1
    ),
}
"""From a definition of the schema and a key of it to the pictures: what stands under each, and what it changes."""


HEAT_MAPS = {
    ("FilmDescription", "error"),
    ("FilmDescription", "subdivision"),
    ("SubdivisionDescription", "threshold"),
    ("SubdivisionDescription", "depth"),
}
"""Keys that say where rays go: beside a picture that is sampled adaptively stands the heat map of its rays."""
