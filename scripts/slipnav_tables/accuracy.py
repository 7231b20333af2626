"""Tables I and II: drives like those of the paper, by its method and by slipnav, over seeds, next to the paper's rows."""

import os
from dataclasses import replace

import numpy as np

from . import paper
from .drive import Drive
from .section import NOT_KNOWN, Section, Table, figures_of, number, succeeded
from .statistics import median, worst

# Heading, key in metrics.json and in the paper's rows, decimals.
COLUMNS_1 = (
    ("D m", "distance_m", 0), ("stops", "stop_count", 0), ("T s", "duration_s", 0), ("ENU %", "enu_error_pct", 2),
    ("median %", "median_error_pct", 2), ("horiz. median m", "horizontal_median_m", 2),
    ("std m", "horizontal_std_m", 2), ("max m", "horizontal_max_m", 2), ("RMS east m", "rms_east_m", 2),
    ("north m", "rms_north_m", 2), ("up m", "rms_up_m", 2),
)
COLUMNS_2 = (
    ("D m", "distance_m", 0), ("T s", "duration_s", 0), ("ENU %", "enu_error_pct", 2),
    ("stop rate %", "stop_rate_pct", 2), ("stops", "stop_count", 0),
)
ASSUMED_THRESHOLD_M = 2.0  # of Table II, which gives none; the one of Rough_B, which is Test5 of Table I
METHOD = "the paper's method"
BY_METHOD = "by_the_papers_method"  # its figures in tables.json
DRIVEN = ("One drive of the paper each; next to it simulated drives: by the paper's method (config/paper.yaml) and by "
          "slipnav, median over the seeds, in brackets the maximum.")
SIMULATED = "slipnav"


def configuration_of_method():
    """config/paper.yaml next to the scripts, in the source tree or as installed."""
    scripts = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    installed = os.path.join(scripts, "..", "..", "share", "slipnav", "config", "paper.yaml")
    return os.path.normpath(installed if os.path.exists(installed) else
                            os.path.join(scripts, "..", "config", "paper.yaml"))


def seeds_of(options):
    return range(1, options.seeds + 1)


def by_method(drives):
    """The same drives by the paper's method."""
    configuration = configuration_of_method()
    return [replace(drive, configurations=(configuration,)) for drive in drives]


def drives_1(row, options):
    """{whose: drives}"""
    drives = [Drive("rough", row.distance_m, seed, paper.AUTONOMOUS, row.threshold_m) for seed in seeds_of(options)]
    return {METHOD: by_method(drives), SIMULATED: drives}


def threshold_2(row):
    if row.policy != paper.AUTONOMOUS:
        return None
    return ASSUMED_THRESHOLD_M if row.threshold_m is None else row.threshold_m


def drives_2(row, options):
    """{whose: drives}"""
    drives = [Drive(row.terrain, row.distance_m, seed, row.policy, threshold_2(row)) for seed in seeds_of(options)]
    return {METHOD: by_method(drives), SIMULATED: drives}


def rows_beside(outcomes, drives_by, columns, heads):
    """([the cells of each kind of drive], {kind: summary}); `heads`: number of cells before them."""
    summaries = {whose: summary(outcomes, drives, columns) for whose, drives in drives_by.items()}
    rows = [[""] * heads + [count_text(whose, outcomes, drives_by[whose])] + simulated_cells(figures, columns)
            for whose, figures in summaries.items()]
    return rows, summaries


def summary(outcomes, drives, columns):
    """Median and worst of each column by its key."""
    values = {key: figures_of(outcomes, drives, key) for _, key, _ in columns}
    return {key: {"median": median(values[key]), "worst": worst(values[key])} for key in values}


def simulated_cells(figures, columns):
    """`median (worst)`; distances are all but equal, and have no worst."""
    cells = []
    for _, key, decimals in columns:
        middle, most = (number(figures[key][which], decimals) for which in ("median", "worst"))
        cells.append(middle if key == "distance_m" or middle == NOT_KNOWN else f"{middle} ({most})")
    return cells


def paper_cells(row, columns):
    return [number(getattr(row, key), decimals) for _, key, decimals in columns]


def count_text(whose, outcomes, drives):
    return f"{whose}, {len(succeeded(outcomes, drives))} drives"


def all_drives(drives_by):
    return [drive for drives in drives_by.values() for drive in drives]


class Table1:
    NAME = "table1"

    @staticmethod
    def drives(options):
        return [drive for row in paper.TABLE_1 for drive in all_drives(drives_1(row, options))]

    @staticmethod
    def section(outcomes, options):
        rows, data, by_paper = [], {}, {}
        for row in paper.TABLE_1:
            beside, summaries = rows_beside(outcomes, drives_1(row, options), COLUMNS_1, 2)
            data[row.name], by_paper[row.name] = summaries[SIMULATED], summaries[METHOD]
            rows += [[row.name, f"{row.threshold_m:g}", "paper"] + paper_cells(row, COLUMNS_1)] + beside
        table = Table(["", "ε m", ""] + [head for head, _, _ in COLUMNS_1], rows)
        return Section("Table I: autonomous stops on rough ground", [table],
                       [DRIVEN], data={**data, BY_METHOD: by_paper})


def mean_stop_rates(rate_of):
    """Of the periodic and of the autonomous rows; None if one is unknown."""
    rates = [[rate_of(row) for row in paper.TABLE_2 if row.policy == policy]
             for policy in (paper.PERIODIC, paper.AUTONOMOUS)]
    return [None if None in of_policy else float(np.mean(of_policy)) for of_policy in rates]


def lower_by_text(name, periodic, autonomous):
    if not periodic or autonomous is None:
        return f"{name}: unknown"
    return f"{name}: {periodic:.2f} % → {autonomous:.2f} %, lower by {100 * (1 - autonomous / periodic):.0f} %"


class Table2:
    NAME = "table2"

    @staticmethod
    def drives(options):
        return [drive for row in paper.TABLE_2 for drive in all_drives(drives_2(row, options))]

    @staticmethod
    def section(outcomes, options):
        rows, data, by_paper = [], {}, {}
        for row in paper.TABLE_2:
            beside, summaries = rows_beside(outcomes, drives_2(row, options), COLUMNS_2, 2)
            data[row.name], by_paper[row.name] = summaries[SIMULATED], summaries[METHOD]
            rows += [[row.name, row.policy, "paper"] + paper_cells(row, COLUMNS_2)] + beside
        table = Table(["", "stops by", ""] + [head for head, _, _ in COLUMNS_2], rows)
        compared = "; ".join(lower_by_text(whose, *mean_stop_rates(rate_of)) for whose, rate_of in (
            ("paper", lambda row: row.stop_rate_pct),
            (METHOD, lambda row: by_paper[row.name]["stop_rate_pct"]["median"]),
            (SIMULATED, lambda row: data[row.name]["stop_rate_pct"]["median"])))
        notes = [
            f"{DRIVEN} Autonomous stops at ε = {ASSUMED_THRESHOLD_M:g} m, which the paper gives only for Rough_B.",
            f"Mean stop rate of the periodic rows → of the autonomous rows. {compared}.",
        ]
        return Section("Table II: periodic and autonomous stops", [table], notes,
                       data={**data, BY_METHOD: by_paper})
