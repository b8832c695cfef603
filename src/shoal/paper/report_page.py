"""The page of the report: plain HTML, its style and pictures inside."""

from collections import Counter
from collections.abc import Sequence
from html import escape
from typing import NamedTuple

from shoal.paper.report_style import CSS
from shoal.paper.report_tables import BADGES, claims_table, data_table
from shoal.paper.report_words import METHOD, QUICK, TABLES, TITLES
from shoal.paper.results import Claim, Figure, Reproduction

_PIXELS = 96.0  # to the inch, on a screen
_NARROW = 480.0  # [px] wider pictures are moved sideways on a phone, rather than shrunk until nobody can read them


class Picture(NamedTuple):
    """A figure with its picture as a data: address, and its size [inch]."""

    figure: Figure
    source: str
    width: float
    height: float


def page(reproduction: Reproduction, pictures: Sequence[Picture], stores: Sequence[str]) -> str:
    """Return the report as one HTML document; `stores` are the folders of the sweeps, relative to it."""
    title, source = TITLES.get(reproduction.paper, (reproduction.paper, ""))
    sections = [
        ("claims", "Claims and verdicts", _claims(reproduction, pictures)),
        ("figures", "Figures", "".join(_picture(reproduction, picture) for picture in pictures)),
        ("tables", "Tables", _tables(reproduction)),
        ("method", "How verdicts were reached", _method(reproduction.paper)),
        ("data", "Run it again, read the data", _data(reproduction, pictures, stores)),
    ]
    sections = [section for section in sections if section[2]]
    links = " ".join(f'<a href="#{name}">{escape(heading)}</a>' for name, heading, _ in sections)
    body = "".join(f'<section id="{name}">\n<h2>{escape(heading)}</h2>\n{content}\n</section>\n'
                   for name, heading, content in sections)  # fmt: skip
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<link rel="icon" href="data:,">\n<title>{escape(title)}</title>\n<style>{CSS}</style>\n</head>\n<body>\n'
        f'<header>\n<h1>{escape(title)}</h1>\n<p class="lead">{escape(source)}</p>\n</header>\n'
        f"<main>\n{_warning(reproduction)}{_summary(reproduction)}{_facts(reproduction)}"
        f'<nav aria-label="Contents">{links}</nav>\n{body}</main>\n</body>\n</html>\n'
    )


def _warning(reproduction: Reproduction) -> str:
    return f'<p class="warning" role="note">{escape(QUICK)}</p>\n' if reproduction.quick else ""


def _summary(reproduction: Reproduction) -> str:
    """How many claims hold, under each reading."""
    if not reproduction.claims:
        return ""
    text = f"Of {len(reproduction.claims)} claims of the paper, tested with 95 % intervals"
    if not reproduction.refit_claims:
        return _tiles(f"{text}:", reproduction.claims)
    differ = [
        one.id
        for one, other in zip(reproduction.claims, reproduction.refit_claims, strict=True)
        if one.verdict != other.verdict
    ]
    return (
        _tiles(f"{text}, with the paper as printed (oceans2020):", reproduction.claims)
        + _tiles("and in the reading that meets most of it (oceans2020-refit):", reproduction.refit_claims)
        + f"<p>Verdicts that depend on the reading: {', '.join(differ) or 'none'}.</p>\n"
    )


def _tiles(text: str, claims: Sequence[Claim]) -> str:
    """A count for each verdict."""
    counts = Counter(str(claim.verdict) for claim in claims)
    tiles = "".join(
        f'<li><b>{counts[verdict]}</b><span class="badge {name}"><span aria-hidden="true">{sign}</span> '
        f"{escape(verdict)}</span></li>"
        for verdict, (sign, name) in BADGES.items()
    )
    return f'<p>{escape(text)}</p>\n<ul class="counts">{tiles}</ul>\n'


def _facts(reproduction: Reproduction) -> str:
    """What was run."""
    rows = [*reproduction.main, *reproduction.refit, *reproduction.sensitivity]
    runs = sum(row.get("status", "done") == "done" for row in rows)
    failed = len(rows) - runs
    versions = ", ".join(f"{name} {version}" for name, version in reproduction.versions.items())
    facts = {
        "Command": f"<code>{escape(reproduction.command)}</code>" if reproduction.command else "",
        "Runs": f"{_count(runs)} of {_count(reproduction.steps)} steps in the curves, "
        f"{reproduction.seeds} seed{'s' if reproduction.seeds != 1 else ''} per point"
        + (f"; {_count(failed)} failed and are left out" if failed else ""),
        "Time": f"{_time(reproduction.seconds)}, without runs that were finished before"
        if reproduction.seconds > 0
        else "",
        "Versions": escape(versions),
    }
    listed = "".join(f"<dt>{name}</dt><dd>{text}</dd>" for name, text in facts.items() if text)
    return f'<dl class="facts">{listed}</dl>\n'


def _claims(reproduction: Reproduction, pictures: Sequence[Picture]) -> str:
    titles = {picture.figure.name: picture.figure.title for picture in pictures}
    return claims_table(reproduction.claims, titles, reproduction.refit_claims) if reproduction.claims else ""


def _picture(reproduction: Reproduction, picture: Picture) -> str:
    figure, pixels = picture.figure, picture.width * _PIXELS
    name = escape(figure.name)
    claims = [claim.id for claim in reproduction.claims if claim.figure == figure.name]
    links = ", ".join(f'<a href="#claim-{escape(claim)}">{escape(claim)}</a>' for claim in claims)
    read = f"Read for {links}. " if claims else ""
    wide = " wide" if pixels > _NARROW else ""
    return (
        f'<figure id="figure-{name}" class="plot{wide}">\n<h3>{escape(figure.title)}</h3>\n'
        f'<div class="scroll" tabindex="0"><img src="{picture.source}" width="{pixels:.0f}" '
        f'height="{picture.height * _PIXELS:.0f}" alt="{escape(figure.title)}"></div>\n'
        f"<figcaption>{escape(figure.caption)} "
        f'<span class="note">{read}Every plotted number: '
        f'<a href="data/{name}.csv">data/{name}.csv</a>.</span></figcaption>\n</figure>\n'
    )


def _tables(reproduction: Reproduction) -> str:
    return "".join(
        data_table(rows, TABLES.get(name, name.replace("_", " ").capitalize()))
        + f'<p class="note">As a file: <a href="data/table_{escape(name)}.csv">data/table_{escape(name)}.csv</a></p>\n'
        for name, rows in reproduction.tables.items()
        if rows
    )


def _method(paper: str) -> str:
    return "".join(f"<p>{escape(paragraph)}</p>\n" for paragraph in METHOD.get(paper, ()))


def _data(reproduction: Reproduction, pictures: Sequence[Picture], stores: Sequence[str]) -> str:
    command = f"<pre>{escape(reproduction.command)}</pre>\n" if reproduction.command else ""
    kinds = [
        '<a href="claims.csv">claims.csv</a>: the claims table',
        '<a href="command.txt">command.txt</a>: the exact command and versions',
    ]
    if pictures:
        kinds.append("figures/NAME.svg and NAME.png, and data/NAME.csv with every plotted number")
    if reproduction.tables:
        kinds.append("data/table_NAME.csv: the tables of this page")
    if stores:
        text = ", ".join(f"<code>{escape(store)}</code>" for store in stores)
        kinds.append(f"the raw data, one row per run in runs.sqlite, in: {text}")
    items = "".join(f"<li>{kind}</li>" for kind in kinds)
    return (
        f"<p>The same command gives the same numbers, bit for bit; an interrupted one resumes.</p>\n{command}"
        f"<p>Beside this page:</p>\n<ul>{items}</ul>"
    )


def _count(number: int) -> str:
    return f"{number:,}".replace(",", "\u2009")


def _time(seconds: float) -> str:
    return f"{seconds / 60:.1f} min" if seconds >= 120 else f"{seconds:.0f} s"
