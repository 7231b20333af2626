"""One simulated drive in a named world, and its figures."""

import json
import math
import os
import statistics
import subprocess
import tempfile
from dataclasses import dataclass
from typing import Tuple

from slipnav_campaign.engine import run_all
from slipnav_campaign.task import Task

from .evaluation import NO_FORECASTS, ratio, scaled

NO_STOPS = "none"
STOPS = "periodic:60:5"


@dataclass(frozen=True)
class Drive:
    world: str
    grade: str
    policy: str
    seed: int
    settings: Tuple[str, ...] = ()

    def __str__(self):
        return f"{self.world}, {self.grade}, {self.policy}, seed {self.seed}"

    def arguments(self, figures):
        listed = ["--world", self.world, "--grade", self.grade, "--policy", self.policy, "--seed", str(self.seed),
                  "--figures", figures]
        for setting in (NO_FORECASTS,) + self.settings:
            listed += ["--set", setting]
        return listed


@dataclass(frozen=True)
class Figures:
    metrics: dict
    simulation: dict

    @property
    def final_pct(self):
        return ratio(scaled(self.metrics["horizontal_final_m"], 100.0), self.metrics["distance_m"])

    @property
    def alarms(self):
        return [alarm["what"] for alarm in self.simulation["alarms"]]


def simulate(call, executable, drive):
    with tempfile.TemporaryDirectory(prefix="slipnav_zoo_") as directory:
        path = os.path.join(directory, "figures.json")
        call([executable] + drive.arguments(path))
        with open(path, encoding="utf-8") as file:
            read = json.load(file)
    return Figures(read["metrics"], read["simulation"])


def drive_all(executable, drives, pool):
    """{drive: Figures or Failure}, in the order of the drives."""
    tasks = [Task(str(drive), simulate, (executable, drive)) for drive in drives]
    return dict(zip(drives, run_all(tasks, pool)))


def names(executable, kind):
    """Available worlds or grades."""
    listed = subprocess.run([executable, "--" + kind, "list"], check=True, capture_output=True, text=True)
    return listed.stdout.split()


def values(figures, key):
    """Of metrics or simulation figures, infinite where there is none."""
    found = []
    for one in figures:
        value = one.metrics.get(key, one.simulation.get(key))
        found.append(math.inf if value is None else value)
    return found


def mean(numbers):
    return statistics.fmean(numbers) if numbers else math.nan


def groups(outcomes):
    """{(world, grade, policy, settings): [(drive, outcome), …]}."""
    found = {}
    for drive, outcome in outcomes.items():
        found.setdefault((drive.world, drive.grade, drive.policy, drive.settings), []).append((drive, outcome))
    return found
