"""Reads the output directory of a run."""

import csv
import json
import os

import numpy as np

MOST_POINTS = 6000  # of one curve; more cannot be seen
STANDSTILL_GAP_S = 0.5


class RunData:
    """The files of one run as arrays by column; a table without rows is empty but has its columns.

    `t` is relative to the first estimate. `smoothed` is None for a run without --smooth; `compared` has the tracks of
    other systems by name.
    """

    def __init__(self, directory):
        def table(name):
            return read_table(os.path.join(directory, name))

        self.directory = directory
        self.timeline = table("timeline.csv")
        if not len(self.timeline["t"]):
            raise ValueError(f"{os.path.join(directory, 'timeline.csv')}: has no rows")
        self.start = self.timeline["t"][0]
        self.filter = table("filter.csv")
        self.wheel_track = table("wheel_track.csv")
        self.nees = table("nees.csv")
        self.forecasts = table("forecasts.csv")
        self.slip_forecasts = table("slip_forecasts.csv")
        self.truth = read_tum(os.path.join(directory, "truth.tum"))
        with open(os.path.join(directory, "metrics.json"), encoding="utf-8") as file:
            self.metrics = json.load(file)
        for one in (self.filter, self.wheel_track, self.nees, self.forecasts, self.slip_forecasts, self.truth):
            one["t"] = one["t"] - self.start
        self.timeline["t"] = self.timeline["t"] - self.start
        covered = (self.truth["t"] >= 0.0) & (self.truth["t"] <= self.timeline["t"][-1])
        self.truth = {name: column[covered] for name, column in self.truth.items()}
        self.smoothed = None
        if os.path.exists(os.path.join(directory, "smoothed.csv")):
            self.smoothed = table("smoothed.csv")
            self.smoothed["t"] = self.smoothed["t"] - self.start
        self.compared = {name: table(f"compare_{name}.csv") for name in self.metrics.get("compared", {})}
        for track in self.compared.values():
            track["t"] = track["t"] - self.start

    def stops(self):
        """Standstills as (begin, end, east, north)."""
        line = self.timeline
        return [(line["t"][begin], line["t"][end], line["est_e"][begin], line["est_n"][begin])
                for begin, end in standstills(line)]

    def errors(self):
        """East, north and up error at each epoch of the timeline; NaN without truth."""
        return errors_of(self.timeline)


def errors_of(line):
    return np.stack([line["est_" + axis] - line["truth_" + axis] for axis in "enu"])


def standstills(timeline):
    """Rows (begin, end) of each standstill, end being the first row after it; those of the first and last epoch are no
    stops."""
    edges = np.flatnonzero(np.diff((timeline["stationary"] > 0.5).astype(int))) + 1
    if timeline["stationary"][0] > 0.5:
        edges = edges[1:]
    return [(begin, end) for begin, end in zip(edges[0::2], edges[1::2])
            if timeline["t"][end] - timeline["t"][begin] >= STANDSTILL_GAP_S]


def read_table(path):
    with open(path, newline="", encoding="ascii") as file:
        rows = list(csv.reader(file))
    values = np.array(rows[1:], dtype=float).reshape(len(rows) - 1, len(rows[0]))
    return dict(zip(rows[0], values.T))


def read_tum(path):
    """Columns t, e, n, u of a TUM file; empty where there is none."""
    if not os.path.exists(path):
        return {name: np.zeros(0) for name in ("t", "e", "n", "u")}
    with open(path, encoding="ascii") as file:
        rows = [line.split()[:4] for line in file if line.strip() and not line.startswith("#")]
    return dict(zip(("t", "e", "n", "u"), np.array(rows, dtype=float).reshape(-1, 4).T))


def thinned(*columns):
    """The columns with as many rows as a plot can show."""
    stride = max(1, -(-len(columns[0]) // MOST_POINTS))
    return tuple(column[::stride] for column in columns)


def single_forecasts(table):
    """Of overlapping forecasts, each that starts where the previous one ends: a list of index arrays into the table."""
    starts, first = np.unique(table["t"], return_index=True)
    chosen = []
    free_from = -np.inf
    for start, begin, end in zip(starts, first, np.append(first[1:], len(table["t"]))):
        if start >= free_from:
            chosen.append(np.arange(begin, end))
            free_from = start + table["horizon_s"][end - 1]
    return chosen
