"""An error says where, what, and how to fix it, and survives the way home from a worker."""

import pickle

import pytest

from shoal.core.errors import (
    MissingExtraError,
    RecordError,
    ScenarioError,
    ShoalError,
    StrategyError,
    TrackError,
)


class TestShoalError:
    """Three parts, one text."""

    def test_reads_as_where_what_and_fix(self):
        assert str(ScenarioError("a.toml:3 seed", "is -1", "give 0 or more")) == (
            "a.toml:3 seed: is -1\n  fix: give 0 or more"
        )

    @pytest.mark.parametrize("kind", [MissingExtraError, RecordError, ScenarioError, StrategyError, TrackError])
    def test_every_kind_is_a_value_error_that_can_be_pickled(self, kind):
        error = pickle.loads(pickle.dumps(kind("here", "what", "how")))
        assert isinstance(error, (ShoalError, ValueError))
        assert (type(error), error.args) == (kind, ("here", "what", "how"))

    def test_a_missing_extra_names_the_command_that_installs_it(self):
        error = MissingExtraError.of("pyproj", "maritime", "projecting a track")
        assert error.args[2] == "pip install '.[maritime]', in your clone of Shoal"
