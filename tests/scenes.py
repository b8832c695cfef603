"""A rover, a body that steers it, and the hand that moves their time."""

import math

from rovers import Hand, Rover
from shoal.buoy.connection import Datagrams
from shoal.buoy.fence import Fence
from shoal.buoy.mavlink import Mavlink
from shoal.buoy.mavlink_body import MavlinkBody
from shoal.buoy.vehicle import Vehicle
from shoal.core.geodesy import Frame

ORIGIN = (5.3, 60.4)
FENCE = Fence(200.0, 100.0, 2.0)
SILENCE = 1.2


class Scene:
    """A rover, a body that listens for it, and the hand that moves their time."""

    def __init__(self, *, at=(0.0, 0.0), origin=ORIGIN, fence=FENCE, detector=lambda x, y: False, key=None, **rover):
        self.hand, self.frame = Hand(), Frame(origin)
        self.connection = Datagrams(("127.0.0.1", 0), listens=True)
        self.rover = Rover(self.connection.place, *self.frame.geographic(*at), **rover)
        self.hand.movers.append(self.rover)
        self.others = []
        self.vehicle = Vehicle("udp:here", self.connection, Mavlink(key=key))
        chosen = {"detector": detector, "silence": SILENCE, "clock": self.hand.clock, "wait": self.hand.wait}
        self.body = MavlinkBody(self.vehicle, self.frame, fence, **chosen)
        self.hand.bodies.append(self.body)

    @property
    def place(self):
        return self.frame.local(self.rover.lon, self.rover.lat)

    @property
    def speed(self):
        return math.hypot(self.rover.east, self.rover.north)

    def another(self, at=(0.0, 0.0), **rover):
        self.others.append(Rover(self.rover.to, *self.frame.geographic(*at), **rover))
        return self.others[-1]

    def close(self):
        self.connection.close()
        for each in (self.rover, *self.others):
            each.socket.close()
