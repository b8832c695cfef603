"""The page in a real browser: live, as a replay, by mouse, by keyboard and on a phone."""

import json
from dataclasses import replace

import numpy as np
import pytest

from browsing import DESK, SHOWN, first_living_agent, pause, place, play, slide
from bulletins import FRAMES, GAUGES, bulletin
from scenarios import scenario
from shoal.drawing.words import estimate_text
from shoal.run.simulate import simulate
from shoal.scenario.load import read_table

pytest.importorskip("starlette", reason="the viewer's libraries are not installed")
pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

from shoal.viewer.frame import pack
from shoal.viewer.outlook import Outlook
from shoal.viewer.replay import replay_page
from shoal.viewer.server import live_app, page_app, serving, serving_session
from shoal.viewer.session import Session


@pytest.fixture(scope="module")
def record():
    return simulate(scenario(changes={"steps": 1000}), every=10)


@pytest.fixture(scope="module")
def replay(record, tmp_path_factory):
    """A file that plays the record."""
    file = tmp_path_factory.mktemp("replay") / "run.html"
    file.write_text(replay_page(record), encoding="utf-8")
    return file


class TestWatching:
    def test_the_run_goes_on_by_itself_and_nothing_complains(self, open_page, address):
        page = open_page(address)
        first = page.evaluate("shoal.step()")
        page.wait_for_function("step => shoal.step() > step", arg=first)
        assert page.evaluate("shoal.agents()") == 50
        assert page.get_by_role("heading", name="Time on target").is_visible()

    def test_pause_really_stops_the_steps(self, open_page, address):
        page = open_page(address)
        pause(page)
        before = page.evaluate("shoal.step()")
        page.wait_for_timeout(500)
        assert page.evaluate("shoal.step()") == before
        play(page)
        page.wait_for_function("step => shoal.step() > step", arg=before)

    def test_one_step_is_one_step(self, open_page, address):
        page = open_page(address)
        pause(page)
        before = page.evaluate("shoal.step()")
        page.get_by_role("button", name="One step forward").click()
        page.wait_for_function("step => shoal.step() === step", arg=before + 1)

    def test_agents_that_hear_fewer_others_have_fewer_links(self, open_page, address):
        page = open_page(address)
        pause(page)
        many = page.evaluate("shoal.links()")
        slide(page, "Neighbors heard, k", "ArrowLeft", 15)
        page.wait_for_function("many => shoal.links() < many / 2", arg=many)
        slide(page, "Neighbors heard, k", "ArrowRight", 15)
        page.wait_for_function("many => shoal.links() > many / 2", arg=many)

    def test_a_buoy_that_is_clicked_with_the_tool_is_gone(self, open_page, address):
        page = open_page(address)
        pause(page)
        before = page.evaluate("shoal.agents()")
        page.keyboard.press("3")
        page.mouse.click(*first_living_agent(page))
        page.wait_for_function("before => shoal.agents() === before - 1", arg=before)
        page.get_by_text("1 not there").wait_for()

    def test_a_click_on_empty_water_adds_a_buoy(self, open_page, address):
        page = open_page(address)
        pause(page)
        before = page.evaluate("shoal.agents()")
        page.keyboard.press("4")
        page.mouse.click(*place(page, -8.0, 8.0))
        page.wait_for_function("before => shoal.agents() === before + 1", arg=before)

    def test_a_target_can_be_dragged(self, open_page, address):
        page = open_page(address)
        pause(page)
        page.keyboard.press("2")
        page.mouse.move(*place(page, 0.0, 0.0))
        page.mouse.down()
        page.mouse.move(*place(page, 5.0, -4.0), steps=4)
        page.mouse.up()
        page.wait_for_function(
            """() => {
                const view = new DataView(shoal.frame());
                const begin = 84 + 20 * view.getUint32(8, true);
                const [x, y] = [view.getFloat32(begin, true), view.getFloat32(begin + 4, true)];
                return Math.hypot(x - 5, y + 4) < 0.2;
            }"""
        )

    def test_the_past_comes_back_to_the_byte(self, open_page, address):
        page = open_page(address)
        pause(page)
        step, shown = page.evaluate("shoal.step()"), page.evaluate(SHOWN)
        for _ in range(5):
            page.keyboard.press("ArrowRight")
        page.wait_for_function("step => shoal.step() === step", arg=step + 5)
        assert page.evaluate(SHOWN) != shown
        for _ in range(5):
            before = page.evaluate("shoal.step()")
            page.keyboard.press("ArrowLeft")
            page.wait_for_function("before => shoal.step() < before", arg=before)
        assert page.evaluate("shoal.step()") == step
        assert page.evaluate(SHOWN) == shown

    def test_the_past_cannot_be_changed_and_the_page_says_so(self, open_page, address):
        page = open_page(address)
        pause(page)
        page.keyboard.press("Home")
        page.get_by_text("This is the past.").wait_for()
        assert page.get_by_role("slider", name="Neighbors heard, k").is_disabled()
        page.keyboard.press("End")
        page.get_by_text("This is the past.").wait_for(state="hidden")

    def test_means_of_the_past_say_when_they_began(self, open_page, address):
        page = open_page(address)
        page.wait_for_function("() => shoal.step() > 0")
        pause(page)
        step = page.evaluate("shoal.step()")
        slide(page, "Neighbors heard, k", "ArrowLeft", 1)
        page.get_by_text(f"since step {step}").first.wait_for()
        page.get_by_role("slider", name="Step shown").fill("0")
        page.get_by_text("so far").first.wait_for()

    def test_charts_of_a_page_opened_late_begin_where_those_of_the_first_do(self, open_page, address):
        first = open_page(address)
        first.wait_for_function("() => shoal.step() >= 10")
        late = open_page(address)
        assert late.evaluate("shoal.charted()") == 0
        late.reload()
        late.wait_for_function("() => window.shoal && shoal.step() >= 10")
        assert late.evaluate("shoal.charted()") == 0

    def test_two_browsers_watch_the_same_run(self, open_page, address):
        one, two = open_page(address), open_page(address)
        pause(one)
        two.wait_for_function("() => !shoal.playing()")
        two.wait_for_function("step => shoal.step() === step", arg=one.evaluate("shoal.step()"))
        assert one.evaluate(SHOWN) == two.evaluate(SHOWN)
        play(two)
        one.wait_for_function("() => shoal.playing()")

    def test_a_malformed_message_is_refused_and_changes_nothing(self, open_page, address):
        page = open_page(address)
        answer = page.evaluate(
            """async () => {
                const socket = new WebSocket(`ws://${location.host}/live`);
                await new Promise((opened) => (socket.onopen = opened));
                socket.send('{"do": "steer"');
                return await new Promise((answered) => {
                    socket.onmessage = ({data}) => {
                        if (typeof data === "string" && data.includes('"error"')) answered(JSON.parse(data));
                    };
                });
            }"""
        )
        assert answer["type"] == "error"
        first = page.evaluate("shoal.step()")
        page.wait_for_function("step => shoal.step() > step", arg=first)

    def test_a_page_from_elsewhere_is_not_let_in(self, browser, address):
        with serving(page_app("<p>elsewhere</p>")) as elsewhere:
            context = browser.new_context()
            page = context.new_page()
            page.goto(elsewhere)
            opened = page.evaluate(
                """url => new Promise((done) => {
                    const socket = new WebSocket(url);
                    socket.onopen = () => done(true);
                    socket.onclose = () => done(false);
                })""",
                address.replace("http", "ws") + "live",
            )
            context.close()
        assert opened is False


class TestComparing:
    def test_two_runs_share_their_time_and_stand_side_by_side(self, open_page):
        other = read_table("oceans2020")
        other["network"]["neighbors"] = 5
        with serving_session(Session([read_table("oceans2020"), other])) as address:
            page = open_page(address)
            page.get_by_role("region", name="Run B").wait_for()
            left, right = (page.get_by_role("region", name=f"Run {run}").bounding_box() for run in "AB")
            assert left["y"] == right["y"]
            assert left["x"] + left["width"] <= right["x"]
            pause(page)
            page.wait_for_timeout(300)
            moments = page.locator(".moment").all_inner_texts()
            assert len({moment.split(" · ")[0] for moment in moments}) == 1
            assert page.get_by_text("A: k = 20 · B: k = 5").is_visible()


class TestALostEngine:
    def test_is_said_plainly_and_can_be_tried_again(self, browser):
        with serving_session(Session([read_table("oceans2020")])) as address:
            context = browser.new_context(viewport=DESK)
            page = context.new_page()
            page.goto(address)
            page.wait_for_function("() => window.shoal && shoal.step() >= 0")
        alert = page.get_by_role("alert")
        alert.get_by_text("Is shoal watch still running?").wait_for()
        assert not page.evaluate("shoal.playing()")
        alert.get_by_role("button", name="Try again").click()
        page.get_by_text("The engine does not answer.").wait_for()
        with serving_session(Session([read_table("oceans2020")]), port=int(address.rstrip("/").rpartition(":")[2])):
            alert.get_by_role("button", name="Try again").click()
            page.wait_for_function("() => shoal.playing()")
            assert not page.get_by_role("alert").is_visible()
            context.close()


class TestARecording:
    def test_can_be_changed_but_for_its_fleets_until_it_is_complete(self, open_page):
        with serving_session(Session([read_table("oceans2020")], limit=40)) as address:
            page = open_page(address)
            pause(page)
            assert page.get_by_role("slider", name="Fast buoys").is_disabled()
            slide(page, "Neighbors heard, k", "ArrowLeft", 1)
            page.get_by_text("1 change so far").wait_for()
            play(page)
            page.get_by_text("The record is complete").wait_for()
            assert page.get_by_role("slider", name="Target speed").is_disabled()
            assert page.get_by_role("button", name="Restart", exact=True).is_disabled()


class TestAFleet:
    @pytest.fixture
    def outlook(self):
        outlook = Outlook()
        outlook.hear(bulletin(frame=b"", busy="5 buoys start"))
        return outlook

    def test_says_that_its_buoys_start_and_then_who_is_there(self, browser, outlook):
        with serving(live_app(outlook)) as address:
            context = browser.new_context(viewport=DESK)
            page = context.new_page()
            page.goto(address)
            page.get_by_text("5 buoys start").wait_for()
            frame = replace(FRAMES, alive=FRAMES.alive & (np.arange(5) != 4))
            outlook.hear(bulletin(frame=pack(frame, 1, run=0, epoch=0, gauges=GAUGES, silent=[2])))
            roll = page.get_by_role("region", name="Fleet")
            roll.get_by_text("4 of 5").wait_for()
            assert roll.locator("dd").all_inner_texts() == ["4 of 5", "no. 4", "no. 2"]
            page.get_by_text("1 silent").wait_for()
            assert not page.get_by_text("5 buoys start").is_visible()
            context.close()

    def test_can_be_looked_back_through_and_not_changed(self, open_page, outlook):
        for at in range(3):
            outlook.hear(bulletin(at))
        with serving(live_app(outlook)) as address:
            page = open_page(address)
            for name in ("Neighbors heard, k", "Target speed", "Speed"):
                assert page.get_by_role("slider", name=name, exact=True).count() == 0
            assert page.get_by_role("button", name="Restart").count() == 0
            assert page.evaluate("shoal.charted()") == 0
            pause(page)
            page.keyboard.press("ArrowLeft")
            page.wait_for_function("() => shoal.step() === 10")
            page.keyboard.press("r")  # keys of what is not there do nothing
            page.keyboard.press("]")
            play(page)
            page.wait_for_function("() => shoal.step() === 20")
            outlook.end("the fleet is gone")
            page.get_by_text("the fleet is gone").wait_for()
            assert page.get_by_role("alert").is_hidden()


class TestAReplay:
    def test_opens_from_a_file_without_any_network(self, open_page, replay):
        page = open_page(replay.as_uri(), offline=True)
        asked = []
        page.on("request", lambda request: asked.append(request.url))
        play(page)
        page.wait_for_function("() => shoal.step() > 100")
        assert asked == []

    def test_shows_the_metrics_of_the_record(self, open_page, replay, record):
        page = open_page(replay.as_uri())
        rows = page.locator("#metrics tbody tr")
        assert rows.count() > 2
        for row in rows.all():
            words = f"{row.locator('.mean').inner_text()} {row.locator('.interval').inner_text()}".strip()
            assert words == estimate_text(record.estimate(row.get_attribute("data-metric")))

    def test_an_earlier_frame_comes_back_to_the_byte(self, open_page, replay):
        page = open_page(replay.as_uri())
        first = page.evaluate(SHOWN)
        page.keyboard.press("End")
        page.wait_for_function("() => shoal.step() === 990")
        assert page.evaluate(SHOWN) != first
        page.get_by_role("slider", name="Step shown").fill("0")
        page.wait_for_function("() => shoal.step() === 0")
        assert page.evaluate(SHOWN) == first

    def test_names_are_text_whatever_they_are(self, open_page, tmp_path):
        name = "<img src=x onerror=alert(1)>"
        file = tmp_path / "run.html"
        file.write_text(replay_page(simulate(scenario(changes={"steps": 20, "name": name}))), encoding="utf-8")
        page = open_page(file.as_uri())
        assert page.locator("#name").inner_text() == name
        assert page.locator("img").count() == 0


def test_frames_of_the_page_are_those_of_the_engine(open_page, replay, record):
    """Positions on the water are the record's, to single precision."""
    page = open_page(replay.as_uri())
    page.keyboard.press("End")
    page.wait_for_function("() => shoal.step() === 990")
    x = json.loads(page.evaluate("JSON.stringify(Array.from(new Float32Array(shoal.frame().slice(84, 84 + 200))))"))
    kept = next(iter(record.trajectories.values()))
    assert x == pytest.approx(list(kept.x[-1]), rel=1e-6)
