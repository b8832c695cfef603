"""A session: play, pause, seek, change; without threads or network."""

import json
import math

import pytest

from frames import decode
from scenarios import changed
from shoal.core.errors import ScenarioError
from shoal.run.simulation import Simulation
from shoal.scenario.load import read_table, scenario_from
from shoal.scenario.on_track import put_on_track
from shoal.viewer.requests import parse_request
from shoal.viewer.session import POINTS, Session
from track_files import eastward


def table(**changes):
    return changed(read_table("oceans2020"), changes)


def session(*tables, **options):
    return Session(tables or [table()], **options)


def ask(one, do, **what):
    one.obey(parse_request(json.dumps({"do": do, **what})))


def played(one, frames):
    for _ in range(frames):
        one.play_on()
    return one


def status(one):
    return json.loads(one.status())


def shown(one, run=0):
    return decode(one.shown.frames[run])


def bits(one, run=0):
    state = one.runs[run].simulation.state()
    return {name: part.tobytes() for name, part in state.items()}


class TestPlaying:
    def test_real_time_is_one_frame_per_step(self):
        one = session()
        assert one.play_on() == pytest.approx(0.1)
        assert (one.number, shown(one).step) == (1, 1)

    @pytest.mark.parametrize(("speed", "steps"), [(0.1, 1), (1, 1), (10, 4), (100, 40), (1000, 250)])
    def test_fast_runs_are_shown_25_to_50_times_a_second(self, speed, steps):
        one = session(speed=speed)
        lasts = one.play_on()
        assert one.number == steps
        assert lasts == pytest.approx(steps * 0.1 / speed)
        assert steps == 1 or 1 / 50 <= lasts <= 1 / 25

    def test_frames_lie_at_multiples_of_the_stride(self):
        one = played(session(), 3)
        ask(one, "speed", value=1000)
        one.play_on()
        assert one.number == 250

    def test_a_large_swarm_is_not_asked_for_more_than_it_can(self):
        fleets = [{"name": "many", "count": 4000, "max_speed": 1.0}]
        one = session(table(fleets=fleets), speed=1000)
        assert one.stride() == 1

    def test_watching_changes_no_bit(self):
        watched = played(session(speed=100), 10)
        unwatched = Simulation(scenario_from(table()))
        unwatched.advance(400)
        assert bits(watched) == {name: part.tobytes() for name, part in unwatched.state().items()}

    def test_pause_and_play(self):
        one = session()
        ask(one, "pause")
        assert not status(one)["playing"]
        ask(one, "play")
        assert status(one)["playing"]


class TestStepping:
    def test_it_runs_so_many_steps_and_pauses(self):
        one = played(session(), 2)
        ask(one, "step", steps=5)
        assert (one.number, shown(one).step, one.playing) == (7, 7, False)

    def test_among_older_frames_it_goes_from_frame_to_frame(self):
        one = played(session(speed=100), 5)
        ask(one, "seek", step=80)
        ask(one, "step")
        assert (shown(one).step, one.number) == (120, 200)
        ask(one, "step", steps=-2)
        assert shown(one).step == 40


class TestSeeking:
    def test_it_shows_the_same_bytes_again_and_pauses(self):
        one = session(speed=100)
        seen = {}
        for _ in range(10):
            one.play_on()
            seen[shown(one).step] = one.shown.frames
        for step, frames in seen.items():
            ask(one, "seek", step=step)
            assert one.shown.frames == frames
            assert not one.playing

    def test_the_run_stays_where_it_was(self):
        one = played(session(speed=100), 5)
        before = bits(one)
        ask(one, "seek", step=40)
        assert bits(one) == before
        told = status(one)
        assert (told["step"], told["first"], told["last"], told["at_end"]) == (40, 0, 200, False)

    def test_play_goes_on_from_the_newest(self):
        one = played(session(speed=100), 5)
        ask(one, "seek", step=40)
        ask(one, "play")
        assert (shown(one).step, status(one)["at_end"]) == (200, True)

    def test_an_older_frame_comes_with_the_scene_it_belongs_to(self):
        one = played(session(), 2)
        ask(one, "add", fleet=0, x=0.0, y=0.0)
        played(one, 1)
        ask(one, "seek", step=1)
        scene = json.loads(one.shown.scenes[0])["scene"]
        assert scene["epoch"] == shown(one).epoch == 0
        assert sum(fleet["count"] for fleet in scene["fleets"]) == len(shown(one).x) == 50

    def test_frames_are_forgotten_when_there_is_no_more_room(self):
        one = played(session(room=10_000), 50)
        kept = status(one)["last"] - status(one)["first"] + 1
        size = len(one.shown.frames[0]) + len(one.shown.numbers[0])
        assert kept == pytest.approx(10_000 / size, abs=1)
        ask(one, "seek", step=3)
        assert shown(one).step == status(one)["first"]


class TestChanging:
    def test_it_is_shown_at_once_though_paused(self):
        one = played(session(), 5)
        ask(one, "pause")
        ask(one, "change", changes={"neighbors": 5})
        assert (shown(one).degree[0], shown(one).step, one.playing) == (5, 5, False)
        ask(one, "drag", x=1.0, y=2.0)
        assert (shown(one).target_x[0], shown(one).target_y[0]) == (1.0, 2.0)

    def test_a_change_acts_on_the_newest_and_shows_it(self):
        one = played(session(), 5)
        ask(one, "seek", step=2)
        ask(one, "kill", agent=0)
        assert (shown(one).step, shown(one).alive[0]) == (5, False)

    def test_restart_forgets_the_frames(self):
        one = played(session(), 5)
        ask(one, "restart", seed=7)
        told = status(one)
        assert (told["first"], told["last"], told["step"]) == (0, 0, 0)
        assert json.loads(one.shown.scenes[0])["scene"]["seed"] == 7

    def test_a_refused_change_changes_nothing(self):
        one = played(session(), 5)
        before, kept = bits(one), one.shown
        with pytest.raises(ScenarioError, match="at most 49"):
            ask(one, "change", changes={"neighbors": 99})
        assert bits(one) == before
        assert one.shown is kept
        assert one.busy is None

    @pytest.mark.parametrize("request_", [{"do": "kill", "agent": 1}, {"do": "change", "changes": {"fast": 1}}])
    def test_there_is_no_second_run(self, request_):
        with pytest.raises(ScenarioError, match="from 0 to 0"):
            session().obey(parse_request(json.dumps({**request_, "run": 1})))

    def test_it_says_that_a_new_strategy_takes_a_while(self):
        one, told = session(), []
        one.on_busy = lambda: told.append(one.busy)
        ask(one, "change", changes={"neighbors": 5})
        assert told == []
        ask(one, "change", changes={"strategy": "random-walk"})
        assert told == ["loading strategy 'random-walk'; the very first time it is compiled, for some 10 s", None]
        ask(one, "change", changes={"strategy": "knn-pso"})
        ask(one, "change", changes={"strategy": "random-walk"})
        assert len(told) == 2


class TestSideBySide:
    def test_both_are_at_the_same_step_with_the_same_chance(self):
        one = session(table(), table(**{"network.neighbors": 5}))
        first, second = shown(one), shown(one, 1)
        assert (first.run, second.run) == (0, 1)
        assert first.x == second.x
        played(one, 30)
        assert shown(one).step == shown(one, 1).step == 30
        assert shown(one).x != shown(one, 1).x
        assert shown(one).target_x == shown(one, 1).target_x

    def test_a_change_is_of_one_of_them(self):
        one = session(table(), table())
        ask(one, "change", run=1, changes={"neighbors": 5})
        assert (shown(one).degree[0], shown(one, 1).degree[0]) == (20, 5)
        assert (shown(one).epoch, shown(one, 1).epoch) == (0, 1)

    def test_each_is_what_it_would_be_alone(self):
        both = played(session(table(), table(**{"network.neighbors": 5})), 20)
        assert bits(both, 1) == bits(played(session(table(**{"network.neighbors": 5})), 20))

    def test_steps_of_different_length_are_refused(self):
        with pytest.raises(ScenarioError, match="time_step"):
            session(table(), table(time_step=0.2))


class TestRecording:
    def test_it_ends_at_the_limit_and_stays_there(self):
        one = played(session(limit=10), 15)
        assert (one.number, one.done, one.playing) == (10, True, False)
        ask(one, "play")
        ask(one, "step")
        assert (one.number, one.playing) == (10, False)

    @pytest.mark.parametrize(
        "request_",
        [
            {"do": "change", "changes": {"fast": 20}},
            {"do": "change", "changes": {"strategy": "shared-sighting"}},
            {"do": "add", "x": 0.0, "y": 0.0},
        ],
    )
    def test_what_one_record_cannot_hold_is_refused(self, request_):
        one = session(limit=10)
        before = bits(one)
        with pytest.raises(ScenarioError, match="a record has one of each"):
            one.obey(parse_request(json.dumps(request_)))
        assert bits(one) == before
        assert one.steersman.log.entries == ()

    def test_all_else_can_be_changed_until_it_is_complete(self):
        one = played(session(limit=10), 4)
        ask(one, "change", changes={"neighbors": 5})
        ask(one, "kill", agent=3)
        ask(one, "drag", x=1.0, y=1.0)
        played(one, 10)
        assert [entry.step for entry in one.steersman.log.entries] == [4, 4, 4]
        with pytest.raises(ScenarioError, match="the record is complete"):
            ask(one, "restart")

    def test_it_can_be_sought(self):
        one = played(session(limit=10), 5)
        ask(one, "seek", step=2)
        assert shown(one).step == 2


class TestTracks:
    def test_time_stops_once_where_all_tracks_end_and_the_total_is_said(self, tmp_path):
        track = eastward(tmp_path, [11.0, 11.001], seconds_apart=600)
        followed = put_on_track(table(), str(track), None) | {"time_step": 10.0}
        one = session(followed, speed=1000)
        end = json.loads(one.runs[0].message)["scene"]["ends"]
        assert end == 61
        while one.playing:
            one.play_on()
        assert one.number == end
        assert not shown(one).present[0]
        assert status(one)["ended"].startswith("The recorded track ends here; time on target ")
        ask(one, "play")
        one.play_on()
        assert one.number > end

    def test_other_targets_have_no_end(self):
        one = played(session(speed=1000), 3)
        assert (json.loads(one.runs[0].message)["scene"]["ends"], one.ended) == (None, None)


class TestHistory:
    def test_it_says_what_the_frames_said(self):
        one = session(table(), table(**{"network.neighbors": 5}), speed=10)
        frames = [[shown(one, run) for run in (0, 1)]]
        for _ in range(20):
            one.play_on()
            frames.append([shown(one, run) for run in (0, 1)])
        histories = [json.loads(text) for text in one.history()]
        assert len(histories) == 2
        for run, told in enumerate(histories):
            assert (told["type"], told["run"]) == ("history", run)
            assert told["step"] == [each[run].step for each in frames]
            for name in ("time_on_target", "recent", "xi", "xi_now", "engaged"):
                said = [math.nan if value is None else value for value in told[name]]
                assert said == pytest.approx([getattr(each[run], name) for each in frames], nan_ok=True)
        assert told["time_on_target"][0] is None

    def test_it_is_short_however_long_the_run(self):
        one = played(session(), POINTS + 50)
        told = json.loads(one.history()[0])
        assert len(told["step"]) == POINTS
        assert (told["step"][0], told["step"][-1]) == (0, POINTS + 50)


class TestHello:
    def test_it_says_what_can_be_asked_for(self):
        told = json.loads(session(table(), table(), limit=5).hello())
        assert (told["type"], told["runs"], told["recording"]) == ("hello", 2, True)
        assert told["speeds"][0] == 1
        assert told["speeds"][-1] == 1000
        assert "knn-pso" in [each["name"] for each in told["strategies"]]


@pytest.mark.parametrize("speed", [0, 1e4])
def test_an_impossible_speed_is_refused(speed):
    with pytest.raises(ScenarioError, match="times real time"):
        session(speed=speed)


def test_time_stops_once_where_a_recorded_track_is_over(tmp_path):
    pytest.importorskip("pyproj", reason="pyproj is not installed")
    file = tmp_path / "track.csv"
    file.write_text("time,lat,lon\n2026-01-01T00:00:00Z,60,5\n2026-01-01T00:00:02Z,60.00001,5\n", encoding="utf-8")
    target = {"kind": "track", "file": str(file), "radius": 1.0}
    one = session(table(targets=[target], **{"area.origin": [5.0, 60.0]}), speed=1000)
    played(one, 1)
    assert (one.number, one.playing) == (21, False)  # 2 s, and the first step without it
    ask(one, "play")
    played(one, 1)
    assert one.playing
    assert one.number > 21
