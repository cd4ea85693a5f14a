"""The scene format: one frozen Struct for each map that a scene file may hold."""

from __future__ import annotations

from course.scene.description.acceleration import AccelerationDescription
from course.scene.description.camera import (
    CameraDescription,
    ImagePlaneDescription,
    LensDescription,
    ShutterDescription,
)
from course.scene.description.environment import (
    ConstantEnvironment,
    CubeEnvironment,
    Environment,
    EnvironmentDescription,
    LatLongEnvironment,
)
from course.scene.description.film import FilmDescription
from course.scene.description.gloss import BallLobe, Gloss, PhongLobe, PlaneLobe
from course.scene.description.integrator import IntegratorDescription
from course.scene.description.lights import (
    AmbientLight,
    DirectionalLight,
    Light,
    LightDescription,
    ObjectLight,
    PointLight,
    RectangleLight,
    SphereLight,
)
from course.scene.description.limits import LimitsDescription
from course.scene.description.materials import Conductor, Dielectric, MaterialDescription
from course.scene.description.motion import MotionDescription
from course.scene.description.objects import (
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
from course.scene.description.sampler import SamplerDescription
from course.scene.description.scene import SceneDescription
from course.scene.description.transforms import (
    Affine,
    Rotate,
    Rotation,
    Scale,
    Transform,
    Translate,
)
from course.scene.description.values import Color, Reflectance, Vector, rgb

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
