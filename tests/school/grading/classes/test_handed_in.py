"""Nothing that is handed in is left out in silence: it is graded, or a row says why not."""

import gzip
import io
import json
import tarfile
import zipfile
from pathlib import Path, PurePosixPath

import pytest

from course.engine.functions.notebook.reading import NotebookError, read_notebook
from course.school.grading.classes import entries
from course.school.grading.classes.entries import Entry, unfolded
from course.school.grading.classes.names import read_name
from course.school.grading.classes.submitted import Submission, find_submissions
from course.school.grading.classes.systems import sent

LENS = b"import numpy as np\n\ndef point_on_disk(u):\n    return np.sqrt(u)\n"
BLUR = b"def displacement(velocity, time):\n    return velocity[:, None] * time\n"
MODULES = ("thin_lens", "motion_blur", "sampling", "importance_sampling")


def put(folder: Path, **files: bytes) -> None:
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def find(folder: Path) -> dict[str, Submission]:
    return {one.student: one for one in find_submissions(folder, MODULES)}


def zipped(**files: bytes) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return buffer.getvalue()


def tarred(mode: str, **files: bytes) -> bytes:
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode=mode) as archive:  # type: ignore[call-overload]
        for name, content in files.items():
            info = tarfile.TarInfo(name)
            info.size = len(content)
            archive.addfile(info, io.BytesIO(content))
    return buffer.getvalue()


@pytest.mark.parametrize(
    ("name", "module", "owner"),
    [
        ("thin_lens.py", "thin_lens", ""),
        ("Thin_Lens.py", "thin_lens", ""),
        ("thin_lens (1).py", "thin_lens", ""),
        ("thin_lens-2.py", "thin_lens", ""),
        ("thin_lens - Copy.py", "thin_lens", ""),
        ("thin-lens.PY", "thin_lens", ""),
        ("thinlens.py", "thin_lens", ""),
        ("thin_lens.py.txt", "thin_lens", ""),
        ("thin_lens.ipynb", "thin_lens", ""),
        ("alice_thin_lens.py", "thin_lens", "alice"),
        ("alice2-thin-lens (3).py", "thin_lens", "alice2"),
        ("Ann Lee thin_lens.py", "thin_lens", "Ann Lee"),
        ("thin_lens_alice.py", "thin_lens", "alice"),
        ("importance_sampling.py", "importance_sampling", ""),
        ("bob_importance_sampling.py", "importance_sampling", "bob"),
        ("student-2.py", "", "student-2"),
        ("helpers.py", "", "helpers"),
    ],
)
def test_what_a_file_s_name_says(name: str, module: str, owner: str) -> None:
    found = read_name(name, MODULES)
    assert (found.module, found.owner) == (module, owner)
    assert found.exact == (name == f"{module}.py")


@pytest.mark.parametrize(
    ("name", "owner", "file"),
    [
        ("leeann_12345_67890_thin_lens-1.py", "leeann_12345", "thin_lens-1.py"),
        ("leeann_LATE_12345_67890_thin_lens.py", "leeann_12345", "thin_lens.py"),
        ("Ann Lee_12345_assignsubmission_file_thin_lens.py", "Ann Lee_12345", "thin_lens.py"),
        ("Ann Lee_12345_assignsubmission_file_", "Ann Lee_12345", ""),
        ("Ann Lee_12345_assignsubmission_file", "Ann Lee_12345", ""),
    ],
)
def test_names_of_canvas_and_moodle(name: str, owner: str, file: str) -> None:
    (found,) = sent(name)
    assert (found.owner, found.file) == (owner, file)


def test_names_of_nobody_s_system() -> None:
    assert sent("alice_thin_lens.py") == ()
    assert sent("alice_2_thin_lens.py") == ()


@pytest.mark.parametrize(
    "name",
    [
        "leemallory_12345_67891_x_888_assignsubmission_file_thin_lens.py",
        "Lee Mallory_12345_assignsubmission_file_x_888_assignsubmission_file_thin_lens.py",
        "Lee_888_1_Mallory_12345_assignsubmission_file_thin_lens.py",
    ],
)
def test_a_name_that_claims_another_s_number_is_nobody_s(tmp_path: Path, name: str) -> None:
    """What a student may choose in the name of a file, or as the own name, is no claim to another's grade."""
    put(tmp_path, **{name: LENS})
    (found,) = find_submissions(tmp_path)
    assert "can be read as that of" in found.trouble
    assert not found.number


def test_a_download_of_canvas(tmp_path: Path) -> None:
    put(
        tmp_path,
        **{
            "leeann_LATE_11_901_thin_lens-1.py": LENS,
            "leeann_LATE_11_902_motion_blur.py": BLUR,
            "leeann_LATE_11_903_notes.pdf": b"%PDF",
            "wubo_12_904_work.zip": zipped(**{"work/thin_lens.py": LENS}),
        },
    )
    found = find(tmp_path)
    assert set(found) == {"leeann_11", "wubo_12"}
    assert found["leeann_11"].sources == {"thin_lens": LENS, "motion_blur": BLUR}
    assert "thin_lens-1.py: Canvas says that it is late" in found["leeann_11"].remarks
    assert {"leeann", "11"} <= {*found["leeann_11"].names}
    assert found["wubo_12"].sources == {"thin_lens": LENS}


def test_downloads_of_moodle_in_folders_and_flat(tmp_path: Path) -> None:
    put(
        tmp_path,
        **{
            "Ann Lee_11_assignsubmission_file_/thin_lens.py": LENS,
            "Ann Lee_11_assignsubmission_onlinetext_/onlinetext.html": b"<p>hello</p>",
            "Bo Wu_12_assignsubmission_file_Thin_Lens.py": LENS,
            "Cy Ng_13_assignsubmission_onlinetext_onlinetext.html": b"<p>def f</p>",
        },
    )
    found = find(tmp_path)
    assert found["Ann Lee_11"].sources == {"thin_lens": LENS}
    assert found["Bo Wu_12"].sources == {"thin_lens": LENS}
    assert "onlinetext.html" in found["Cy Ng_13"].trouble
    assert any("typed into Moodle" in remark for remark in found["Cy Ng_13"].remarks)


def test_flat_files_are_told_apart_by_name_or_by_what_they_define(tmp_path: Path) -> None:
    put(
        tmp_path,
        **{
            "alice_thin_lens.py": LENS,
            "alice_motion_blur.py": BLUR,
            "bob.py": BLUR,
            "cy.py": b"print('nothing')\n",
            "thin_lens.py": LENS,
            "notes.docx": b"PK",
        },
    )
    found = find(tmp_path)
    assert found["alice"].sources == {"thin_lens": LENS, "motion_blur": BLUR}
    assert found["bob"].sources == {"motion_blur": BLUR}
    assert "bob.py was graded as motion_blur.py" in found["bob"].remarks
    assert "there is no file for a module" in found["cy"].trouble
    assert "rename it STUDENT_thin_lens.py" in found["thin_lens.py"].trouble
    assert "is no folder, archive" in found["notes.docx"].trouble


def test_a_file_named_after_its_student_is_the_one_module_that_is_graded(tmp_path: Path) -> None:
    put(tmp_path, **{"alice.py": b"x = (\n"})
    (found,) = find_submissions(tmp_path, ["thin_lens"])
    assert found.sources == {"thin_lens": b"x = (\n"}


@pytest.mark.parametrize("name", ["Thin_Lens.py", "thin_lens (1).py", "ada_thin_lens.py"])
def test_another_spelling_in_a_folder_is_graded_and_told(tmp_path: Path, name: str) -> None:
    put(tmp_path / "ada", **{name: LENS})
    (found,) = find_submissions(tmp_path, MODULES)
    assert found.sources == {"thin_lens": LENS}
    assert found.remarks == (f"{name} was graded as thin_lens.py",)


def test_the_exact_name_goes_first_and_the_others_are_told(tmp_path: Path) -> None:
    put(
        tmp_path / "ada",
        **{"thin_lens.py": LENS, "thin_lens (1).py": b"old", "x/thin_lens.py": b""},
    )
    (found,) = find_submissions(tmp_path, MODULES)
    assert found.sources == {"thin_lens": LENS}
    assert found.remarks == ("not graded, for thin_lens.py was: thin_lens (1).py, x/thin_lens.py",)


def test_two_spellings_are_for_the_student_to_choose_from(tmp_path: Path) -> None:
    put(tmp_path / "ada", **{"thin_lens (1).py": LENS, "thin_lens (2).py": LENS})
    (found,) = find_submissions(tmp_path, MODULES)
    assert found.trouble == (
        "thin_lens.py is in it more than once: thin_lens (1).py, thin_lens (2).py"
    )


def test_one_file_that_defines_the_functions_under_another_name(tmp_path: Path) -> None:
    put(tmp_path / "ada", **{"solution.py": LENS, "notes.txt": b""})
    put(tmp_path / "bob", **{"a.py": LENS, "b.py": LENS})
    put(tmp_path / "cy", README=b"")
    (tmp_path / "dan").mkdir()
    found = find(tmp_path)
    assert found["ada"].sources == {"thin_lens": LENS}
    assert "a.py, b.py define functions of thin_lens" in found["bob"].trouble
    assert "it holds README" in found["cy"].trouble
    assert "it is empty" in found["dan"].trouble


@pytest.mark.parametrize(
    ("suffix", "mode"), [(".tar", "w"), (".tar.gz", "w:gz"), (".tgz", "w:gz"), (".tar.xz", "w:xz")]
)
def test_tar_archives(tmp_path: Path, suffix: str, mode: str) -> None:
    put(tmp_path, **{f"ada{suffix}": tarred(mode, **{"./work/thin_lens.py": LENS})})
    assert find(tmp_path)["ada"].sources == {"thin_lens": LENS}


def test_archives_in_folders_and_in_archives(tmp_path: Path) -> None:
    inner = zipped(**{"thin_lens.py": LENS})
    put(tmp_path / "ada", **{"work.zip": inner})
    put(tmp_path, **{"bob.zip": zipped(**{"a/b.zip": inner})})
    put(tmp_path, **{"cy.zip": zipped(**{"b.zip": zipped(**{"c.zip": inner})})})
    found = find(tmp_path)
    assert found["ada"].sources == found["bob"].sources == {"thin_lens": LENS}
    assert "lies too deep" in found["cy"].trouble


@pytest.mark.parametrize("name", ["ada.rar", "ada.7z", "ada/work.rar", "ada.zip"])
def test_archives_that_can_t_be_read_say_what_to_do(tmp_path: Path, name: str) -> None:
    put(tmp_path, **{name: b"Rar!\x1a\x07\x00"})
    found = find(tmp_path)["ada"]
    assert "archive, which can't be read here; unpack it" in found.trouble
    assert not found.sources


@pytest.mark.parametrize("name", ["../thin_lens.py", "/thin_lens.py", "a/../../thin_lens.py"])
def test_paths_in_a_tar_that_lead_out(tmp_path: Path, name: str) -> None:
    put(tmp_path, **{"ada.tar": tarred("w", **{name: LENS})})
    assert "leads out" in find(tmp_path)["ada"].trouble


@pytest.mark.parametrize("kind", [tarfile.SYMTYPE, tarfile.LNKTYPE, tarfile.FIFOTYPE])
def test_links_and_pipes_in_a_tar(tmp_path: Path, kind: bytes) -> None:
    buffer = io.BytesIO()
    with tarfile.open(fileobj=buffer, mode="w") as archive:
        info = tarfile.TarInfo("thin_lens.py")
        info.type, info.linkname = kind, "/etc/passwd"
        archive.addfile(info)
    put(tmp_path, **{"ada.tar": buffer.getvalue()})
    assert "is a link or no ordinary file" in find(tmp_path)["ada"].trouble


def test_a_tar_that_unpacks_to_more_than_it_may(tmp_path: Path) -> None:
    put(tmp_path, **{"ada.tgz": gzip.compress(bytes(entries.LARGEST_TAR + 1), 1)})
    assert "too large" in find(tmp_path)["ada"].trouble


def test_a_tar_whose_head_claims_a_name_without_end(tmp_path: Path) -> None:
    info = tarfile.TarInfo("././@LongLink")
    info.type, info.size = tarfile.GNUTYPE_LONGNAME, 2**33
    put(tmp_path, **{"ada.tar": info.tobuf() + bytes(2048)})
    assert find(tmp_path)["ada"].trouble


def test_many_archives_share_one_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(
        entries.ArchiveBudget, "__init__", lambda self: vars(self).update(entries=5, bytes=99)
    )
    content = zipped(**{f"{i}.py": b"" for i in range(3)})
    both = [Entry(PurePosixPath(f"{i}.zip"), lambda _: content) for i in range(2)]
    remarks: list[str] = []
    found = [str(entry.path) for entry in unfolded(iter(both), remarks)]
    assert found == ["0.zip", "0.zip/0.py", "0.zip/1.py", "0.zip/2.py", "1.zip"]
    assert remarks == ["1.zip: is too large to be a submission"]


def test_what_programs_leave_behind_is_no_candidate(tmp_path: Path) -> None:
    put(
        tmp_path / "ada",
        **{
            "thin_lens.py": LENS,
            ".ipynb_checkpoints/thin_lens.py": b"",
            ".venv/lib/site-packages/thin_lens.py": b"",
            "__MACOSX/._thin_lens.py": b"",
        },
    )
    (found,) = find_submissions(tmp_path, MODULES)
    assert (found.sources, found.remarks) == ({"thin_lens": LENS}, ())


def notebook(*cells: str) -> bytes:
    made = [{"cell_type": "code", "source": cell.splitlines(keepends=True)} for cell in cells]
    made.insert(1, {"cell_type": "markdown", "source": ["def not_code"]})
    return json.dumps({"cells": made, "nbformat": 4}).encode()


def test_a_notebook_gives_what_its_functions_use(tmp_path: Path) -> None:
    content = notebook(
        "%matplotlib inline\nimport numpy as np\nimport matplotlib.pyplot as plt",
        "SCALE = 1.0\ndef helper(u):\n    return SCALE * np.sqrt(u)",
        "%%time\n1/0",
        "def point_on_disk(u):\n    return helper(u) % 2",
        "this is no Python",
        "plt.show(point_on_disk(np.zeros((2, 3))))\nraise SystemExit",
    )
    put(tmp_path / "ada", **{"Thin Lens.ipynb": content})
    (found,) = find_submissions(tmp_path, MODULES)
    source = found.sources["thin_lens"].decode()
    assert "matplotlib" not in source
    assert "SystemExit" not in source
    space: dict[str, object] = {}
    exec(source, space)  # the test's own text
    assert {"np", "SCALE", "helper", "point_on_disk"} <= set(space)
    assert found.remarks == (
        "Thin Lens.ipynb was graded from its cells as thin_lens.py",
        "Thin Lens.ipynb: cell 6, line 1: is no Python, so the cell is left out",
    )


def test_a_notebook_or_a_text_of_any_name_is_known_by_its_functions(tmp_path: Path) -> None:
    lines = ["import numpy as np", "def point_on_disk(u):\n    return u", "1/0"]
    one_string = {"cells": [{"cell_type": "code", "source": "\n".join(lines[:2])}], "nbformat": 4}
    put(tmp_path / "ada", **{"Untitled.ipynb": notebook(*lines), "notes.txt": b"def f(): 1"})
    put(tmp_path / "bob", **{"Untitled1.ipynb": json.dumps(one_string).encode()})
    put(tmp_path / "cy", **{"thin_lens.py.txt": LENS, "a.ipynb": notebook(*lines)})
    put(tmp_path / "dan", **{"a.ipynb": notebook("x = 1")})
    put(tmp_path / "eve", **{"a.ipynb": notebook(*lines), "b.ipynb": notebook(*lines)})
    found = find(tmp_path)
    for name in ("ada", "bob"):
        assert b"def point_on_disk" in found[name].sources["thin_lens"]
        assert b"1/0" not in found[name].sources["thin_lens"]
    remark, *_ = found["ada"].remarks
    assert "Untitled.ipynb was graded from its cells as thin_lens.py" in remark
    assert found["cy"].sources == {"thin_lens": LENS}
    assert "it holds a.ipynb" in found["dan"].trouble
    assert "a.ipynb, b.ipynb define functions of thin_lens" in found["eve"].trouble


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"{}", "is no notebook"),
        (b"\xff", "is no notebook"),
        (b'{"cells": ' + b"[" * 100_000, "is no notebook"),
        (b'{"cells": [{"cell_type": "code"}]}', "is no notebook"),
        (b"[]", "is no notebook"),
    ],
)
def test_notebooks_that_are_none(content: bytes, why: str) -> None:
    with pytest.raises(NotebookError, match=why):
        read_notebook("work.ipynb", content, ["thin_lens"])


def test_a_notebook_without_the_functions_says_what_it_left_out(tmp_path: Path) -> None:
    put(tmp_path / "ada", **{"thin_lens.ipynb": notebook("x = 1", "%run lens.py")})
    (found,) = find_submissions(tmp_path, MODULES)
    assert found.trouble == (
        "thin_lens.ipynb: defines none of its functions; hand in thin_lens.py; "
        "cell 3, line 1: left out: %run lens.py"
    )
