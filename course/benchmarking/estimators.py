"""The measurements: for each module of the course its scene, and the estimators that render it.

Two estimators whose pictures converge to the same one share a reference; where an estimator is of another integral
(a ball instead of its surface, another lobe, another filter) it has a reference of its own.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import sqrt
from pathlib import Path

from course.engine.formats.yaml.overriding import Overrides
from course.engine.functions.effects import PROJECT

SAMPLERS = ("regular", "random", "jittered", "sobol")


@dataclass(frozen=True)
class Estimator:
    """One way to render a module's scene.

    Attributes
    ----------
    variant : what the scene is changed to, such as "ball"; empty where the scene is as its file says
    sampler : name of the sampler
    integral : name of the converged picture that it is measured against
    groups : the comparisons in which it appears
    overrides : of the scene that is rendered
    reference : of the scene that the reference is rendered from
    points : on the light, for each sample of a pixel
    biased : its error is not noise: at no number of samples does a mean over seeds give the converged picture
    """

    variant: str
    sampler: str
    integral: str
    groups: tuple[str, ...]
    overrides: Overrides = field(default_factory=dict)
    reference: Overrides = field(default_factory=dict)
    points: int = 1
    biased: bool = False

    @property
    def name(self) -> str:
        """Unique within its module."""
        return f"{self.variant} {self.sampler}".strip()

    def label(self, group: str) -> str:
        """The label that tells it apart in a comparison."""
        sampler = "Sobol" if self.sampler == "sobol" else self.sampler
        names = {"samplers": sampler, "filters": f"{self.variant}, {sampler}"}
        return names.get(group, self.variant)


@dataclass(frozen=True)
class Module:
    """A module of the course and how its scene is measured.

    Attributes
    ----------
    name : as in `course.engine.functions.modules.MODULES`
    scene : the scene file
    groups : comparisons, each a figure: name -> its title
    """

    name: str
    scene: Path
    groups: Mapping[str, str]
    estimators: tuple[Estimator, ...]

    @property
    def title(self) -> str:
        """The name as prose."""
        return self.name.replace("_", " ")


def _samplers(variant: str, integral: str, **more: str) -> tuple[Estimator, ...]:
    """The scene as its file says, by each sampler; `more` says in which other comparison a sampler appears too."""
    return tuple(
        Estimator(
            variant,
            sampler,
            integral,
            ("samplers", *([more[sampler]] if sampler in more else ())),
            biased=sampler == "regular",
        )
        for sampler in SAMPLERS
    )


_GAUSSIAN: Overrides = {("film", "filter"): "gaussian", ("film", "sigma"): 0.4}

_LAMP = ("lights", 0)
_SQUARE = {
    "type": "rectangle",
    "corner": [-5.3075, 4.289, -4.782],
    "edge_u": [-0.448, 0.0, 0.550],
    "edge_v": [0.263, 0.622, 0.214],
    "intensity": [170, 146, 112],
}
"""In the place of the ball in soft_shadows.yaml, at right angles to the view from it to the scene's middle, and as
large as the disk that the ball shows."""


def _light(samples: str) -> Estimator:
    scene: Overrides = {(*_LAMP, "samples"): samples}
    return Estimator(samples, "sobol", samples, ("lights",), scene, scene)


def _grid(k: int) -> Estimator:
    return Estimator(
        f"grid {k} x {k}",
        "sobol",
        "square",
        ("light_grid",),
        {_LAMP: {**_SQUARE, "samples": f"grid {k}"}},
        {_LAMP: _SQUARE},
        points=k * k,
        biased=True,
    )


_VARIANCE = {"floor": 1 / 900, "steel": 1 / 60, "gold": 1 / 60, "copper": 1 / 60}
"""Of the reflected directions, along each axis, in square radians; cos^n is nearly a Gaussian of variance 1 / n."""


def _lobe(lobe: str) -> Estimator:
    """Every glossy material of glossy.yaml with one kind of lobe, of the same variance whatever the kind."""
    scene: Overrides = {
        ("materials", name, "gloss"): _gloss(lobe, v) for name, v in _VARIANCE.items()
    }
    return Estimator(lobe, "sobol", f"{lobe} lobes", ("lobes",), scene, scene)


def _gloss(lobe: str, variance: float) -> dict[str, object]:
    # Uniform on a square of edge r: r^2 / 12 along each axis; in a ball of radius r: r^2 / 5.
    return {
        "plane": {"lobe": "plane", "roughness": sqrt(12 * variance)},
        "ball": {"lobe": "ball", "glossiness": sqrt(5 * variance)},
        "phong": {"lobe": "phong", "exponent": 1 / variance},
    }[lobe]


def _module(name: str, groups: Mapping[str, str], *estimators: Estimator) -> Module:
    return Module(name, PROJECT / "scenes" / f"{name}.yaml", groups, estimators)


def _by_samplers(name: str) -> Module:
    groups = {"samplers": "four ways to place samples"}
    return _module(name, groups, *_samplers("", "as the scene"))


BENCHED = {
    module.name: module
    for module in (
        _module(
            "supersampling",
            {"samplers": "four ways to place samples", "filters": "box and Gaussian"},
            *_samplers("box", "box", random="filters", sobol="filters"),
            *(
                Estimator("Gaussian", sampler, "Gaussian", ("filters",), _GAUSSIAN, _GAUSSIAN)
                for sampler in ("random", "sobol")
            ),
        ),
        _module(
            "soft_shadows",
            {
                "samplers": "four ways to place samples",
                "lights": "four lights, Sobol points",
                "light_grid": "a grid of point lights against random points",
            },
            *_samplers("sphere", "sphere", sobol="lights"),
            _light("ball"),
            _light("facing disk"),
            Estimator(
                "square",
                "sobol",
                "square",
                ("lights", "light_grid"),
                {_LAMP: _SQUARE},
                {_LAMP: _SQUARE},
            ),
            *map(_grid, (2, 4, 8)),
        ),
        _module(
            "glossy",
            {
                "samplers": "four ways to place samples",
                "lobes": "three lobes, equally wide, Sobol points",
            },
            *_samplers("", "as the scene"),
            *map(_lobe, ("plane", "ball", "phong")),
        ),
        *map(_by_samplers, ("thin_lens", "motion_blur", "cube_map")),
    )
}
"""The modules that are measured, by name, in the course's order."""

FURTHER_BENCHED = {name: _by_samplers(name) for name in ("blurred_transparency", "textures")}
"""Estimators that are measured only if they are named."""
