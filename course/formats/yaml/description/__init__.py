"""The scene format: one frozen Struct for each map that a scene file may hold."""

from __future__ import annotations

from course.formats.yaml.description.acceleration import AccelerationDescription
from course.formats.yaml.description.camera import (
    CameraDescription,
    ImagePlaneDescription,
    LensDescription,
    ShutterDescription,
)
from course.formats.yaml.description.environment import (
    ConstantEnvironment,
    CubeEnvironment,
    Environment,
    EnvironmentDescription,
    LatLongEnvironment,
)
from course.formats.yaml.description.film import FilmDescription
from course.formats.yaml.description.gloss import BallLobe, Gloss, PhongLobe, PlaneLobe
from course.formats.yaml.description.integrator import IntegratorDescription
from course.formats.yaml.description.lights import (
    AmbientLight,
    DirectionalLight,
    Light,
    LightDescription,
    ObjectLight,
    PointLight,
    RectangleLight,
    SphereLight,
)
from course.formats.yaml.description.limits import LimitsDescription
from course.formats.yaml.description.materials import Conductor, Dielectric, MaterialDescription
from course.formats.yaml.description.motion import MotionDescription
from course.formats.yaml.description.objects import (
    Box,
    Cone,
    Cylinder,
    Disk,
    DisplacedSphere,
    HeightField,
    MeshFile,
    Object,
    ObjectDescription,
    Quad,
    Sphere,
    Torus,
    TorusKnot,
)
from course.formats.yaml.description.sampler import SamplerDescription
from course.formats.yaml.description.scene import SceneDescription
from course.formats.yaml.description.transforms import (
    Affine,
    Rotate,
    Rotation,
    Scale,
    Transform,
    Translate,
)
from course.formats.yaml.description.values import Color, Reflectance, Vector, rgb

__all__ = [
    "AccelerationDescription",
    "Affine",
    "AmbientLight",
    "BallLobe",
    "Box",
    "CameraDescription",
    "Color",
    "Conductor",
    "Cone",
    "ConstantEnvironment",
    "CubeEnvironment",
    "Cylinder",
    "Dielectric",
    "DirectionalLight",
    "Disk",
    "DisplacedSphere",
    "Environment",
    "EnvironmentDescription",
    "FilmDescription",
    "Gloss",
    "HeightField",
    "ImagePlaneDescription",
    "IntegratorDescription",
    "LatLongEnvironment",
    "LensDescription",
    "Light",
    "LightDescription",
    "LimitsDescription",
    "MaterialDescription",
    "MeshFile",
    "MotionDescription",
    "Object",
    "ObjectDescription",
    "ObjectLight",
    "PhongLobe",
    "PlaneLobe",
    "PointLight",
    "Quad",
    "RectangleLight",
    "Reflectance",
    "Rotate",
    "Rotation",
    "SamplerDescription",
    "Scale",
    "SceneDescription",
    "ShutterDescription",
    "Sphere",
    "SphereLight",
    "Torus",
    "TorusKnot",
    "Transform",
    "Translate",
    "Vector",
    "rgb",
]
