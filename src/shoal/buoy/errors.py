"""What goes wrong with bodies and sensors."""

from shoal.core.errors import ShoalError


class BodyError(ShoalError):
    """A body, or a sensor, that cannot be used."""


class UnreadyError(BodyError):
    """A body that cannot say where it is, or does not obey, now: a loop does without it in this step, and goes on."""
