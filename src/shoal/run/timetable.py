"""The commands of a run: when they come, and what agents go by from then on."""

from shoal.scenario.commands import Command
from shoal.scenario.instructions import Instructions
from shoal.scenario.schema import Scenario


class Timetable:
    """The commands that are still to come, in the order of their steps.

    Parameters
    ----------
    scenario : that they are in

    Attributes
    ----------
    instructions : what agents go by now; None as long as that is the scenario itself
    """

    def __init__(self, scenario: Scenario) -> None:
        self._scenario = scenario
        self._coming = sorted(scenario.commands, key=lambda command: command.step)
        self.instructions: Instructions | None = None

    def add(self, command: Command) -> None:
        """Let another command come, after those of its step."""
        self._coming = sorted([*self._coming, command], key=lambda each: each.step)

    def stops(self, first: int, last: int) -> list[int]:
        """Where a run from step `first` to `last` must stop, `last` included."""
        return sorted({last, *(command.step for command in self._coming if first < command.step < last)})

    def due(self, number: int) -> list[Command]:
        """The commands that are obeyed from step `number` on; they come no more."""
        due = [command for command in self._coming if command.step <= number]
        self._coming = self._coming[len(due) :]
        for command in due:
            if command.set:
                self.instructions = (self.instructions or Instructions.of(self._scenario)).after(command)
        return due
