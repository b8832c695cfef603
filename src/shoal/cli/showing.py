"""What of a fleet can be watched while it runs: a page of our own, and a beacon for others."""

import webbrowser
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, NamedTuple

from shoal.cli.progress import note

if TYPE_CHECKING:
    from shoal.scenario.schema import Scenario
    from shoal.viewer.bulletin import Bulletin
    from shoal.viewer.feed import Feed
    from shoal.viewer.outlook import Outlook

OVER = "the fleet's run is over"
NOWHERE = "none"


class Showing(NamedTuple):
    """A fleet as others see it: what tells them; `end` lets them know that it is over."""

    feed: "Feed"
    end: Callable[[], None]


@contextmanager
def showing(
    scenario: "Scenario", speed: float | None, *, page: bool, browser: bool, listen: str
) -> Iterator[Showing | None]:
    """Let a fleet be watched while this is a context; None if nobody can.

    Parameters
    ----------
    speed : times real time; None: a step takes as long as it takes
    page : serve a page of our own; browser : open it
    listen : where others may watch, HOST:PORT, or none

    Raises
    ------
    FleetError : an address that is none, or cannot be had
    MissingExtraError : a library is not installed
    """
    from shoal.run.compiling import BUOYS, needs_compiling
    from shoal.viewer.feed import Feed

    tell: list[Callable[[Bulletin], None]] = []
    with ExitStack() as stack:
        leave: Callable[[], None] = lambda: None  # noqa: E731
        if listen != NOWHERE:
            leave = stack.enter_context(_beacon(listen, tell))
        outlook = None
        if page:
            from shoal.viewer.outlook import Outlook

            outlook = Outlook()
            tell.append(outlook.hear)
        if not tell:
            yield None
            return
        feed = Feed(scenario, speed, tell)
        compiles = "the engine is compiled, which is done once; then " * needs_compiling(scenario, BUOYS)
        feed.say(f"{compiles}{scenario.agents} buoys start")
        if outlook:
            stack.enter_context(serving_outlook(outlook, browser=browser))

        def end() -> None:
            feed.say(OVER)
            leave()
            if outlook:
                outlook.end(OVER)

        yield Showing(feed, end)


@contextmanager
def _beacon(listen: str, tell: "list[Callable[[Bulletin], None]]") -> Iterator[Callable[[], None]]:
    """A beacon at an address; gives what ends it."""
    from shoal.buoy.address import host_and_port
    from shoal.buoy.beacon import Beacon
    from shoal.viewer.address import is_local, reachable

    host, port = host_and_port(listen, "--listen", free=True)
    beacon = Beacon(host, port)
    tell.append(lambda bulletin: beacon.tell(bulletin.to_bytes()))
    note(f"watch it from elsewhere: shoal watch --fleet {reachable(host)}:{beacon.port}")
    if not is_local(host):
        note(f"anybody who can reach {host} can watch this fleet")
    try:
        yield beacon.close
    finally:
        beacon.close()


@contextmanager
def serving_outlook(outlook: "Outlook", *, host: str = "127.0.0.1", port: int = 0, browser: bool) -> Iterator[None]:
    """Serve the page of an outlook while this is a context, and open it."""
    from shoal.viewer.address import is_local
    from shoal.viewer.server import live_app, serving

    with serving(live_app(outlook), host, port) as address:
        note(f"watch at {address}")
        if not is_local(host):
            note(f"anybody who can reach {host} can watch this fleet")
        if browser:
            webbrowser.open(address)
        yield
