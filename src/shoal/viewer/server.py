"""The server: the page's files and its WebSocket, from a thread of its own."""

import asyncio
import logging
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from shoal.core.errors import MissingExtraError
from shoal.viewer.address import LOCAL, Guard, listen, names_of, reachable
from shoal.viewer.page import LIVE_POLICY, assets
from shoal.viewer.requests import LONGEST
from shoal.viewer.session import Session
from shoal.viewer.worker import Worker

if TYPE_CHECKING:
    from starlette.applications import Starlette
    from starlette.websockets import WebSocket

    from shoal.viewer.client import Show

_HEADERS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-store",
}


@contextmanager
def serving_session(session: Session, host: str = LOCAL, port: int = 0) -> Iterator[str]:
    """Run a session and serve it while this is a context; gives the address. Port 0 is a free one.

    Raises
    ------
    ShoalError : the address cannot be had, or the page is not built
    MissingExtraError : starlette, uvicorn or websockets is not installed
    """
    with Worker(session) as worker, serving(live_app(worker), host, port) as address:
        yield address


@contextmanager
def serving(app: "Starlette", host: str = LOCAL, port: int = 0) -> Iterator[str]:
    """Serve an app from a thread while this is a context; gives the address.

    Raises
    ------
    ShoalError : the address cannot be had
    MissingExtraError : uvicorn or websockets is not installed
    """
    require_libraries()
    import uvicorn

    logging.getLogger("uvicorn.error").addFilter(_is_ours)
    listener = listen(host, port)
    config = uvicorn.Config(
        Guard(app, names_of(host)),
        ws="websockets-sansio",
        ws_max_size=LONGEST,
        ws_per_message_deflate=False,
        lifespan="off",
        log_config=None,
        log_level="error",
        server_header=False,
        timeout_graceful_shutdown=1,
    )
    server = uvicorn.Server(config)
    thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, name="shoal-server")
    thread.start()
    try:
        yield f"http://{reachable(host)}:{listener.getsockname()[1]}/"  # it listens already: early requests wait
    finally:
        server.should_exit = True
        thread.join()
        listener.close()


def live_app(show: "Show") -> "Starlette":
    """The page, and the WebSocket through which it sees and controls what there is to see."""
    require_libraries()
    from starlette.applications import Starlette
    from starlette.routing import WebSocketRoute

    from shoal.viewer.client import Client

    async def live(socket: "WebSocket") -> None:
        await Client(socket, show).serve()

    files = {path: (each.content, each.media_type) for path, each in assets().items()}
    return Starlette(routes=[*_routes(files, LIVE_POLICY), WebSocketRoute("/live", live)])


def page_app(page: str) -> "Starlette":
    """One page that needs nothing else and says its policy itself."""
    require_libraries()
    from starlette.applications import Starlette

    return Starlette(routes=_routes({"/": (page.encode(), "text/html")}, "frame-ancestors 'none'"))


def _routes(files: dict[str, tuple[bytes, str]], policy: str) -> list[Any]:
    from starlette.responses import Response
    from starlette.routing import Route

    headers = {**_HEADERS, "Content-Security-Policy": policy}

    def route(path: str, content: bytes, media_type: str) -> Route:
        async def answer(request: Any) -> Response:
            return Response(content, media_type=media_type, headers=headers)

        return Route(path, answer, methods=["GET"])

    return [route(path, *file) for path, file in files.items()]


def _is_ours(told: logging.LogRecord) -> bool:
    """Whether an error is one of the server: not that somebody sent text that is none, nor that pages end with it."""
    return not (told.exc_info and isinstance(told.exc_info[1], (UnicodeError, asyncio.CancelledError)))


def require_libraries() -> None:
    """Refuse to begin without them.

    Raises
    ------
    MissingExtraError : one is not installed
    """
    for name in ("starlette", "uvicorn", "websockets"):
        if find_spec(name) is None:
            raise MissingExtraError.of(name, "viewer", "watching a run in a browser")
