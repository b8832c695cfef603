"""The page of a design for whoever buys: one sheet of HTML, its figure inside, nothing fetched from anywhere."""

import base64
import io
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from shoal.core.files import write_atomic
from shoal.core.text import plain
from shoal.core.version import RESULTS_VERSION, VERSION
from shoal.experiments.fleet_front import FleetFront
from shoal.study.design_words import buying, names_of, searches, shortened, simulated, spread
from shoal.study.searching import shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROWS = 10  # of the table: the rest is in the folder of the design
CSS = """
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1.6rem 1.2rem; max-width: 50rem; background: #fff; color: #1d2328;
  font: 15px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
h1 { font-size: 1.5rem; line-height: 1.25; margin: 0 0 .3rem; }
h2 { font-size: 1.05rem; margin: 1.1rem 0 .4rem; }
p, ul { margin: .4rem 0; } ul { padding-left: 1.2rem; } li { margin: .2rem 0; }
.soft { color: #55606b; font-size: .87rem; }
img { display: block; width: 100%; height: auto; margin: .6rem 0 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .88rem; }
th, td { text-align: right; padding: .22rem .55rem; border-bottom: 1px solid #d8dee4; white-space: nowrap;
  font-variant-numeric: tabular-nums; }
th { border-bottom-width: 2px; white-space: normal; vertical-align: bottom; }
th:last-child, td:last-child { text-align: left; }
tr.own td { background: #fdeee2; }
@media print {
  @page { size: A4; margin: 12mm 14mm; }
  body { max-width: none; padding: 0; font-size: 9.5pt; line-height: 1.3; }
  h1 { font-size: 16pt; } h2 { font-size: 11pt; margin-top: .6rem; }
  img { width: auto; max-width: 100%; max-height: 97mm; margin: .3rem auto 0; }
  .soft, table { font-size: 8.5pt; }
  th, td { padding: .08rem .5rem; }
  tr.own td { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  table, li { break-inside: avoid; }
}
"""


def write_page(scenario: str, result: FleetFront, figure: "Figure", file: str | Path) -> None:
    """Write the page of a design; one of Shoal's of this name is replaced.

    Raises
    ------
    RecordError : it cannot be written
    """
    write_atomic(file, page(scenario, result, _picture(figure)).encode(), ours=True)


def page(scenario: str, result: FleetFront, picture: str) -> str:
    """Return the page as HTML; `picture` is the address of the figure."""
    search = result.search
    title = f"Which fleet to buy: {scenario}"
    told = "".join(f"<li>{_text(each)}</li>" for each in buying(result))
    method = (
        f"{search.trials} fleets were chosen by a sampler and as many at random, {search.runs} runs of "
        f"{search.scenario.steps:,} steps each, all with the same seeds. {len(result.alternatives)} of them were run "
        f"again, {search.final_runs} times each, on seeds that the search had not seen: all numbers here are of "
        "these runs, with 95 % intervals. A fleet is dominated for sure where another costs no more and its interval "
        "lies above. What one agent is worth of another is told by all that was tried, by a smooth curve. "
        f"{searches(result)} A simulation is no trial at sea: it knows what the scenario says, and nothing else."
    )
    facts = (
        f"Shoal {VERSION}, results version {RESULTS_VERSION}, scenario {search.scenario.hash}, seed "
        f"{search.scenario.seed}, {result.steps:,} steps in all."
    )
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<meta name="generator" content="shoal">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n<link rel="icon" href="data:,">\n'
        f"<title>{_text(title)}</title>\n<style>{CSS}</style>\n</head>\n<body>\n<header>\n<h1>{_text(title)}</h1>\n"
        f'<p class="soft">{_text(search.scenario.description)}</p>\n</header>\n<main>\n<ul>{told}</ul>\n'
        f'<img src="{picture}" alt="{_text(_described(result))}">\n{_table(result)}\n'
        f'<h2>What was simulated</h2>\n<p class="soft">{_text(simulated(result))}</p>\n'
        f'<h2>How this was found</h2>\n<p class="soft">{_text(method)}</p>\n<p class="soft">{_text(facts)}</p>\n'
        "</main>\n</body>\n</html>\n"
    )


def _table(result: FleetFront) -> str:
    search = result.search
    kept = shortened(result, ROWS)
    left = len(result.front) - sum(each.on_front for each in kept)
    titles = [search.less.words, *names_of(result), *(_field(each.field) for each in search.variables)]
    head = "".join(f"<th>{_text(title)}</th>" for title in [*titles, search.more.words, "remark"])
    values = {id(each): {**search.start, **each.point} for each in kept}
    rows = "".join(
        f"<tr{' class=own' if each.present else ''}>"
        + "".join(
            f"<td>{_text(cell)}</td>"
            for cell in (
                spread(each.less, exact=True), *map(str, each.counts),
                *(shown(values[id(each)][variable.field]) for variable in search.variables),
                spread(each.more), "the scenario's own" if each.present else "",
            )
        )
        + "</tr>"
        for each in kept
    )  # fmt: skip
    more = f'<p class="soft">{left} more fleets of the front lie between these.</p>' if left else ""
    return (
        f"<h2>The front: no fleet that was found gives more for less</h2>\n"
        f'<div class="scroll" tabindex="0" role="region" aria-label="The front as a table">'
        f"<table><thead><tr>{head}"
        f"</tr></thead><tbody>{rows}</tbody></table></div>{more}"
    )


def _described(result: FleetFront) -> str:
    first, last = result.front[0], result.front[-1]
    less, more = result.search.less.words, result.search.more.words
    return (
        f"{more} against {less}: from {spread(first.more)} for {spread(first.less, exact=True)} to {spread(last.more)} "
        f"for {spread(last.less, exact=True)}"
    )


def _picture(figure: "Figure") -> str:
    from shoal.drawing.style import style

    stream = io.BytesIO()
    with style():
        figure.savefig(stream, format="png", dpi=200, facecolor="white", metadata={"Software": f"shoal {VERSION}"})
    return f"data:image/png;base64,{base64.b64encode(stream.getvalue()).decode()}"


def _field(name: str) -> str:
    return "k" if name == "neighbors" else name


def _text(text: str) -> str:
    return escape(plain(text))
