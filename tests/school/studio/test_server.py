"""The page answers nobody but itself: the loopback address, a token, and the browser's word on who asks."""

from __future__ import annotations

import http.client
import json
import re
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from course.base.errors import CourseError
from course.school.studio.server import LARGEST, Server, _Handler
from course.school.studio.studio import Studio


@pytest.fixture
def server(work: Path) -> Iterator[Server]:
    """A server of a studio that hasn't begun to render."""
    made = Server(Studio(work / "ball.yaml", None))
    yield made
    made.close()


Answer = tuple[int, bytes, dict[str, str]]


def ask(
    server: Server, path: str, headers: dict[str, str] | None = None, body: Any = None
) -> Answer:
    connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=30)
    given = {"Host": f"127.0.0.1:{server.port}"} | (headers or {})
    try:
        if body is None:
            connection.request("GET", path, headers=given)
        else:
            kind = {"Content-Type": "application/json"}
            connection.request("POST", path, body=body, headers=kind | given)
        answer = connection.getresponse()
        return answer.status, answer.read(), dict(answer.getheaders())
    finally:
        connection.close()


def test_the_address_has_all_that_is_needed(server: Server) -> None:
    parts = urlsplit(server.address)
    assert parts.hostname == "127.0.0.1"
    status, text, headers = ask(server, f"{parts.path}?{parts.query}")
    assert status == 200
    assert b"<title>ball.yaml" in text
    policy = headers["Content-Security-Policy"]
    assert policy.startswith("default-src 'none'")
    assert "frame-ancestors 'none'" in policy
    assert headers["Cache-Control"] == "no-store"
    assert headers["Referrer-Policy"] == "no-referrer"


def test_tokens_are_long_and_no_two_are_the_same(work: Path) -> None:
    servers = [Server(Studio(work / "ball.yaml", None)) for _ in range(3)]
    assert len({each.token for each in servers}) == 3
    assert all(len(each.token) >= 32 for each in servers)
    for each in servers:
        each.close()


PATHS = ("/", "/events", "/picture/course", "/view.yaml", "/nothing")
WISHES = ("/orbit", "/value", "/pixel", "/reset", "/again", "/save")


@pytest.mark.parametrize("token", ["", "x", "é"])
def test_without_its_token_nothing_is_told_or_done(server: Server, token: str) -> None:
    given = {"X-Token": token.encode().decode("latin-1")} if token else {}
    for path in PATHS:
        status, text, _ = ask(server, path, given)
        assert status == 403
        assert b"<html" not in text
    for path in WISHES:
        assert ask(server, path, given, "{}")[0] == 403
    assert list(Path.cwd().glob("*view*")) == []


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": "example.org"},
        {"Host": "127.0.0.1"},
        {"Host": "127.0.0.1:1"},
        {"Host": "penumbra.example:{port}"},
        {"Origin": "http://example.org"},
        {"Origin": "null"},
        {"Origin": "https://127.0.0.1:{port}"},
        {"Origin": "http://127.0.0.1:1"},
        {"Sec-Fetch-Site": "cross-site"},
        {"Sec-Fetch-Site": "same-site"},
    ],
)
def test_another_host_or_origin_is_refused_even_with_the_token(
    server: Server, headers: dict[str, str]
) -> None:
    given = {name: value.format(port=server.port) for name, value in headers.items()}
    given["X-Token"] = server.token
    assert ask(server, "/", given)[0] == 403
    assert ask(server, "/reset", given, "{}")[0] == 403


def test_its_own_page_is_answered(server: Server) -> None:
    own = {"X-Token": server.token, "Origin": f"http://127.0.0.1:{server.port}"}
    own["Sec-Fetch-Site"] = "same-origin"
    assert ask(server, "/reset", own, "{}")[0] == 204
    assert ask(server, "/picture/course", own)[0] == 204
    assert ask(server, "/picture/../../etc/passwd", own)[0] == 404
    assert ask(server, "/nothing", own)[0] == 404


def test_it_listens_on_the_loopback_address_alone(server: Server) -> None:
    assert server._server.socket.getsockname()[0] == "127.0.0.1"
    others = {each[4][0] for each in socket.getaddrinfo(socket.gethostname(), None)}
    for address in others - {"127.0.0.1", "::1"}:
        with pytest.raises(OSError):  # noqa: PT011 - refused, unreachable or timed out
            socket.create_connection((address, server.port), timeout=2).close()


@pytest.mark.parametrize(
    ("wish", "body"),
    [
        ("/orbit", "{}"),
        ("/orbit", "[]"),
        ("/orbit", "nonsense"),
        ("/orbit", json.dumps({"turn": "1", "tilt": 0, "zoom": 1})),
        ("/orbit", json.dumps({"turn": True, "tilt": 0, "zoom": 1})),
        ("/orbit", '{"turn": NaN, "tilt": 0, "zoom": 1}'),
        ("/orbit", '{"turn": 1e400, "tilt": 0, "zoom": 1}'),
        ("/orbit", json.dumps({"turn": 10**400, "tilt": 0, "zoom": 1})),
        ("/pixel", json.dumps({"x": 1.5, "y": 2})),
        ("/value", json.dumps({"path": "lights", "value": 1})),
        ("/stop", "{}"),
        ("/hello", "{}"),
        ("/reset", "{}" + " " * LARGEST),
    ],
)
def test_what_is_no_wish_is_refused(server: Server, wish: str, body: str) -> None:
    assert ask(server, wish, {"X-Token": server.token}, body)[0] == 400


def test_a_form_of_another_page_is_refused(server: Server) -> None:
    given = {"X-Token": server.token, "Content-Type": "text/plain"}
    assert ask(server, "/reset", given, "{}")[0] == 400


def test_the_page_names_no_other_host(server: Server) -> None:
    _, text, _ = ask(server, "/", {"X-Token": server.token})
    addresses = set(re.findall(rb"https?://[^\"' <`]+", text))
    assert addresses <= {b"http://www.w3.org/2000/svg"}


def test_a_page_that_is_closed_while_it_is_answered_is_no_error(
    server: Server, capfd: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def gone(*_: Any) -> None:
        raise BrokenPipeError

    monkeypatch.setattr(_Handler, "do_GET", gone)
    with pytest.raises(http.client.RemoteDisconnected):
        ask(server, "/")
    assert capfd.readouterr().err == ""


def test_a_port_can_be_chosen_and_one_that_is_taken_is_told(server: Server) -> None:
    studio = server._server.studio
    with pytest.raises(CourseError, match=f"port {server.port} can't be had"):
        Server(studio, server.port)
    first = Server(studio)
    first.close()
    second = Server(studio, first.port)
    assert second.address.startswith(f"http://127.0.0.1:{first.port}/?token=")
    assert second.token != first.token
    second.close()
