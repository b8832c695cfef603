"""What the report says in full sentences."""

from shoal.paper import alife_claims, cases, density_claims, readings, readings_study, statements
from shoal.paper.curves import FEW
from shoal.paper.leave_out import best_gain
from shoal.paper.published import BARS
from shoal.record.names import label_of

TITLES = {
    "oceans2020": (
        "Reproduction: Heterogeneous Swarms for Maritime Dynamic Target Search and Tracking",
        "Every figure and claim of Kwa, Tokić, Yue and Bouffanais, OCEANS 2020, simulated again with Shoal.",
    ),
    "oceans2020-readings": (
        "Which reading of the paper? Heterogeneous Swarms for Maritime Dynamic Target Search and Tracking",
        "What Kwa, Tokić, Yue and Bouffanais, OCEANS 2020, leave open, read in every defensible way, and how much of "
        "the paper each reading meets.",
    ),
    "aamas2020": (
        "Reproduction: Optimal Swarm Strategy for Dynamic Target Search and Tracking",
        "The published curves of Kwa, Leong Kit and Bouffanais, AAMAS 2020, simulated again with Shoal.",
    ),
    "alife2023": (
        "Mixed fleets after a target that flees",
        "What the abstract of Kwa, Babineau, Philippot and Bouffanais, Artificial Life 29, 2023, says, tried with "
        "Shoal. Numbers of the setting are ours.",
    ),
    "density2023": (
        "The density of a swarm",
        "What the abstract of Kwa, Philippot and Bouffanais, Swarm Intelligence 17, 2023, says, tried with Shoal. "
        "Numbers of the setting are ours.",
    ),
}

QUICK = (
    "This is a quick run: fewer steps, seeds and points than the paper. Its intervals are wide and its verdicts "
    "preliminary; leave out --quick for the full length."
)

TABLES = {
    "peaks": "Where the curves over k peak, and how high they are there",
    "sensitivity_peaks": "The same with what the paper leaves open decided the other way, one choice at a time",
    "sensitivity_conclusions": "Verdicts on C1 to C13 under each of these choices, and which of them change",
    "verdicts": "The verdicts under both readings, and which depend on the reading",
    "refit_peaks": "The same under oceans2020-refit",
    "readings_scores": "Every reading: its verdicts, how many statements hold, and its score",
    "readings": "Every statement at each target speed under each reading: the number that speaks most against it",
    "readings_peaks": "Where the curves over k peak under each reading",
    "frontier": "Statements that hold under some reading each, but under none together; and those that hold under none",
    "published": "Measured and published values of the homogeneous predecessor, in the units of the metrics",
}

# Words and units of columns; others are shown as they are called.
COLUMNS: dict[str, tuple[str, str]] = {
    "neighbors": ("k", ""),
    "fast": ("fast buoys", "of 50"),
    "target_speed": ("target", "m/s"),
    "k_star": ("k*", ""),
    "time_on_target": ("time on target at k*", "share"),
    "xi_peak_k": ("k of the peak of Ξ", ""),
    "xi": ("Ξ there", ""),
    "at_edge": ("at edge", "of the k"),
    "tolerance": ("tolerated", ""),
}
METRICS = {name: label_of(name) for name in ("time_on_target", "xi", "response")}

_SEEDS = (
    f"Each point is run with several seeds. Its interval is Student\u2019s t over them, at 95 %; with fewer than {FEW} "
    "seeds their spread is pooled over points. Run r of every point shares its chance (target path and starts), "
    "so comparisons are made seed by seed, and a difference can be sure although two bands overlap."
)

_RULE = " ".join((cases.__doc__ or "").split("\n\n", 1)[-1].split())  # said once, beside the code that applies it


def _rules(*docs: str | None) -> list[str]:
    """Paragraphs of docstrings, without their first lines."""
    return [" ".join(text.split()) for doc in docs for text in (doc or "").split("\n\n")[1:]]


METHOD = {
    "alife2023": (_SEEDS, *_rules(alife_claims.__doc__, best_gain.__doc__), _RULE),
    "density2023": (_SEEDS, *_rules(density_claims.__doc__, best_gain.__doc__), _RULE),
    "oceans2020-readings": (
        *_rules(readings.__doc__, statements.__doc__, readings_study.run_study.__doc__),
        _SEEDS,
        _RULE,
    ),
    "oceans2020": (
        _SEEDS,
        "The place and the height of a peak are those of the smooth curves that fit all points, drawn from a Gaussian "
        "process that learns from the points how smooth the curve is, with noise bootstrapped over seeds. On made-up "
        "curves of the paper\u2019s shapes, from 3 or 5 seeds, 93 % or more of the intervals hold the true place.",
        _RULE,
        "The key number of a claim is that of the case that speaks most against it.",
        "Where the paper reads a k off a plot (\u201cabout 18\u201d), "
        f"{cases.ABOUT:g} to either side are allowed, and half a k for its last digit. Nothing was tuned to make a "
        "claim pass.",
    ),
    "aamas2020": (
        _SEEDS,
        f"A published value is met where ours differs by no more than {BARS['time_on_target'][0]:g} (time on target), "
        f"{100 * BARS['response'][1]:g} % (response), or, where that is wider, than one more run of ours would (95 % "
        "prediction interval). The claims\u2019 cases are these values, each true or false, not open.",
        _RULE,
        "Published are values for adaptive repulsion only; of constant repulsion the figure shows our curve alone.",
    ),
}
