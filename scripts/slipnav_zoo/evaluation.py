"""One recorded drive through `evaluate`, and what is read from its files."""

import csv
import json
import math
import os
import tempfile
from dataclasses import dataclass

import numpy as np

SHORTEST_REST_S = 1.5  # a stop that every filter should use
REST_SPEED_MPS = 0.002
LONGEST_GAP_S = 1.0  # between wheel samples, within a rest
NO_FORECASTS = "forecast.interval_s=60"  # they cost most of the time, and change no estimate


@dataclass(frozen=True)
class Evaluation:
    metrics: dict
    stops_seen: int  # wheels at rest
    stops_used: int  # of those, with zero updates
    largest_speed_mps: float  # of the estimate
    largest_wheel_mps: float

    @property
    def final_pct(self):
        return ratio(scaled(self.metrics["horizontal_final_m"], 100.0), self.metrics["distance_m"])


def scaled(value, factor):
    return None if value is None else factor * value


def ratio(value, reference):
    return None if value is None or not reference else value / reference


def read_columns(path, names):
    with open(path, newline="", encoding="ascii") as file:
        reader = csv.reader(file)
        heads = next(reader, [])
        places = [heads.index(name) for name in names]
        rows = [[row[place] for place in places] for row in reader]
    return dict(zip(names, np.array(rows, dtype=float).reshape(len(rows), len(names)).T))


def rests(time, speed):
    """(begin, end) of wheels at rest, without the rests before the first and after the last motion."""
    moving = np.abs(speed) > REST_SPEED_MPS
    found, begin, last_moving = [], None, None
    for t, moves in zip(time, moving):
        if moves:
            if begin is not None and last_moving is not None and t - begin >= SHORTEST_REST_S:
                found.append((begin, t))
            begin, last_moving = None, t
        elif begin is None:
            begin = t
    return found


def used(rest, time, stationary):
    inside = (time >= rest[0]) & (time <= rest[1])
    return bool(stationary[inside].any())


def read_evaluation(directory):
    with open(os.path.join(directory, "metrics.json"), encoding="utf-8") as file:
        metrics = json.load(file)
    wheels = read_columns(os.path.join(directory, "filter.csv"), ("t", "wheel_speed"))
    timeline = read_columns(os.path.join(directory, "timeline.csv"), ("t", "speed", "stationary"))
    found = rests(wheels["t"], wheels["wheel_speed"])
    return Evaluation(metrics, len(found), sum(used(rest, timeline["t"], timeline["stationary"]) for rest in found),
                      float(np.abs(timeline["speed"]).max(initial=0.0)),
                      float(np.nanmax(np.abs(wheels["wheel_speed"]), initial=0.0)))


def evaluate(call, executable, bag, configurations, settings=()):
    """Of a campaign."""
    with tempfile.TemporaryDirectory(prefix="slipnav_zoo_") as directory:
        command = [executable, bag, "--out", directory]
        for configuration in configurations:
            command += ["--config", configuration]
        for setting in (NO_FORECASTS,) + tuple(settings):
            command += ["--set", setting]
        call(command)
        return read_evaluation(directory)


def finite(value):
    return value is not None and math.isfinite(value)
