"""The meaning of a column, by its heading in many languages, or by what stands in it."""

import re
import unicodedata
from collections.abc import Sequence

from course.school.grading.classes.tables import ClassTable

NAME, FIRST, LAST, NUMBER, LOGIN, EMAIL, GITHUB, GRADE = (
    *("name", "first name", "last name", "number", "login", "address", "GitHub", "grade"),
)


def squashed(text: str) -> str:
    """A text without what systems write in different ways: accents, case, blanks and signs."""
    plain = (
        unicodedata.normalize("NFKD", text)
        .casefold()
        .replace("\N{LATIN SMALL LETTER DOTLESS I}", "i")
    )
    return re.sub(r"[\W_]", "", "".join(c for c in plain if not unicodedata.combining(c)))


def _squashed(text: str) -> frozenset[str]:
    return frozenset(map(squashed, text.split()))


_HEADINGS = {
    NAME: _squashed(
        "student students name fullname vollstandigername vollername nomcomplet nometprenom "
        "nombrecompleto nombreyapellidos apellidosynombre nomecompleto nomecognome cognomeenome "
        "volledigenaam naam tamad tamadi adsoyad adisoyadi "
        "pełnanazwa imieinazwisko celejmeno fullstandigtnamn namn fuldenavn navn fulltnavn "
        "kokonimi ονοματεπωνυμο полноеимя фио 氏名 フルネーム 姓名 全名 성명 이름"
    ),
    FIRST: _squashed(
        "firstname givenname givennames forename vorname vornamen prenom prenoms nombres "
        "primeironome voornaam fornamn fornavn etunimi imie jmeno имя ονομα 名 名字"
    ),
    LAST: _squashed(
        "lastname surname familyname nachname familienname zuname nomdefamille apellido apellidos "
        "cognome apelido apelidos sobrenome achternaam soyad soyadi nazwisko prijmeni "
        "efternamn efternavn etternavn sukunimi фамилия επωνυμο επιθετο 姓"
    ),
    NUMBER: _squashed(
        "id identifier sisuserid idnumber studentid studentnumber studentno participant sid "
        "orgdefinedid matrikelnummer matrikelnr matrnr matrikel identifiant numeroetudiant "
        "numerodetudiant codeetudiant identificador numerodeid numerodeidentificacion matricola "
        "numerodimatricola identificativo codiceidentificativo matricula numerodematricula legajo "
        "studentnummer ogrencino ogrencinumarasi numeralbumu osobnicislo "
        "studijnicislo opiskelijanumero personnummer идентификатор номер αριθμοσμητρωου "
        "学号 学籍番号 학번"
    ),
    LOGIN: _squashed(
        "sisloginid login loginid username netid account benutzername benutzerkennung "
        "nutzername kennung anmeldename nomdutilisateur nombredeusuario usuario nomeutente "
        "nomedeutilizador nomedeusuario gebruikersnaam kullaniciadi "
        "nazwauzytkownika uzivatelskejmeno anvandarnamn brukernavn brugernavn kayttajatunnus "
        "логин имяпользователя ονομαχρηστη ユーザ名 用户名"
    ),
    EMAIL: _squashed(
        "email emailaddress mail mailadresse emailadresse courriel adressedecourriel adresseemail "
        "adressemail adresseelectronique correo correoelectronico direccionemail "
        "direcciondecorreo indirizzoemail enderecodeemail epostaadresi eposta epostadress epost "
        "epostadresse adresemail adresaemail sahkoposti sahkopostiosoite электроннаяпочта "
        "メールアドレス 电子邮件 邮箱 이메일"
    ),
    GITHUB: _squashed("githubusername"),
    GRADE: _squashed(
        "grade bewertung note nota calificacion voto valutazione cijfer not notu ocena znamka "
        "hodnoceni betyg karakter arvosana оценка βαθμος 評点 成绩 分数"
    ),
}

_ONE_OF_TWO = {FIRST: _squashed("nombre nome ad adi"), LAST: _squashed("nom")}
"""Headings of a part of a name where the other part has a column of its own, and of the whole where it hasn't."""

_PARTICIPANT = re.compile(r"(\D*\D\s)\d+")
"""What Moodle's worksheet has before a number, in any language."""


def meanings(table: ClassTable) -> tuple[str, ...]:
    """The meaning of each column; empty for one that is not understood, or has the heading of another one."""
    heads = [squashed(column) for column in table.columns]
    found = [next((m for m, known in _HEADINGS.items() if head in known), "") for head in heads]
    for part, known in _ONE_OF_TWO.items():
        other = LAST if part == FIRST else FIRST
        for i, head in enumerate(heads):
            if head in known:
                found[i] = part if other in found else NAME
    for i, head in enumerate(heads):
        if head in heads[:i]:
            found[i] = ""
        elif not found[i]:
            found[i] = _by_content([cells[i] for _, cells in table.rows if cells[i]])
    return tuple(found)


def _by_content(values: Sequence[str]) -> str:
    if values and all(re.fullmatch(r"[^@\s]+@[^@\s]+\.[^@\s]+", value) for value in values):
        return EMAIL
    # One word before all numbers: `Teilnehmer/in 4711`.
    before = {found[1] if (found := _PARTICIPANT.fullmatch(value)) else "" for value in values}
    return NUMBER if len(before) == 1 and "" not in before else ""


def is_participant(values: Sequence[str]) -> bool:
    """Whether a column is that by which Moodle knows the rows of its worksheet."""
    return bool(values) and all(_PARTICIPANT.fullmatch(value) for value in values)
