"""Simulated drives as tasks of a campaign."""

import tempfile

from slipnav_campaign.engine import run_all
from slipnav_campaign.task import Task

from .drive import read_outcome


def simulate(call, executable, drive):
    with tempfile.TemporaryDirectory(prefix="slipnav_tables_") as directory:
        call([executable] + drive.arguments(directory))
        return read_outcome(drive, directory)


def drive_all(executable, drives, pool):
    """{drive: Outcome or Failure}"""
    tasks = [Task(str(drive), simulate, (executable, drive), drive.distance_m) for drive in drives]
    return dict(zip(drives, run_all(tasks, pool)))
