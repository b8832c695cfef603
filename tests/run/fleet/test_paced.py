"""The sea by the clock: what befalls it before the first step is done is no error."""

from scenarios import small
from shoal.run.fleet.kills import Killing
from shoal.run.fleet.log import Log
from shoal.run.fleet.ocean import Ocean
from shoal.run.fleet.paced import PacedSea


class Nobody:
    """A crowd whose buoy 3 is gone when the first step is to begin, and whose others say nothing."""

    tied = ()

    def ask(self, tick):
        return [], [3]


def test_who_is_lost_in_step_0_is_lost_at_step_1():
    ocean = Ocean(small(5, 2, {"steps": 4}))
    log = Log(ocean)
    PacedSea(ocean, Nobody(), Killing(Nobody(), {}), log, 1e-3).run(lambda done, total: None)
    record = log.record([])
    assert [(loss.step, loss.agents) for loss in record.scenario.losses] == [(1, (3,))]
    assert record.trajectories[0].alive[:, 3].tolist() == [True, False, False, False]
    assert record.trajectories[0].alive[:, :3].all()
