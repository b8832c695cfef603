"""record.json: what it says, checked against itself. Nothing that it names is loaded, opened or run."""

import hashlib
import json
import math
from pathlib import Path
from typing import Annotated, Any, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from shoal.core.errors import RecordError
from shoal.core.messages import REPORT_BYTES
from shoal.core.version import RESULTS_VERSION, VERSION
from shoal.scenario.recorded import RecordedScenario, recorded_scenario

FORMAT = 3  # 1 had no checksums; 2 had neither a roster nor whom agents heard

_Finite = Annotated[float, Field(allow_inf_nan=False)]
_Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
_NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
_Whole = Annotated[int, Field(ge=0, lt=2**64)]


class _Part(BaseModel):
    """Strict in what readers of records rely on, free in all else: scenarios of later versions say more."""

    model_config = ConfigDict(strict=True, extra="allow", frozen=True)


class _Steered(_Part):
    step: _Whole
    words: str


class _Provenance(_Part):
    steps: _Whole
    seed: _Whole
    scenario_hash: str
    results_version: int
    versions: dict[str, str]
    platform: str
    started: str
    seconds: Annotated[float, Field(ge=0, allow_inf_nan=False)]
    notes: list[str]
    steered: list[_Steered] = []


class _Facts(_Part):
    model_config = ConfigDict(extra="forbid")

    fleets: list[str]
    counts: list[_Whole]
    max_speeds: list[_Positive]
    unit: _Positive
    time_step: _Positive
    area: _Positive
    report_bytes: Annotated[int, Field(ge=REPORT_BYTES, lt=2**31)]
    interval: _NotNegative = 0.0
    airtime: _NotNegative = 0.0
    capacities: list[_NotNegative] = []
    costs: list[_NotNegative] = []


class _Summary(_Part):
    runs: Annotated[int, Field(ge=1, le=10_000_000)]


class RecordContent(_Part):
    """What record.json says; `raw` is all of it, as plain data. `sha256` is of each other file, None in format 1."""

    format: int
    summary: _Summary
    provenance: _Provenance
    facts: _Facts
    scenario: RecordedScenario
    sha256: dict[str, str] | None = None
    raw: dict[str, Any]

    def checksum_of(self, file: str) -> str | None:
        """SHA-256 of a file of the record; None where format 1 has none."""
        return None if self.sha256 is None else self.sha256[file]

    @model_validator(mode="after")
    def _agrees_with_itself(self) -> Self:
        facts, scenario, about = self.facts, self.scenario, self.provenance
        area = scenario.area
        same = {
            "facts.fleets": (facts.fleets, [fleet.name for fleet in scenario.fleets]),
            "facts.counts": (facts.counts, scenario.counts),
            "facts.max_speeds": (facts.max_speeds, [fleet.max_speed for fleet in scenario.fleets]),
            "facts.unit": (facts.unit, max(area.width, area.height) / 20.0),
            "facts.time_step": (facts.time_step, scenario.time_step),
            "facts.area": (facts.area, area.width * area.height),
            "provenance.steps": (about.steps, scenario.steps),
            "provenance.seed": (about.seed, scenario.seed),
        }
        for name, (said, follows) in same.items():
            if said != follows and not (isinstance(said, float) and math.isclose(said, follows)):  # type: ignore[arg-type]
                raise ValueError(f"{name} says {said}, its scenario {follows}")
        return self


def read_content(file: Path) -> RecordContent:
    """Read a record.json.

    Raises
    ------
    RecordError : of a newer Shoal
    ValueError, OSError, RecursionError : damaged
    """
    raw = json.loads(file.read_text(encoding="utf-8"), parse_constant=_no_number)
    if not isinstance(raw, dict):
        raise ValueError("record.json is not an object")
    _check_versions(str(file.parent), raw)
    if raw["format"] >= 2 and raw.get("checksum") != sum_of_content(raw):
        raise ValueError("record.json is not what was written")
    try:
        content = RecordContent.model_validate({**raw, "scenario": _scenario_of(raw), "raw": raw})
    except ValidationError as errors:
        first = errors.errors()[0]
        place = ".".join(map(str, first["loc"]))
        raise ValueError(f"record.json: {place + ': ' if place else ''}{first['msg']}") from None
    if (content.sha256 is None) != (content.format == 1):
        raise ValueError("record.json: sha256 is missing")
    if content.format == 1 and _hash_of(raw["scenario"]) != content.provenance.scenario_hash:
        raise ValueError("record.json: its scenario is not the one that was run")
    return content


def _scenario_of(raw: dict[str, Any]) -> RecordedScenario:
    """The scenario that was run.

    Raises
    ------
    ValueError : there is none, or it has not the shape of one
    """
    if not isinstance(raw.get("scenario"), dict):
        raise ValueError("record.json has no scenario")
    try:
        return recorded_scenario(raw["scenario"], raw["provenance"]["scenario_hash"])
    except ValidationError as errors:
        first = errors.errors()[0]
        raise ValueError(f"record.json: scenario.{'.'.join(map(str, first['loc']))}: {first['msg']}") from None


def sum_of_content(content: dict[str, Any]) -> str:
    """SHA-256 of a record.json, its checksum excepted; neither layout nor the order of keys counts."""
    rest = {name: part for name, part in content.items() if name != "checksum"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def _check_versions(where: str, raw: dict[str, Any]) -> None:
    """Refuse what this Shoal cannot know."""
    known, results = raw["format"], raw["provenance"]["results_version"]
    for name, version, newest in (("format", known, FORMAT), ("results version", results, RESULTS_VERSION)):
        if type(version) is not int or version < 1:
            raise ValueError(f"record.json: {name} {version!r} has never been")
        if version > newest:
            problem = f"is of {name} {version}; this Shoal ({VERSION}) knows up to {newest}"
            raise RecordError(where, problem, "install a newer Shoal to read it")


def _no_number(constant: str) -> None:
    raise ValueError(f"record.json: {constant} is not a number")


def _hash_of(scenario: dict[str, Any]) -> str:
    """The scenario's hash as results version 1 made it; later formats have checksums."""
    content = {name: part for name, part in scenario.items() if name not in ("name", "description", "seed")}
    content = json.loads(json.dumps(content))  # a copy
    own = [fleet["strategy"] for fleet in content["fleets"] if fleet["strategy"]]
    for part in (content["strategy"], *own, *content["targets"]):
        part.pop("file", None)
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:16]
