"""What a design says, in sentences, the same in a terminal, a notebook and on the page for who buys."""

from collections.abc import Iterator, Sequence
from typing import Literal

import numpy as np

from shoal.experiments.exchange_rate import ExchangeRate
from shoal.experiments.fleet_front import Alternative, FleetFront
from shoal.experiments.front import Spread
from shoal.metrics.summary import METRICS
from shoal.record.names import label_of
from shoal.record.words import UNKNOWN, told


def sentences(result: FleetFront) -> list[str]:
    """Return what the fleets that were run again, the exchange rates and the searches say."""
    failed = [each.reason for several in result.tried.values() for each in several if each.reason]
    return [
        *buying(result),
        _dominated(result),
        searches(result),
        *([f"{len(failed)} trials could not run or failed, the first: {failed[0]}"] if failed else []),
    ]


def buying(result: FleetFront) -> list[str]:
    """Return what matters to whoever buys: the present fleet, what there is for its cost, exchange rates."""
    return [_present(result), *_instead(result), *exchange(result), *_at_the_most(result)]


def exchange(result: FleetFront) -> Iterator[str]:
    """What one agent of a fleet is worth of the cheapest one, and which of the two is the better buy."""
    names, costs = names_of(result), result.costs
    base = names[result.base]
    for fleet in result.free:
        if fleet == result.base:
            continue
        rate = next((each for each in result.rates if each.fleet == fleet), None)
        if rate is None:
            yield f"What was tried does not tell how many {base} one {names[fleet]} is worth."
            continue
        price, cheap = costs[fleet], costs[result.base]
        interval = f"[{_short(rate.low)}, {_short(rate.high)}]"
        told = f"One {names[fleet]} is worth {_short(rate.worth)} {interval} {base} here"
        if not price or not cheap:
            yield f"{told}."
            continue
        ratio = price / cheap
        yield f"{told} and costs {_short(ratio)} times as much: {_buy(rate, ratio, names[fleet], base)}."


def _at_the_most(result: FleetFront) -> Iterator[str]:
    """Fleets of which much of the front has as many as were allowed: it would go on elsewhere if there were more."""
    names = names_of(result)
    for allowed in result.search.fleets:
        place = names.index(allowed.name)
        full = sum(each.counts[place] == allowed.most for each in result.front)
        if not allowed.fixed and full * 3 >= len(result.front) and full > 1:
            yield (
                f"{full} of the {len(result.front)} fleets of the front have {allowed.most} {allowed.name}, the most "
                "that were allowed: with more of them the front would be another one."
            )


def simulated(result: FleetFront) -> str:
    """What was simulated: kinds of agents and their prices, what they do, whom they hear, and what was counted."""
    search, costs = result.search, result.costs
    kinds = ", ".join(
        f"{each.name} of {each.max_speed:.3g} m/s" + (f" at {amount(cost)} each" if cost else "")
        for each, cost in zip(search.scenario.fleets, costs, strict=True)
    )
    strategies = dict.fromkeys((each.strategy or search.scenario.strategy).name for each in search.scenario.fleets)
    k = f", each hears the {search.scenario.network.neighbors} nearest"
    looked_for = "neighbors" in [each.field for each in search.variables]
    goals = "; ".join(
        f"{label_of(each.metric)}: {METRICS[each.metric].sentence}" for each in (search.more, search.less)
    )
    return f"{kinds}. They follow the strategy {' and '.join(strategies)}{'' if looked_for else k}. {goals}."


def names_of(result: FleetFront) -> list[str]:
    """Names of the scenario's fleets."""
    return [each.name for each in result.search.scenario.fleets]


def fleet_text(counts: Sequence[int], names: Sequence[str] = ()) -> str:
    """A fleet in short, "15 + 35"; with names, "15 BoB-1 + 35 BoB-0"."""
    if not names:
        return " + ".join(map(str, counts))
    return " + ".join(f"{count} {name}" for count, name in zip(counts, names, strict=True) if count) or "nothing"


def shortened(result: FleetFront, rows: int) -> list[Alternative]:
    """Return the front, or so many of it that lie evenly over what is gained, and the present fleet."""
    front = result.front
    if len(front) > rows:
        wanted = np.linspace(front[0].more.mean, front[-1].more.mean, rows)
        places = {int(np.argmin([abs(each.more.mean - value) for each in front])) for value in wanted}
        front = [front[at] for at in sorted(places)]
    return [each for each in result.alternatives if each.present or any(each is one for one in front)]


def standing(each: Alternative) -> Literal["front", "behind", "beaten"]:
    """Where a fleet stands."""
    return "front" if each.on_front else "behind" if each.beaten_by is None else "beaten"


def amount(value: float) -> str:
    """A cost: whole where it is."""
    return f"{value:,.0f}" if float(value).is_integer() else f"{value:,.4g}"


def spread(value: Spread, *, exact: bool = False) -> str:
    """A mean and its interval; `exact`: a number without one is a cost."""
    if not np.isfinite(value.mean):
        return UNKNOWN
    if exact and value.low == value.high:
        return amount(value.mean)
    return told(value.mean, value.low, value.high)


def _dominated(result: FleetFront) -> str:
    others = [each for each in result.alternatives if not each.on_front]
    sure = sum(each.beaten_by is not None for each in others)
    return (
        f"{len(result.alternatives)} fleets were run again: {len(result.front)} are on the front, {sure} are dominated "
        f"for sure (beyond both intervals), {len(others) - sure} are behind it by their means only."
    )


def _present(result: FleetFront) -> str:
    present, names = result.present, names_of(result)
    told = f"The scenario's own fleet, {_told(present, names)}, "
    if present.on_front:
        return f"{told}is on the front."
    if present.beaten_by is None:
        return f"{told}is behind the front by its mean; no fleet that was run again dominates it for sure."
    better = result.alternatives[present.beaten_by]
    return f"{told}is dominated for sure, by {_told(better, names)}."


def _instead(result: FleetFront) -> Iterator[str]:
    """The best of the front that costs no more than the present fleet, and the cheapest that is worth no less."""
    present, names = result.present, names_of(result)
    if present.on_front or not np.isfinite([present.less.mean, present.more.mean]).all():
        return
    best = [each for each in result.front if each.less.mean <= present.less.mean][-1]
    yield f"For no more than that, there is {_told(best, names)}."
    cheap = next((each for each in result.front if each.more.mean >= present.more.mean), best)
    if cheap is not best:
        yield f"For no less than it gives, there is {_told(cheap, names)}."


def _told(each: Alternative, names: Sequence[str]) -> str:
    return f"{fleet_text(each.counts, names)}, which gives {spread(each.more)} for {spread(each.less, exact=True)}"


def searches(result: FleetFront) -> str:
    """Return how the sampler did beside the search at random."""
    sampler, random = (result.hypervolumes[name] for name in ("sampler", "random"))
    if not random > 0:
        return "The search at random found nothing, so that the sampler has no yardstick."
    return (
        f"The sampler's front dominates {sampler / random:.2f} times the area (hypervolume) of that of as many trials "
        "at random."
    )


def _buy(rate: ExchangeRate, price: float, dear: str, cheap: str) -> str:
    if rate.low > price:
        return f"for the money, {dear} are the better buy"
    if rate.high < price:
        return f"for the money, {cheap} are the better buy"
    return "which of the two is the better buy is not told"


def _short(value: float) -> str:
    return f"{value:.2g}" if value < 10 else f"{value:,.0f}"
