"""Take the screenshots of the viewer: python docs/screenshots.py FOLDER (needs playwright and a chromium)."""

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from playwright.sync_api import Browser, Page, sync_playwright

from shoal import load, simulate
from shoal.scenario.load import read_table
from shoal.viewer.replay import replay_page
from shoal.viewer.server import serving_session
from shoal.viewer.session import Session

CHROMIUM = [Path(path) for path in ("/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome")]
DESK = {"width": 1280, "height": 720}
PHONE = {"width": 390, "height": 844}
STEPS = 2000  # of the replay
SPEED = 10.0  # times real time


def main(folder: Path) -> None:
    """Write every screenshot into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    with sync_playwright() as engine:
        own = Path(engine.chromium.executable_path)
        chromium = next((path for path in [own, *CHROMIUM] if path.exists()), None)
        if chromium is None:
            sys.exit("no chromium is installed: run `playwright install chromium`")
        browser = engine.chromium.launch(executable_path=str(chromium), args=["--no-sandbox", "--disable-gpu"])
        shoot_live(browser, folder)
        shoot_comparison(browser, folder)
        shoot_replay(browser, folder)
        browser.close()


def shoot_live(browser: Browser, folder: Path) -> None:
    """A running swarm: light, dark with halos, the keys, and on a phone."""
    with serving_session(Session([read_table("oceans2020")], speed=SPEED)) as address:
        shoot(browser, address, folder / "live.png", run_on)
        shoot(browser, address, folder / "live-dark.png", run_on, key="h", color_scheme="dark")
        shoot(browser, address, folder / "keys.png", run_on, key="?")
        shoot(browser, address, folder / "phone.png", run_on, viewport=PHONE, has_touch=True)
        shoot(browser, address, folder / "phone-dark.png", run_on, viewport=PHONE, has_touch=True, color_scheme="dark")


def shoot_comparison(browser: Browser, folder: Path) -> None:
    """Two runs on one seed, that differ in k."""
    few = read_table("oceans2020")
    few["network"]["neighbors"] = 5
    with serving_session(Session([read_table("oceans2020"), few], speed=SPEED)) as address:
        shoot(browser, address, folder / "against.png", run_on)
        shoot(browser, address, folder / "against-dark.png", run_on, color_scheme="dark")


def shoot_replay(browser: Browser, folder: Path) -> None:
    """A record as a page."""
    scenario = load("oceans2020")
    record = simulate(scenario.model_copy(update={"steps": STEPS}), every=2)
    with TemporaryDirectory() as scratch:
        file = Path(scratch, "replay.html")
        file.write_text(replay_page(record), encoding="utf-8")
        seek = f"() => shoal.step() === {STEPS - 2}"

        def to_the_end(page: Page) -> None:
            page.keyboard.press("End")
            page.wait_for_function(seek)

        shoot(browser, file.as_uri(), folder / "replay.png", to_the_end)


def shoot(
    browser: Browser, address: str, file: Path, prepare: Callable[[Page], None], key: str | None = None, **options: Any
) -> None:
    """Open an address, prepare the page, press a key and take its picture."""
    with opened(browser, address, **{"viewport": DESK, "device_scale_factor": 2, **options}) as page:
        prepare(page)
        if key:
            page.keyboard.press(key)
        page.wait_for_timeout(500)  # numbers and charts follow ten times a second
        page.screenshot(path=file)


def run_on(page: Page) -> None:
    """Let a live run go on for long enough to fill the charts, then pause it."""
    if not page.evaluate("() => shoal.playing()"):
        page.keyboard.press(" ")
    last = page.evaluate("() => shoal.step()") + 700
    page.wait_for_function("last => shoal.step() >= last", arg=last)
    page.keyboard.press(" ")
    page.wait_for_function("() => !shoal.playing()")


@contextmanager
def opened(browser: Browser, address: str, **options: Any) -> Iterator[Page]:
    """A page that shows its first frame, in a browser of its own."""
    context = browser.new_context(**options)
    page = context.new_page()
    page.goto(address)
    page.wait_for_function("() => window.shoal && shoal.step() >= 0")
    yield page
    context.close()


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
