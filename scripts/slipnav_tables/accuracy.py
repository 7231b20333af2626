"""Tables I and II: drives like those of the paper, over seeds, next to the paper's rows."""

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
SIMULATED = "simulated"


def seeds_of(options):
    return range(1, options.seeds + 1)


def drives_1(row, options):
    return [Drive("rough", row.distance_m, seed, paper.AUTONOMOUS, row.threshold_m) for seed in seeds_of(options)]


def threshold_2(row):
    if row.policy != paper.AUTONOMOUS:
        return None
    return ASSUMED_THRESHOLD_M if row.threshold_m is None else row.threshold_m


def drives_2(row, options):
    return [Drive(row.terrain, row.distance_m, seed, row.policy, threshold_2(row)) for seed in seeds_of(options)]


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


def count_text(outcomes, drives):
    return f"{SIMULATED}, {len(succeeded(outcomes, drives))} drives"


class Table1:
    NAME = "table1"

    @staticmethod
    def drives(options):
        return [drive for row in paper.TABLE_1 for drive in drives_1(row, options)]

    @staticmethod
    def section(outcomes, options):
        rows, data = [], {}
        for row in paper.TABLE_1:
            drives = drives_1(row, options)
            data[row.name] = summary(outcomes, drives, COLUMNS_1)
            rows.append([row.name, f"{row.threshold_m:g}", "paper"] + paper_cells(row, COLUMNS_1))
            rows.append(["", "", count_text(outcomes, drives)] + simulated_cells(data[row.name], COLUMNS_1))
        table = Table(["", "ε m", ""] + [head for head, _, _ in COLUMNS_1], rows)
        return Section("Table I: autonomous stops on rough ground", [table],
                       ["Simulated: median over the seeds, in brackets the largest. One drive of the paper each."],
                       data=data)


def mean_stop_rate(rates):
    return float(np.mean(rates)) if rates and None not in rates else None


def lower_by_text(name, periodic, autonomous):
    if not periodic or autonomous is None:
        return f"{name}: unknown"
    return f"{name}: {periodic:.2f} % → {autonomous:.2f} %, lower by {100 * (1 - autonomous / periodic):.0f} %"


class Table2:
    NAME = "table2"

    @staticmethod
    def drives(options):
        return [drive for row in paper.TABLE_2 for drive in drives_2(row, options)]

    @staticmethod
    def section(outcomes, options):
        rows, data = [], {}
        for row in paper.TABLE_2:
            drives = drives_2(row, options)
            data[row.name] = summary(outcomes, drives, COLUMNS_2)
            rows.append([row.name, row.policy, "paper"] + paper_cells(row, COLUMNS_2))
            rows.append(["", "", count_text(outcomes, drives)] + simulated_cells(data[row.name], COLUMNS_2))
        table = Table(["", "stops by", ""] + [head for head, _, _ in COLUMNS_2], rows)
        rates = {policy: ([row.stop_rate_pct for row in paper.TABLE_2 if row.policy == policy],
                          [data[row.name]["stop_rate_pct"]["median"] for row in paper.TABLE_2 if row.policy == policy])
                 for policy in (paper.PERIODIC, paper.AUTONOMOUS)}
        compared = "; ".join(lower_by_text(name, *(mean_stop_rate(rates[policy][i]) for policy in rates))
                             for i, name in enumerate(("paper", SIMULATED)))
        notes = [
            "Simulated: median over the seeds, in brackets the largest. Autonomous stops at ε = "
            f"{ASSUMED_THRESHOLD_M:g} m, which the paper says for Rough_B alone.",
            f"Mean stop rate of the periodic rows → of the autonomous rows. {compared}.",
        ]
        return Section("Table II: periodic and autonomous stops", [table], notes, data=data)
