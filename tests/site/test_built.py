"""The site as `make docs` builds it: without a warning, a dead link, a request to elsewhere. Needs zensical."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
OWN = ROOT / ".docs/bin/zensical"
TOOLS = ROOT / "docs/tools"


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """The site, built in a copy, so that nothing of the repository changes."""
    zensical = OWN if OWN.exists() else shutil.which("zensical")
    if not zensical:
        pytest.skip("zensical is not installed: `make docs` installs it")
    copy = tmp_path_factory.mktemp("site")
    for folder in ("src", "docs/tools"):
        shutil.copytree(ROOT / folder, copy / folder, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "zensical.toml", copy)
    subprocess.run([sys.executable, TOOLS / "stage_site.py", copy / "build/site"], check=True)
    done = subprocess.run([zensical, "build", "--strict"], cwd=copy, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "warning" not in (done.stdout + done.stderr).lower()
    return copy / "site"


@pytest.mark.slow
class TestSite:
    """Built once."""

    def test_no_link_is_dead(self, site):
        command = [sys.executable, TOOLS / "dead_links.py", site]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout

    def test_the_api_is_there(self, site):
        page = (site / "reference/api.html").read_text(encoding="utf-8")
        assert "Run a scenario and return its record." in page
        assert "<code>runs</code>: independent replicates" in page

    def test_every_page_opens_without_a_network(self, site):
        pytest.importorskip("playwright", reason="playwright is not installed")
        if not any(map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))):
            pytest.skip("no chromium is installed")
        command = [sys.executable, TOOLS / "open_site.py", site]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
