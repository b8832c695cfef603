"""Who says which points a search tries next: optuna's samplers, asked and told by us.

Optuna keeps nothing: its study is made anew from what our stores hold. Akiba, Sano, Yanase, Ohta, Koyama, "Optuna: a
next-generation hyperparameter optimization framework", KDD 2019.
"""

from collections.abc import Sequence
from typing import Any, Literal

from shoal.core.errors import MissingExtraError
from shoal.experiments.design import Point
from shoal.experiments.objective import Objective
from shoal.experiments.variable import Variable

Sampler = Literal["tpe", "random"]
_LARGEST_SEED = 2**32 - 1  # of optuna's samplers
STARTING = 10  # points at random before the sampler learns from them


class Asker:
    """A study of optuna's in memory.

    Parameters
    ----------
    variables : what is searched
    objectives : what for; one, or several
    sampler : tpe - tree-structured Parzen estimator (Bergstra et al., NIPS 2011; for several objectives Ozaki et al.,
        GECCO 2020); random - every point by chance alone
    seed : of the sampler's chance
    starting : points by chance before the sampler learns

    Raises
    ------
    MissingExtraError : optuna is not installed
    """

    def __init__(
        self,
        variables: Sequence[Variable],
        objectives: Sequence[Objective],
        sampler: Sampler,
        seed: int,
        starting: int = STARTING,
    ) -> None:
        optuna = _optuna()
        self._variables = variables
        spaces = optuna.distributions
        self._spaces = {each.field: _space(spaces, each) for each in variables}
        chance = seed % _LARGEST_SEED
        if sampler == "random":
            chosen = optuna.samplers.RandomSampler(seed=chance)
        else:
            chosen = optuna.samplers.TPESampler(seed=chance, multivariate=True, n_startup_trials=starting)
        self._study = optuna.create_study(directions=[each.optuna for each in objectives], sampler=chosen)
        self._failed = optuna.trial.TrialState.FAIL
        self._create = optuna.trial.create_trial

    def ask(self) -> tuple[Any, Point]:
        """Return a trial to `tell` of, and its point."""
        trial = self._study.ask(self._spaces)
        return trial, {each.field: each.value(trial.params[each.field]) for each in self._variables}

    def tell(self, trial: Any, values: Sequence[float] | None) -> None:
        """Say what a trial gave, or that it gave nothing."""
        if values is None:
            self._study.tell(trial, state=self._failed)
        else:
            self._study.tell(trial, list(values))

    def prefer(self, point: Point) -> None:
        """Have this point asked for next."""
        self._study.enqueue_trial({each.field: each.place(point[each.field]) for each in self._variables})

    def learn(self, point: Point, values: Sequence[float]) -> None:
        """Say what a point gave that nobody asked for; one outside the ranges is left out."""
        places = {each.field: each.place(point.get(each.field)) for each in self._variables}
        if all(place is not None for place in places.values()):
            self._study.add_trial(self._create(params=places, distributions=self._spaces, values=list(values)))


def require_optuna() -> None:
    """Refuse a search where optuna is absent.

    Raises
    ------
    MissingExtraError : it is not installed
    """
    _optuna()


def _optuna() -> Any:
    try:
        import optuna
    except ImportError:
        raise MissingExtraError.of("optuna", "tune", "a search for the best values") from None
    optuna.logging.set_verbosity(optuna.logging.ERROR)  # a library never prints
    return optuna


def _space(spaces: Any, variable: Variable) -> Any:
    if variable.choices and not all(isinstance(each, (int, float)) for each in variable.choices):
        return spaces.CategoricalDistribution(tuple(range(len(variable.choices))))
    if variable.whole:
        return spaces.IntDistribution(int(variable.low), int(variable.high))
    return spaces.FloatDistribution(variable.low, variable.high, log=variable.by_logarithm)
