"""Which strategies a scenario's fleets follow, as the engine takes them: one, or a team of several."""

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from shoal.core.errors import ScenarioError
from shoal.scenario.schema import Scenario
from shoal.scenario.strategy_choice import StrategyChoice
from shoal.strategies import Strategy
from shoal.strategies.compiled import compiled_for, made_of
from shoal.strategies.errors import strategy_errors
from shoal.strategies.puppet import PUPPET
from shoal.strategies.team import MOST, depth_of, team

_NO_ERRORS = nullcontext()


@dataclass(frozen=True)
class Crew:
    """What runs.

    Attributes
    ----------
    strategies : of each fleet
    params : NamedTuple for the kernels; its class decides whose functions run
    memory : names of all remembered fields, those that are told first
    told : names of those
    """

    strategies: tuple[Strategy, ...]
    params: Any
    memory: tuple[str, ...]
    told: tuple[str, ...]

    @cached_property
    def builtin(self) -> bool:
        """Whether all of it comes with Shoal."""
        return all(each.builtin for each in self.strategies)

    @cached_property
    def made_of(self) -> str | None:
        """What names its compiled code beside the strategies: empty if all are ours, None if it cannot be kept."""
        return made_of(self.strategies)

    @property
    def sums(self) -> int:
        """How many rows of sums the engine keeps."""
        return max(2, *(len(each.sums._fields) for each in self.strategies))

    @property
    def ranked(self) -> bool:
        """Whether ranks are worked out."""
        return any(each.ranked for each in self.strategies)

    @property
    def name(self) -> str:
        """Names of the strategies, each once."""
        return "+".join(dict.fromkeys(each.name for each in self.strategies))

    @property
    def source(self) -> str:
        """File of the first strategy that a user wrote, or else of the first."""
        return next((each for each in self.strategies if not each.builtin), self.strategies[0]).source

    def compiled(self, *entries: Callable[..., Any]) -> tuple[Callable[..., Any], ...]:
        """Entry kernels of the engine, or of a buoy, for these strategies."""
        return compiled_for(self.strategies, *entries)

    def puppets(self) -> "Crew":
        """The same agents by name, wanting what somebody outside writes into their memory: want_x, want_y [m/s]."""
        hands = tuple(
            replace(PUPPET, name=each.name, hears_all=each.hears_all, source=each.source) for each in self.strategies
        )
        return Crew(strategies=hands, params=PUPPET.params(), memory=tuple(PUPPET.memory), told=())

    def naming_errors(self) -> AbstractContextManager[None]:
        """A context in which what a user's strategy gets wrong becomes one StrategyError that names its line."""
        return _NO_ERRORS if self.builtin else strategy_errors(self.strategies)


def crew_of(scenario: Scenario) -> Crew:
    """Return the strategies of a scenario's fleets; fleets without one of their own follow the scenario's."""
    choices = [fleet.strategy or scenario.strategy for fleet in scenario.fleets]
    owners = tuple(choice.owner for choice in choices)
    told = tuple(dict.fromkeys(field for owner in owners for field in owner.told))
    rest = [field for owner in owners for field in owner.memory]
    return Crew(
        strategies=owners,
        params=crew_params(choices, scenario.counts),
        memory=tuple(dict.fromkeys([*told, *rest])),
        told=told,
    )


def crew_params(choices: list[StrategyChoice], counts: list[int]) -> Any:
    """Parameters of one strategy if all follow it alike, of nested teams if not: what `counts` agents each choose.

    Raises
    ------
    ScenarioError : too many teams
    """
    params = choices[-1].kernel_params()
    until = sum(counts)
    for fleet in range(len(choices) - 2, -1, -1):
        until -= counts[fleet + 1]
        if not all(choice == choices[fleet] for choice in choices[fleet + 1 :]):
            if depth_of(params) == MOST:
                raise ScenarioError(
                    "fleets.strategy",
                    f"changes more than {MOST - 1} times from fleet to fleet",
                    "use fewer strategies, or put fleets that share one next to each other at the end",
                )
            params = team(choices[fleet].kernel_params(), params, until)
    return params
