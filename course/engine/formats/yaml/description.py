"""The scene format: one frozen Struct for each map that a scene file may hold.

Lights are told apart by `type`, objects by `shape`, gloss by `lobe`; y is up, and every shape is centred on the origin.
In the file a step of `transform` is told by its only key, `{translate: [0, 1, 0]}`. A union of Structs needs a tag, so
loading adds `STEP: translate` to each step before it is converted; it stands in no file.
"""

from typing import Annotated, Any, Final, Literal, TypeAlias

import msgspec
import numpy as np
from numpy.typing import NDArray

from course.base.inputs import LARGEST_DATA, MOST_PIXELS


class Map(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A map of a scene file: a misspelt key is never passed over."""


Vector: TypeAlias = tuple[float, float, float]

_Fraction: TypeAlias = Annotated[float, msgspec.Meta(ge=0, le=1)]
_NotNegative: TypeAlias = Annotated[float, msgspec.Meta(ge=0)]
_Positive: TypeAlias = Annotated[float, msgspec.Meta(gt=0)]

_ThreeFractions: TypeAlias = Annotated[
    tuple[_Fraction, ...], msgspec.Meta(min_length=3, max_length=3)
]
_ThreeNotNegative: TypeAlias = Annotated[
    tuple[_NotNegative, ...], msgspec.Meta(min_length=3, max_length=3)
]

# A colour is a number, for grey, or red, green and blue; linear light, not sRGB. The three are a
# tuple bounded in length, not tuple[F, F, F]: msgspec 0.22 crashes in the garbage collector on a
# union of a bounded number and a tuple of fixed length.
Reflectance: TypeAlias = _Fraction | _ThreeFractions
Color: TypeAlias = _NotNegative | _ThreeNotNegative


def about(description: str, unit: str | None = None, **bounds: Any) -> msgspec.Meta:
    """Describe a key of the scene format, for the checks and for the JSON schema.

    Parameters
    ----------
    description : one line, as the reference page shows it
    unit : written as ``x-unit`` in the schema; "world unit" is the scene's own unit of length
    bounds : gt, ge, lt, le, min_length or pattern, as `msgspec.Meta` has them
    """
    extra = None if unit is None else {"x-unit": unit}
    return msgspec.Meta(description=description, extra_json_schema=extra, **bounds)


def rgb(color: float | tuple[float, ...]) -> NDArray[np.float64]:
    """Red, green and blue of a colour that may be given as one number.

    Returns (3,) float64: in the colour's own unit; a number is repeated in all three channels.
    """
    return np.array(np.broadcast_to(np.asarray(color, dtype=np.float64), (3,)))


class MotionDescription(Map, frozen=True, kw_only=True):
    """Straight and even motion; where things stand is where they are at time 0."""

    velocity: Annotated[Vector, about("How far it goes in a second.", "world unit/s")] = (
        0.0,
        0.0,
        0.0,
    )


STEP: Final = "<step>"

Row: TypeAlias = tuple[float, float, float, float]


class TransformStep(Map, frozen=True, kw_only=True, tag_field=STEP):
    """What all steps have in common."""


class Rotation(Map, frozen=True, kw_only=True):
    """A turn about an axis through the origin; counter-clockwise seen from the axis' tip."""

    axis: Annotated[Vector, about("Direction of the axis; any length but 0.")]
    degrees: Annotated[float, about("Angle of the turn.", "degree")]


class Translate(TransformStep, frozen=True, kw_only=True, tag="translate"):
    """Move."""

    translate: Annotated[Vector, about("How far to move along x, y and z.", "world unit")]


class Scale(TransformStep, frozen=True, kw_only=True, tag="scale"):
    """Scale about the origin; negative factors mirror."""

    scale: Annotated[float | Vector, about("Factor, or one for each of x, y and z; none is 0.")]


class Rotate(TransformStep, frozen=True, kw_only=True, tag="rotate"):
    """Turn."""

    rotate: Annotated[Rotation, about("Axis and angle.")]


class Affine(TransformStep, frozen=True, kw_only=True, tag="matrix"):
    """Any affine map."""

    matrix: Annotated[
        tuple[Row, Row, Row, Row],
        about(
            "Rows of the matrix that takes a place, as the column (x, y, z, 1), to where it goes;"
            " the last one is 0 0 0 1, and nothing is flattened."
        ),
    ]


Transform: TypeAlias = Translate | Scale | Rotate | Affine


class GlossDescription(Map, frozen=True, kw_only=True, tag_field="lobe"):
    """What all lobes have in common: `lobe` tells them apart."""


class PlaneLobe(GlossDescription, frozen=True, kw_only=True, tag="plane"):
    """The mirrored direction is moved on a square at right angles to it."""

    roughness: Annotated[float, about("Edge of the square, at distance 1; 0 is a mirror.", ge=0)]
    basis: Annotated[
        Literal["module", "smallest"],
        about(
            "How the square is turned: as `jitter_on_plane` of the module glossy has it; or with one edge at right"
            " angles both to the direction and to what becomes of the direction if its smallest component is set to 1."
            " Then that function is not called."
        ),
    ] = "module"


class BallLobe(GlossDescription, frozen=True, kw_only=True, tag="ball"):
    """The mirrored direction's end is moved within a ball."""

    glossiness: Annotated[float, about("Radius of the ball; 0 is a mirror.", ge=0, lt=1)]


class PhongLobe(GlossDescription, frozen=True, kw_only=True, tag="phong"):
    """Directions with a density of cos(angle)^exponent about the mirrored one."""

    exponent: Annotated[float, about("The larger, the sharper.", ge=0)]


Gloss: TypeAlias = PlaneLobe | BallLobe | PhongLobe


class Dielectric(Map, frozen=True, kw_only=True):
    """The clear inside of a material that refracts, such as glass."""

    refraction_index: Annotated[float, about("Index of refraction against vacuum.", gt=0)] = 1.5
    absorption: Annotated[
        Color,
        about("Absorption coefficient: light fades by exp(-absorption * length).", "1/world unit"),
    ] = 0.0
    shaded: Annotated[
        bool, about("Whether the ambient and diffuse terms are added to what it reflects.")
    ] = False
    roughness: Annotated[
        float,
        about(
            "Frosted glass: refracted directions are moved on a square of this edge, at distance 1;"
            " 0 is clear glass. With distribution ggx it is alpha, up to 1.",
            ge=0,
        ),
    ] = 0.0
    distribution: Annotated[
        Literal["square", "ggx"],
        about(
            "What the roughness is: the edge of a `square`, or the slopes of microfacets with a distribution by"
            " `ggx`, which the module microfacets draws; they blur what is mirrored, too."
        ),
    ] = "square"
    surrounded_by: Annotated[
        str | None,
        about(
            "Name of the dielectric that lies all around it, such as the water that a glass ball lies in; null for"
            " vacuum. Surfaces of the two must not touch or cross."
        ),
    ] = None


class Conductor(Map, frozen=True, kw_only=True):
    """A metal: by the Fresnel equations it mirrors more the more grazing the light, white at last."""

    refraction_index: Annotated[
        Color, about("Real part of the index of refraction, against vacuum.")
    ]
    absorption_index: Annotated[
        Color, about("Imaginary part of the index of refraction, the extinction coefficient.")
    ]
    fresnel: Annotated[
        Literal["exact", "approximate"],
        about(
            "The Fresnel equations, or their usual approximation, which holds where n^2 + k^2 is much larger than 1."
        ),
    ] = "exact"
    roughness: Annotated[
        float,
        about(
            "Alpha of the microfacets: half of the surface is turned by less than arctan(alpha). The module"
            " microfacets draws them; 0 is smooth.",
            ge=0,
            le=1,
        ),
    ] = 0.0
    distribution: Annotated[
        Literal["ggx"], about("Which microfacets there are: their normals' distribution.")
    ] = "ggx"


_Times: TypeAlias = Annotated[float, msgspec.Meta(gt=0, le=1e4)]


class Facets(Map, frozen=True, kw_only=True):
    """A highlight by Torrance and Sparrow: mirrors whose normals lie as dense as the exponent's power of a cosine."""

    refraction_index: Annotated[
        float, about("Index of refraction of the facets against what surrounds them.", gt=0, le=1e4)
    ] = 1.5
    absorption_index: Annotated[
        float, about("Imaginary part of that index: 0 of what is no metal.", ge=0, le=1e4)
    ] = 0.0
    covers: Annotated[
        bool, about("Whether the diffuse term gets what the facets leave of a light, and not all.")
    ] = False


_Layer: TypeAlias = Annotated[
    Annotated[str, msgspec.Meta(min_length=1)] | None,
    about(
        "Which layer of an EXR file, such as ViewLayer.Combined; null for the one without a name, or the only one."
    ),
]


class TextureDescription(Map, frozen=True, kw_only=True):
    """A picture on a surface, repeated beyond its edges."""

    image: Annotated[
        str,
        about(
            "File of the picture, relative to the scene file: PNG, JPEG, EXR or HDR, nothing in it above 1.",
            min_length=1,
        ),
    ]
    layer: _Layer = None
    repeat: Annotated[
        tuple[_Times, _Times],
        about(
            "How often the picture repeats along u and v: a quad's x and -z, a sphere's longitude and latitude,"
            " and the texture coordinates of a mesh."
        ),
    ] = (1.0, 1.0)
    interpolation: Annotated[
        Literal["bilinear", "nearest", "trilinear"],
        about(
            "What is seen between the middles of pixels: a mixture, or the nearest pixel; trilinear is a mixture of"
            " smaller pictures, too, where a pixel of the render covers more than one of the texture."
        ),
    ] = "bilinear"


class NormalMapDescription(Map, frozen=True, kw_only=True):
    """A picture of shading normals: red along u, green along v, blue along the normal, each from -1 to 1."""

    image: Annotated[
        str,
        about(
            "File of the picture, relative to the scene file. Codes of PNG and JPEG are taken as they are, without"
            " sRGB's curve; (0.5, 0.5, 1) is the normal itself.",
            min_length=1,
        ),
    ]
    layer: _Layer = None
    repeat: Annotated[
        tuple[_Times, _Times],
        about("How often the picture repeats along u and v, as of a texture."),
    ] = (1.0, 1.0)
    interpolation: Annotated[
        Literal["bilinear", "nearest"],
        about(
            "Which normal there is between the middles of pixels: a mixture, or the nearest one."
        ),
    ] = "bilinear"


class NoiseDescription(Map, frozen=True, kw_only=True):
    """Perlin's noise in the object's own coordinates, as if it were carved from it."""

    scale: Annotated[
        float, about("Grains along one unit of the object.", "1/world unit", gt=0, le=1e4)
    ] = 4.0
    conversion: Annotated[
        Literal["linear", "absolute"],
        about("What becomes of noise n, from -1 to 1: (n + 1) / 2, or its absolute value: veins."),
    ] = "linear"


class BumpDescription(Map, frozen=True, kw_only=True):
    """Shading normals of a surface that is raised along its normals; exactly one of image and noise."""

    image: Annotated[
        str | None,
        about(
            "File of a picture, relative to the scene file. Its grey is the share of height: the mean of the codes,"
            " without sRGB's curve."
        ),
    ] = None
    layer: _Layer = None
    repeat: Annotated[
        tuple[_Times, _Times],
        about("How often the picture repeats along u and v, as of a texture."),
    ] = (1.0, 1.0)
    noise: Annotated[
        NoiseDescription | None, about("Noise whose value is the share of height.")
    ] = None
    height: Annotated[
        float,
        about(
            "How high white is above black before the object is transformed; below 0 white is deeper. An uneven"
            " scaling counts by its mean.",
            "world unit",
            ge=-1e6,
            le=1e6,
        ),
    ] = 0.1


class MaterialDescription(Map, frozen=True, kw_only=True):
    """Blinn-Phong reflection, with a mirror, a metal or a dielectric on top."""

    color: Annotated[
        Reflectance | None,
        about(
            "Multiplies the ambient and diffuse terms; "
            "left out, it is 0.8 of what the mirror leaves: 0.8 (1 - mirror) in each channel."
        ),
    ] = None
    ambient: Annotated[
        float, about("Factor of the ambient term; above 1 it makes light.", ge=0, le=1e6)
    ] = 1.0
    diffuse: Annotated[
        float, about("Factor of the diffuse term; above 1 it may make light.", ge=0, le=1e6)
    ] = 1.0
    ambient_color: Annotated[
        Reflectance | None, about("Colour of the ambient term, where it is another than color.")
    ] = None
    specular: Annotated[Color, about("Colour of the highlight; a sharp one may exceed 1.")] = 0.0
    exponent: Annotated[float, about("Blinn-Phong exponent of the highlight.", ge=0)] = 32.0
    highlight: Annotated[
        Literal["cosine", "plain", "phong", "plain_phong"],
        about(
            "Blinn's highlight, about the half vector, or Phong's, about the mirrored direction. cosine and phong fade"
            " with the cosine between light and normal, as the diffuse term does; the plain ones don't, as in the"
            " models' first form."
        ),
    ] = "cosine"
    facets: Annotated[
        Facets | None,
        about("Makes the highlight that of microfacets; null for one by exponent alone."),
    ] = None
    emission: Annotated[
        Color,
        about(
            "What the surface sends out by itself, the same from both sides and in all directions. It counts wherever"
            " a ray meets it. No shadow ray looks for it, so only path tracing and radiosity light others by it, unless"
            " the object is one of the lights, by type: object.",
            "W/(m^2 sr)",
        ),
    ] = 0.0
    unlit: Annotated[
        Color,
        about(
            "Radiance of white that is seen whatever the light, times color and its texture or noise, in the place of"
            " the ambient and the diffuse term; 0 for a surface that is lit.",
            "W/(m^2 sr)",
        ),
    ] = 0.0
    mirror: Annotated[Reflectance, about("Share of the light that is mirrored.")] = 0.0
    gloss: Annotated[Gloss | None, about("Blurs what is mirrored; null for a perfect mirror.")] = (
        None
    )
    dielectric: Annotated[
        Dielectric | None, about("Makes the material refract; null where it is opaque.")
    ] = None
    conductor: Annotated[
        Conductor | None,
        about(
            "Makes the mirror a metal's: its Fresnel reflectance times mirror; null where it is none."
        ),
    ] = None
    texture: Annotated[
        TextureDescription | None,
        about(
            "A picture that multiplies color and ambient_color from place to place; with one, color left out is all"
            " that the mirror leaves."
        ),
    ] = None
    specular_texture: Annotated[
        TextureDescription | None,
        about("A picture that multiplies specular from place to place; null for none."),
    ] = None
    noise: Annotated[
        NoiseDescription | None,
        about(
            "Noise that multiplies color and ambient_color from place to place, in the place of a texture; null for"
            " none."
        ),
    ] = None
    normal_map: Annotated[
        NormalMapDescription | None,
        about("A picture that turns the shading normals from place to place; null for none."),
    ] = None
    bump: Annotated[
        BumpDescription | None,
        about("Heights whose slopes tilt the shading normals; null for none. Outlines stay flat."),
    ] = None


MOST_KNOT_SEGMENTS: Final = 16384
"""Flat pieces along the tube of a knot."""

_Segments: TypeAlias = Annotated[int, about("Flat pieces around the axis.", ge=3, le=4096)]


class ObjectDescription(Map, frozen=True, kw_only=True, tag_field="shape"):
    """The keys that all shapes share."""

    material: Annotated[str, about("Name of one of the materials.", min_length=1)]
    name: Annotated[str, about("Name for messages, tables and lights of type object.")] = ""
    shading: Annotated[
        Literal["smooth", "flat"], about("Interpolated normals, or one for each triangle.")
    ] = "smooth"
    transform: Annotated[
        tuple[Transform, ...], about("Steps applied in order, the first one first.")
    ] = ()
    motion: Annotated[MotionDescription, about("How the object moves.")] = MotionDescription()
    from_behind: Annotated[
        Literal["turned", "kept", "unseen"],
        about(
            "What camera rays see that come upon a triangle from behind: it, with its normals turned to the viewer; it,"
            " with normals as they are, which needs integrator.shading_normals: interpolated; or what lies behind it."
            " Other rays see it in any case."
        ),
    ] = "turned"


SHARED: Final = ObjectDescription.__struct_fields__


class Quad(ObjectDescription, frozen=True, kw_only=True, tag="quad"):
    """A rectangle in the plane of x and z; its normal is +y."""

    width: Annotated[float, about("Extent along x.", "world unit", gt=0)] = 1.0
    depth: Annotated[float, about("Extent along z.", "world unit", gt=0)] = 1.0


class Box(ObjectDescription, frozen=True, kw_only=True, tag="box"):
    """A box along the axes."""

    size: Annotated[
        tuple[_Positive, _Positive, _Positive], about("Extents along x, y and z.", "world unit")
    ] = (1.0, 1.0, 1.0)


class Sphere(ObjectDescription, frozen=True, kw_only=True, tag="sphere"):
    """A sphere of triangles with smooth normals."""

    radius: Annotated[float, about("Radius.", "world unit", gt=0)] = 1.0
    segments: _Segments = 64


class Disk(ObjectDescription, frozen=True, kw_only=True, tag="disk"):
    """A disk in the plane of x and z; its normal is +y."""

    radius: Annotated[float, about("Radius.", "world unit", gt=0)] = 1.0
    segments: _Segments = 64


class Cylinder(ObjectDescription, frozen=True, kw_only=True, tag="cylinder"):
    """A cylinder about y, with flat caps."""

    radius: Annotated[float, about("Radius.", "world unit", gt=0)] = 0.5
    height: Annotated[float, about("Extent along y.", "world unit", gt=0)] = 1.0
    segments: _Segments = 64


class Cone(ObjectDescription, frozen=True, kw_only=True, tag="cone"):
    """A cone about y, its tip up, with a flat base."""

    radius: Annotated[float, about("Radius of the base.", "world unit", gt=0)] = 0.5
    height: Annotated[float, about("Extent along y.", "world unit", gt=0)] = 1.0
    segments: _Segments = 64


class Torus(ObjectDescription, frozen=True, kw_only=True, tag="torus"):
    """A ring about y."""

    radius: Annotated[float, about("Radius of the ring's middle line.", "world unit", gt=0)] = 1.0
    tube: Annotated[float, about("Radius of the tube, less than radius.", "world unit", gt=0)] = (
        0.25
    )
    segments: _Segments = 96
    sides: Annotated[int, about("Flat pieces around the tube.", ge=3, le=4096)] = 48


class TorusKnot(ObjectDescription, frozen=True, kw_only=True, tag="torus_knot"):
    """A tube along the (p, q) knot on a torus; p and q have no common divisor."""

    p: Annotated[int, about("Turns about the axis.", ge=1, le=32)] = 2
    q: Annotated[int, about("Turns through the hole.", ge=1, le=32)] = 3
    radius: Annotated[float, about("Radius of the torus.", "world unit", gt=0)] = 1.0
    tube: Annotated[
        float,
        about("Radius of the tube, so thin that it meets itself nowhere.", "world unit", gt=0),
    ] = 0.2
    segments: Annotated[
        int, about("Flat pieces along the tube, at least 8 (p + q).", ge=16, le=MOST_KNOT_SEGMENTS)
    ] = 512
    sides: Annotated[int, about("Flat pieces around the tube.", ge=3, le=1024)] = 32


class DisplacedSphere(ObjectDescription, frozen=True, kw_only=True, tag="displaced_sphere"):
    """A bumpy ball: a sphere moved along its normal by a sum of smooth waves."""

    radius: Annotated[float, about("Radius without the bumps.", "world unit", gt=0)] = 1.0
    amplitude: Annotated[
        float, about("Height of the bumps, less than radius.", "world unit", ge=0)
    ] = 0.1
    frequency: Annotated[float, about("Bumps around the ball.", gt=0, le=1e6)] = 6.0
    segments: Annotated[int, about("Flat pieces around the axis.", ge=3, le=4096)] = 256
    seed: Annotated[int, about("Chooses the waves.", ge=0, le=2**32 - 1)] = 0


class HeightField(ObjectDescription, frozen=True, kw_only=True, tag="height_field"):
    """Hills over the plane of x and z: a sum of smooth waves."""

    size: Annotated[tuple[_Positive, _Positive], about("Extents along x and z.", "world unit")] = (
        1.0,
        1.0,
    )
    amplitude: Annotated[float, about("Height of the hills.", "world unit", ge=0)] = 0.1
    frequency: Annotated[float, about("Waves across the field.", gt=0, le=1e6)] = 4.0
    segments: Annotated[int, about("Cells along each side.", ge=1, le=4096)] = 128
    seed: Annotated[int, about("Chooses the waves.", ge=0, le=2**32 - 1)] = 0


class MeshFile(ObjectDescription, frozen=True, kw_only=True, tag="mesh"):
    """A mesh from a PLY, OBJ, STL, GLB or glTF file."""

    file: Annotated[str, about("Path of the file, relative to the scene file.", min_length=1)]
    materials: Annotated[
        dict[str, str],
        about(
            "Materials of faces, by the names that the file gives to theirs: those of usemtl in an OBJ file, and of the"
            " materials of a GLB file. Faces of other names have material."
        ),
    ] = msgspec.field(default_factory=dict)
    only: Annotated[
        Annotated[tuple[str, ...], msgspec.Meta(min_length=1)] | None,
        about(
            "Names of the file's materials whose faces are this object, an empty one for faces without; null for all"
            " faces."
        ),
    ] = None
    normals: Annotated[
        Literal["angle", "area"],
        about(
            "By what the faces around a vertex count in its normal, where the file has none: `angle`, and vertices at"
            " one place are smooth up to 40 degrees; `area`, and only those that faces share are smooth."
        ),
    ] = "angle"


Object: TypeAlias = (
    Quad
    | Box
    | Sphere
    | Disk
    | Cylinder
    | Cone
    | Torus
    | TorusKnot
    | DisplacedSphere
    | HeightField
    | MeshFile
)


_Intensity: TypeAlias = Annotated[
    Color | None,
    about("Every point of the light carries this whole intensity; or give radiance.", "W/sr"),
]
_Radiance: TypeAlias = Annotated[
    Color | None,
    about("Lambertian emission, which the camera sees; or give intensity.", "W/(m^2 sr)"),
]
_Motion: TypeAlias = Annotated[MotionDescription, about("How the light moves.")]


class LightDescription(Map, frozen=True, kw_only=True, tag_field="type"):
    """What all lights have in common: `type` tells them apart."""


class AmbientLight(LightDescription, frozen=True, kw_only=True, tag="ambient"):
    """Light that is everywhere and casts no shadow."""

    radiance: Annotated[Color, about("Radiance from every direction.", "W/(m^2 sr)")]


class PointLight(LightDescription, frozen=True, kw_only=True, tag="point"):
    """A light without extent."""

    position: Annotated[Vector, about("Where it is.", "world unit")]
    intensity: Annotated[Color, about("Radiant intensity.", "W/sr")]
    shadow_rays: Annotated[
        Literal["short", "whole"],
        about(
            "Whether shadow rays end just short of the light, or at the light itself: then a surface in which the light"
            " lies hides it."
        ),
    ] = "short"
    motion: _Motion = MotionDescription()


class SpotLight(PointLight, frozen=True, kw_only=True, tag="spot"):
    """A point light that shines into a cone, with a soft edge."""

    direction: Annotated[Vector, about("Way along the middle of the cone; any length but 0.")]
    inner_angle: Annotated[
        float,
        about(
            "Angle from the direction up to which it has its whole intensity.",
            "degree",
            ge=0,
            le=180,
        ),
    ] = 20.0
    outer_angle: Annotated[
        float,
        about(
            "Angle from which on it is dark, not less than inner_angle. Between the two it falls off as the fourth"
            " power of a line in the angle's cosine.",
            "degree",
            gt=0,
            le=180,
        ),
    ] = 30.0


class DirectionalLight(LightDescription, frozen=True, kw_only=True, tag="directional"):
    """A light infinitely far away."""

    direction: Annotated[Vector, about("Direction the light travels in; any length but 0.")]
    irradiance: Annotated[Color, about("Irradiance of a surface that faces it.", "W/m^2")]


class RectangleLight(LightDescription, frozen=True, kw_only=True, tag="rectangle"):
    """A parallelogram; by radiance it emits towards cross(edge_u, edge_v), unless it is two-sided."""

    corner: Annotated[Vector, about("One corner.", "world unit")]
    edge_u: Annotated[Vector, about("Edge from the corner.", "world unit")]
    edge_v: Annotated[Vector, about("Other edge from the corner.", "world unit")]
    intensity: _Intensity = None
    radiance: _Radiance = None
    samples: Annotated[
        str,
        about(
            "`point`: one random point for each sample; `grid K`: the centres of K x K cells.",
            pattern=r"^(point|grid [1-9][0-9]?)$",
        ),
    ] = "point"
    two_sided: Annotated[
        bool, about("By radiance: whether it shines to both sides; then it can't be visible.")
    ] = False
    visible: Annotated[
        bool, about("By radiance: whether rays can see it, and whether it casts shadows.")
    ] = True
    motion: _Motion = MotionDescription()


class SphereLight(LightDescription, frozen=True, kw_only=True, tag="sphere"):
    """A ball that shines outwards; by radiance its radius must be over 0."""

    center: Annotated[Vector, about("Centre.", "world unit")]
    radius: Annotated[float, about("Radius.", "world unit", ge=0)]
    intensity: _Intensity = None
    radiance: _Radiance = None
    samples: Annotated[
        Literal[
            "sphere",
            "ball",
            "facing disk",
            "visible",
            "sphere by polar",
            "ball by polar",
            "ball by rejection",
        ],
        about(
            "Where its light comes from: the surface, the whole ball, or the disk that it shows;"
            " by radiance the surface, or only what is visible of it, which is less noisy."
            " What names a way takes points by `sphere_by_polar`, `ball_by_polar` or `ball_by_rejection` of the"
            " module sampling, the first three values by functions of soft_shadows. `ball by rejection` draws"
            " numbers of its own."
        ),
    ] = "sphere"
    motion: _Motion = MotionDescription()


class ObjectLight(LightDescription, frozen=True, kw_only=True, tag="object"):
    """An object whose material has emission, which then lights others: shadow rays look for it at every hit."""

    object: Annotated[
        str,
        about(
            "Name of one of the objects; its shape, its motion and its material's emission are the light's.",
            min_length=1,
        ),
    ]


Light: TypeAlias = (
    AmbientLight
    | PointLight
    | SpotLight
    | DirectionalLight
    | RectangleLight
    | SphereLight
    | ObjectLight
)


_Lights: TypeAlias = Annotated[
    bool, about("Whether it also lights diffuse surfaces, by one shadow ray for each sample.")
]
_Sampling: TypeAlias = Annotated[
    Literal["automatic", "uniform", "cosine", "power", "inversion", "alias"],
    about(
        "How directions towards its light are chosen: `automatic`, by the cosine and the picture's brightness; by"
        " the module importance_sampling, `uniform`, by the `cosine`, or half and half with the `power` heuristic; or"
        " by the module environment_light, as the picture is bright, by `inversion` or by an `alias` table."
    ),
]
_SeenBy: TypeAlias = Annotated[
    Literal["all", "camera"],
    about("Which rays see it: all of them, or only those from the camera, like a backdrop."),
]
_Scale: TypeAlias = Annotated[Color, about("Radiance of white.", "W/(m^2 sr)")]
_Lookup: TypeAlias = Annotated[
    Literal["seamless", "clamped"],
    about("Whether the interpolation goes on across the cube's edges."),
]


class EnvironmentDescription(Map, frozen=True, kw_only=True, tag_field="type"):
    """What all environments have in common: `type` tells them apart."""


class ConstantEnvironment(EnvironmentDescription, frozen=True, kw_only=True, tag="constant"):
    """The same radiance from every direction."""

    radiance: Annotated[Color, about("Radiance of the background.", "W/(m^2 sr)")] = 0.0
    lights: _Lights = False
    sampling: _Sampling = "automatic"
    seen_by: _SeenBy = "all"


class CubeEnvironment(EnvironmentDescription, frozen=True, kw_only=True, tag="cube"):
    """Six square pictures around the scene, PNG, JPEG, EXR or Radiance HDR; exactly one of faces and cross."""

    faces: Annotated[
        tuple[str, str, str, str, str, str] | None,
        about("Files of the faces +x, -x, +y, -y, +z, -z, in the OpenGL orientation."),
    ] = None
    cross: Annotated[str | None, about("File of a horizontal (4:3) or vertical (3:4) cross.")] = (
        None
    )
    layer: _Layer = None
    scale: _Scale = 1.0
    lookup: _Lookup = "seamless"
    lights: _Lights = False
    sampling: _Sampling = "automatic"
    seen_by: _SeenBy = "all"


class LatLongEnvironment(EnvironmentDescription, frozen=True, kw_only=True, tag="lat_long"):
    """A picture of all directions, longitude by latitude: -z in its middle, +x to the right of it, +y at its top."""

    image: Annotated[
        str,
        about("File of the picture, twice as wide as high: PNG, JPEG, EXR or HDR.", min_length=1),
    ]
    layer: _Layer = None
    size: Annotated[
        Annotated[int, msgspec.Meta(ge=1, le=8192)] | None,
        about("Edge of the cube's faces; half the height if null.", "pixel"),
    ] = None
    scale: _Scale = 1.0
    lookup: _Lookup = "seamless"
    lights: _Lights = False
    sampling: _Sampling = "automatic"
    seen_by: _SeenBy = "all"


class AngularEnvironment(LatLongEnvironment, frozen=True, kw_only=True, tag="angular"):
    """A light probe: all directions in a disk, -z in its middle, +x right, +y up, and +z all around its rim."""

    image: Annotated[
        str, about("File of the picture, as wide as high: PNG, JPEG, EXR or HDR.", min_length=1)
    ]
    size: Annotated[
        Annotated[int, msgspec.Meta(ge=1, le=8192)] | None,
        about("Edge of the cube's faces; a quarter of the width if null.", "pixel"),
    ] = None


class BackdropEnvironment(EnvironmentDescription, frozen=True, kw_only=True, tag="backdrop"):
    """A picture that fills what the camera sees behind everything, and moves with it; no other ray sees it."""

    image: Annotated[
        str, about("File of the picture, of any proportions: PNG, JPEG, EXR or HDR.", min_length=1)
    ]
    layer: _Layer = None
    interpolation: Annotated[
        Literal["bilinear", "nearest"],
        about("What is seen between the middles of pixels: a mixture, or the nearest pixel."),
    ] = "bilinear"
    scale: _Scale = 1.0

    @property
    def lights(self) -> bool:
        """It lights nothing."""
        return False

    @property
    def sampling(self) -> str:
        """No direction towards it is chosen."""
        return "automatic"

    @property
    def seen_by(self) -> str:
        """Which rays see it."""
        return "camera"


Environment: TypeAlias = (
    ConstantEnvironment
    | CubeEnvironment
    | LatLongEnvironment
    | AngularEnvironment
    | BackdropEnvironment
)


class LensDescription(Map, frozen=True, kw_only=True):
    """A thin lens; exactly one of focus_distance and focus_point."""

    aperture_radius: Annotated[
        float, about("Radius of the lens; 0 is a pinhole.", "world unit", ge=0)
    ]
    shape: Annotated[
        Literal["disk", "square", "polygon"],
        about("Shape of the aperture: a disk, the square around it, or a regular polygon in it."),
    ] = "disk"
    blades: Annotated[int, about("Corners of the polygon.", ge=3, le=32)] = 6
    samples: Annotated[
        Literal["point", "polar", "rejection"],
        about(
            "What places points on a disk: `point_on_disk` of the module thin_lens, or `disk_by_polar` or "
            "`disk_by_rejection` of the module sampling. The last one draws numbers of its own."
        ),
    ] = "point"
    focus_distance: Annotated[
        float | None, about("Distance of the plane in focus, along the view.", "world unit")
    ] = None
    focus_point: Annotated[Vector | None, about("A point of the plane in focus.", "world unit")] = (
        None
    )


class ShutterDescription(Map, frozen=True, kw_only=True):
    """When the shutter opens and closes; it only matters where something moves."""

    open: Annotated[float, about("When it opens.", "second")] = 0.0
    close: Annotated[float, about("When it closes, not before it opens.", "second")] = 1.0


class ImagePlaneDescription(Map, frozen=True, kw_only=True):
    """The picture as a rectangle in front of the eye; it may lie off the view's axis, and stretch its pixels."""

    distance: Annotated[
        float, about("Its distance from the eye, along the view.", "world unit", gt=0)
    ] = 1.0
    left: Annotated[
        float, about("Where its left edge is, seen from the view's axis.", "world unit")
    ]
    right: Annotated[float, about("Its right edge, more than left.", "world unit")]
    bottom: Annotated[float, about("Its lower edge.", "world unit")]
    top: Annotated[float, about("Its upper edge, more than bottom.", "world unit")]


class CameraDescription(Map, frozen=True, kw_only=True):
    """A perspective camera."""

    eye: Annotated[Vector, about("Centre of projection.", "world unit")]
    look_at: Annotated[Vector, about("Point in the middle of the picture.", "world unit")]
    up: Annotated[Vector, about("Direction that points up in the picture; any length but 0.")] = (
        0.0,
        1.0,
        0.0,
    )
    vertical_fov: Annotated[
        float, about("Angle from the picture's lower to its upper edge.", "degree", gt=0, lt=180)
    ] = 40.0
    image_plane: Annotated[
        ImagePlaneDescription | None, about("The picture's edges; they replace vertical_fov.")
    ] = None
    handedness: Annotated[
        Literal["right", "left"],
        about("Whether the picture shows what is to the right on the right; left mirrors it."),
    ] = "right"
    near: Annotated[
        float,
        about(
            "The camera sees nothing that is nearer than this along the view.", "world unit", ge=0
        ),
    ] = 0.0
    lens: Annotated[LensDescription | None, about("A thin lens; null for a pinhole.")] = None
    shutter: Annotated[ShutterDescription, about("When light is let in.")] = ShutterDescription()
    motion: Annotated[MotionDescription, about("How the camera moves.")] = MotionDescription()


LARGEST_SIDE: Final = 65536
"""Pixels along one side of a picture."""


class SubdivisionDescription(Map, frozen=True, kw_only=True):
    """Adaptive supersampling by contrast: rays through the corners of pixels, more where corners differ."""

    threshold: Annotated[
        float,
        about(
            "Cells with two corners that differ by more than this in some channel are divided into four.",
            "radiance",
            ge=0,
        ),
    ] = 0.1
    depth: Annotated[
        int,
        about(
            "How many times a pixel may be divided: its smallest cells are 1 / 2^depth wide.",
            ge=0,
            le=8,
        ),
    ] = 3


class ToneDescription(Map, frozen=True, kw_only=True):
    """Photographic tone mapping (Reinhard et al., 2002): a picture of any range, brought to what a screen shows."""

    key: Annotated[
        float, about("What the logarithmic mean of the luminances becomes.", gt=0, le=100)
    ] = 0.18
    burn: Annotated[
        float, about("The part of the pixels that may burn out to white.", "percent", ge=0, le=100)
    ] = 1.0
    saturation: Annotated[
        float, about("1 keeps colours as they are, 0 makes the picture grey.", ge=0, le=10)
    ] = 1.0
    gamma: Annotated[
        _Positive | None,
        about("Values are encoded by the power 1 / gamma; null for the film's encoding."),
    ] = None


class DenoiseDescription(Map, frozen=True, kw_only=True):
    """A preview for PNGs: means over neighbours that Welch's test doesn't separate (Sakai et al., 2024)."""

    level: Annotated[
        float, about("Probability that a channel separates two equal pixels.", gt=1e-6, lt=1)
    ] = 0.05
    sigma: Annotated[
        float,
        about(
            "Deviation of the Gaussian over the neighbours, which are within two of it.",
            "pixel",
            ge=0.5,
            le=10,
        ),
    ] = 2.0


class FilmDescription(Map, frozen=True, kw_only=True):
    """Size of the picture and its reconstruction filter."""

    width: Annotated[int, about("Width of the picture.", "pixel", ge=1, le=LARGEST_SIDE)] = 640
    height: Annotated[int, about("Height of the picture.", "pixel", ge=1, le=LARGEST_SIDE)] = 480
    filter: Annotated[
        Literal["box", "gaussian"], about("How the samples of a pixel are weighted.")
    ] = "box"
    error: Annotated[
        _Positive | None,
        about(
            "Sample until the root-mean-square error of the whole picture is estimated to be this; a"
            " radiance of 1 is white. sampler.samples is the most that a pixel takes on average.",
            "radiance",
        ),
    ] = None
    subdivision: Annotated[
        SubdivisionDescription | None,
        about(
            "Rays through the corners of pixels instead of samples within them, and more where corners differ."
            " sampler.samples is the number of rays through each corner."
        ),
    ] = None
    denoise: Annotated[
        DenoiseDescription | None,
        about(
            "A PNG shows means over neighbours, which are biased: a preview. Other files hold the picture as rendered."
        ),
    ] = None
    white: Annotated[
        float,
        about(
            "What a PNG shows as white, and anything brighter too.", "radiance", ge=1e-30, le=1e30
        ),
    ] = 1.0
    encoding: Annotated[
        Literal["srgb", "linear"],
        about(
            "Codes of a PNG: the nearest ones of the sRGB curve, or in proportion to the radiance and rounded down."
        ),
    ] = "srgb"
    exposure: Annotated[
        float, about("A PNG shows 2 to this power times as much light.", "stop", ge=-60, le=60)
    ] = 0.0
    gamut: Annotated[
        Literal["srgb", "display_p3", "rec2020"],
        about("The primaries of the scene's colours; a PNG is in those of sRGB."),
    ] = "srgb"
    tone: Annotated[ToneDescription | None, about("Tone mapping of a PNG; null for none.")] = None
    dither: Annotated[
        bool,
        about("Codes of a PNG are chosen by chance, with the right mean, in place of the nearest."),
    ] = False
    sigma: Annotated[
        float,
        about(
            "Standard deviation of the gaussian filter; a narrower one would leave samples without weight.",
            "pixel",
            ge=0.02,
        ),
    ] = 1 / 6


MOST_SAMPLES: Final = 65536
"""Samples of a pixel."""


class SamplerDescription(Map, frozen=True, kw_only=True):
    """The pattern of samples; `regular` and `jittered` need a square number of them."""

    type: Annotated[
        Literal[
            "sobol",
            "random",
            "jittered",
            "regular",
            "halton",
            "hammersley",
            "chained",
            "xorshift",
            "blue_noise",
            "dithered",
        ],
        about("Pattern of the samples; `blue_noise` and `dithered` spread the error."),
    ] = "sobol"
    samples: Annotated[int, about("Samples a pixel.", "1/pixel", ge=1, le=MOST_SAMPLES)] = 16


DEEPEST: Final = 1024
"""Bounces that can be followed."""

_Bounces = Annotated[int, msgspec.Meta(ge=0, le=DEEPEST)]


MANY_LIGHTS: Final = 64
"""Lights up to which all are asked, unless a scene says otherwise."""


class IntegratorDescription(Map, frozen=True, kw_only=True):
    """Which light reaches the eye, and where the recursion ends."""

    type: Annotated[
        Literal["distribution", "path"],
        about(
            "`distribution`: direct light, seen through mirrors and glass; `path`: all light, that from"
            " wall to wall too."
        ),
    ] = "distribution"
    max_depth: Annotated[int, about("Bounces after the camera ray.", ge=0, le=DEEPEST)] = 5
    cutoff: Annotated[
        float,
        about(
            "A bounced ray is dropped when the largest channel of its throughput is below this;"
            " paths are not, they have the roulette.",
            ge=0,
            lt=1,
        ),
    ] = 1 / 512
    roulette: Annotated[
        _Bounces | None,
        about("Bounces that a path makes before Russian roulette may end it; null for never."),
    ] = 1
    light_sampling: Annotated[
        Literal["automatic", "all", "uniform", "power", "tree"],
        about(
            "Which lights a hit asks for their light: `all`; or one that is chosen at random, so that many lights cost"
            " as little as one: each as probable (`uniform`), in proportion to the `power` that lights send out, or by"
            " a light `tree` of the module many_lights, which knows where the hit is; `automatic`: all of up to"
            f" {MANY_LIGHTS} lights, or one of more, by power."
        ),
    ] = "automatic"
    gloss_sampling: Annotated[
        Literal["automatic", "lobe", "lamp", "balance", "power"],
        about(
            "How glossy surfaces find lamps with a size: by directions of the `lobe`, by points on the `lamp`, or by"
            " both, weighted by the `balance` or the `power` heuristic of the module multiple_importance. For Phong's"
            " lobes and rough metals, and for rectangles and `visible` spheres with a radiance; all others are found by"
            " the lobe. `automatic` is `power` for rough metals and `lobe` for Phong's."
        ),
    ] = "automatic"
    into_surface: Annotated[
        Literal["mirror", "keep"],
        about(
            "What becomes of mirrored, glossy and refracted directions that point to the wrong side of their surface:"
            " mirrored to the right one, or kept, and the ray meets the surface again."
        ),
    ] = "mirror"
    terminator: Annotated[
        Literal["round", "facets"],
        about(
            "Where shadow rays of smooth meshes start: where the round surface would be, or at the flat triangle, whose"
            " neighbours cast shadows on it."
        ),
    ] = "round"
    shading_normals: Annotated[
        Literal["bent", "interpolated"],
        about(
            "What becomes of smooth meshes' normals that look away from the viewer: bent until they are at right angles"
            " to the ray, or left as they are, but for glass."
        ),
    ] = "bent"
    surface_offset: Annotated[
        float,
        about(
            "Least distance from a surface at which rays leave it. Above 0, what lights send is worked out at the"
            " surface itself, though shadow rays start at that distance; at 0 all is done at a distance of the engine's"
            " own, too small to be seen.",
            "world unit",
            ge=0,
        ),
    ] = 0.0


class DensityNoise(Map, frozen=True, kw_only=True):
    """Densities by Perlin's noise: clouds of fog with clear air between them."""

    scale: Annotated[
        float, about("Grains along one unit of the scene.", "1/world unit", gt=0, le=1e4)
    ] = 1.0
    clear: Annotated[float, about("Share of the noise's range that is clear air.", ge=0, lt=1)] = (
        0.5
    )
    cells: Annotated[
        int, about("Cells of the grid along the longest edge of the box.", ge=2, le=256)
    ] = 64


class FogSphere(Map, frozen=True, kw_only=True):
    """A ball of fog."""

    center: Annotated[Vector, about("Its middle.", "world unit")]
    radius: Annotated[float, about("Its radius.", "world unit", gt=0)]


class MediumDescription(Map, frozen=True, kw_only=True):
    """Fog, smoke or dust: what fills space between surfaces, and glass that lies in it too."""

    extinction: Annotated[
        Color,
        about(
            "What is lost on a unit of length: light fades by exp(-extinction * length). With a grid or noise one"
            " number, which densities multiply.",
            "1/world unit",
        ),
    ]
    albedo: Annotated[Reflectance, about("Share of what is lost that is scattered.")] = 1.0
    g: Annotated[
        float,
        about(
            "Mean cosine of the angle between light before and after: above 0 it goes on forwards, below 0 it turns"
            " back, at 0 all directions are alike.",
            ge=-0.99,
            le=0.99,
        ),
    ] = 0.0
    box: Annotated[
        tuple[Vector, Vector] | None,
        about(
            "The lowest and the highest corner of what it fills; without it and sphere, the whole scene and beyond.",
            "world unit",
        ),
    ] = None
    sphere: Annotated[FogSphere | None, about("The ball that it fills, in the place of a box.")] = (
        None
    )
    grid: Annotated[
        str | None,
        about(
            "File of densities, relative to the scene file: an array of three axes, x, y and z, as numpy.save writes"
            " it. Its cells fill the box."
        ),
    ] = None
    noise: Annotated[DensityNoise | None, about("Densities by noise, from 0 to 1.")] = None


class PhotonsDescription(Map, frozen=True, kw_only=True):
    """Caustics by photons: light that mirrors and glass send to matte surfaces, beside direct light.

    With ``gather`` light by way of matte surfaces, too.
    """

    count: Annotated[
        int,
        about(
            "Photons that leave the lamps and the environment, where it lights surfaces, in each pass. A million take"
            " about two seconds.",
            ge=1,
            le=10**9,
        ),
    ] = 200_000
    samples: Annotated[
        int,
        about(
            "Samples of a pixel that share a pass: the next ones have new photons.", ge=1, le=2**20
        ),
    ] = 16
    radius: Annotated[
        _Positive | None,
        about(
            "Radius of the first pass in which photons are looked for around a point; null for a twentieth of that of a"
            " ball around all mirrors and glass.",
            "world unit",
        ),
    ] = None
    alpha: Annotated[
        float,
        about(
            "How slowly the radius shrinks from pass to pass: at 1 it stays, and the smaller alpha, the sharper and"
            " noisier later passes are.",
            ge=0.001,
            le=1,
        ),
    ] = 2 / 3
    cone: Annotated[
        float,
        about(
            "How flat the filter is: at 1 photons at the radius count nothing, and at 1000 as much as near ones. Not"
            " with nearest.",
            ge=1,
            le=1000,
        ),
    ] = 1.1
    nearest: Annotated[
        Annotated[int, msgspec.Meta(ge=1, le=1000)] | None,
        about(
            "How many photons count, the nearest within the radius, whose disk is as small as they are near; null for"
            " all within the radius, by the filter."
        ),
    ] = None
    gather: Annotated[
        int,
        about(
            "Rays that each matte point sends to ask photons where they land (final gathering): light that other matte"
            " surfaces send on. 0 for none, as in paths, which find that light by themselves. Another `count` photons"
            " are sent to all of the scene.",
            ge=0,
            le=1024,
        ),
    ] = 0


class AccelerationDescription(Map, frozen=True, kw_only=True):
    """Who answers the rays: the picture is the same, the time is not."""

    type: Annotated[
        Literal["embree", "hierarchy"],
        about(
            "`embree`: the library; `hierarchy`: `build` and `traverse` of the module bounding_volumes,"
            " for small pictures of what stands still. `course radiosity` takes Embree anyway."
        ),
    ] = "embree"
    leaf_size: Annotated[
        int, about("Most triangles in a leaf of the hierarchy.", ge=1, le=1024)
    ] = 4


class LimitsDescription(Map, frozen=True, kw_only=True):
    """The largest meshes and pictures that are read; larger ones are refused before they take memory."""

    bytes: Annotated[int, about("Most bytes of a mesh or picture file.", ge=1, le=2**50)] = (
        LARGEST_DATA
    )
    pixels: Annotated[
        int,
        about(
            "Most pixels of a picture. Each takes 12 bytes as linear light, and up to 6 more while the file is read.",
            "pixel",
            ge=1,
            le=2**50,
        ),
    ] = MOST_PIXELS


class SceneDescription(Map, frozen=True, kw_only=True):
    """A scene for the Penumbra ray tracer."""

    title: Annotated[str, about("What the picture shows.")] = ""
    seed: Annotated[int, about("Chooses the random numbers.", ge=0, le=2**32 - 1)] = 0
    camera: Annotated[CameraDescription, about("Where the picture is taken from.")]
    film: Annotated[FilmDescription, about("Size of the picture and its filter.")] = (
        FilmDescription()
    )
    sampler: Annotated[SamplerDescription, about("Number and pattern of samples.")] = (
        SamplerDescription()
    )
    integrator: Annotated[IntegratorDescription, about("How far light is followed.")] = (
        IntegratorDescription()
    )
    acceleration: Annotated[
        AccelerationDescription, about("What finds the triangles that rays hit.")
    ] = AccelerationDescription()
    limits: Annotated[
        LimitsDescription, about("How large the files may be that the scene names.")
    ] = LimitsDescription()
    environment: Annotated[Environment, about("What a ray sees that hits nothing.")] = (
        ConstantEnvironment()
    )
    materials: Annotated[
        dict[str, MaterialDescription], about("What objects are made of, by name.")
    ] = msgspec.field(default_factory=dict)
    lights: Annotated[tuple[Light, ...], about("The lights.")] = ()
    objects: Annotated[tuple[Object, ...], about("The objects.")] = ()
    media: Annotated[
        tuple[MediumDescription, ...],
        about("What fills space; boxes and balls of it must not overlap."),
    ] = ()
    photons: Annotated[
        PhotonsDescription | None,
        about("Caustics by photons; null for none. Not in fog."),
    ] = None
