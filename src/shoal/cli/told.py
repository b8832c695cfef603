"""What is told of a record that was just made: its notes, its table or its JSON, and its figure."""

from pathlib import Path
from typing import TYPE_CHECKING, Literal

from shoal.cli.progress import note

if TYPE_CHECKING:
    from shoal.record.record import Record


def tell(
    record: "Record",
    out: Path | None,
    figure: Path | None,
    as_json: bool,
    *,
    width: Literal["single", "double"] = "double",
    everything: bool = False,
) -> None:
    """Print a record, `everything` of it or what matters most, and draw it, so wide, if that was asked for."""
    for each in record.provenance["notes"]:
        note(each)
    if out:
        note(f"record: {out} (shoal show {out})")
    print_and_draw(record, figure, as_json, width=width, everything=everything)


def print_and_draw(
    record: "Record",
    figure: Path | None,
    as_json: bool,
    *,
    width: Literal["single", "double"] = "double",
    everything: bool = False,
) -> None:
    """Print a record and draw it, without what was noted when it was made."""
    if as_json:
        from shoal.cli.summary import print_json

        print_json(record)
    else:
        from shoal.cli.table import print_record

        print_record(record, everything=everything)
    if figure:
        from shoal.study.plot import save, summary

        save(summary(record, width=width), figure)
        note(f"figure: {figure}")
