"""The studio's page, on the loopback address of this machine, for whoever knows its token.

Every request has to name this server as its host and to bring the token. A page of another origin can do neither: its
browser names the host that it believes to ask, and it doesn't know the token.
"""

from __future__ import annotations

import json
import re
import secrets
import sys
import threading
from html import escape
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from queue import Empty
from typing import Any
from urllib.parse import parse_qs, urlsplit

from course.base.errors import CourseError
from course.engine.recording import view
from course.school.studio.saving import write_view, yaml_of_view
from course.school.studio.studio import POLL, Studio

HOST = "127.0.0.1"

LARGEST = 1 << 14
"""Bytes of a request's body."""

QUIET = 10.0
"""Seconds after which a page that is told nothing is told that the studio lives."""

PICTURES = ("mine", "course", "difference", "change")

WISHES: dict[str, dict[str, type | tuple[type, ...]]] = {
    "orbit": {"turn": (int, float), "tilt": (int, float), "zoom": (int, float)},
    "value": {"path": list, "value": (int, float)},
    "pixel": {"x": int, "y": int, "side": str},
    "reset": {},
    "again": {},
}
"""What the page may ask for, and the types of what it tells with it."""


class Server:
    """Serves the page of a studio; CourseError where the port can't be had.

    Parameters
    ----------
    port : that it answers on; 0 for one of chance

    Attributes
    ----------
    address : where the page is, with its token
    """

    def __init__(self, studio: Studio, port: int = 0) -> None:
        self.token = secrets.token_urlsafe(24)
        try:
            self._server = _HTTP((HOST, port), _Handler)
        except OSError as error:
            raise CourseError(
                f"port {port} can't be had: {error.strerror}; choose another"
            ) from error
        self._server.studio, self._server.token = studio, self.token
        self.port = int(self._server.server_address[1])
        self.address = f"http://{HOST}:{self.port}/?token={self.token}"
        # Looks whether it is to end as often as the studio looks at its files.
        self._thread = threading.Thread(
            target=self._server.serve_forever, args=(POLL,), daemon=True
        )
        self._thread.start()

    def close(self) -> None:
        """Serve no more."""
        self._server.closing = True
        self._server.shutdown()
        self._server.server_close()


class _HTTP(ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False
    studio: Studio
    token: str
    closing = False

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Tell of an error, unless a page was closed while it was answered."""
        if not isinstance(sys.exc_info()[1], ConnectionError):
            super().handle_error(request, client_address)


class _Handler(BaseHTTPRequestHandler):
    server: _HTTP
    protocol_version = "HTTP/1.1"
    server_version = "Penumbra"
    sys_version = ""
    timeout = 60

    # ---------------------------------------------------------------- who asks

    def _refused(self) -> bool:
        """Refuse whoever isn't the studio's own page; true if refused."""
        port = self.server.server_address[1]
        hosts = {f"{HOST}:{port}", f"localhost:{port}"}
        host, origin = self.headers.get("Host", ""), self.headers.get("Origin")
        given = self.headers.get("X-Token") or self._query().get("token", "")
        allowed = (
            host in hosts
            and (origin is None or origin == f"http://{host}")
            and self.headers.get("Sec-Fetch-Site", "none") in ("none", "same-origin")
            and secrets.compare_digest(given.encode(), self.server.token.encode())
        )
        if not allowed:
            self._answer(
                HTTPStatus.FORBIDDEN, b"the address of the studio has a token\n", "text/plain"
            )
        return not allowed

    def _query(self) -> dict[str, str]:
        return {name: values[0] for name, values in parse_qs(urlsplit(self.path).query).items()}

    # ---------------------------------------------------------------- answers

    def do_GET(self) -> None:
        """Answer with the page, a picture, or what happens."""
        if self._refused():
            return
        path = urlsplit(self.path).path
        if path == "/":
            self._page()
        elif path == "/events":
            self._events()
        elif path.startswith("/picture/") and path.removeprefix("/picture/") in PICTURES:
            self._picture(path.removeprefix("/picture/"))
        elif path == "/view.yaml":
            self._answer(HTTPStatus.OK, yaml_of_view(self.server.studio).encode(), "text/plain")
        else:
            self._answer(HTTPStatus.NOT_FOUND, b"there is no such page\n", "text/plain")

    def do_POST(self) -> None:
        """Take a wish of the page."""
        told, wish = self._body(), urlsplit(self.path).path.strip("/")
        if self._refused():
            return
        if wish == "save":
            ok, text = write_view(self.server.studio)
            status = HTTPStatus.OK if ok else HTTPStatus.CONFLICT
            self._answer(status, text.encode(), "text/plain")
            return
        wanted = WISHES.get(wish)
        if wanted is None or told is None or not _fits(told, wanted):
            self._answer(
                HTTPStatus.BAD_REQUEST, b"the studio doesn't understand this\n", "text/plain"
            )
            return
        self.server.studio.ask(wish, **{name: told[name] for name in wanted if name in told})
        self._answer(HTTPStatus.NO_CONTENT, b"", "text/plain")

    def _body(self) -> dict[str, Any] | None:
        """The JSON of the request; None if there is none."""
        try:
            length = int(self.headers.get("Content-Length", "0"))
        except ValueError:
            length = -1
        if not 0 <= length <= LARGEST:
            self.close_connection = True
            return None
        data = self.rfile.read(length)
        if self.headers.get("Content-Type") != "application/json":
            return None
        try:
            told = json.loads(data)
        # Brackets in brackets, 16,000 deep.
        except (ValueError, RecursionError):
            return None
        return told if isinstance(told, dict) else None

    def _page(self) -> None:
        nonce = secrets.token_urlsafe(16)
        text = page(self.server.studio, self.server.token, nonce)
        policy = (
            f"default-src 'none'; style-src 'unsafe-inline'; script-src 'nonce-{nonce}';"
            " connect-src 'self'; img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        )
        self._answer(HTTPStatus.OK, text.encode(), "text/html", {"Content-Security-Policy": policy})

    def _picture(self, name: str) -> None:
        pixels = self.server.studio.picture(name)
        if pixels is None:
            self._answer(HTTPStatus.NO_CONTENT, b"", "text/plain")
            return
        height, width, _ = pixels.shape
        self._answer(
            HTTPStatus.OK,
            pixels.tobytes(),
            "application/octet-stream",
            {"X-Size": f"{width}x{height}"},
        )

    def _events(self) -> None:
        """Tell what happens, as server-sent events, until the page is gone."""
        self.close_connection = True
        self._head(HTTPStatus.OK, "text/event-stream", None, {})
        studio = self.server.studio
        events = studio.listen()
        try:
            while not self.server.closing:
                try:
                    waiting = [events.get(timeout=QUIET)]
                    while not events.empty():
                        waiting.append(events.get())
                    if any(name == "gone" for name, _ in waiting):
                        break
                    # Of several of a kind that wait only the last one counts.
                    text = "".join(
                        f"event: {name}\ndata: {json.dumps(data)}\n\n"
                        for name, data in dict(waiting).items()
                    )
                except Empty:
                    text = ": still here\n\n"
                self.wfile.write(text.encode())
                self.wfile.flush()
        except OSError:
            pass
        finally:
            studio.forget(events)

    def _answer(
        self, status: HTTPStatus, data: bytes, kind: str, more: dict[str, str] | None = None
    ) -> None:
        self._head(status, kind, len(data), more or {})
        self.wfile.write(data)

    def _head(
        self, status: HTTPStatus, kind: str, length: int | None, more: dict[str, str]
    ) -> None:
        self.send_response(status)
        self.send_header(
            "Content-Type", f"{kind}; charset=utf-8" if kind.startswith("text") else kind
        )
        if length is not None:
            self.send_header("Content-Length", str(length))
        for name, value in {
            "Cache-Control": "no-store",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
            "Cross-Origin-Resource-Policy": "same-origin",
            **more,
        }.items():
            self.send_header(name, value)
        self.end_headers()

    def log_message(self, *_arguments: Any) -> None:
        """Nothing is logged: the token stands in addresses."""


def _fits(told: dict[str, Any], wanted: dict[str, Any]) -> bool:
    needed = (name for name in wanted if name != "side")
    kinds = all(
        isinstance(told[name], kind) and not isinstance(told[name], bool)
        for name, kind in wanted.items()
        if name in told
    )
    numbers = [value for value in told.values() if isinstance(value, int | float)]
    return kinds and all(name in told for name in needed) and all(abs(n) < 1e9 for n in numbers)


def page(studio: Studio, token: str, nonce: str) -> str:
    """The page: one HTML file that asks for nothing but what the studio tells it."""
    parts = {
        "title": escape(studio.scene.name),
        "mode": "view" if studio.mine is None else "studio",
        "token": token,
        "nonce": nonce,
        "style": view.style() + _file("studio.css"),
        "rays": view.script(),
        "script": _file("studio.js"),
    }
    template = _file("studio.html")
    return re.sub(r"\[\[(\w+)\]\]", lambda found: parts[found[1]], template)


def _file(name: str) -> str:
    return files("course.school.studio").joinpath(name).read_text(encoding="utf-8")
