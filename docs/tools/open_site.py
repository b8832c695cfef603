"""Open every page of a site in a browser that reaches no other host: python docs/tools/open_site.py FOLDER [--axe].

Needs playwright and a chromium. Exit code 1 and a line each if a page asks for what is not there, or elsewhere, or has
an error in its scripts, or if the search finds nothing; with --axe, for what axe-core finds on a page, light or dark:
`npm ci` in web/ installs it, and it takes some minutes.
"""

import re
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Literal

from playwright.sync_api import Browser, Request, Route, TimeoutError, sync_playwright

CHROMIUM = [Path(path) for path in ("/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome")]
ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"]
WORD = "repulsion"  # to search for
AXE = Path(__file__).parents[2] / "web/node_modules/axe-core/axe.min.js"
SCHEMES: dict[Literal["light", "dark"], str] = {"light": "default", "dark": "slate"}  # a browser's word: the site's
FINDINGS = """() => axe.run(document, {resultTypes: ["violations"]}).then(({violations}) =>
    violations.map(({id, nodes}) => `${id}: ${nodes.slice(0, 3).map(({html}) => html.slice(0, 160)).join(" | ")}`))"""


def main(folder: Path, axe: bool) -> int:
    """Print each fault; return the exit code."""
    files = [file for file in sorted(folder.resolve().rglob("*.html")) if file.name != "404.html"]  # needs a server
    with sync_playwright() as engine:
        own = Path(engine.chromium.executable_path)
        chromium = next((path for path in [own, *CHROMIUM] if path.exists()), None)
        browser = engine.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        found = list(faults(browser, files))
        found += [each for scheme in SCHEMES for each in unreadable(browser, files, scheme)] if axe else []
        found += [] if finds(browser, folder.resolve() / "index.html") else [f"search: finds no {WORD}"]
        browser.close()
    for fault in found:
        print(fault)
    print(f"{len(files)} pages opened{', and looked at by axe-core' if axe else ''}, {len(found)} faults")
    return int(bool(found))


def faults(browser: Browser, files: list[Path]) -> Iterator[str]:
    """What goes wrong while pages load from disk, one after the other."""
    told: list[str] = []

    def guard(route: Route) -> None:
        if route.request.url.startswith(("file:", "data:", "blob:")):
            route.continue_()
        else:
            told.append(f"asks for {route.request.url}")
            route.abort()

    def fail(request: Request) -> None:
        if request.failure != "net::ERR_ABORTED":  # the next page was opened before it came, or `guard` told of it
            told.append(f"failed: {request.url} {request.failure}")

    with browser.new_context(offline=True) as context:
        page = context.new_page()
        page.route("**/*", guard)
        page.on("requestfailed", fail)
        page.on("pageerror", lambda error: told.append(f"error: {error}"))
        for file in files:
            page.goto(file.as_uri(), wait_until="load")
            page.wait_for_timeout(50)
            yield from (f"{file.name}: {each}" for each in told)
            told.clear()


def unreadable(browser: Browser, files: list[Path], scheme: Literal["light", "dark"]) -> Iterator[str]:
    """What axe-core finds on pages: what somebody cannot see, reach or have read aloud."""
    with browser.new_context(offline=True, bypass_csp=True, color_scheme=scheme, reduced_motion="reduce") as context:
        context.add_init_script(path=AXE)
        page = context.new_page()
        for file in files:
            page.goto(file.as_uri(), wait_until="load")
            shown = page.evaluate("document.body.dataset.mdColorScheme")
            if shown not in (None, SCHEMES[scheme]):
                yield f"{file.name}: is {shown} where {scheme} is asked for"
            yield from (f"{file.name} ({scheme}): {each}" for each in page.evaluate(FINDINGS))


def finds(browser: Browser, file: Path) -> bool:
    """Does the search of the first page find a word, without a server?"""
    with browser.new_context(offline=True) as context:
        page = context.new_page()
        page.goto(file.as_uri(), wait_until="load")
        page.get_by_role("button", name="Search").first.click()
        page.get_by_placeholder("Search").press_sequentially(WORD, delay=50)
        marked = page.locator("mark", has_text=re.compile(f"^{WORD}$", re.IGNORECASE))  # in what was found
        with suppress(TimeoutError):
            marked.first.wait_for(timeout=10_000)
        return marked.count() > 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), "--axe" in sys.argv[2:]))
