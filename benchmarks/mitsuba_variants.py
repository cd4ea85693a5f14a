"""Mitsuba's variants, LLVM and scalar, of which a process has one switched on; sensors by Mitsuba's samplers."""

import os
import re
from pathlib import Path
from typing import Any

from benchmarks.mitsuba_export import Exported, NotExportableError

OLDEST_LLVM = 17
ROBUST = "embree_use_robust_intersections"
"""Of a scene of Mitsuba's: whether it asks Embree for its robust mode, as this renderer does."""

LIBRARY_FOLDERS = (
    "/usr/lib",
    "/usr/lib64",
    "/usr/local/lib",
    "/opt/homebrew/opt",
    "/usr/local/opt",
)


def find_llvm() -> Path | None:
    """The newest LLVM library that the variant can use; None where there is none.

    With an LLVM older than 17 the process aborts, so the version is told from the file's name.
    """
    named = os.environ.get("DRJIT_LIBLLVM_PATH")
    if named:
        return Path(named)
    found = []
    for folder in LIBRARY_FOLDERS:
        for pattern in ("libLLVM*", "*/libLLVM*", "llvm*/lib/libLLVM*", "*/llvm*/lib/libLLVM*"):
            for path in Path(folder).glob(pattern):
                version = re.search(r"libLLVM(?:-|\.so\.|\.)(\d+)", path.name)
                if version and path.exists() and int(version[1]) >= OLDEST_LLVM:
                    found.append((int(version[1]), str(path)))
    return Path(max(found)[1]) if found else None


def start_llvm(threads: int) -> None:
    """Switch Mitsuba to its LLVM variant.

    Raises NotExportableError: there is no LLVM on this machine that Mitsuba can use.
    """
    library = find_llvm()
    if library is None:
        raise NotExportableError(
            f"no LLVM {OLDEST_LLVM} or newer was found; install one (Debian: libllvm19) or name the library in"
            " DRJIT_LIBLLVM_PATH"
        )
    os.environ["DRJIT_LIBLLVM_PATH"] = str(library)
    _start("llvm_ad_rgb", threads)


def start_scalar(threads: int) -> None:
    """Switch Mitsuba to its scalar variant."""
    _start("scalar_rgb", threads)


def start_fastest(threads: int) -> None:
    """Switch Mitsuba to its LLVM variant, or to its scalar one on a machine without LLVM."""
    (start_scalar if find_llvm() is None else start_llvm)(threads)


def _start(variant: str, threads: int) -> None:
    import drjit
    import mitsuba

    mitsuba.set_variant(variant)
    # Samplers that round the number of samples up would say so each time; `Sensors.samples` tells it.
    mitsuba.set_log_level(mitsuba.LogLevel.Error)
    drjit.set_thread_count(threads)


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
