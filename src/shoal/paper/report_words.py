"""What the report says in full sentences."""

TITLES = {
    "oceans2020": (
        "Reproduction: Heterogeneous Swarms for Maritime Dynamic Target Search and Tracking",
        "Every figure and claim of Kwa, Tokić, Yue and Bouffanais, OCEANS 2020, simulated again with Shoal.",
    ),
    "aamas2020": (
        "Reproduction: Optimal Swarm Strategy for Dynamic Target Search and Tracking",
        "The published curves of Kwa, Leong Kit and Bouffanais, AAMAS 2020, simulated again with Shoal.",
    ),
}

QUICK = (
    "This is a quick run: fewer steps, seeds and points than the paper. Its intervals are wide and its verdicts "
    "preliminary; leave out --quick for the full length."
)

TABLES = {
    "sensitivity": "What the paper leaves open, each choice decided the other way: where the curves over k peak",
    "published": "Measured and published values of the homogeneous predecessor",
}

METHOD = (
    "Each point is run with several seeds. Its interval is Student\u2019s t over them, at 95 %. Run r of every point "
    "shares its chance (the path of the target, the starts), so comparisons are made seed by seed, and a difference "
    "can be sure although two bands overlap.",
    "Where a curve peaks is estimated with a bootstrap over seeds: seeds are drawn with replacement, the curve is "
    "averaged over them, and its peak is taken; the interval holds the middle 95 % of the peaks.",
    "A claim holds if its whole interval is on the side that the paper says, and does not hold if all of it is on the "
    "other side. It holds partly if some of its parts (swarms, speeds, numbers of neighbors) hold and others do not. "
    "If the interval reaches to both sides, the runs cannot tell: undecided. Nothing was tuned to make a claim pass.",
)
