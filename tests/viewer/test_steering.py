"""What a person steers, looks into and saves, in a real browser: and what is saved makes the same bits again."""

import csv
import json
import time
import tomllib
import xml.etree.ElementTree as ET

import pytest

from browsing import first_living_agent, pause, place, play, slide
from scenarios import scenario
from shoal.run.change_log import read_log
from shoal.run.simulate import simulate
from shoal.scenario.load import load, read_table

pytest.importorskip("starlette", reason="the viewer's libraries are not installed")
pytest.importorskip("playwright.sync_api", reason="playwright is not installed")

from shoal.viewer.replay import replay_page
from shoal.viewer.server import serving_session
from shoal.viewer.session import Session


def saved(page, button, folder):
    """The file that a button of the page saves."""
    with page.expect_download() as download:
        page.get_by_role("button", name=button, exact=True).click()
    file = folder / download.value.suggested_filename
    download.value.save_as(file)
    return file


def steer(session, page, act):
    """Do what changes the run, and wait until it has."""
    before, begun = session.steersman.changes, time.monotonic()
    act()
    while session.steersman.changes == before:
        assert time.monotonic() - begun < 120.0
        page.wait_for_timeout(20)


def bits(session):
    return {name: part.tobytes() for name, part in session.runs[0].simulation.state().items()}


def test_what_is_steered_in_a_browser_is_made_again_to_the_bit(open_page, tmp_path):
    session = Session([read_table("oceans2020")], names=["oceans2020"], speed=20)
    with serving_session(session) as address:
        page = open_page(address)
        pause(page)
        steer(session, page, lambda: slide(page, "Neighbors heard, k", "ArrowLeft", 3))
        steer(session, page, lambda: slide(page, "Target speed", "ArrowRight", 1))
        play(page)
        page.wait_for_function("() => shoal.step() > 40")
        pause(page)
        page.keyboard.press("3")
        steer(session, page, lambda: page.mouse.click(*first_living_agent(page)))
        for strategy in ("lattice", "knn-pso"):
            steer(session, page, lambda: page.locator("#strategy").select_option(strategy))  # noqa: B023
        page.locator("summary", has_text="Parameters").click()
        page.get_by_label("delta").fill("0.03")
        steer(session, page, lambda: page.keyboard.press("Enter"))
        page.get_by_label("Seed").fill("9")
        steer(session, page, lambda: page.keyboard.press("Enter"))
        page.locator("label", has_text="Move target").click()
        steer(session, page, lambda: page.mouse.click(*place(page, 5.0, -4.0)))
        play(page)
        page.wait_for_function("() => shoal.step() > 60")
        pause(page)
        log, table = saved(page, "Changes", tmp_path), saved(page, "Scenario", tmp_path)
    assert load(table) == session.runs[0].simulation.scenario
    assert tomllib.loads(table.read_text(encoding="utf-8"))["seed"] == 9
    script = read_log(log)
    assert {each.steering.do for each in script.entries} == {"change", "kill", "restart", "drag"}
    again = Session([each.table for each in script.runs], script=script, speed=1000)
    for _ in range(1000):
        if again.playing:
            again.play_on()
    assert again.number == session.number == script.step
    assert bits(again) == bits(session)


def test_the_water_and_the_numbers_are_saved_as_they_are(open_page, address, tmp_path):
    page = open_page(address)
    page.wait_for_function("() => shoal.step() > 5")
    pause(page)
    step = page.evaluate("shoal.step()")
    assert saved(page, "PNG", tmp_path).read_bytes().startswith(b"\x89PNG")
    drawing = ET.parse(saved(page, "SVG", tmp_path)).getroot()
    words = {each.text for each in drawing.iter("{http://www.w3.org/2000/svg}text")}
    assert {"east [m]", "north [m]"} <= words
    assert len(list(drawing.iter("{http://www.w3.org/2000/svg}path"))) > 10
    with saved(page, "CSV", tmp_path).open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert int(rows[-1]["step"]) == step
    assert float(rows[-1]["time [s]"]) == pytest.approx(step * 0.1)
    assert {"time_on_target [share]", "losses [1/h]", "speed [m/s]"} <= set(rows[-1])


def test_a_buoy_is_found_pinned_followed_and_measured_from(open_page, address):
    page = open_page(address)
    pause(page)
    page.keyboard.press("i")
    page.keyboard.type("44")
    page.get_by_role("button", name="no. 44, BoB-0").wait_for()
    page.keyboard.press("Enter")
    panel = page.get_by_role("region", name="Buoys")
    panel.get_by_role("heading", name="BoB-0 no. 44").wait_for()
    facts = dict(zip(panel.locator("dt").all_inner_texts(), panel.locator("dd").all_inner_texts(), strict=True))
    assert facts["Strategy"] == "knn-pso"
    assert facts["Spacing a_R"].endswith(" m")
    assert facts["Hears"] == "20 of k = 20"
    page.mouse.move(5, 5)
    assert panel.get_by_role("heading", name="BoB-0 no. 44").is_visible()  # it stays
    middle = page.evaluate("shoal.place(0, 0)")
    panel.get_by_role("button", name="Follow").click()
    page.wait_for_function("before => shoal.place(0, 0)[0] !== before[0]", arg=middle)
    panel.get_by_role("button", name="Let go").click()
    page.mouse.click(*first_living_agent(page))
    panel.get_by_role("heading", name="no. 0").wait_for()
    page.keyboard.press("e")
    assert panel.get_by_role("button", name="Measure").get_attribute("aria-pressed") == "true"
    page.mouse.move(*place(page, 0.0, 0.0))
    page.mouse.down()
    page.mouse.move(*place(page, 5.0, 0.0), steps=2)
    page.mouse.up()
    assert page.evaluate("shoal.measured()").startswith("5")
    assert page.evaluate("shoal.measured()").endswith("m · 090°")


def test_charts_show_what_is_chosen_by_keyboard_with_values_and_zoom(open_page, address):
    page = open_page(address)
    page.get_by_role("slider", name="Speed", exact=True).fill("5")
    page.wait_for_function("() => shoal.step() > 600")
    pause(page)
    choice = page.get_by_role("combobox", name="Metric of chart 3")
    choice.focus()
    page.keyboard.type("Clust")
    card = page.locator(".numbers .card").nth(2)
    page.wait_for_function("() => document.querySelectorAll('select.metric')[2].value === 'clustering'")
    assert float(card.locator(".value").inner_text().split()[0]) > 0.1
    chart = card.get_by_role("group")
    chart.focus()
    page.keyboard.press("ArrowLeft")
    keys = page.locator(".key")
    keys.first.get_by_text("at step").wait_for()  # of all charts, not only of this
    assert len({text[text.index("at step") :] for text in keys.all_inner_texts()}) == 1
    page.keyboard.press("+")
    whole = page.get_by_role("button", name="Show whole run")
    whole.wait_for()
    page.keyboard.press("Escape")
    whole.wait_for(state="hidden")
    page.get_by_label("Over time, not steps").check()
    page.wait_for_function("() => document.querySelector('.plot').getAttribute('aria-label').includes('time [')")


def test_a_link_leads_to_a_step_of_a_replay_whose_curve_ends_there(open_page, tmp_path):
    file = tmp_path / "run.html"
    file.write_text(replay_page(simulate(scenario(changes={"steps": 400}), every=10)), encoding="utf-8")
    page = open_page(f"{file.as_uri()}#step=200")
    assert page.evaluate("shoal.step()") == 200
    assert json.loads(page.evaluate("JSON.stringify(shoal.lines(0))")) == {"so far": 200, "batches, whole run": 390}
    page.get_by_role("button", name="One step forward").click()
    page.get_by_role("button", name="Link to this step").click()
    page.wait_for_function("() => location.hash === '#step=210'")
