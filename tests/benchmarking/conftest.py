"""A scene file that renders in milliseconds: a penumbra, and what it takes to bench it."""

import json
from pathlib import Path
from typing import Any

import pytest

from benchmarks.mitsuba_variants import find_llvm, start_llvm

SCENE: dict[str, Any] = {
    "title": "a penumbra",
    "camera": {"eye": [0, 3, 3], "look_at": [0, 0, 0]},
    "film": {"width": 24, "height": 16},
    "sampler": {"type": "sobol", "samples": 4},
    "materials": {"matt": {"color": 0.8}},
    "lights": [{"type": "sphere", "center": [1, 3, 1], "radius": 0.5, "intensity": 30}],
    "objects": [
        {"shape": "quad", "width": 8, "depth": 8, "material": "matt"},
        {"shape": "box", "material": "matt", "transform": [{"translate": [0, 1, 0]}]},
    ],
}


@pytest.fixture
def penumbra(tmp_path: Path) -> Path:
    path = tmp_path / "penumbra.yaml"
    path.write_text(json.dumps(SCENE), encoding="utf-8")
    return path


@pytest.fixture
def llvm() -> None:
    """Mitsuba's variant that LLVM compiles, in one thread."""
    pytest.importorskip("mitsuba", reason="needs Mitsuba: pip install .[peers]")
    if find_llvm() is None:
        pytest.skip("needs LLVM 17 or newer, such as Debian's libllvm19")
    start_llvm(1)
