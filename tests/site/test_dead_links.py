"""A dead link of a built site is found, and so is what it would fetch from elsewhere."""

import pytest

from dead_links import faults, main


@pytest.fixture
def site(tmp_path):
    """Two pages that lead to each other, and to the web."""
    (tmp_path / "a.html").write_text('<a href="b/index.html#there">b</a> <a href="https://example.org">web</a>')
    (tmp_path / "b").mkdir()
    (tmp_path / "b/index.html").write_text('<h1 id="there">b</h1> <a href="../a.html">a</a> <a href="./">b</a>')
    return tmp_path


def test_a_sound_site_has_none(site, capsys):
    assert list(faults(site)) == []
    assert main(site) == 0
    assert capsys.readouterr().out == "2 pages, 0 dead links or outside loads\n"


@pytest.mark.parametrize(
    ("tag", "fault"),
    [
        ('<a href="d.html">', "c.html: d.html: no such file"),
        ('<img src="c.png">', "c.html: c.png: no such file"),
        ('<a href="b/index.html#here">', "c.html: b/index.html#here: no such heading"),
        ('<a href="#here">', "c.html: #here: no such heading"),
        ('<script src="https://example.org/x.js"></script>', "c.html: loads https://example.org/x.js"),
        ('<link href="//example.org/x.css">', "c.html: loads //example.org/x.css"),
    ],
)
def test_each_fault_is_named(site, tag, fault, capsys):
    (site / "c.html").write_text(tag)
    assert list(faults(site)) == [fault]
    assert main(site) == 1
    assert fault in capsys.readouterr().out
