"""Two buoys of one number: who comes second is refused; who is under way goes on, and says so."""

import math
from collections.abc import Callable

from shoal.buoy.mesh import Peers
from shoal.core.errors import FleetError

LOOK = 1.0  # [s] in which a buoy looks who is there, before it takes its vehicle
GRACE = 5.0  # [s] in which one that is ending is gone
NEW = 10.0  # [s] under way, in which a buoy still is the second of two
_AGAIN = 0.05


class Twins:
    """Looks out for another buoy of the same number.

    A vehicle that is under way is never stopped by one: whoever reaches the mesh could stop it so.

    Parameters
    ----------
    mesh : that the buoys are on
    me : number of this buoy
    now : says the time [s]
    tell : called with a sentence when another comes, or is gone

    Attributes
    ----------
    came : how often one came
    """

    def __init__(self, mesh: Peers, me: int, now: Callable[[], float], tell: Callable[[str], None]) -> None:
        self.came = 0
        self._mesh, self._me, self._now, self._tell = mesh, me, now, tell
        self._begun, self._new_until = now(), math.inf
        self._since: float | None = None
        self._heard = 0

    def look(self) -> bool:
        """Return whether another is there.

        Raises
        ------
        FleetError : this one came second, and the first stays
        """
        before, after = self._mesh.namesakes()
        now = self._now()
        if not before + after:
            if self._since is not None:
                self._tell(f"buoy {self._me}: the other buoy {self._me} is gone")
            self._since = None
            return False
        if self._since is None:
            self._since = now
            self.came += 1
            self._tell(f"buoy {self._me}: there is another buoy {self._me} on the mesh; end one of them")
        if before and self._since <= self._new_until and now - self._since > GRACE:
            problem = f"is {self._me}, but a buoy {self._me} is on the mesh already"
            raise FleetError("--id", problem, "give this one its own number, or end the other first")
        return True

    def under_way(self) -> None:
        """From now on this buoy steers: soon it is no longer the one that goes."""
        self._new_until = self._now() + NEW

    def second(self) -> bool:
        """Return whether another is there that came first, and may be about to end.

        Raises
        ------
        FleetError : it stays
        """
        return self.look() and self._mesh.namesakes()[0] > 0

    def wait(self, wait: Callable[[float], None]) -> None:
        """Return when nobody else of this number is there.

        Parameters
        ----------
        wait : lets some seconds pass

        Raises
        ------
        FleetError : the other stays
        """
        while self._now() - self._begun < LOOK or self.look():
            wait(_AGAIN)
            self.look()

    def hear(self, reports: int) -> bool:
        """Take how many reports of this number were another's; return whether there are more than before.

        Parameters
        ----------
        reports : counted since the start
        """
        more = reports > self._heard
        if more and not self._heard and self._since is None:
            self._tell(f"buoy {self._me}: somebody else reports as buoy {self._me}; end one of the two")
        self._heard = reports
        return more
