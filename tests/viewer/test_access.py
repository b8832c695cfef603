"""Everybody can use the page: no finding of axe-core, every control by keyboard, room for fingers, and paper."""

from pathlib import Path

import pytest

from browsing import DESK, PHONE, pause
from scenarios import scenario
from searches import runs_of
from shoal.experiments.fleet_range import FleetRange
from shoal.paper.report import write_report
from shoal.paper.results import Claim, Reproduction
from shoal.run.simulate import simulate
from shoal.scenario.load import read_table
from shoal.study.design import DesignOptions, designed
from shoal.study.design_page import page as page_to_buy_by

pytest.importorskip("starlette", reason="the viewer's libraries are not installed")
pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

from playwright.sync_api import TimeoutError as NothingHappened

from shoal.viewer.replay import replay_page
from shoal.viewer.server import serving_session
from shoal.viewer.session import Session

AXE = Path(__file__).parents[2] / "web" / "node_modules" / "axe-core" / "axe.min.js"
FINDINGS = """() => axe.run(document, {resultTypes: ["violations"]}).then(({violations}) =>
    violations.map(({id, nodes}) => `${id}: ${nodes.map(({html}) => html.slice(0, 120)).join(" | ")}`))"""
LEAST = 44  # [px] of what fingers touch


@pytest.fixture(scope="module")
def wide():
    """A run in an arena four times as wide as high."""
    table = read_table("oceans2020")
    table["area"] |= {"width": 80.0}
    with serving_session(Session([table])) as address:
        yield address


@pytest.fixture
def open_file(browser):
    """Open a file that is no page of the viewer."""
    contexts = []

    def open_(file):
        contexts.append(browser.new_context(viewport=PHONE, bypass_csp=True))
        page = contexts[-1].new_page()
        page.goto(file.as_uri())
        return page

    yield open_
    for context in contexts:
        context.close()


def findings(page):
    """What axe-core finds, in words."""
    page.evaluate(AXE.read_text(encoding="utf-8"))
    return page.evaluate(FINDINGS)


@pytest.mark.skipif(not AXE.exists(), reason="axe-core is not installed: npm ci in web/")
class TestAxeFindsNothing:
    @pytest.mark.parametrize("scheme", ["light", "dark"])
    def test_on_a_live_page_its_panels_and_its_help(self, open_page, address, scheme):
        page = open_page(address, color_scheme=scheme, bypass_csp=True)
        pause(page)
        page.locator("summary", has_text="Parameters").click()
        assert findings(page) == []
        page.keyboard.press("?")
        assert findings(page) == []

    def test_on_a_phone_and_on_a_low_wide_arena(self, open_page, wide):
        for viewport in (DESK, PHONE, {"width": 844, "height": 390}):
            assert findings(open_page(wide, viewport, bypass_csp=True)) == []

    def test_on_the_report_of_a_reproduction(self, open_file, tmp_path):
        claim = Claim("C3", "k* is about 18", "k* is 18.2", 18.2, 17.1, 19.3, unit="k", figure="tot_k", verdict="holds")
        found = Reproduction(
            "oceans2020", False, 100_000, 5, [{"fast": 15, "run": 0, "status": "done"}], [], claims=[claim], figures=[],
            tables={"peaks": [{"fast": 15, "k_star": 18.2}]}, command="shoal reproduce", versions={}, seconds=1.0,
        )  # fmt: skip
        assert findings(open_file(write_report(found, tmp_path / "report"))) == []

    def test_on_the_page_of_a_design(self, open_file, tmp_path):
        def value(scenario, run):
            return sum(fleet.count * fleet.max_speed for fleet in scenario.fleets) / 100.0

        ranges = [FleetRange("BoB-1", 0, 5, 3), FleetRange("BoB-0", 0, 5, 1)]
        options = DesignOptions(trials=6, runs=2, final_runs=2)
        found = designed("oceans2020", (ranges, []), {"steps": 50}, options, executor=runs_of(value), report=None)
        file = tmp_path / "buy.html"
        file.write_text(page_to_buy_by("oceans2020", found.result, "data:,"), encoding="utf-8")
        assert findings(open_file(file)) == []

    def test_on_a_replay(self, open_page, tmp_path):
        file = tmp_path / "run.html"
        file.write_text(replay_page(simulate(scenario(changes={"steps": 200}), every=10)), encoding="utf-8")
        assert findings(open_page(file.as_uri(), bypass_csp=True)) == []


STATE = """() => JSON.stringify([
    [...document.querySelectorAll("input, select")].map((each) =>
        ["checkbox", "radio"].includes(each.type) ? each.checked : each.value),
    [...document.querySelectorAll("[aria-pressed], [aria-expanded], details, dialog")].map((each) =>
        [each.ariaPressed, each.ariaExpanded, each.open]),
    shoal.playing(), shoal.step(), shoal.saved(),
    document.documentElement.dataset.theme, document.querySelector("#about").textContent,
    document.activeElement.matches("canvas") && document.querySelector(".place").textContent,
])"""
STOP = """() => {
    const each = document.activeElement;
    const name = each.getAttribute("aria-label") || each.labels?.[0]?.innerText || each.innerText || "";
    const kind = each.matches("canvas, summary") ? each.localName : each.type;
    return each === document.body ? null : [kind, name.trim().split("\\n")[0]];
}"""
USED_BY = {
    "range": ["ArrowRight", "ArrowLeft"],
    "select-one": ["ArrowDown"],
    "number": ["ArrowUp"],
    "button": ["Enter"],
}
ALWAYS_THERE = {
    "Panels (B)", "Full screen (Z)", "Dark or light (D)", "Keys (?)", "Metric of chart 1", "Measure", "CSV",
    "Swarm", "Look", "Strategy",
    "Neighbors heard, k", "Target speed", "Fast buoys", "Parameters of the strategy", "Seed", "Restart", "Trails",
    "Restart from step 0 (R)", "One step back (←)", "Play (space)", "One step forward (→)", "Step shown", "Speed",
}  # fmt: skip


class TestTheKeyboard:
    def test_reaches_and_uses_every_control(self, open_page, address):
        page = open_page(address)
        pause(page)
        page.keyboard.press("ArrowRight")
        page.wait_for_function("() => shoal.step() > 0")
        used, useless = set(), []
        for _ in range(80):
            page.keyboard.press("Tab")
            stop = page.evaluate(STOP)
            if stop is None:  # the browser's own bar
                continue
            kind, name = stop
            if name in used:
                break
            assert name, f"a {kind} has no name"
            if any(self.changes(page, key) for key in USED_BY.get(kind, ["Space", "ArrowRight", "ArrowRight"])):
                used.add(name)
            else:
                useless.append(name)
            self.put_back(page, name)
        assert useless == []
        assert used >= ALWAYS_THERE

    def changes(self, page, key):
        """Whether a key does something within a moment."""
        before = page.evaluate(STATE)
        page.keyboard.press(key)
        try:
            page.wait_for_function(f"before => ({STATE})() !== before", arg=before, timeout=4000)
        except NothingHappened:
            return False
        return True

    def put_back(self, page, name):
        """Close or unfold what was opened or folded, so that the way goes on where it was."""
        if name.startswith("Keys"):
            page.keyboard.press("Escape")
        elif name in ("Step shown", "One step back (←)"):
            page.keyboard.press("End")  # the past cannot be changed
            page.wait_for_function("() => !document.querySelector('#tool-add').closest('fieldset').disabled")
        elif page.evaluate("shoal.playing()"):
            page.keyboard.press("Space")
            page.wait_for_function("() => !shoal.playing()")
        elif name.startswith("Restart"):
            page.keyboard.press("ArrowRight")  # from step 0 there is no way back
            page.wait_for_function("() => !document.querySelector('[aria-label^=\"One step back\"]').disabled")
        elif name.startswith("Panels") or page.evaluate("document.activeElement.ariaExpanded") == "false":
            page.keyboard.press("Enter")

    def test_of_the_page_is_not_taken_by_a_click_on_the_water(self, open_page, address):
        page = open_page(address)
        pause(page)
        page.locator(".water canvas").click()
        before = page.evaluate("shoal.step()")
        page.keyboard.press("ArrowRight")
        page.wait_for_function("step => shoal.step() === step", arg=before + 1)


class TestRoom:
    def test_a_low_wide_arena_takes_three_fifths_of_the_width(self, open_page, wide):
        page = open_page(wide)
        (left, _), (right, _) = (page.evaluate("x => shoal.place(x, 0)", x) for x in (-40.0, 40.0))
        assert right - left >= 0.6 * DESK["width"]

    @pytest.mark.parametrize("viewport", [PHONE, {"width": 844, "height": 390}, {"width": 320, "height": 640}])
    def test_the_swarm_stays_in_sight_while_it_is_changed_and_fingers_have_room(self, open_page, address, viewport):
        page = open_page(address, viewport, has_touch=True, is_mobile=True)
        slider = page.get_by_role("slider", name="Target speed")
        slider.scroll_into_view_if_needed()
        water, moved = page.locator(".water canvas").bounding_box(), slider.bounding_box()
        assert 0 <= water["y"] < water["y"] + water["height"] <= viewport["height"]
        assert moved["y"] + moved["height"] <= viewport["height"]
        small = page.evaluate(
            """least => [...document.querySelectorAll("button, select, summary, input")]
                .filter((each) => each.checkVisibility())
                .map((each) => [each, (each.closest("label") ?? each).getBoundingClientRect()])
                .filter(([, box]) => box.height < least || box.width < least).map(([each]) => each.outerHTML)""",
            LEAST,
        )
        assert small == []

    def test_panels_fold_and_go_away(self, open_page, address):
        page = open_page(address)
        page.get_by_role("button", name="Swarm", exact=True).click()
        assert page.get_by_role("slider", name="Target speed").is_hidden()
        narrow = page.locator("main").bounding_box()["width"]
        page.keyboard.press("b")
        assert page.locator("main").bounding_box()["width"] > 1.5 * narrow


class TestPaper:
    def test_shows_the_swarm_as_it_is(self, open_page, wide):
        page = open_page(wide, color_scheme="dark")
        pause(page)
        page.evaluate("dispatchEvent(new Event('beforeprint'))")
        page.emulate_media(media="print", color_scheme="dark")
        water = page.locator(".water canvas")
        box = water.bounding_box()
        drawn = water.evaluate(
            """canvas => {
                const {data} = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
                return [canvas.width / canvas.height, new Set(new Uint32Array(data.buffer)).size];
            }"""
        )
        assert drawn[0] == pytest.approx(box["width"] / box["height"], rel=0.02)
        assert drawn[1] > 50  # colors: not an empty sheet
        assert page.get_by_role("slider", name="Target speed").is_hidden()
        page.emulate_media(media="screen", color_scheme="dark")
        page.evaluate("dispatchEvent(new Event('afterprint'))")
        assert page.evaluate("document.documentElement.dataset.theme ?? null") is None
