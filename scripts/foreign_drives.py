#!/usr/bin/python3
"""Evaluates third-party drives, each configured only by the data sheet of its sensor, next to simpler methods.

Prints a table, and below it the limits that are broken; ends with status 1 if one is. Drives whose file is not
there are skipped by name.
"""

import argparse
import os
import shutil
import statistics
import sys

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from slipnav_campaign import engine  # noqa: E402
from slipnav_campaign.task import Failure, Task  # noqa: E402
from slipnav_zoo import catalog  # noqa: E402
from slipnav_zoo.evaluation import evaluate, ratio  # noqa: E402
from slipnav_zoo.table import Limits, markdown, number  # noqa: E402

HEADS = ["drive", "m", "ENU %", "final %", "NEES", "3σ %", "stops", "used", "wheels+gyro %", "textbook %", "ratio",
         "bound / grown", "held %"]

FORECASTS = "forecast.interval_s=1"
LARGEST_RATIO = 1.2  # to the textbook filter, or to wheels and gyro
LARGEST_MEDIAN_RATIO = 1.0
SPARE_PCT = 0.3  # of the distance, over wheels and gyro on real drives
LARGEST_NEES = 4.0
MEDIAN_NEES = (0.2, 2.0)
LEAST_COVERAGE_PCT = 95.0
FEWEST_FORECASTS = 10  # that can be judged
BOUND_RATIO_SIMULATED = (0.0, 5.0)  # 3 is exact
BOUND_RATIO_REAL = (2.5, 6.0)
LEAST_HELD_PCT = 98.0


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        self.exit(2, f"foreign: {message}\n")


def parse_arguments():
    here = os.path.dirname(os.path.abspath(__file__))
    parser = Parser(prog="foreign", description=__doc__.splitlines()[0])
    parser.add_argument("--data", default=os.path.join(here, "..", "..", "shared", "data"), metavar="DIR",
                        help="where the recordings and their configurations are (default %(default)s)")
    parser.add_argument("--config-dir", default=os.path.join(here, "..", "config"), metavar="DIR",
                        help="where configurations are that are not next to the recordings (default %(default)s)")
    parser.add_argument("--only", metavar="TEXT", default="", help="drives whose name contains this")
    parser.add_argument("--set", action="append", default=[], metavar="BLOCK.KEY=VALUE",
                        help="one setting, for every drive; for experiments")
    engine.add_options(parser)
    parser.add_argument("--out", metavar="FILE.md", help="also write the table here")
    parser.add_argument("--evaluate", default=shutil.which("evaluate"), metavar="FILE", help="the executable")
    arguments = parser.parse_args()
    if not arguments.evaluate or not os.access(arguments.evaluate, os.X_OK):
        parser.error(f"no executable '{arguments.evaluate or 'evaluate'}', name it by --evaluate")
    if not os.path.isdir(arguments.data):
        parser.error(f"no folder '{arguments.data}', name it by --data")
    return arguments


def find(name, *folders):
    for folder in folders:
        path = os.path.join(folder, name)
        if os.path.isfile(path):
            return path
    return None


def task_of(drive, arguments):
    """None if its files are missing."""
    bag = find(drive.bag + ".bag", arguments.data)
    configurations = [find(name, arguments.data, arguments.config_dir) for name in drive.configurations]
    if bag is None or None in configurations:
        return None
    return Task(drive.bag, evaluate, (arguments.evaluate, bag, configurations, [FORECASTS] + arguments.set),
                os.path.getsize(bag))


def evaluate_all(drives, arguments):
    """{drive: Evaluation, Failure, or None if its files are missing}"""
    tasks = {drive: task_of(drive, arguments) for drive in drives}
    there = {drive: task for drive, task in tasks.items() if task is not None}
    with engine.pool_of(arguments) as pool:
        outcomes = dict(zip(there, engine.run_all(list(there.values()), pool)))
    return {drive: outcomes.get(drive) for drive in drives}


def row(drive, outcome):
    if outcome is None or isinstance(outcome, Failure):
        return [drive.bag, "not there" if outcome is None else "failed"] + ["-"] * (len(HEADS) - 2)
    metrics = outcome.metrics
    compared = (ratio(metrics["enu_error_pct"], drive.textbook_pct) if drive.simulated
                else ratio(outcome.final_pct, drive.wheels_and_gyro_pct))
    return [drive.bag, number(metrics["distance_m"], 0), number(metrics["enu_error_pct"], 3),
            number(outcome.final_pct, 3), number(metrics["position_nees_mean"]),
            number(metrics["coverage_3sigma_pct"], 1), str(outcome.stops_seen), str(outcome.stops_used),
            number(drive.wheels_and_gyro_pct), number(drive.textbook_pct), number(compared),
            number(bound_ratio(metrics)), number(metrics["forecast_below_pct"], 1)]


def bound_ratio(metrics):
    """The forecast bound of three standard deviations over the error that has grown by the end of its horizon."""
    return ratio(metrics["forecast_bound_m"], metrics["forecast_growth_rms_m"])


def check(drive, outcome, limits):
    if isinstance(outcome, Failure):
        limits.fail(drive.bag, str(outcome))
        return
    metrics = outcome.metrics
    least, largest = BOUND_RATIO_SIMULATED if drive.simulated else BOUND_RATIO_REAL
    if metrics["forecasts_judged"] >= FEWEST_FORECASTS:
        limits.at_least(drive.bag, "forecast bound / grown", bound_ratio(metrics), least)
        limits.at_most(drive.bag, "forecast bound / grown", bound_ratio(metrics), largest)
        limits.at_least(drive.bag, "forecast bound held %", metrics["forecast_below_pct"], LEAST_HELD_PCT)
    if drive.simulated:
        limits.at_most(drive.bag, "ENU error %", metrics["enu_error_pct"], LARGEST_RATIO * drive.textbook_pct)
        limits.at_most(drive.bag, "NEES", metrics["position_nees_mean"], LARGEST_NEES)
    elif drive.wheels_and_gyro_pct is not None:
        limits.at_most(drive.bag, "final error %", outcome.final_pct,
                       LARGEST_RATIO * drive.wheels_and_gyro_pct + SPARE_PCT)
    else:
        limits.at_most(drive.bag, "final error m", metrics["horizontal_final_m"], drive.largest_final_m)
        return  # truth good to meters, with lasting errors, says nothing about 3σ
    limits.at_least(drive.bag, "coverage of 3σ %", metrics["coverage_3sigma_pct"], LEAST_COVERAGE_PCT)
    limits.at_least(drive.bag, "used stops", outcome.stops_used, outcome.stops_seen)


def check_medians(outcomes, limits):
    ratios, nees = [], []
    for drive, outcome in outcomes.items():
        if drive.simulated and outcome is not None and not isinstance(outcome, Failure):
            ratios.append(ratio(outcome.metrics["enu_error_pct"], drive.textbook_pct))
            nees.append(outcome.metrics["position_nees_mean"])
    if ratios and None not in ratios + nees:
        limits.at_most("median", "ratio to the textbook", statistics.median(ratios), LARGEST_MEDIAN_RATIO)
        limits.at_least("median", "NEES", statistics.median(nees), MEDIAN_NEES[0])
        limits.at_most("median", "NEES", statistics.median(nees), MEDIAN_NEES[1])


def campaign(arguments):
    outcomes = evaluate_all([drive for drive in catalog.ALL if arguments.only in drive.bag], arguments)
    limits = Limits()
    for drive, outcome in outcomes.items():
        if outcome is not None:
            check(drive, outcome, limits)
    check_medians(outcomes, limits)
    table = markdown(HEADS, [row(drive, outcome) for drive, outcome in outcomes.items()])
    print(table + "\n\n" + limits.text())
    if arguments.out:
        with open(arguments.out, "w", encoding="utf-8") as file:
            file.write(table + "\n")
    return 1 if limits.broken else 0


def main():
    arguments = parse_arguments()
    return engine.status_of(lambda: campaign(arguments), lambda text: print(f"foreign: {text}", file=sys.stderr))


if __name__ == "__main__":
    sys.exit(main())
