"""What each built-in strategy costs per agent-step, beside the paper's; all take turns, round after round.

    python benchmarks/bench_strategies.py

Ratios count: machines differ and are shared. Nothing here passes or fails.
"""

from bench_engine import AGENTS, ROUNDS, SHORT_TURN, engine_turn, load, machine, scenario, shown, take_turns

from shoal.strategies import CATALOGUE

PAPER = "knn-pso"
K = 20
MOST = 3.0  # times the paper's: what costs more is marked


def main() -> None:
    """Measure and print, the cheapest first."""
    best = take_turns(
        {(name, K): engine_turn(scenario("oceans2020", K, {"name": name}), SHORT_TURN) for name in CATALOGUE}
    )
    paper = best[PAPER, K]
    print(f"ns per agent-step of one core: N = {AGENTS}, k = {K}, f64, metrics on, the fastest of {ROUNDS} rounds\n")
    print(f"{'':22}{'ns':>8}{'x paper':>10}")
    for (name, _), cost in sorted(best.items(), key=lambda each: each[1]):
        print(f"{name:22}{shown(cost):>8}{shown(cost / paper):>10}{'  more than 3 x' if cost > MOST * paper else ''}")
    print(f"\n{machine()}; load {load()}")


if __name__ == "__main__":
    main()
