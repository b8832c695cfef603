"""What goes wrong where something learns."""

from shoal.core.errors import ShoalError


class LearnError(ShoalError):
    """An environment that cannot be made, or actions that it cannot take; a strategy that cannot be trained."""
