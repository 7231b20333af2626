"""Error against stop rate, for periodic and autonomous stops."""

import matplotlib.pyplot as plt
import numpy as np

from slipnav_report import palette
from slipnav_report.page import png_of

from . import paper
from .drive import Drive
from .section import Figure, Section, Table, figures_of, number, succeeded
from .statistics import median, worst

TERRAINS = ("rough", "unpaved")
DISTANCE_M = 650.0
EVERY_S = (6, 12, 30, 60, 120)
THRESHOLDS_M = (2, 3, 5, 8)
NEVER = "none"
RATE_TICKS_PCT = (0, 0.5, 1, 2, 5, 10, 20, 30)


def periodic(every_s):
    return f"periodic:{every_s:g}:{paper.HOLD_S:g}"


# Label in the figure, policy and threshold, from the most stops to the fewest.
PERIODIC_POINTS = tuple((f"{every_s} s", periodic(every_s), None) for every_s in EVERY_S) + (("never", NEVER, None),)
AUTONOMOUS_POINTS = tuple((f"ε {threshold} m", paper.AUTONOMOUS, threshold) for threshold in THRESHOLDS_M)


def drives_of(terrain, point, options):
    _, policy, threshold_m = point
    return [Drive(terrain, DISTANCE_M, seed, policy, threshold_m) for seed in range(1, options.curve_seeds + 1)]


def point_data(outcomes, terrain, point, options):
    drives = drives_of(terrain, point, options)
    errors = figures_of(outcomes, drives, "enu_error_pct")
    stretches = [stretch for outcome in succeeded(outcomes, drives) for stretch in outcome.stretches
                 if stretch.after_stop]
    return {
        "label": point[0], "policy": point[1], "threshold_m": point[2], "drives": len(errors),
        "stop_rate_pct": median(figures_of(outcomes, drives, "stop_rate_pct")),
        "stop_count": median(figures_of(outcomes, drives, "stop_count")),
        "enu_error_pct": {"median": median(errors), "worst": worst(errors)},
        "stretches": len(stretches),
        "stretches_beyond_threshold": sum(stretch.growth_m > point[2] for stretch in stretches) if point[2] else None,
    }


def error_of_periodic(points, rate_pct):
    """Median error of periodic stops with the same stop rate; None beyond the densest of them."""
    known = sorted((point["stop_rate_pct"], point["enu_error_pct"]["median"]) for point in points
                   if point["stop_rate_pct"] is not None and point["enu_error_pct"]["median"] is not None)
    if rate_pct is None or not known or not known[0][0] <= rate_pct <= known[-1][0]:
        return None
    return float(np.interp(rate_pct, *zip(*known)))


def lower_by_pct(value, reference):
    return None if value is None or not reference else 100.0 * (1.0 - value / reference)


def terrain_data(outcomes, terrain, options):
    points = [point_data(outcomes, terrain, point, options) for point in PERIODIC_POINTS + AUTONOMOUS_POINTS]
    by_clock = points[:len(PERIODIC_POINTS)]
    reference = next(point for point in by_clock if point["policy"] == paper.PERIODIC)
    for point in points:
        point["stop_rate_lower_by_pct"] = lower_by_pct(point["stop_rate_pct"], reference["stop_rate_pct"])
    for point in points[len(PERIODIC_POINTS):]:
        point["periodic_error_pct"] = error_of_periodic(by_clock, point["stop_rate_pct"])
    return points


def table_row(terrain, point):
    error = point["enu_error_pct"]
    beyond = point["stretches_beyond_threshold"]
    return [terrain, point["policy"] if point["threshold_m"] is None else point["label"], str(point["drives"]),
            number(point["stop_count"], 0), number(point["stop_rate_pct"], 2),
            number(point["stop_rate_lower_by_pct"], 0), number(error["median"], 2), number(error["worst"], 2),
            number(point.get("periodic_error_pct"), 2), "-" if beyond is None else f"{beyond} of {point['stretches']}"]


def draw_points(axes, points, color, name):
    known = [point for point in points if point["stop_rate_pct"] is not None]
    rates = [point["stop_rate_pct"] for point in known]
    medians = np.array([point["enu_error_pct"]["median"] for point in known], dtype=float)
    above = np.array([point["enu_error_pct"]["worst"] for point in known], dtype=float) - medians
    axes.errorbar(rates, medians, yerr=[np.zeros(len(known)), above], color=color, marker="o", ms=5, lw=1.5,
                  capsize=3, elinewidth=0.8, label=name)
    for point, rate, error in zip(known, rates, medians):
        axes.annotate(point["label"], (rate, error), xytext=(4, -12), textcoords="offset points", color=color,
                      fontsize=8)


def draw(data):
    figure, all_axes = plt.subplots(1, len(TERRAINS), sharey=True, figsize=(11, 5))
    for axes, terrain in zip(all_axes, TERRAINS):
        draw_points(axes, data[terrain][:len(PERIODIC_POINTS)], palette.DEAD_RECKONING, "periodic, 3 s each")
        draw_points(axes, data[terrain][len(PERIODIC_POINTS):], palette.ESTIMATE, "autonomous")
        axes.set_xscale("symlog", linthresh=1.0)
        axes.set_xticks(RATE_TICKS_PCT)
        axes.set_xticklabels([f"{tick:g}" for tick in RATE_TICKS_PCT])
        axes.set_xlim(-0.1, RATE_TICKS_PCT[-1] * 1.5)  # room for the last label
        axes.set_ylim(bottom=0.0)
        axes.set_title(f"{terrain}, {DISTANCE_M:.0f} m")
        axes.set_xlabel("time at standstill for stops [%]")
        axes.grid(alpha=0.3)
    all_axes[0].set_ylabel("ENU error [% of the distance], median and worst")
    all_axes[0].legend()
    return figure


class Curve:
    NAME = "curve"

    @staticmethod
    def drives(options):
        return [drive for terrain in TERRAINS for point in PERIODIC_POINTS + AUTONOMOUS_POINTS
                for drive in drives_of(terrain, point, options)]

    @staticmethod
    def section(outcomes, options):
        data = {terrain: terrain_data(outcomes, terrain, options) for terrain in TERRAINS}
        heads = ["ground", "stops by", "drives", "stops", "stop rate %", "lower by %", "ENU % median", "worst",
                 "periodic at that rate", "grown beyond ε"]
        table = Table(heads, [table_row(terrain, point) for terrain in TERRAINS for point in data[terrain]])
        notes = [
            f"`lower by`: the stop rate, against {paper.PERIODIC}. `periodic at that rate`: median error of "
            "periodic stops at the same stop rate, linear between their points; autonomous stops pay when theirs is "
            "smaller.",
            "`grown beyond ε`: stretches of driving after a stop in which the horizontal error changed by more than ε, "
            "which the forecast's bound should prevent.",
        ]
        figure = Figure("error_against_stop_rate", "Error against stop rate", png_of(draw(data)))
        return Section(f"Error against stop rate, {DISTANCE_M:.0f} m", [table], notes, [figure], data)
