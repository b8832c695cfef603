"""The glossary holds every noun of the source: the words that modules and classes are named by."""

import ast
import re
from pathlib import Path

import pytest

import shoal
from shoal.scenario.disturbances import DISTURBANCES
from shoal.scenario.targets import TARGETS

ROOT = Path(__file__).resolve().parents[1]
SOURCE = Path(shoal.__file__).parent
(TABLE,) = re.findall(r"\| --- \| --- \|\n(.*)", (ROOT / "docs/glossary.md").read_text(encoding="utf-8"), re.DOTALL)
TERMS = re.findall(r"^\| ([^|]+) \|", TABLE, re.MULTILINE)
DICTIONARY = """
actor adaptive add address afloat ahead any around array arrived arrow assembled asset assumption at atomic bar block
bound box broken build cannot carry cf change chart check choice choose class clean cli client clip column command
compare compared compiled compiler compiling console content core count crash crashed csv curved data dataframe
dataset declared difference disc dispatch dive doc drag drawing duration each eddy edit effort encoder ended error
executor experiment export exported extra figure file fill film fixed floating folder format frontier frozen geojson
gpx graph ground guard gyre histogram info inlined inner installed interrupt interval is kept keyword kill kml label
land layout legend level library listen listing live load lock locked look lowering main map mark meaning measure
message meta missing move moving name named netcdf new nmea no now older one open opened option outcome
output over page paired panel param pause picture place placement plain play plot plugin polygon print private
progress projected published quantity range read reason recorded reproduce resample restart result robustness rotation
running said saved scaled schema scored seek seen self sensing sensitivity sensor server setting several shoal show
side signal simulate simulation size stamp startup statement statistic stop stopped strategy style suited summary
swept table text thought tide top tree turn uniform unknown varied vehicle version view virtual wanted watch watched
waiting weight word writer xml datagram port serial stream unready aboard attend killing late letter note obedient paced
borrowed deferral process quickest sail serve storm term tied zenoh relayed listed many template vector
form gpu hear known nearest packed place measured promising searching spread start
act asked earned learn observe train
"""  # words that mean what any dictionary says, and file formats
PLAIN = frozenset(DICTIONARY.split())
KINDS = [*TARGETS, *DISTURBANCES]


def words(name):
    """The words of a name in CamelCase or snake_case, in lower case."""
    return [word.lower() for word in re.findall(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+", name)]


def singular(word):
    """The forms that a word may have in the glossary: itself, and the singular of a plural."""
    return {word, word.removesuffix("s"), word.removesuffix("es"), re.sub("ies$", "y", word)}


def named():
    """Words of the names of packages, modules and public classes, and where each is."""
    found = {}
    for file in sorted(SOURCE.rglob("*.py")):
        parts = [part for part in file.relative_to(SOURCE).with_suffix("").parts if not part.startswith("__")]
        classes = [
            node.name
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8")))
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_")
        ]
        for name in (*parts, *classes):
            for word in words(name):
                found.setdefault(word, f"{file.relative_to(SOURCE)}: {name}")
    return found


def explained():
    listed = [*TERMS, *KINDS, *(each.name for each in (*shoal.list_strategies(), *shoal.list_metrics()))]
    return {form for name in listed for word in words(name) for form in singular(word)}


def test_every_noun_of_the_source_is_in_the_glossary():
    known = explained() | PLAIN
    assert {word: place for word, place in named().items() if not singular(word) & known} == {}


def test_plain_words_are_used_and_are_not_in_the_glossary_too():
    used = {form for word in named() for form in singular(word)}
    assert sorted(PLAIN - used) == []
    assert sorted(PLAIN & {word for term in TERMS for word in words(term)} - {"unit"}) == []


def test_the_glossary_is_in_order_and_has_every_term_once():
    terms = [term.lower() for term in TERMS]
    assert terms == sorted(set(terms))


@pytest.mark.parametrize("name", ["crew", "team", "fleet", "swarm", "tally", "stage", "record", "trajectory", "frame"])
def test_collectives_are_explained_one_by_one(name):
    assert name in TERMS


def test_words_of_a_name():
    assert words("KnnPso") == ["knn", "pso"]
    assert words("time_on_target") == ["time", "on", "target"]
    assert singular("strategies") & {"strategy"}
