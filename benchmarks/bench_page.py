"""How often a second the live page draws, and how much it weighs: python benchmarks/bench_page.py (needs playwright).

The page is in a headless browser without a graphics card, on the cores that the engine works on, too.
"""

import gzip
import sys
from pathlib import Path

from playwright.sync_api import sync_playwright

from shoal.scenario.edit import apply
from shoal.scenario.load import read_table
from shoal.viewer.page import assets
from shoal.viewer.server import serving_session
from shoal.viewer.session import Session

CHROMIUM = [Path(path) for path in ("/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome")]
DESK = {"width": 1280, "height": 720}
SWARMS = (50, 500, 2000, 20_000)
SECONDS = 5


def main() -> None:
    """Print a line for the page's weight and one for each swarm."""
    weight = sum(len(gzip.compress(each.content, 9)) for each in assets().values())
    print(f"{weight / 1000:.1f} kB gzipped")
    with sync_playwright() as engine:
        own = Path(engine.chromium.executable_path)
        found = [path for path in [own, *CHROMIUM] if path.exists()]
        if not found:
            sys.exit("no chromium is installed: run `playwright install chromium`")
        browser = engine.chromium.launch(executable_path=str(found[0]), args=["--no-sandbox", "--disable-gpu"])
        for agents in SWARMS:
            print(f"{agents:6,} agents: {frames_a_second(browser, agents):5.1f} frames a second")
        browser.close()


def frames_a_second(browser, agents: int) -> float:
    """How often the page draws a swarm of so many, on average, after it has begun."""
    table = apply(read_table("oceans2020"), {"agents": agents, "density": "keep"})
    with serving_session(Session([table])) as address:
        page = browser.new_page(viewport=DESK)
        page.goto(address)
        page.wait_for_function("() => window.shoal && shoal.step() > 2", timeout=120_000)
        page.wait_for_timeout(1500)
        rates = []
        for _ in range(SECONDS):
            page.wait_for_timeout(1000)
            rates.append(page.evaluate("shoal.fps()"))
        page.close()
    return sum(rates) / len(rates)


if __name__ == "__main__":
    main()
