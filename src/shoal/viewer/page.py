"""The page: its three files as they are served, or all in one with a recorded run inside."""

import base64
import hashlib
import re
from importlib import resources
from typing import NamedTuple

from shoal.core.errors import ShoalError
from shoal.viewer.scene import as_json

LIVE_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data: blob:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)


class Asset(NamedTuple):
    """One file of the page."""

    content: bytes
    media_type: str


def assets() -> dict[str, Asset]:
    """The files of the page by the path they are served at; there are no others.

    Raises
    ------
    ShoalError : the page is not built
    """
    return {
        "/": Asset(_read("index.html").encode(), "text/html"),
        "/app.js": Asset(_read("app.js").encode(), "text/javascript"),
        "/app.css": Asset(_read("app.css").encode(), "text/css"),
    }


def inline_page(scene: dict[str, object], frames: bytes) -> str:
    """Return the page as one HTML text that shows these frames and loads nothing from anywhere.

    Its policy lets no script run but the page's own, known by its hash.

    Raises
    ------
    ShoalError : the page is not built
    """
    script = _inside_html(_read("app.js"))
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    policy = (
        f"default-src 'none'; script-src 'sha256-{digest}'; style-src 'unsafe-inline'; img-src data: blob:; "
        "base-uri 'none'; form-action 'none'"
    )
    data = (
        f'<script type="application/json" id="scene">{as_json(scene)}</script>\n'
        f'<script type="text/plain" id="frames">{base64.b64encode(frames).decode()}</script>\n'
    )
    kind = ' type="module"' if re.search(r"<script[^>]*type=.module", _read("index.html")) else ""
    page = _replace(r'<link[^>]*href="app\.css"[^>]*>', f"<style>{_read('app.css')}</style>", _read("index.html"))
    page = _replace(r'\s*<script[^>]*src="app\.js"[^>]*></script>', "", page)
    page = _replace(r"<head>", f'<head>\n<meta http-equiv="Content-Security-Policy" content="{policy}">', page)
    return _replace(r"</body>", f"{data}<script{kind}>{script}</script>\n</body>", page)


def _replace(pattern: str, text: str, page: str) -> str:
    changed, count = re.subn(pattern, lambda _: text, page)
    if count != 1:
        raise ShoalError("view/static/index.html", f"has {count} times {pattern}", "build the page again")
    return changed


def _inside_html(script: str) -> str:
    """A script with nothing in its strings that HTML would take for the end of it."""
    return re.sub(r"<(/script|!--)", r"<\\\1", script, flags=re.IGNORECASE)


def _read(name: str) -> str:
    try:
        return (resources.files("shoal.viewer") / "static" / name).read_text(encoding="utf-8")
    except OSError:
        raise ShoalError(
            "the page of the viewer", f"is not built ({name} is missing)", "run `npm run build` in web/, or reinstall"
        ) from None
