"""How hypothesis searches."""

from hypothesis import HealthCheck, settings

# derandomize: the same examples on every machine, so that a red build is red for its change. Search anew with
# `pytest --hypothesis-profile=search`. No deadline: the first example compiles.
settings.register_profile(
    "repeatable",
    deadline=None,
    derandomize=True,
    database=None,
    print_blob=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.register_profile("search", settings.get_profile("repeatable"), derandomize=False)
settings.load_profile("repeatable")
