"""The figure of stop intervals by ground, with analysis of variance and Tukey's test."""

import itertools

import matplotlib.pyplot as plt
import numpy as np

from slipnav_report import palette
from slipnav_report.page import png_of

from . import paper
from .drive import Drive
from .section import NOT_KNOWN, Figure, Section, Table, number, succeeded
from .statistics import anova_p, median, p_text, tukey_p

# A drive that stops once in time to forecast after it; 15 s of driving are 12 m.
FORECAST_POLICY = "periodic:40:3"
FORECAST_DISTANCE_M = 60.0
HORIZON_S = 300.0  # far enough that few forecasts stay below the threshold up to it
DRIVE_DISTANCE_M = 300.0
BOX_COLOURS = (palette.SAFE, palette.STOP, palette.TRUTH, palette.ERROR)


def forecast_drives(terrain, options):
    return [Drive(terrain, FORECAST_DISTANCE_M, seed, FORECAST_POLICY, options.interval_threshold_m,
                  (f"forecast.horizon_s={HORIZON_S:g}",), paper.COLLECTION_S)
            for seed in range(1, options.interval_tests + 1)]


def real_drives(terrain, options):
    return [Drive(terrain, DRIVE_DISTANCE_M, seed, paper.AUTONOMOUS, options.interval_threshold_m)
            for seed in range(1, options.interval_tests + 1)]


def forecast_interval(outcome):
    """Seconds, and whether they are only known to be more."""
    return min(outcome.time_to_stop_s, HORIZON_S), outcome.time_to_stop_s == np.inf


def real_interval(outcome):
    """The median interval between stops of a drive; where no interval is complete, the longest drive without a stop."""
    complete = [stretch.duration_s for stretch in outcome.stretches if stretch.after_stop and stretch.ended_by_stop]
    if complete:
        return median(complete), False
    return max(stretch.duration_s for stretch in outcome.stretches), True


KINDS = (
    ("forecast", "Forecast time to the stop, 15 s after a stop", forecast_drives, forecast_interval),
    ("real", "Actual time between stops, median of each drive", real_drives, real_interval),
)
TITLES = {name: title for name, title, _, _ in KINDS}


def kind_data(outcomes, options, drives_of, interval_of):
    data = {}
    for terrain in paper.TERRAINS:
        found = [interval_of(outcome) for outcome in succeeded(outcomes, drives_of(terrain, options))]
        data[terrain] = {"intervals_s": [value for value, _ in found], "at_least": sum(more for _, more in found)}
    return data


def tests_of(data):
    """ANOVA's and Tukey's p values; None if unknown."""
    groups = {ground: data[ground]["intervals_s"] for ground in data}
    return {"anova_p": anova_p(list(groups.values())), "tukey_p": tukey_p(groups)}


def interval_table(kinds, titles):
    rows = []
    for name, title in titles.items():
        for ground, found in kinds[name].items():
            values = found["intervals_s"]
            quartiles = np.percentile(values, (25, 50, 75, 0, 100)) if values else [None] * 5
            rows.append([title, ground, str(len(values))] + [number(value, 1) for value in quartiles]
                        + [str(found["at_least"])])
    return Table(["seconds", "ground", "values", "lower quartile", "median", "upper quartile", "least", "most",
                  "no stop seen"], rows)


def significance_table(tests, titles, pairs):
    heads = ["p", "paper"] + list(titles.values())
    rows = [["ANOVA", "-"] + [p_text(tests[name]["anova_p"]) for name in titles]]
    for pair in pairs:
        rows.append(["/".join(pair), paper.TUKEY_P.get(pair, NOT_KNOWN)]
                    + [p_text(tests[name]["tukey_p"].get(pair)) for name in titles])
    return Table(heads, rows, "One-way analysis of variance, and Tukey's test of each pair of grounds")


def order_text(data):
    medians = {ground: median(data[ground]["intervals_s"]) for ground in data}
    known = [ground for ground in data if medians[ground] is not None]
    return " > ".join(sorted(known, key=lambda ground: -medians[ground]))


def draw_boxes(axes, data, title):
    boxes = axes.boxplot([found["intervals_s"] for found in data.values()], patch_artist=True, widths=0.6,
                         whis=(0, 100), medianprops={"color": palette.TEXT, "lw": 2})
    for place, (found, box, color) in enumerate(zip(data.values(), boxes["boxes"], itertools.cycle(BOX_COLOURS)), 1):
        box.set(facecolor=color, alpha=0.6)
        values = found["intervals_s"]
        axes.plot(place + np.linspace(-0.2, 0.2, len(values)), values, ".", color=palette.TEXT, ms=3)
    axes.set_xticklabels(data)
    axes.set_ylim(bottom=0.0)
    axes.set_ylabel("ΔTime [s]")
    axes.set_title(title, fontsize=10)
    axes.grid(axis="y", alpha=0.3)


def draw(kinds, titles):
    figure, all_axes = plt.subplots(1, len(titles), figsize=(11, 5))
    for axes, (name, title) in zip(np.atleast_1d(all_axes), titles.items()):
        draw_boxes(axes, kinds[name], title)
    return figure


def notes_of(kinds, options):
    notes = [
        f"ε = {options.interval_threshold_m:g} m, which the paper does not say for its figure. Boxes: quartiles and "
        "median; whiskers: least and most; points: the drives.",
        f"Forecast: {FORECAST_POLICY} over {FORECAST_DISTANCE_M:g} m, the forecast {paper.COLLECTION_S:g} s after the "
        f"first stop, looking {HORIZON_S:g} s ahead. Real: autonomous over {DRIVE_DISTANCE_M:g} m. `no stop seen`: "
        "drives with a lower bound only, which counts as the value.",
    ]
    for name, title, _, _ in KINDS:
        notes.append(f"{title}, order of the medians: {order_text(kinds[name])}; the paper: "
                     "paved > unpaved > gravel ≥ rough.")
    return notes


class Intervals:
    NAME = "intervals"

    @staticmethod
    def drives(options):
        return [drive for terrain in paper.TERRAINS for _, _, drives_of, _ in KINDS
                for drive in drives_of(terrain, options)]

    @staticmethod
    def section(outcomes, options):
        kinds = {name: kind_data(outcomes, options, drives_of, interval_of)
                 for name, _, drives_of, interval_of in KINDS}
        tests = {name: tests_of(kinds[name]) for name in kinds}
        data = {name: {"terrains": kinds[name], "anova_p": tests[name]["anova_p"],
                       "tukey_p": {"/".join(pair): p for pair, p in tests[name]["tukey_p"].items()}} for name in kinds}
        figure = Figure("stop_intervals", "Stop intervals by ground", png_of(draw(kinds, TITLES)))
        tables = [interval_table(kinds, TITLES), significance_table(tests, TITLES, paper.TUKEY_P)]
        return Section("Stop intervals", tables, notes_of(kinds, options), [figure], data)
