"""Agents that are told from outside, step by step, what to do: the example of the how-to."""

import re
from pathlib import Path

import numpy as np

PAGE = (Path(__file__).resolve().parents[2] / "docs/how-to/own-strategy.md").read_text(encoding="utf-8")


def test_a_puppet_does_as_it_is_told():
    (code,) = (each for each in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL) if "class Puppet" in each)
    scope = {"__name__": "puppets"}
    exec("from typing import NamedTuple\nimport shoal\n" + code, scope)
    simulation, agents = scope["simulation"], scope["agents"]
    assert np.hypot(simulation.swarm.x[:agents], simulation.swarm.y[:agents]).max() < 2.0  # all went to the center
    wishes = np.random.default_rng(1).uniform(-0.5, 0.5, (2, agents))
    with simulation.edit() as now:
        now.swarm.memory[:agents] = wishes.T
    simulation.advance(1)
    assert simulation.swarm.vx[:agents].tolist() == wishes[0].tolist()
    assert simulation.swarm.vy[:agents].tolist() == wishes[1].tolist()
