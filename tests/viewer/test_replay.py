"""Replay: a record as one page."""

import base64
import json
import re
from dataclasses import replace

import numpy as np
import pytest

from frames import decode_all
from scenarios import scenario
from shoal.core.errors import RecordError, ScenarioError
from shoal.run.simulate import simulate
from shoal.viewer.replay import choose_frames, replay_page


@pytest.fixture(scope="module")
def record():
    return simulate(scenario(changes={"steps": 4000}), every=2)


def frames_of(page):
    return decode_all(base64.b64decode(re.search(r'id="frames">([^<]*)<', page).group(1)))


def scene_of(page):
    return json.loads(re.search(r'id="scene">([^<]*)<', page).group(1))


class TestReplayPage:
    def test_2000_frames_of_50_agents_are_less_than_5_megabytes(self, record):
        page = replay_page(record)
        assert len(frames_of(page)) == 2000
        assert len(page.encode()) <= 5_000_000

    def test_the_real_page_loads_nothing_from_anywhere(self, record):
        page = re.sub(r'id="frames">[^<]*<', "", replay_page(record, frames=10))
        links = re.findall(r"""(?:src|href|action|poster|data-src)\s*=\s*["']?([^"'\s>]+)""", page)
        assert all(link.startswith(("data:", "#")) for link in links)
        assert set(re.findall(r"https?://[^\s\"'`)]+", page)) <= {"http://www.w3.org/2000/svg"}
        assert not re.search(r"@import|url\((?!['\"]?(?:data:|#))", page)

    def test_it_shows_no_more_frames_than_asked_for(self, small_page, record):
        frames = frames_of(replay_page(record, frames=50))
        assert len(frames) == 50
        assert (frames[0].step, frames[-1].step) == (0, 3998)

    def test_it_shows_fewer_where_they_would_be_too_large_to_open(self, small_page, record, monkeypatch):
        monkeypatch.setattr("shoal.viewer.replay.ROOM", 10 * (93 + 50 * 30) + 1)
        assert len(frames_of(replay_page(record))) == 10
        assert len(frames_of(replay_page(record, frames=3))) == 3

    def test_very_many_agents_are_dots_in_it(self, small_page, record, monkeypatch):
        monkeypatch.setattr("shoal.viewer.recorded.FULL", 49)
        frame = frames_of(replay_page(record, frames=1))[0]
        assert (len(frame.x), frame.vx) == (50, [])

    def test_a_hostile_name_stays_a_name(self, small_page):
        hostile = "</script><script>alert(1)"
        page = replay_page(simulate(scenario(changes={"steps": 20, "name": hostile})))
        assert scene_of(page)["name"] == hostile
        assert "<script>alert" not in page

    def test_a_record_without_frames_is_refused(self, small_page, record):
        empty = replace(record, trajectories={})
        with pytest.raises(RecordError, match="keeps no frames"):
            replay_page(empty)

    def test_no_frames_at_all_cannot_be_asked_for(self, small_page, record):
        with pytest.raises(ScenarioError, match="ask for 1 or more"):
            replay_page(record, frames=0)


class TestChooseFrames:
    def test_all_of_them_if_there_is_room(self):
        assert list(choose_frames(np.array([0, 10, 20, 21, 22]), 5, "all")) == [0, 1, 2, 3, 4]

    def test_evenly_in_time_where_steps_are_not_even(self):
        """An overview of every 100th step and 300 last steps: the last ones must not crowd out the rest."""
        steps = np.concatenate([np.arange(0, 10_000, 100), np.arange(10_000, 10_300)])
        chosen = steps[choose_frames(steps, 50, "all")]
        assert (chosen[0], chosen[-1]) == (0, 10_299)
        assert np.diff(chosen).max() <= 300
        assert np.count_nonzero(chosen >= 10_000) <= 4

    def test_the_end_is_as_long_as_every_step_was_kept(self):
        steps = np.concatenate([np.arange(0, 10_000, 100), np.arange(10_000, 10_300)])
        assert list(steps[choose_frames(steps, 2000, "end")]) == list(range(10_000, 10_300))
        assert list(steps[choose_frames(steps, 3, "end")]) == [10_297, 10_298, 10_299]
