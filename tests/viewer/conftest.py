"""A page of three small files instead of the built one, for tests of the server."""

import pytest

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
