"""What a log keeps of a fleet: the links that its buoys really used."""

import numpy as np
import pytest

from scenarios import scenario
from shoal.buoy.aboard import Aboard
from shoal.buoy.tether import BEGIN
from shoal.core.links import unpacked
from shoal.run.fleet.log import Log
from shoal.run.fleet.ocean import Ocean

RADIO = {"neighbors": 12, "range": 7.0, "loss": 0.2, "delay": 2}
EVERYBODY = np.arange(50, dtype=np.int32)


@pytest.mark.parametrize("network", [{}, RADIO], ids=["ideal", "poor"])
def test_what_buoys_say_they_heard_is_what_the_engine_let_them_hear(network):
    chosen = scenario("oceans2020", {f"network.{name}": value for name, value in network.items()})
    ocean, aboard = Ocean(chosen), Aboard(chosen, range(50))
    aboard.begin(ocean.tick(BEGIN))
    for _ in range(8):
        tick = ocean.tick()
        aboard.hear(aboard.speak(tick), tick.step)
        said = aboard.act(tick)
        assert np.array_equal(aboard.links(said.ids), unpacked(ocean.simulation.look().links[0]))
        ocean.obey(said.ids, said.wants)
        ocean.advance()


def test_who_says_nothing_in_a_step_heard_nobody_in_it():
    chosen = scenario("oceans2020", {"steps": 2})
    ocean, seen = Ocean(chosen), []
    log = Log(ocean, onlooker=lambda simulation, frame, silent: seen.append(unpacked(frame.links[0])))
    heard = np.random.default_rng(1).random((50, 50)) < 0.5
    for speakers in (EVERYBODY, EVERYBODY[:7]):
        log.hear(speakers, heard[speakers])
        log.keep(ocean.advance())
    kept = [unpacked(links) for links in log.record([]).trajectories[0].links]
    assert np.array_equal(kept, seen)
    assert np.array_equal(kept[0], heard)
    assert np.array_equal(kept[1][:7], heard[:7])
    assert not kept[1][7:].any()


def test_where_buoys_do_not_say_it_links_are_the_sea_s():
    ocean = Ocean(scenario("oceans2020", {"steps": 1}))
    log = Log(ocean)
    log.hear(EVERYBODY, None)
    log.keep(frame := ocean.advance())
    assert np.array_equal(log.record([]).trajectories[0].links, frame.links)
