"""Whose reports agents have, worked out the long way: a search over the links of a step, and a list of all heard."""

import math

import numpy as np

import replay

LOSS = 1 << 33  # the stream of keys that losses draw from


def searched(direct, most):
    """hops[j][i]: over how many links at most `most` the report of j reaches i, 0 for itself and for none."""
    agents = len(direct)
    found = [[0] * agents for _ in range(agents)]
    for j in range(agents):
        front, seen = [j], {j}
        for hop in range(1, most + 1):
            front = [i for i in range(agents) if i not in seen and any(direct[by][i] for by in front)]
            seen |= set(front)
            for i in front:
                found[j][i] = hop
    return found


class Hearsay:
    """Goes through the frames of a run of a scenario, step by step, and keeps every report that anybody ever heard."""

    def __init__(self, chosen, frames, run=0):
        self.chosen, self.frames, self.run = chosen, frames, run
        self.heard = [[[] for _ in range(chosen.agents)] for _ in range(chosen.agents)]  # [listener][speaker]: steps

    def spoken(self, step):
        """The last step of which reports can have arrived."""
        arrived = step - self.chosen.network.delay
        return arrived - arrived % self.chosen.report_steps

    def direct(self, step):
        """direct[j][i]: the report of j that arrives now reaches i by itself."""
        network, frames, agents, then = self.chosen.network, self.frames, self.chosen.agents, self.spoken(step)
        links = [[False] * agents for _ in range(agents)]
        if then < 0:
            return links
        key = replay.split(replay.split(replay.split(self.chosen.seed, 0), self.run), then + network.delay)
        for j in range(agents):
            for i in range(agents):
                dx, dy = frames.x[step, i] - frames.x[then, j], frames.y[step, i] - frames.y[then, j]
                near = dx * dx + dy * dy <= (network.range or math.inf) ** 2
                there = i != j and frames.alive[then, j] and frames.alive[step, i]
                lost = network.loss > 0 and replay.uniform(replay.split(key, LOSS + j), i) < network.loss
                links[j][i] = bool(there and near and not lost)
        return links

    def step(self, step):
        """(N, N) whether listener i (row) goes by a report of j in a step; to be called for all steps in order."""
        network, frames, agents, then = self.chosen.network, self.frames, self.chosen.agents, self.spoken(step)
        hops = searched(self.direct(step), network.hops)
        links = np.zeros((agents, agents), bool)
        for i in range(agents):
            has = []
            for j in range(agents):
                if hops[j][i]:
                    self.heard[i][j].append(then)
                fresh = [said for said in self.heard[i][j] if said >= then - network.max_age]
                if fresh and frames.alive[step, i]:
                    dx = frames.x[step, i] - frames.x[max(fresh), j]
                    dy = frames.y[step, i] - frames.y[max(fresh), j]
                    has.append((dx * dx + dy * dy, j))
            links[i, [j for _, j in sorted(has)[: frames.neighbors[step, i]]]] = True
        return links
