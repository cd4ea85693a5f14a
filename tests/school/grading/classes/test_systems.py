"""What learning systems hand out and take: names of their downloads, lists of a class in any language, uploads."""

import csv
import json
import random
import zipfile
from pathlib import Path
from time import perf_counter

import pytest

from course.base.errors import CourseError
from course.school.grading.classes.roster import Matched, match, read_roster
from course.school.grading.classes.submitted import Submission, find_submissions
from course.school.grading.classes.systems import sent
from course.school.grading.reports.classes import doubts_of, write_gradebook

BLUR = b"def displacement(velocity, time):\n    return velocity[:, None] * time\n"
MODULES = ("motion_blur", "thin_lens")


def put(folder: Path, *names: str, content: bytes = BLUR) -> None:
    for name in names:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def find(folder: Path) -> dict[str, Submission]:
    return {one.student: one for one in find_submissions(folder, MODULES)}


def matched(tmp_path: Path, folder: Path, text: str) -> Matched:
    path = tmp_path / "roster.csv"
    path.write_text(text, encoding="utf-8")
    claims = {one.student: one.claims for one in find_submissions(folder, MODULES)}
    return match(read_roster(path).students, claims)


def owners(found: Matched) -> dict[str, str]:
    return {student: one.name for student, one in found.students.items()}


@pytest.mark.parametrize(
    ("name", "file", "names", "login"),
    [
        ("Lab 1_jdoe_attempt_2026-09-24-21-26-00_motion_blur.py", "motion_blur.py", (), "jdoe"),
        ("Lab_1_jdoe_attempt_2026-09-24-21-26-00.txt", "comments.txt", (), "1_jdoe"),
        ("397-2557 - Mary-Ann Smith - Sep 24, 2026 926 PM", "", ("Mary-Ann Smith",), ""),
        ("397-25 - Bo Wu - 24 - Sep 24, 2026 1126 AM - a b.py", "a b.py", ("Bo Wu - 24",), ""),
        ("1-2 - Bo Wu - Sept. 4, 2026 2126 - motion_blur.py", "motion_blur.py", ("Bo Wu",), ""),
        ("Müller_Zoë_zm_42_1234", "", ("Zoë Müller",), "zm_42"),
    ],
)
def test_names_of_other_systems(name: str, file: str, names: tuple[str, ...], login: str) -> None:
    (found,) = sent(name, is_folder=True)
    assert (found.file, found.names, found.logins[:1]) == (file, names, (login,) if login else ())


def test_blackboard_s_latest_try_of_each(tmp_path: Path) -> None:
    at = "attempt_2026-09-24-21-26"
    put(tmp_path, f"Lab_1_jdoe_{at}-00_motion_blur.py", content=b"old")
    put(tmp_path, f"Lab_1_jdoe_{at}-01_motion_blur.py", f"Lab_1_jdoe_{at}-01_thin_lens.py")
    put(tmp_path, f"Lab_1_jdoe_{at}-01.txt", f"Lab_1_a_doe_{at}-00_motion_blur.py")
    put(tmp_path, f"Lab_1_doe_{at}-00_motion_blur.py")
    found = find(tmp_path)
    assert {*found} == {"Lab_1_jdoe", "Lab_1_a_doe", "Lab_1_doe"}
    assert found["Lab_1_jdoe"].sources == dict.fromkeys(MODULES, BLUR)
    assert any("an earlier try was not graded" in one for one in found["Lab_1_jdoe"].remarks)
    own = matched(tmp_path, tmp_path, "Name,Username\nJo Doe,jdoe\nAl Doe,a_doe\nDi Doe,doe\n")
    # Whether doe or a_doe has sent the one of both, the name doesn't say.
    assert owners(own) == {"Lab_1_jdoe": "Jo Doe", "Lab_1_doe": "Di Doe"}
    assert "Lab_1_a_doe" in own.unknown


def test_brightspace_s_folders(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    put(folder, "7-9 - Ann Lee - Sep 9, 2026 926 PM/motion_blur.py", content=b"old")
    put(folder, "7-9 - Ann Lee - Sep 10, 2026 926 AM/motion_blur.py")
    put(folder, "8-9 - Bo Wu - Oct 1, 2026 1201 AM/motion_blur.py")
    put(folder, "9-9 - Bo Wu - Oct 1, 2026 1201 AM/motion_blur.py")
    found = find(folder)
    assert found["Ann Lee_7-9"].sources == {"motion_blur": BLUR}
    text = (
        "OrgDefinedId,Username,Last Name,First Name,Email,End-of-Line Indicator\n"
        "#0012,#alee,Lee,Ann,alee@example.org,#\n#0013,#bwu,Wu,Bo,bwu@example.org,#\n"
    )
    own = matched(tmp_path, folder, text)
    # Two of one name are for somebody else to tell apart.
    assert owners(own) == {"Ann Lee_7-9": "Ann Lee"}
    assert read_roster(tmp_path / "roster.csv").students[0].keys[0] == {"0012"}


def test_ilias_s_folders(tmp_path: Path) -> None:
    folder = tmp_path / "class"
    put(folder, "Müller_Zoë_zm42_1234/motion_blur.py", "Lee_Ann_alee_77/motion_blur.py")
    own = matched(tmp_path, folder, "Nachname;Vorname;Benutzername\nMüller;Zoë;zm42\nLee;Ann;al\n")
    assert owners(own) == {"Müller_Zoë_zm42_1234": "Zoë Müller", "Lee_Ann_alee_77": "Ann Lee"}


@pytest.mark.parametrize("above", ["blur-lab-submissions", "class"])
def test_github_classroom_s_clones(tmp_path: Path, above: str) -> None:
    folder = tmp_path / above
    for login in ("ann-l", "bwu", "annlee"):
        put(folder, f"blur-lab-{login}/motion_blur.py", f"blur-lab-{login}/.git/HEAD")
    text = (
        '"identifier","github_username","github_id","name"\n"Lee, Ann","ann-l","17",""\n'
        '"bwu","other","18",""\n'
    )
    own = matched(tmp_path, folder, text)
    # A login of GitHub is everybody's to choose: it is no name, and no other login.
    assert owners(own) == {"blur-lab-ann-l": "ann-l"}
    assert own.unknown == ("blur-lab-annlee", "blur-lab-bwu")


def test_gradescope_s_export(tmp_path: Path) -> None:
    folder = tmp_path / "assignment_1_export"
    put(folder, "submission_11/motion_blur.py", "submission_12/motion_blur.py")
    put(folder, "submission_13/motion_blur.py")
    metadata = (
        "submission_11:\n  :submitters:\n  - :name: Ann Lee\n    :sid: '0012'\n"
        "    :email: alee@example.org\n  :created_at: 2026-09-24 21:26:00.5 Z\n"
        "submission_12:\n  :submitters:\n  - :name: Bo Wu\n    :sid: ''\n    :email: bwu@example.org\n"
        "  - :name: 12\n    :email: cy@example.org\n"
    )
    put(folder, "submission_metadata.yml", content=metadata.encode())
    found = find(folder)
    assert {*found} == {
        "Ann Lee_0012",
        "Bo Wu_bwu@example.org",
        "12_cy@example.org",
        "submission_13",
    }
    assert any("handed in together" in one for one in found["12_cy@example.org"].remarks)
    text = "Name,SID,Email\nLee,0012,x@example.org\nWu,13,bwu@example.org\nNg,12,cy@example.org\n"
    assert owners(matched(tmp_path, folder, text)) == {
        "Ann Lee_0012": "Lee",
        "Bo Wu_bwu@example.org": "Wu",
        "12_cy@example.org": "Ng",
    }


LISTS = {
    "German": "Matrikelnummer;Nachname;Vorname;E-Mail\n4711;Lee;Ann;alee@example.org\n",
    "French": "Identifiant;Nom;Prénom;Adresse de courriel\n4711;Lee;Ann;alee@example.org\n",
    "Spanish": "Número de ID,Apellido(s),Nombre,Dirección de correo\n4711,Lee,Ann,alee@example.org\n",
    "Italian": "Matricola\tCognome\tNome\tIndirizzo email\n4711\tLee\tAnn\talee@example.org\n",
    "Portuguese": "Número de matrícula,Nome,Endereço de email\n4711,Ann Lee,alee@example.org\n",
    "Turkish": "Öğrenci Numaras\u0131;Ad\u0131 Soyad\u0131;E-posta adresi\n4711;Ann Lee;alee@example.org\n",
    "Turkish in two": "Öğrenci No;Ad;Soyad;E-posta\n4711;Ann;Lee;alee@example.org\n",
    "Polish": "Numer albumu;Imię;Nazwisko;Adres e-mail\n4711;Ann;Lee;alee@example.org\n",
    "Russian": "Номер,Фамилия,Имя,Электронная почта\n4711,Lee,Ann,alee@example.org\n",
    "Greek": "Αριθμός μητρώου,Ονοματεπώνυμο,E-mail\n4711,Ann Lee,alee@example.org\n",
    "Japanese": "学籍番号,氏名,メールアドレス\n4711,Ann Lee,alee@example.org\n",
    "unknown, by what stands in it": "Foo|Student ID|Bar\nx|4711|alee@example.org\n",
    "Excel's line": "sep=;\nMatrikelnr.;Name\n4711;Ann Lee\n",
}


@pytest.mark.parametrize("language", LISTS)
def test_lists_of_a_class_in_other_languages(tmp_path: Path, language: str) -> None:
    path = tmp_path / "r.csv"
    wide = language == "Excel's line"
    path.write_text(LISTS[language], encoding="utf-16" if wide else "utf-8-sig")
    (one,) = read_roster(path).students
    assert "4711" in one.keys[0]
    assert "sep" in LISTS[language] or "alee" in one.keys[1]
    assert "unknown" in language or "annlee" in one.keys[2]


GERMAN = (
    '\ufeff"ID","Vollständiger Name","E-Mail-Adresse","Status","Bewertung","Bestwertung",'
    '"Bewertung kann geändert werden","Zuletzt geändert (Bewertung)","Feedback als Kommentar"\n'
    '"Teilnehmer/in 4711","Erika Beispiel","erika@example.org","Zur Bewertung abgegeben",'
    '"","20,00","Ja","-",""\n'
)
UNKNOWN = (
    "Auðkenni,Fullt nafn,Netfang,Staða,Einkunn,Hámarkseinkunn,Síðast breytt (einkunn)\n"
    "Þátttakandi 4711,Erika Beispiel,erika@example.org,Skilað,,20.00,-\n"
)


@pytest.mark.parametrize(("text", "place", "grade"), [(GERMAN, 4, "17,5"), (UNKNOWN, 4, "17.5")])
def test_a_worksheet_of_moodle_comes_back_as_it_was_with_the_grades(
    tmp_path: Path, text: str, place: int, grade: str
) -> None:
    folder = tmp_path / "class"
    put(folder, "Participant_4711_assignsubmission_file_/motion_blur.py")
    own = matched(tmp_path, folder, text)
    assert [*own.students] == ["Participant_4711"]
    roster = read_roster(tmp_path / "roster.csv")
    grades = [(own.students["Participant_4711"], 87.5)]
    write_gradebook("moodle.csv", roster, grades, 100.0, "Lens", tmp_path / "m.csv")
    rows = [*csv.reader((tmp_path / "m.csv").read_text("utf-8").splitlines())]
    came = [*csv.reader(text.removeprefix("\ufeff").splitlines())]
    came[1][place] = grade
    assert rows == came
    (told,) = doubts_of(roster, "Lens", 100.0)
    assert "highest grade is 20" in told


def test_any_other_list_goes_to_moodle_with_a_column_more(tmp_path: Path) -> None:
    path = tmp_path / "r.csv"
    path.write_text(LISTS["German"], encoding="utf-8")
    roster = read_roster(path)
    grades = [(roster.students[0], 12.25)]
    write_gradebook("moodle.csv", roster, grades, 100.0, "Lens", tmp_path / "m.csv")
    assert (tmp_path / "m.csv").read_text("utf-8").splitlines() == [
        "Matrikelnummer,Nachname,Vorname,E-Mail,Lens",
        "4711,Lee,Ann,alee@example.org,12.25",
    ]


def test_what_is_passed_over_is_told(tmp_path: Path) -> None:
    path = tmp_path / "r.csv"
    path.write_text("Name,Group,Name,,Old\nAnn,1,Bob,x,3\n,2,,,\n\n", encoding="utf-8")
    roster = read_roster(path)
    assert [one.name for one in roster.students] == ["Ann"]
    assert [one.removeprefix(f"{path}: ") for one in roster.told] == [
        "nobody is looked for by the columns Group, Name, (no heading), Old",
        "line 3 names nobody: 2",
    ]


@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"Foo,Bar\n1,2\n", "found Foo, Bar"),
        (b"Name,ID\nLee, Ann,11\n", ":2: has 3 cells and the heading 2; a name with a comma"),
        ("Name;Ort\nZoë;Köln\n".encode("cp1252"), "save it as CSV in UTF-8"),
    ],
)
def test_lists_that_are_refused_say_what_to_do(tmp_path: Path, content: bytes, told: str) -> None:
    path = tmp_path / "r.csv"
    path.write_bytes(content)
    with pytest.raises(CourseError, match=told):
        read_roster(path)


@pytest.mark.parametrize(
    ("title", "doubtful"), [("Final Grade", 1), ("final", 1), ("Override", 1), ("Finals", 0)]
)
def test_a_title_that_canvas_passes_over(tmp_path: Path, title: str, doubtful: int) -> None:
    path = tmp_path / "r.csv"
    path.write_text("Student,ID,Section\nAnn,1,A\n", encoding="utf-8")
    assert len([*doubts_of(read_roster(path), title, 100.0)]) == doubtful


def test_a_class_of_five_thousand(tmp_path: Path) -> None:
    path = tmp_path / "r.csv"
    rows = [f'"Lee {i}, Ann {i}",{i},login{i}' for i in range(5000)]
    path.write_text("Student,ID,SIS Login ID\n" + "\n".join(rows), encoding="utf-8")
    chosen = random.Random(0)
    claims = {
        f"s{i}": chosen.choice(
            [((f"{i}",), (), ()), ((), (f"login{i}",), ()), ((), (), (f"Ann {i} Lee {i}",))]
        )
        for i in range(5000)
    }
    began = perf_counter()
    own = match(read_roster(path).students, claims)
    assert {name: one.row["ID"] for name, one in own.students.items()} == {
        f"s{i}": str(i) for i in range(5000)
    }
    # Takes a tenth of a second; with a loop in a loop it took minutes.
    assert perf_counter() - began < 60


@pytest.mark.parametrize("mark", ["pyvenv.cfg", "conda-meta/history"])
def test_an_environment_beside_the_work(tmp_path: Path, mark: str) -> None:
    names = [f"hw/env/{mark}", "hw/solution.py", "hw/env/own/readme.md"]
    names += [f"hw/env/lib/python3.12/site-packages/pkg/f{i}.py" for i in range(2500)]
    names += [f"hw/env/lib/python3.12/m{i}.py" for i in range(12_000)]
    with zipfile.ZipFile(tmp_path / "ada.zip", "w") as archive:
        for name in names:
            archive.writestr(name, BLUR if name == "hw/solution.py" else b"def displacement(): ...")
    (tmp_path / "bob").mkdir()
    for name in (names[0], names[1], *names[-80:]):
        put(
            tmp_path / "bob", name, content=BLUR if name == names[1] else b"def displacement(): ..."
        )
    for found in find(tmp_path).values():
        assert found.sources == {"motion_blur": BLUR}
        assert any("hw/env: what is installed" in one for one in found.remarks)


def test_work_in_an_environment_s_own_folder_is_found(tmp_path: Path) -> None:
    put(tmp_path / "ada", "motion_blur.py", "pyvenv.cfg", "lib/python3/motion_blur.py")
    (found,) = find_submissions(tmp_path, MODULES)
    assert found.sources == {"motion_blur": BLUR}


def test_json_is_no_notebook_of_a_system(tmp_path: Path) -> None:
    put(tmp_path / "ada", "motion_blur.ipynb", content=json.dumps({"cells": 3}).encode())
    (found,) = find_submissions(tmp_path, MODULES)
    assert "is no notebook" in found.trouble
