"""Questions in the files of learning platforms: XML of the structure that the specifications ask for, nothing lost."""

import json
import re
import xml.etree.ElementTree as ET
from base64 import b64decode
from html.parser import HTMLParser

import pytest

from course.school.quizzes.packing import canvas, marked, moodle, prairielearn, qti21
from course.school.quizzes.question import LETTERS, Choice, Question, ShownPicture

PNG = b"\x89PNG\r\n\x1a\n" + bytes(range(256))


def asked(number: int, module: str = "film", choices: int = 4) -> Question:
    return Question(
        f"{module}-{number:02}",
        module,
        "expose",
        ("`film.expose` as it should be & with a <mistake>.", 'Which "one"?'),
        (
            ShownPicture("Right", "A curve.", PNG),
            ShownPicture("With a mistake", "Another < curve.", PNG[::-1]),
        ),
        tuple(
            Choice(f"Mistake `{letter}` & 1 < 2", f"Not {letter}.") for letter in LETTERS[:choices]
        ),
        number % choices,
        "It is `x` < 1.",
    )


QUESTIONS = [asked(1), asked(2), asked(3, "glossy", 3)]

QTI12 = {
    "questestinterop": "assessment",
    "assessment": "section",
    "section": "item*",
    "item": "itemmetadata presentation resprocessing itemfeedback*",
    "itemmetadata": "qtimetadata",
    "qtimetadata": "qtimetadatafield*",
    "qtimetadatafield": "fieldlabel fieldentry",
    "presentation": "material response_lid",
    "material": "mattext",
    "response_lid": "render_choice",
    "render_choice": "response_label*",
    "response_label": "material",
    "resprocessing": "outcomes respcondition*",
    "outcomes": "decvar",
    "respcondition": "conditionvar setvar? displayfeedback",
    "conditionvar": "varequal",
    "itemfeedback": "flow_mat",
    "flow_mat": "material",
}
"""Children of each element in their order, of those that IMS QTI 1.2.1 allows; others have text alone."""

QTI21 = {
    "assessmentItem": "responseDeclaration outcomeDeclaration* itemBody responseProcessing modalFeedback*",
    "responseDeclaration": "correctResponse",
    "correctResponse": "value",
    "outcomeDeclaration": "defaultValue?",
    "defaultValue": "value",
    "choiceInteraction": "simpleChoice*",
    "responseProcessing": "responseCondition setOutcomeValue",
    "responseCondition": "responseIf",
    "responseIf": "match setOutcomeValue",
    "match": "variable correct",
    "setOutcomeValue": "(baseValue|variable)",
}
"""Likewise of IMS QTI 2.1."""

MANIFEST = {
    "manifest": "metadata organizations resources",
    "metadata": "schema schemaversion",
    "resources": "resource*",
    "resource": "file*",
}
"""Likewise of IMS Content Packaging 1.1."""


def structured(text: bytes, rules: dict[str, str], namespace: str) -> ET.Element:
    """The root of a document whose elements have the children that the rules say."""
    root = ET.fromstring(text)
    assert root.tag.startswith(f"{{{namespace}}}")
    for element in root.iter():
        name = element.tag.partition("}")[2]
        if name in rules:
            pattern = re.sub(r"(\w+|\([\w|]+\))([*?]?) ?", r"(?:\1 )\2", rules[name])
            children = "".join(f"{child.tag.partition('}')[2]} " for child in element)
            assert re.fullmatch(pattern, children), f"{name}: {children}"
    for element in root.iter():
        element.tag = element.tag.partition("}")[2]
    return root


class Tags(HTMLParser):
    """Sources of pictures, and the text, of HTML."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.pictures: list[dict[str, str | None]] = []
        self.text = ""
        self.feed(html)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "img":
            self.pictures.append(dict(attrs))

    def handle_data(self, data: str) -> None:
        self.text += data


def test_a_package_of_qti_12_holds_what_it_names() -> None:
    files = canvas(QUESTIONS)
    manifest = structured(
        files["imsmanifest.xml"], MANIFEST, "http://www.imsglobal.org/xsd/imscp_v1p1"
    )
    named = [each.attrib["href"] for each in manifest.iter("file")]
    assert sorted(named) == sorted(name for name in files if name != "imsmanifest.xml")
    identifiers = [each.attrib["identifier"] for each in manifest.iter("resource")]
    assert len(set(identifiers)) == len(identifiers)
    for module, count in (("film", 2), ("glossy", 1)):
        text = files[f"{module}/{module}.xml"]
        quiz = structured(text, QTI12, "http://www.imsglobal.org/xsd/ims_qtiasiv1p2")
        assert len(quiz.findall(".//item")) == count
        for item in quiz.iter("item"):
            question = next(each for each in QUESTIONS if each.name == item.attrib["ident"])
            said = Tags(str(item.findtext("presentation/material/mattext")))
            assert [each["src"] for each in said.pictures] == [
                f"$IMS-CC-FILEBASE$/penumbra/{question.name}-{number}.png" for number in (1, 2)
            ]
            assert files[f"penumbra/{question.name}-1.png"] == PNG
            assert "film.expose as it should be & with a <mistake>." in said.text
            labels = [each.attrib["ident"] for each in item.iter("response_label")]
            assert labels == list(LETTERS[: len(question.choices)])
            scored = [
                each for each in item.iter("respcondition") if each.find("setvar") is not None
            ]
            assert [each.findtext("conditionvar/varequal") for each in scored] == [
                LETTERS[question.answer]
            ]
            feedback = {each.attrib["ident"] for each in item.iter("itemfeedback")}
            assert {each.attrib["linkrefid"] for each in item.iter("displayfeedback")} == feedback


def test_a_package_of_one_module_is_one_quiz() -> None:
    """As New Quizzes of Canvas asks for, which takes no package with two."""
    kinds = re.findall(r'type="(imsqti\w+)"', canvas(QUESTIONS[:2])["imsmanifest.xml"].decode())
    assert kinds == ["imsqti_xmlv1p2"]


def test_a_package_of_qti_21_holds_what_it_names() -> None:
    files = qti21(QUESTIONS)
    manifest = structured(
        files["imsmanifest.xml"], MANIFEST, "http://www.imsglobal.org/xsd/imscp_v1p1"
    )
    named = {each.attrib["href"] for each in manifest.iter("file")}
    assert named == set(files) - {"imsmanifest.xml"}
    for question in QUESTIONS:
        text = files[f"items/{question.name}.xml"]
        item = structured(text, QTI21, "http://www.imsglobal.org/xsd/imsqti_v2p1")
        right = item.findtext("responseDeclaration/correctResponse/value")
        choices = {each.attrib["identifier"] for each in item.iter("simpleChoice")}
        assert right == LETTERS[question.answer]
        assert right in choices
        assert len(choices) == len(question.choices)
        assert {each.attrib["identifier"] for each in item.iter("modalFeedback")} <= choices
        assert {each.attrib["src"].replace("../", "") for each in item.iter("img")} <= set(files)
        assert all(each.attrib["alt"] for each in item.iter("img"))


def test_moodle_gets_pictures_inside_and_one_right_answer() -> None:
    quiz = ET.fromstring(moodle(QUESTIONS))
    kinds = [each.attrib["type"] for each in quiz]
    assert kinds == ["category", "multichoice", "multichoice", "category", "multichoice"]
    for question, element in zip(
        QUESTIONS, quiz.iterfind("question[@type='multichoice']"), strict=True
    ):
        fractions = [answer.attrib["fraction"] for answer in element.iter("answer")]
        assert fractions.index("100") == question.answer
        assert sorted(fractions) == ["0"] * (len(question.choices) - 1) + ["100"]
        inside = {f.attrib["name"]: b64decode(str(f.text)) for f in element.iter("file")}
        assert list(inside.values()) == [PNG, PNG[::-1]]
        said = Tags(str(element.findtext("questiontext/text")))
        assert [each["src"] for each in said.pictures] == [
            f"@@PLUGINFILE@@/{one}" for one in inside
        ]
        # The letters of pictures are among the answers.
        assert element.findtext("shuffleanswers") == "false"


def test_prairielearn_gets_a_folder_a_question() -> None:
    files = prairielearn(QUESTIONS)
    infos = [json.loads(text) for name, text in files.items() if name.endswith("/info.json")]
    assert len({info["uuid"] for info in infos}) == len(QUESTIONS)
    assert all({"uuid", "title", "topic", "type"} <= info.keys() for info in infos)
    for question in QUESTIONS:
        home = f"penumbra/{question.module}/{question.name}"
        # An element of PrairieLearn is HTML that is XML here, too.
        page = ET.fromstring(f"<all>{files[f'{home}/question.html'].decode()}</all>")
        right = [each.attrib["correct"] for each in page.iter("pl-answer")]
        assert right.index("true") == question.answer
        assert right.count("true") == 1
        choices = page.find("pl-multiple-choice")
        assert choices is not None
        assert choices.attrib["order"] == "fixed"
        for picture in page.iter("pl-figure"):
            assert f"{home}/clientFilesQuestion/{picture.attrib['file-name']}" in files


def test_texts_are_escaped_and_code_is_marked() -> None:
    assert marked("`a < b` & <c>") == "<code>a &lt; b</code> &amp; &lt;c&gt;"


def test_the_structure_is_looked_at() -> None:
    broken = canvas(QUESTIONS)["film/film.xml"].replace(b"<outcomes>", b"<outcome>")
    broken = broken.replace(b"</outcomes>", b"</outcome>")
    with pytest.raises(AssertionError, match="resprocessing: outcome"):
        structured(broken, QTI12, "http://www.imsglobal.org/xsd/ims_qtiasiv1p2")
