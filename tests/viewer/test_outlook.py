"""What a page sees of a fleet: the newest, or what it went back to; it changes nothing."""

import json

import pytest

from bulletins import FRAMES, bulletin
from frames import decode
from shoal.viewer.outlook import Outlook
from shoal.viewer.requests import parse_request
from shoal.viewer.worker import Watcher


class Page:
    """A page that notes what it is told."""

    def __init__(self, outlook):
        self.outlook, self.changes, self.errors = outlook, 0, []
        self.watcher = Watcher(self._changed, self.errors.append)
        outlook.watch(self.watcher)

    def _changed(self):
        self.changes += 1

    def ask(self, do, **facts):
        self.outlook.ask(parse_request(json.dumps({"do": do, **facts})), self.watcher)

    @property
    def status(self):
        return json.loads(self.outlook.view.status)


@pytest.fixture
def page():
    """A page on a fleet of which three frames were heard, of steps 0, 10 and 20."""
    outlook = Outlook()
    page = Page(outlook)
    for at in range(len(FRAMES.step)):
        outlook.hear(bulletin(at))
    return page


def test_before_anything_is_heard_there_is_nothing_to_see():
    page = Page(Outlook())
    page.ask("step", steps=1)
    assert (page.outlook.view.kept.frames, page.status["step"], page.errors) == ((), 0, [])


def test_a_fleet_that_starts_has_a_scene_and_a_sentence():
    page = Page(Outlook())
    page.outlook.hear(bulletin(frame=b"", busy="5 buoys start"))
    assert json.loads(page.outlook.view.kept.scenes[0])["scene"]["fleets"]
    assert (page.status["busy"], page.outlook.view.kept.frames) == ("5 buoys start", ())


def test_the_newest_is_shown(page):
    assert page.changes == 3
    assert decode(page.outlook.view.kept.frames[0]).step == 20
    told = {"type": "status", "playing": True, "speed": 1.0, "busy": None}
    assert page.status == {**told, "step": 20, "first": 0, "last": 20, "at_end": True}


def test_what_is_told_again_is_no_news(page):
    page.outlook.hear(bulletin(2))
    page.outlook.hear(bulletin(1))
    assert (page.status["last"], json.loads(page.outlook.history()[0])["step"]) == (20, [0, 10, 20])


def test_its_charts_are_full_for_who_comes_late(page):
    (history,) = map(json.loads, page.outlook.history())
    assert (history["step"], history["xi"]) == ([0, 10, 20], [0.25] * 3)


def test_one_can_go_back_while_the_fleet_goes_on(page):
    page.ask("seek", step=12)
    assert (page.status["step"], page.status["playing"]) == (10, False)
    page.outlook.hear(bulletin(2))
    assert page.status["step"] == 10
    page.ask("step", steps=-1)
    assert page.status["step"] == 0
    page.ask("play")
    assert (page.status["step"], page.status["playing"]) == (20, True)


@pytest.mark.parametrize(
    ("do", "facts"),
    [("kill", {"agent": 1}), ("change", {"changes": {"neighbors": 3}}), ("restart", {}), ("speed", {"value": 2.0})],
)
def test_nothing_can_be_changed(page, do, facts):
    page.ask(do, **facts)
    assert page.errors[0].startswith("request: the buoys of a fleet decide by themselves\n  fix:")
    assert page.status["playing"]


def test_what_is_over_can_be_looked_back_through(page):
    page.outlook.end("the fleet is gone")
    page.ask("play")
    assert (page.status["busy"], page.status["playing"], page.status["step"]) == ("the fleet is gone", False, 20)
    page.ask("seek", step=0)
    assert page.status["step"] == 0


def test_who_left_is_told_nothing_more(page):
    page.outlook.leave(page.watcher)
    page.outlook.hear(bulletin(2))
    assert page.changes == 3
