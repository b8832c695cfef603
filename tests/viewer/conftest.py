"""A page of three small files instead of the built one, for tests of the server; and a browser with the built one."""

from pathlib import Path

import pytest

from browsing import DESK
from shoal.scenario.load import read_table

CHROMIUM = [Path(path) for path in ("/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome")]

FILES = {
    "index.html": '<!doctype html><html><head><link rel="stylesheet" href="app.css"></head><body>'
    '<p id="told"></p><script src="app.js"></script></body></html>',
    "app.js": "document.getElementById('told').textContent = '</script><!-- told -->';",
    "app.css": "p { color: green }",
}


@pytest.fixture
def small_page(monkeypatch):
    monkeypatch.setattr("shoal.viewer.page._read", FILES.__getitem__)
    return FILES


@pytest.fixture(scope="module")
def browser():
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    with playwright.sync_playwright() as engine:
        own = Path(engine.chromium.executable_path)
        found = [path for path in [own, *CHROMIUM] if path.exists()]
        if not found:
            pytest.skip("no chromium is installed")
        arguments = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
        browser = engine.chromium.launch(executable_path=str(found[0]), args=arguments)
        yield browser
        browser.close()


@pytest.fixture
def address():
    """A run of oceans2020 that plays."""
    from shoal.viewer.server import serving_session
    from shoal.viewer.session import Session

    with serving_session(Session([read_table("oceans2020")])) as where:
        yield where


@pytest.fixture
def open_page(browser):
    """Open an address in a browser of its own; gives the page, which says at the end whether all went well."""
    contexts, told = [], []

    def open_(address, viewport=DESK, **options):
        context = browser.new_context(viewport=viewport, **options)
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(60_000)
        page.on("pageerror", lambda error: told.append(str(error)))
        page.on("console", lambda message: told.append(message.text) if message.type in ("error", "warning") else None)
        page.goto(address)
        page.wait_for_function("() => window.shoal && shoal.step() >= 0")
        return page

    yield open_
    for context in contexts:
        context.close()
    assert told == []
