"""Cells of a grid of speeds, rates, grounds and sensors, drawn once."""

import itertools
import random

from slipnav_campaign.task import Failure

from .simulation import STOPS, Drive, groups, mean, values
from .table import Limits, markdown, number

HEADS = ["m/s", "encoders Hz", "IMU Hz", "world", "grade", "stamps", "ENU %", "NEES", "3σ %", ""]

SPEEDS_MPS = (0.04, 0.1, 0.8, 3.0)
DISTANCES_M = {0.04: 8.0, 0.1: 20.0, 0.8: 120.0, 3.0: 400.0}
SLOW_MPS = 0.5  # the start takes minutes: it needs no more fixes than a fast one
ENCODERS_HZ = (2, 10, 100)
IMU_HZ = (50, 200, 1000)
WORLDS = ("paved", "rough", "sand", "slope_firm")
GRADES = ("tactical", "mems")
JITTER_S = (0.0, 0.001)
DRAW_SEED = 14
CELLS = 60
SEEDS = 4

GOOD = (2.0, 97.0)  # largest NEES, least coverage in %
LEAST_GOOD = 57
FAIR = (4.0, 93.0)  # in all


def cells(count=CELLS):
    """The same at every call."""
    every = list(itertools.product(SPEEDS_MPS, ENCODERS_HZ, IMU_HZ, WORLDS, GRADES, JITTER_S))
    return random.Random(DRAW_SEED).sample(every, CELLS)[:count]


def settings(cell):
    speed, encoders, imu, _, _, jitter = cell
    listed = [f"simulator.drive.speed_mps={speed:g}", f"simulator.drive.distance_m={DISTANCES_M[speed]:g}",
              f"simulator.encoder.rate_hz={encoders}", f"simulator.imu.rate_hz={imu}"]
    if speed < SLOW_MPS:
        listed.append("simulator.gps.rate_hz=1")
    if jitter:
        listed += [f"simulator.{sensor}.host_stamps.noise_s={jitter:g}" for sensor in ("imu", "encoder")]
    return tuple(listed)


def drives(count=CELLS, seeds=SEEDS):
    return [Drive(cell[3], cell[4], STOPS, seed, settings(cell))
            for cell in cells(count) for seed in range(1, seeds + 1)]


def grade_of(nees, coverage_pct):
    for name, (largest, least) in (("good", GOOD), ("fair", FAIR)):
        if nees <= largest and coverage_pct >= least:
            return name
    return "broken"


def report(outcomes, count=CELLS):
    limits = Limits()
    rows, good = [], 0
    found = groups(outcomes)
    for cell in cells(count):
        key = (cell[3], cell[4], STOPS, settings(cell))
        who = " ".join(f"{value:g}" if isinstance(value, (int, float)) else value for value in cell)
        figures = []
        for drive, outcome in found[key]:
            if isinstance(outcome, Failure):
                limits.fail(who + f" seed {drive.seed}", str(outcome))
            else:
                figures.append(outcome)
        nees = mean(values(figures, "position_nees_mean"))
        coverage_pct = mean(values(figures, "coverage_3sigma_pct"))
        verdict = grade_of(nees, coverage_pct) if len(figures) == len(found[key]) else "failed"
        good += verdict == "good"
        if verdict in ("broken", "failed"):
            limits.fail(who, f"NEES {number(nees)}, coverage {number(coverage_pct, 1)} %")
        rows.append([f"{cell[0]:g}", str(cell[1]), str(cell[2]), cell[3], cell[4], "jitter" if cell[5] else "true",
                     number(mean(values(figures, "enu_error_pct")), 3), number(nees), number(coverage_pct, 1), verdict])
    if good * CELLS < LEAST_GOOD * len(rows):
        limits.fail("grid", f"{good} of {len(rows)} cells are good, not {LEAST_GOOD} of {CELLS}")
    return markdown(HEADS, rows), limits
