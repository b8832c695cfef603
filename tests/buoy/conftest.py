"""What tests of bodies share."""

import pytest


@pytest.fixture
def scene():
    """Makes scenes of a rover and its body, begun unless told otherwise, and closes them."""
    from scenes import Scene  # which needs pymavlink

    made = []

    def make(**options):
        begun = options.pop("begun", True)
        made.append(Scene(**options))
        if begun:
            made[-1].body.begin(arm=True)
        return made[-1]

    yield make
    for each in made:
        each.close()
