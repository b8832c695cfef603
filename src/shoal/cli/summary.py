"""The summary of a record as one line of JSON."""

import json

from shoal.cli.output import write
from shoal.record.frames import trajectory_sha256
from shoal.record.record import Record


def print_json(record: Record) -> None:
    """Print the metrics, where they come from, and the SHA-256 of the first run's trajectory if all of it was kept."""
    first = record.trajectories.get(0)
    sha256 = None if first is None else trajectory_sha256(first, record.scenario.steps)
    write(json.dumps({**record.summary(), "trajectory_sha256": sha256}) + "\n")
