"""Pictures of the further modules in Mitsuba and here: what the page says of them, and two of them again, small.

Small ones have 16 batches, and a |t| of 10 that one of the 72 blocks and channels of a right pair exceeds 4 times in
10^6 (Student's distribution, 15 degrees of freedom). Seeds are fixed. Roughnesses that are 10% too large exceed it.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from benchmarks import peer_agreement
from benchmarks.mitsuba_agreement import FAR
from benchmarks.mitsuba_export import NotExportableError, export
from benchmarks.mitsuba_llvm import LlvmScene
from benchmarks.peer_agreement import DOCUMENT, cases, measure, read, table
from benchmarks.peer_scenes import scene_path
from course import load_scene
from course.engine.functions.modules import COURSE
from tests.lengths import share

LIMIT = 10.0


def test_every_case_that_is_kept_agrees() -> None:
    found = {each.name: each for each in read()}
    assert list(found) == list(cases())
    assert {each.module for each in found.values()} >= {
        "microfacets",
        "multiple_importance",
        "blue_noise",
    }
    for name, each in found.items():
        assert each.module in COURSE
        assert each.agreement.largest < FAR, name
        assert each.blocks == 288


def test_the_page_has_the_table_of_what_is_kept() -> None:
    assert table(read()).markdown() in DOCUMENT.read_text(encoding="utf-8")


@pytest.mark.usefixtures("llvm")
@pytest.mark.parametrize("name", share(["Veach's plates, Phong's lobes", "rough metals"], 2))
def test_pictures_agree_again(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(peer_agreement, "SIZE", (48, 32))
    found = measure(name, replace(cases()[name], samples=64, theirs=64), 16, tmp_path)
    assert found.blocks == 72
    assert found.agreement.largest < LIMIT
    assert (found.correlated is None) == (name != "rough metals")


@pytest.mark.usefixtures("llvm")
def test_microfacets_are_left_to_mitsubas_plugins() -> None:
    exported = export(load_scene(scene_path("rough_metals")), 8, 8)
    np.testing.assert_allclose(exported.materials.alpha, [0.2, 0.1, 0.4, 0.8])
    assert exported.materials.metal.all()
    with pytest.raises(NotExportableError, match="microfacets"):
        LlvmScene(replace(exported, lights=()))
