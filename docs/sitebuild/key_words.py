"""What is said of a key of scene files that has no pictures: that it shows nothing, or where its pictures are."""

NOTHING = "It shows nowhere in the picture."

SHAPES = (
    *("Quad", "Box", "Sphere", "Disk", "Cylinder", "Cone", "Torus", "TorusKnot"),
    *("DisplacedSphere", "HeightField", "MeshFile"),
)

FLAT = ("Quad", "Box", "Disk")

WORDS: dict[tuple[str, str], str] = {
    ("SceneDescription", "title"): NOTHING,
    **{
        ("IntegratorDescription", key): "It changes the noise and the time, not what is shown."
        for key in ("light_sampling", "gloss_sampling", "roulette")
    },
    **{
        ("BackdropEnvironment", key): "It shows as it does of a texture and of other environments."
        for key in ("interpolation", "scale")
    },
    (
        "TextureDescription",
        "interpolation",
    ): "The nearest pixel shows where one of the texture covers several of the picture, trilinear where it is the other"
    " way round.",
    (
        "MeshFile",
        "normals",
    ): "It shows in coarse meshes alone, whose triangles differ much in size.",
    ("AccelerationDescription", "type"): "Both find the same triangles: the picture is the same.",
    (
        "AccelerationDescription",
        "leaf_size",
    ): "It changes the tests and the time, not what is shown.",
    (
        "LensDescription",
        "samples",
    ): "All fill the disk evenly: noise and time change, not what is shown.",
    **{
        ("LimitsDescription", key): "It decides what is refused, not what is shown."
        for key in ("bytes", "pixels")
    },
    **{(shape, "name"): NOTHING for shape in SHAPES},
    **{(shape, "shading"): "Its faces are flat: both look the same." for shape in FLAT},
}

ELSEWHERE: dict[tuple[str, str], tuple[str, str]] = {
    ("CubeEnvironment", "lookup"): ("LatLongEnvironment", "lookup"),
    ("CubeEnvironment", "scale"): ("LatLongEnvironment", "scale"),
    ("CubeEnvironment", "lights"): ("LatLongEnvironment", "lights"),
    ("CubeEnvironment", "sampling"): ("ConstantEnvironment", "sampling"),
    ("CubeEnvironment", "seen_by"): ("ConstantEnvironment", "seen_by"),
    **{
        ("AngularEnvironment", key): ("LatLongEnvironment", key)
        for key in ("image", "size", "scale", "lookup", "lights")
    },
    **{
        ("AngularEnvironment", key): ("ConstantEnvironment", key) for key in ("sampling", "seen_by")
    },
    ("LatLongEnvironment", "sampling"): ("ConstantEnvironment", "sampling"),
    ("LatLongEnvironment", "seen_by"): ("ConstantEnvironment", "seen_by"),
    ("RectangleLight", "intensity"): ("SphereLight", "intensity"),
    ("SphereLight", "radiance"): ("RectangleLight", "radiance"),
    **{
        (shape, "segments"): ("Sphere", "segments")
        for shape in ("Disk", "Cylinder", "Cone", "Torus")
    },
    **{
        (shape, "shading"): ("Sphere", "shading")
        for shape in SHAPES
        if shape not in {"Sphere", *FLAT}
    },
}
"""From a definition of the schema and a key of it to another of the same meaning that has pictures."""
