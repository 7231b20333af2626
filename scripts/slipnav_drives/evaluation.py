"""One recording through the executable `evaluate`, and what is read from its output and files."""

import json
import os
import tempfile
from dataclasses import dataclass
from typing import Optional, Tuple

from slipnav_campaign.task import Failure

from .recordings import stem

NAME_WIDTH = 20  # of the table of `evaluate`
HEAD_LINES = 2
PROGRAM = "evaluate: "


@dataclass(frozen=True)
class Order:
    """Settings shared by all recordings."""

    executable: str
    options: Tuple[str, ...]  # for the executable
    out: Optional[str]  # directory of all
    with_stops: bool  # whether times between stops are needed


@dataclass(frozen=True)
class Evaluation:
    head: Tuple[str, ...]  # lines of the table
    rows: Tuple[str, ...]
    remarks: Tuple[str, ...]  # lines below it: the verdict
    said: Tuple[str, ...]  # problems and alarms
    metrics_json: Optional[str]  # as it was written
    stops: Optional[object] = None  # StopTimes

    @property
    def metrics(self):
        return json.loads(self.metrics_json)


def evaluate(call, recording, order):
    if order.out:
        return evaluate_into(os.path.join(order.out, recording.name), call, recording, order)
    if order.with_stops:
        with tempfile.TemporaryDirectory(prefix="slipnav_evaluate_") as directory:
            return evaluate_into(directory, call, recording, order)
    return evaluation_of(recording, *call(command(recording, order)), None, None)


def evaluate_into(directory, call, recording, order):
    for name in ("metrics.json", "report.html"):  # of an earlier run, which this one may not overwrite
        if os.path.exists(os.path.join(directory, name)):
            os.remove(os.path.join(directory, name))
    output, errors = call(command(recording, order) + ["--out", directory])
    with open(os.path.join(directory, "metrics.json"), encoding="utf-8") as file:
        metrics_json = file.read()
    stops = None
    if order.with_stops:
        from .stops import read_stop_times  # needs numpy, which takes time to load

        stops = read_stop_times(directory)
    return evaluation_of(recording, output, errors, metrics_json, stops)


def command(recording, order):
    words = [order.executable, recording.parts[0]]
    for part in recording.parts[1:]:
        words += ["--part", part]
    return words + list(order.options)


def evaluation_of(recording, output, errors, metrics_json, stops):
    lines = output.splitlines()
    remark = stem(recording.parts[0]) + ": "
    rows = tuple(renamed(line, recording) for line in lines[HEAD_LINES:] if not line.startswith(remark))
    remarks = tuple(recording.name + ": " + line[len(remark):] for line in lines if line.startswith(remark))
    if not rows or not remarks:
        raise Failure("evaluate printed nothing")
    return Evaluation(tuple(lines[:HEAD_LINES]), rows, remarks, findings(errors.splitlines()), metrics_json, stops)


def renamed(line, recording):
    """A row of the table with the name of the recording instead of that of its first file."""
    own = stem(recording.parts[0])
    if own == recording.name or not line.startswith(own):
        return line
    width = max(NAME_WIDTH, len(own))
    return (recording.name + line[len(own):width].rstrip()).ljust(NAME_WIDTH) + line[width:]


def findings(lines):
    """What the program printed, without the lines about its plots."""
    return tuple(line[len(PROGRAM):] for line in lines if line.startswith(PROGRAM))


def reason(failure):
    text = str(failure)
    return text[len(PROGRAM):] if text.startswith(PROGRAM) else text
