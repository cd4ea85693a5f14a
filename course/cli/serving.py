"""Serve the page of a studio until Ctrl-C."""

from __future__ import annotations

import signal
import threading
import webbrowser
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from course.school.studio.studio import Studio


port_option = click.option(
    "--port",
    type=click.IntRange(1024, 65535),
    help="Of the page, where one has to be forwarded to another machine.  [default: one of chance]",
)


def serve(studio: Studio, no_browser: bool, port: int | None) -> None:
    """Start it, print its address, open a browser, and wait."""
    from course.school.studio.server import Server

    ended = threading.Event()

    def end(*_: Any) -> None:
        ended.set()

    before = signal.signal(signal.SIGTERM, end)
    server = Server(studio, port or 0)
    studio.start()
    try:
        click.echo(f"{server.address}\nThe page follows {studio.scene}; Ctrl-C ends it.")
        if not no_browser:
            webbrowser.open(server.address)
        # With a limit, for otherwise Ctrl-C is not heard everywhere.
        while not ended.wait(0.5):
            pass
    except KeyboardInterrupt:
        pass
    finally:
        server.close()
        studio.close()
        signal.signal(signal.SIGTERM, before)
