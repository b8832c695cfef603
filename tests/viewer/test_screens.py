"""The page on every screen, by keyboard and by touch."""

import pytest

from browsing import DESK, PHONE, first_living_agent, pause

pytest.importorskip("starlette", reason="the viewer's libraries are not installed")
pytest.importorskip("playwright.sync_api", reason="playwright is not installed")


class TestEveryScreen:
    @pytest.mark.parametrize("viewport", [DESK, PHONE], ids=["desk", "phone"])
    @pytest.mark.parametrize("scheme", ["light", "dark"])
    def test_nothing_sticks_out_sideways(self, open_page, address, viewport, scheme):
        page = open_page(address, viewport, color_scheme=scheme)
        page.get_by_role("slider", name="Target speed").wait_for()
        assert page.evaluate("document.documentElement.scrollWidth") == viewport["width"]

    def test_every_control_has_a_name(self, open_page, address):
        page = open_page(address)
        page.locator("summary").click()
        controls = page.locator("button:visible, input:visible, select:visible, canvas:visible")
        assert controls.count() > 20
        nameless = controls.evaluate_all(
            """all => all.filter((each) => !(each.getAttribute("aria-label") || each.innerText ||
                [...(each.labels ?? [])].some((label) => label.innerText))).map((each) => each.outerHTML)"""
        )
        assert nameless == []

    def test_the_dark_page_can_be_made_light(self, open_page, address):
        page = open_page(address, color_scheme="dark")
        dark = page.evaluate("getComputedStyle(document.body).backgroundColor")
        page.keyboard.press("d")
        assert page.evaluate("getComputedStyle(document.body).backgroundColor") != dark

    def test_the_keys_are_listed_on_the_page(self, open_page, address):
        page = open_page(address)
        page.keyboard.press("?")
        page.get_by_role("dialog").get_by_text("play, pause").wait_for()
        page.keyboard.press("Escape")
        page.get_by_role("dialog").wait_for(state="hidden")

    def test_touch_removes_a_buoy_too(self, open_page, address):
        page = open_page(address, PHONE, has_touch=True)
        pause(page)
        before = page.evaluate("shoal.agents()")
        page.locator("label", has_text="Remove").tap()
        page.evaluate("scrollTo(0, 0)")
        page.touchscreen.tap(*first_living_agent(page))
        page.wait_for_function("before => shoal.agents() === before - 1", arg=before)


class TestKeyboard:
    """Fields take text (WCAG 2.1.1, 2.1.2); test_access.py goes through all controls."""

    def test_a_field_takes_what_is_typed_and_lets_tab_go(self, address, open_page):
        page = open_page(address)
        pause(page)
        step = page.evaluate("shoal.step()")
        seed = page.locator("#seed")
        seed.click()
        for keys, value in (("Control+a", "1"), ("4", "4"), ("2", "42"), ("ArrowUp", "43"), ("Backspace", "4")):
            page.keyboard.press(keys)
            assert seed.input_value() == value
        assert page.evaluate("shoal.step()") == step  # digits and arrows are the field's, not the page's
        page.keyboard.press("Tab")
        assert not seed.evaluate("field => field === document.activeElement")
        page.keyboard.press("Shift+Tab")
        assert seed.evaluate("field => field === document.activeElement")
        page.keyboard.press("Enter")
        page.wait_for_function("() => document.getElementById('about').innerText.includes('seed 4')")

    def test_every_number_field_does(self, address, open_page):
        page = open_page(address)
        pause(page)
        page.locator("summary", has_text="Parameters").click()
        fields = page.locator("input[type=number]:visible")
        assert fields.count() > 5
        for number in range(fields.count()):
            field = fields.nth(number)
            field.focus()
            page.keyboard.press("Control+a")
            page.keyboard.type("1")
            assert field.input_value() == "1"
