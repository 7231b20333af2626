"""One simulated drive: what to simulate, and what is read from its files."""

import csv
import json
import os
from dataclasses import asdict, dataclass
from typing import List, Optional, Tuple

import numpy as np

from slipnav_report.run_data import standstills

from .paper import AUTONOMOUS

HALF_EPOCH_S = 0.005


@dataclass(frozen=True)
class Drive:
    """Equal drives are run once, whoever asks for them."""

    terrain: str
    distance_m: float
    seed: int
    policy: str
    threshold_m: Optional[float] = None
    settings: Tuple[str, ...] = ()  # BLOCK.KEY=VALUE
    probe_after_stop_s: Optional[float] = None  # read the forecast that is made so long after the first stop
    with_stretches: bool = False  # also where the stops are not autonomous
    configurations: Tuple[str, ...] = ()  # YAML files
    with_forecasts: bool = False  # compare them with what came

    def __str__(self):
        settings = "".join(f" {setting}" for setting in
                           (*map(os.path.basename, self.configurations), *self.settings))
        threshold = "" if self.threshold_m is None else f" ε {self.threshold_m:g} m"
        return f"{self.terrain} {self.distance_m:g} m {self.policy}{threshold}{settings} seed {self.seed}"

    def arguments(self, directory):
        """For the executable `simulate`."""
        listed = ["--terrain", self.terrain, "--distance", f"{self.distance_m:g}", "--seed", str(self.seed),
                  "--policy", self.policy]
        if self.threshold_m is not None:
            listed += ["--threshold", f"{self.threshold_m:g}"]
        for configuration in self.configurations:
            listed += ["--config", configuration]
        for setting in self.settings:
            listed += ["--set", setting]
        return listed + ["--out", directory]


@dataclass(frozen=True)
class Stretch:
    """Driving between stops, from the start of the route to the first, or from the last to the end of the drive."""

    duration_s: float
    growth_m: Optional[float]  # largest horizontal length of the change of the error since its begin
    after_stop: bool
    ended_by_stop: bool


@dataclass(frozen=True)
class Promises:
    """Bounds on the growth since the last stop, and what came; only where no stop came before."""

    horizon_s: np.ndarray
    since_s: np.ndarray  # from the stop to the end of the horizon
    bound_m: np.ndarray
    growth_m: np.ndarray

    def at(self, horizon_s):
        chosen = self.horizon_s == horizon_s
        return Promises(*(getattr(self, key)[chosen] for key in ("horizon_s", "since_s", "bound_m", "growth_m")))


@dataclass(frozen=True)
class Outcome:
    metrics: dict
    stretches: List[Stretch]  # of autonomous drives, and where they were wanted
    time_to_stop_s: Optional[float]  # what the probed forecast says; infinite beyond its horizon
    promises: Optional[Promises] = None  # where they were wanted

    def as_json(self):
        time_to_stop_s = self.time_to_stop_s
        return {"metrics": self.metrics, "stretches": [asdict(stretch) for stretch in self.stretches],
                "time_to_stop_s": "beyond the horizon" if time_to_stop_s == np.inf else time_to_stop_s}


def read_outcome(drive, directory):
    """Raises OSError, ValueError or KeyError if the files are missing or malformed."""
    with open(os.path.join(directory, "metrics.json"), encoding="utf-8") as file:
        metrics = json.load(file)
    stretches, time_to_stop_s, promises = [], None, None
    wants_stretches = drive.policy == AUTONOMOUS or drive.with_stretches
    if wants_stretches or drive.with_forecasts or drive.probe_after_stop_s is not None:
        timeline = read_columns(os.path.join(directory, "timeline.csv"),
                                ("t", "est_e", "est_n", "truth_e", "truth_n", "stationary"))
        if wants_stretches:
            stretches = driving_stretches(timeline)
        if drive.probe_after_stop_s is not None:
            forecasts = read_columns(os.path.join(directory, "forecasts.csv"), ("t", "time_to_stop_s"))
            time_to_stop_s = probed_time_to_stop(timeline, forecasts, drive.probe_after_stop_s)
        if drive.with_forecasts:
            promises = kept_promises(timeline, read_columns(os.path.join(directory, "forecasts.csv"),
                                                            ("t", "horizon_s", "horizontal_bound_m")))
    return Outcome(metrics, stretches, time_to_stop_s, promises)


def read_columns(path, names):
    """Some columns of a table; the rest is not converted, which is most of the time that reading takes."""
    with open(path, newline="", encoding="ascii") as file:
        reader = csv.reader(file)
        heads = next(reader, [])
        places = [heads.index(name) for name in names]
        rows = [[row[place] for place in places] for row in reader]
    return dict(zip(names, np.array(rows, dtype=float).reshape(len(rows), len(names)).T))


def driving_stretches(timeline, with_growth=True):
    """In their order; growths need truth."""
    time = timeline["t"]
    error = None
    if with_growth:
        error = np.stack([timeline["est_" + axis] - timeline["truth_" + axis] for axis in "en"])
    stops = standstills(timeline)
    driving = np.flatnonzero(timeline["stationary"] < 0.5)
    if not len(driving):
        raise ValueError("the rover did not drive")
    begins = [driving[0]] + [end for _, end in stops]
    ends = [begin for begin, _ in stops] + [driving[-1]]  # the rest at the end is not driving
    return [Stretch(float(time[end] - time[begin]), growth(error[:, begin:end + 1]) if with_growth else None, i > 0,
                    i < len(stops))
            for i, (begin, end) in enumerate(zip(begins, ends))]


def kept_promises(timeline, forecasts):
    """Of the forecasts whose stretch of driving, after a stop, lasts to the end of the horizon."""
    time, stationary = timeline["t"], timeline["stationary"] > 0.5
    rest = np.maximum.accumulate(np.where(stationary, np.arange(len(time)), -1))  # the last estimate at rest
    ends = forecasts["t"] + forecasts["horizon_s"]
    made = np.searchsorted(time, forecasts["t"] - HALF_EPOCH_S)
    end = np.minimum(np.searchsorted(time, ends - HALF_EPOCH_S), len(time) - 1)
    kept = (ends <= time[-1] + HALF_EPOCH_S) & (rest[end] == rest[made]) & (rest[made] >= 0)
    stop, end = rest[made[kept]], end[kept]
    error = np.stack([timeline["est_" + axis] - timeline["truth_" + axis] for axis in "en"])
    growth_m = np.hypot(*(error[:, end] - error[:, stop]))
    known = np.isfinite(growth_m)
    return Promises(forecasts["horizon_s"][kept][known], (time[end] - time[stop])[known],
                    forecasts["horizontal_bound_m"][kept][known], growth_m[known])


def growth(error):
    """Largest change of the error [m] since the first epoch that truth covers."""
    known = error[:, np.isfinite(error).all(axis=0)]
    if not known.size:
        raise ValueError("no truth between two stops")
    return float(np.hypot(*(known - known[:, :1])).max())


def probed_time_to_stop(timeline, forecasts, after_s):
    """The first forecast made at least this long after the end of the first stop."""
    times = probed_times(timeline, forecasts, after_s)
    if not times:
        raise ValueError("the rover did not stop")
    if times[0] is None:
        raise ValueError(f"no forecast was made {after_s:g} s after the first stop and before the next")
    return times[0]


def probed_times(timeline, forecasts, after_s):
    """The same for each stop; infinite beyond the horizon, None where no forecast was made before the next stop."""
    time = timeline["t"]
    stops = standstills(timeline)
    begins = [time[begin] for begin, _ in stops[1:]] + [time[-1]]
    times = []
    for (_, end), until in zip(stops, begins):
        made = np.flatnonzero((forecasts["t"] >= time[end] + after_s) & (forecasts["t"] < until))
        if len(made):
            time_to_stop_s = float(forecasts["time_to_stop_s"][made[0]])
            times.append(np.inf if np.isnan(time_to_stop_s) else time_to_stop_s)
        else:
            times.append(None)
    return times
