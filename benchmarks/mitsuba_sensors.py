"""The camera of an exported scene in Mitsuba, with its film and each of Mitsuba's samplers."""

from __future__ import annotations

from typing import Any

from benchmarks.mitsuba_export import Exported

SAMPLERS = ("independent", "stratified", "multijitter", "orthogonal", "ldsampler")


class Sensors:
    """Mitsuba's sensors by sampler, each made when it is first asked for.

    Parameters
    ----------
    exported : the scene
    shutter : seconds that the camera's shutter is open
    """

    def __init__(self, exported: Exported, shutter: float) -> None:
        self._exported, self._shutter = exported, shutter
        self._made: dict[str, Any] = {}

    def __getitem__(self, sampler: str) -> Any:
        """The sensor that draws from a sampler."""
        import mitsuba as mi

        if sampler not in self._made:
            self._made[sampler] = mi.load_dict(sensor_map(self._exported, sampler, self._shutter))
        return self._made[sampler]

    def samples(self, sampler: str, samples: int) -> int:
        """How many samples a sampler takes where that many are asked for: some round up."""
        drawn = self[sampler].sampler().clone()
        drawn.set_sample_count(samples)
        return int(drawn.sample_count())


def sensor_map(exported: Exported, sampler: str, shutter: float) -> dict[str, Any]:
    """The camera with its film and sampler, as Mitsuba wants to be told."""
    import mitsuba as mi

    camera = exported.camera
    lens = camera["aperture_radius"] > 0
    sensor = {
        "type": "thinlens" if lens else "perspective",
        "fov": camera["vertical_fov"],
        "fov_axis": "y",
        "to_world": mi.ScalarTransform4f().look_at(
            list(camera["eye"]), list(camera["look_at"]), list(camera["up"])
        ),
        "shutter_open": 0.0,
        "shutter_close": shutter,
        "film": {
            "type": "hdrfilm",
            "width": exported.width,
            "height": exported.height,
            "pixel_format": "rgb",
            "component_format": "float32",
            "rfilter": {"type": "box"},
        },
        "sampler": {"type": sampler, "sample_count": 16},
    }
    if lens:
        sensor["aperture_radius"] = camera["aperture_radius"]
        sensor["focus_distance"] = camera["focus_distance"]
    return sensor
