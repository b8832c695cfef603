"""What neighbors exert in single precision: finite wherever agents are, and as in double where numbers are the same."""

import numpy as np
import pytest

from shoal.compiler.kernel import entry_kernel
from shoal.compiler.lanes import WIDTH, everywhere, narrow, put, take
from shoal.core.messages import Briefing, Own, Report, Truth
from shoal.scenario.crew import crew_of
from shoal.scenario.load import load
from shoal.strategies import CATALOGUE, asking

WITH_INFLUENCE = sorted(name for name, known in CATALOGUE.items() if known.builtin and known.influence)
AWAY = np.concatenate([[0.0], 10.0 ** np.linspace(-9, 6, 31)])
NEAR = (AWAY > 1e-2) & (AWAY < 1e4)


@entry_kernel
def influences(away, params, told, out):
    """What a speaker at the origin exerts on listeners `away` from it along x, (2, 2, L): in double, and in single."""
    briefing, truth = Briefing(0, 0.0, 0.0, 0.0, 0.0, 0.0, False, 0.0, 0.0), Truth(False, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    other = Report(0, 0.0, 0.0, 0.1, 0.2, False, told, 0.0, 0)
    for i in range(0, away.size, WIDTH):
        none = everywhere(0.0)
        x, one = take(away, i, none), none + 1.0
        me = Own(1, x, none, none, none, none > one, one, 0.1, 0.0, 0, briefing, truth, 0.0, 0.0, False)
        put(out[0], (0, i), asking.influence(me, other, params)[0] + none)
        short, short_one, short_x = narrow(none), narrow(one), narrow(x)
        me = Own(1, short_x, short, short, short, none > one, short_one, 0.1, 0.0, 0, briefing, truth, 0.0, 0.0, False)
        put(out[1], (0, i), asking.influence(me, other, params)[0] + short)


def in_both(name, **changes):
    crew = crew_of(load("oceans2020", strategy=name))
    out = np.full((2, 1, AWAY.size), np.nan)
    told = np.zeros(1, [(field, float) for field in crew.told or ("unused",)])[0]
    influences(AWAY, crew.params._replace(**changes), told, out)
    return out[:, 0]


@pytest.mark.parametrize("name", WITH_INFLUENCE)
def test_is_that_of_double_precision_rounded(name):
    double, single = in_both(name)
    assert np.isfinite(single).all()
    assert np.allclose(single[NEAR], double[NEAR], rtol=2e-5)


@pytest.mark.parametrize("exponent", [0.0, 1.5, 5.0, 30.0, 100.0])
def test_is_finite_under_any_exponent(exponent):
    double, single = in_both("knn-pso", repulsion_exponent=exponent)
    assert np.isfinite(single).all()
    held = NEAR & (double < 1e25) & (double > 1e-30)
    assert np.allclose(single[held], double[held], rtol=1e-3)
