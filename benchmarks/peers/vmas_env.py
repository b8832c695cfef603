"""Shoal's learning environment in VMAS, as a good user of it would write it: 50 agents, k = 8 reports, one target.

Work on all agents at once is done for the first of them and kept for the others: VMAS asks for one at a time. Actions
are velocities; there is no contact, no drag, and no action but that. Its target goes from waypoint to waypoint.
"""

from typing import Any

import torch
from vmas.simulator.core import Agent, Landmark, Sphere, World
from vmas.simulator.scenario import BaseScenario

AGENTS, K, HALF, FENCE, REACH = 50, 8, 10.0, 8.5, 1.0
TARGET_SPEED, WAYPOINTS, STEP = 3.0, 8.0, 0.1
FAST, SLOW = 2.6, 1.0  # m/s; 15 of the one, 35 of the other


class Swarm(BaseScenario):  # type: ignore[misc]
    """Search for a target and track it; reward: whether anybody is on it."""

    def make_world(self, batch_dim: int, device: Any, **kwargs: Any) -> Any:
        """50 agents without bodies, one target."""
        world = World(
            batch_dim, device, dt=STEP, drag=0.0, x_semidim=FENCE, y_semidim=FENCE, substeps=1, collision_force=0.0
        )
        for number in range(AGENTS):
            speed = FAST if number < 15 else SLOW
            world.add_agent(Agent(f"agent_{number}", shape=Sphere(0.1), collide=False, u_range=1.0, max_speed=speed))
        self.target = Landmark("target", shape=Sphere(REACH), collide=False, movable=False)
        world.add_landmark(self.target)
        self.speeds = torch.tensor([FAST] * 15 + [SLOW] * 35)
        return world

    def reset_world_at(self, env_index: int | None = None) -> None:
        """Everybody anywhere."""
        swarms = self.world.batch_dim if env_index is None else 1
        for agent in self.world.agents:
            agent.set_pos((2 * torch.rand(swarms, 2) - 1) * FENCE, env_index)
        self.target.set_pos((2 * torch.rand(swarms, 2) - 1) * WAYPOINTS, env_index)
        self.waypoint = (2 * torch.rand(self.world.batch_dim, 2) - 1) * WAYPOINTS

    def process_action(self, agent: Any) -> None:
        """The action is the velocity, as a share of the top speed."""
        agent.state.vel = agent.action.u * agent.max_speed
        agent.action.u = torch.zeros_like(agent.action.u)

    def pre_step(self) -> None:
        """Move the target on, and choose where it goes next once it is there."""
        way = self.waypoint - self.target.state.pos
        far = way.norm(dim=-1, keepdim=True)
        self.target.state.pos = self.target.state.pos + way / far.clamp(min=1e-6) * TARGET_SPEED * STEP
        new = (2 * torch.rand_like(self.waypoint) - 1) * WAYPOINTS
        self.waypoint = torch.where(far < 1.5, new, self.waypoint)

    def reward(self, agent: Any) -> Any:
        """1 if anybody is on target; everything of the step is worked out here, for the first agent."""
        if agent is self.world.agents[0]:
            self._look()
        return self.watched

    def _look(self) -> None:
        place = torch.stack([each.state.pos for each in self.world.agents], dim=1)
        velocity = torch.stack([each.state.vel for each in self.world.agents], dim=1)
        on = ((place - self.target.state.pos.unsqueeze(1)).square().sum(-1) <= REACH * REACH).float()
        self.watched = on.amax(dim=1)
        way = place.unsqueeze(2) - place.unsqueeze(1)
        square = way.square().sum(-1)
        square.diagonal(dim1=1, dim2=2).fill_(torch.inf)
        nearest = square.topk(K, dim=-1, largest=False).indices
        there = torch.gather(way, 2, nearest.unsqueeze(-1).expand(-1, -1, -1, 2))
        heard = torch.gather(on.unsqueeze(1).expand(-1, AGENTS, -1), 2, nearest)
        own = torch.cat([place, velocity, on.unsqueeze(-1)], dim=-1)
        self.seen = torch.cat([own, there.flatten(2), heard], dim=-1)

    def observation(self, agent: Any) -> Any:
        """What the agent is, and what its k nearest say."""
        if not hasattr(self, "seen"):
            self._look()
        return self.seen[:, int(agent.name.removeprefix("agent_"))]
