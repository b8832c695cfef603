"""The page of versions tells the numbers that the code has."""

import re
from pathlib import Path

from shoal.core import wire
from shoal.core.version import RESULTS_VERSION
from shoal.experiments import store_rows
from shoal.record import content
from shoal.run import change_log
from shoal.viewer import bulletin, frame

PAGE = (Path(__file__).resolve().parents[1] / "docs/reference/versions.md").read_text(encoding="utf-8")


def test_formats_are_those_of_the_code():
    told = {word: int(number) for word, number in re.findall(r"^\| \[?(\w+)[^|]*\| (\d+) \|", PAGE, re.MULTILINE)}
    assert told == {
        "record": content.FORMAT,
        "store": store_rows.FORMAT,
        "report": wire.VERSION,
        "log": change_log.FORMAT,
        "frame": frame.FORMAT,
        "bulletin": bulletin.FORMAT,
    }


def test_the_results_version_is_todays():
    assert re.findall(r"Today's results version is (\d+)", PAGE) == [str(RESULTS_VERSION)]
