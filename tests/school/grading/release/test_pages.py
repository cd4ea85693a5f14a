"""Pages without the site tell of its figures, and of the command that makes the same where there is one."""

from course.school.grading.release.pages import plain_pages

PAGE = b"""\
# A page

<!-- site: rays ball 30,40 -->

<!-- site: rays away 30,40 -->

<!-- site: picture ball A ball. -->

<!-- site: live ball -->
"""


def test_what_a_command_can_make_is_told_with_it() -> None:
    contents = {"docs/a.md": PAGE, "scenes/ball.yaml": b"<!-- site: live ball -->\n"}
    plain = plain_pages(contents)
    assert plain["scenes/ball.yaml"] == contents["scenes/ball.yaml"]
    _, _, rays, _, away, _, picture, _, live = plain["docs/a.md"].decode().splitlines()
    assert "`course pixel scenes/ball.yaml 30,40 --html rays.html`" in rays
    assert "`course render scenes/ball.yaml`" in picture
    # Its scene isn't there.
    assert away == "*[On the course's site (`course docs`): the rays of one pixel, in 3D.]*"
    assert live == "*[On the course's site (`course docs`): a view with sliders.]*"


def test_functions_and_classes_are_described_without_sphinx() -> None:
    directives = b".. autofunction:: course.render\n\n.. autoclass:: course.Picture\n   :members:\n"
    page = b"# From Python\n\n```{eval-rst}\n" + directives + b"```\n"
    (plain,) = plain_pages({"python.md": page}).values()
    text = plain.decode()
    assert "eval-rst" not in text
    assert "auto" not in text.split("render(", maxsplit=1)[0]
    assert "\nrender(scene, *, spp=None, size=None," in text
    assert "Parameters\n----------" in text
    assert "\nPicture.save(path)\n\nWrite the picture" in text
    # A property isn't called.
    assert "\nPicture.linear\n\n(H, W, 3) float32" in text
