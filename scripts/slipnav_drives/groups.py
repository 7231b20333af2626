"""The paper's tables and its figure of stop intervals, from recordings by group."""

import itertools

import matplotlib
import numpy as np

matplotlib.use("Agg")  # no display needed

from slipnav_campaign.task import Failure  # noqa: E402
from slipnav_report.page import png_of  # noqa: E402
from slipnav_tables import accuracy, intervals, paper  # noqa: E402
from slipnav_tables.section import NOT_KNOWN, Figure, Section, Table, figures_of, number  # noqa: E402
from slipnav_tables.statistics import median, worst  # noqa: E402

ERRORS = tuple(key for _, key, _ in accuracy.COLUMNS_1 if key not in ("distance_m", "stop_count", "duration_s"))
TITLES = {"forecast": f"Forecast time to the stop, {paper.COLLECTION_S:g} s after a stop",
          "real": "Actual time between stops"}
DOUBT = ("Every interval counts separately, since a group with a single recording has no other values. Those of one drive "
         "are not independent: the true p values are larger.")


def root_mean_square(values):
    known = [value for value in values if value is not None]
    return float(np.sqrt(np.mean(np.square(known)))) if known else None


STATISTICS = {"median": median, "rms": root_mean_square, "max": worst}


def judged(members, outcomes):
    return [one for one in members if not isinstance(outcomes[one], Failure)]


def names_text(recordings):
    return ", ".join(recording.name for recording in recordings)


def accuracy_section(groups, outcomes, simulated):
    rows, data = [], {}
    for name, members in groups.items():
        known = judged(members, outcomes)
        values = {key: figures_of(outcomes, known, key) for _, key, _ in accuracy.COLUMNS_1}
        data[name] = {key: {kind: of(values[key]) for kind, of in STATISTICS.items()} for key in values}
        for kind in STATISTICS:
            rows.append([name if kind == "median" else "", str(len(known)) if kind == "median" else "", kind]
                        + [NOT_KNOWN if kind == "rms" and key not in ERRORS else number(data[name][key][kind], decimals)
                           for _, key, decimals in accuracy.COLUMNS_1])
    rows += [[f"simulated, {name}", "", "median (max)"] + accuracy.simulated_cells(figures, accuracy.COLUMNS_1)
             for name, figures in simulated.get("table1", {}).items() if name != accuracy.BY_METHOD]
    rows += [[f"paper, {row.name}", "1", ""] + accuracy.paper_cells(row, accuracy.COLUMNS_1) for row in paper.TABLE_1]
    heads = ["group", "drives", ""] + [head for head, _, _ in accuracy.COLUMNS_1]
    notes = ["Over the recordings of a group, each of which counts once. The paper's rows are single drives."]
    for name, members in groups.items():
        without = [one for one in judged(members, outcomes) if outcomes[one].metrics["enu_error_pct"] is None]
        if without:
            notes.append(f"{name}: no errors for {names_text(without)}: no truth.")
    return Section("Table I: accuracy by group", [Table(heads, rows)], notes, data=data)


def stops_section(groups, outcomes, simulated):
    rows, data = [], {}
    for name, members in groups.items():
        known = judged(members, outcomes)
        data[name] = accuracy.summary(outcomes, known, accuracy.COLUMNS_2)
        rows.append([name, str(len(known)), ""] + accuracy.simulated_cells(data[name], accuracy.COLUMNS_2))
    for row in paper.TABLE_2:
        if row.name in simulated.get("table2", {}):
            rows.append([f"simulated, {row.name}", "", row.policy]
                        + accuracy.simulated_cells(simulated["table2"][row.name], accuracy.COLUMNS_2))
    rows += [[f"paper, {row.name}", "1", row.policy] + accuracy.paper_cells(row, accuracy.COLUMNS_2)
             for row in paper.TABLE_2]
    heads = ["group", "drives", "stops by"] + [head for head, _, _ in accuracy.COLUMNS_2]
    notes = ["Median over the recordings, the largest in brackets. How the rover was stopped, a recording does not "
             "say."]
    return Section("Table II: stops by group", [Table(heads, rows)], notes, data=data)


def seconds_of(stops, kind):
    """Times of one drive; a forecast beyond its horizon counts as the horizon."""
    if kind == "real":
        return list(stops.real_s)
    return [min(value, stops.horizon_s) for value in stops.forecast_s]


def kind_data(groups, outcomes, kind):
    """({group: its values}, whether each interval counts by itself, notes). Groups without a value are omitted."""
    found, notes = {}, []
    for name, members in groups.items():
        times = {one: seconds_of(outcomes[one].stops, kind) for one in judged(members, outcomes)}
        without = [one for one in times if not times[one]]
        if without:
            notes.append(f"{TITLES[kind]}, {name}: unknown for {names_text(without)}, "
                         + ("which have no two stops." if kind == "real" else
                            f"where no forecast follows a stop by {paper.COLLECTION_S:g} s before the next."))
        if len(without) < len(times):
            found[name] = [values for values in times.values() if values]
    single = any(len(drives) < 2 for drives in found.values())
    horizon_s = max((outcomes[one].stops.horizon_s for members in groups.values() for one in judged(members, outcomes)),
                    default=0.0)
    data = {}
    for name, drives in found.items():
        values = list(itertools.chain(*drives)) if single else [median(values) for values in drives]
        data[name] = {"intervals_s": values,
                      "at_least": sum(value >= horizon_s for value in values) if kind == "forecast" else 0}
    return data, single, notes


def beside(kinds, simulated):
    """The same with the grounds of simulated drives, which are not part of any test."""
    found = simulated.get("intervals", {})
    return {kind: {**data, **{f"{ground}, simulated": values
                              for ground, values in found.get(kind, {}).get("terrains", {}).items()}}
            for kind, data in kinds.items()}


def intervals_section(groups, outcomes, simulated):
    kinds, tests, titles, notes, doubt = {}, {}, {}, [], False
    for kind, title in TITLES.items():
        data, single, said = kind_data(groups, outcomes, kind)
        notes += said
        if not data:
            notes.append(f"{title}: unknown for every group.")
            continue
        kinds[kind], titles[kind] = data, title
        tests[kind] = intervals.tests_of(data) if len(data) > 1 else {"anova_p": None, "tukey_p": {}}
        doubt = doubt or single
        notes.append(f"{title}, order of the medians: {intervals.order_text(data)}."
                     + ("" if len(data) > 1 else " With one group there is nothing to compare."))
    notes.insert(0, DOUBT if doubt else "A recording counts once, with the median of its intervals.")
    if not kinds:
        return Section("Stop intervals by group", [], notes[1:])
    pairs = list(itertools.combinations(groups, 2))
    shown = beside(kinds, simulated)
    tables = [intervals.interval_table(shown, titles), intervals.significance_table(tests, titles, pairs)]
    figure = Figure("stop_intervals", "Stop intervals by group", png_of(intervals.draw(shown, titles)))
    data = {kind: {"groups": kinds[kind], "anova_p": tests[kind]["anova_p"],
                   "tukey_p": {"/".join(pair): p for pair, p in tests[kind]["tukey_p"].items()}} for kind in kinds}
    return Section("Stop intervals by group", tables, notes, [figure], data)


def sections_of(groups, outcomes, simulated=None):
    """{name: Section}. `groups`: {name: recordings}; `outcomes`: {recording: Evaluation or Failure}; `simulated`: the
    sections of a tables.json."""
    sections = {name: section(groups, outcomes, simulated or {})
                for name, section in (("accuracy", accuracy_section), ("stops", stops_section),
                                      ("intervals", intervals_section))}
    for name, members in groups.items():
        failed = [one for one in members if isinstance(outcomes[one], Failure)]
        if failed:
            sections["accuracy"].notes.append(f"{name}: without {names_text(failed)}, which failed.")
    return sections
