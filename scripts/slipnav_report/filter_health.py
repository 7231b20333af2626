"""Figures of the filter itself: velocity, biases, and whether innovations and errors match its covariance."""

import matplotlib.pyplot as plt
import numpy as np

from . import palette
from .plotting import band, has_values, legend_beside, say_why_empty, shade_range, shade_standstill
from .run_data import thinned

MICRO_G = 9.80665e-6  # m/s²
DEG_PER_H = np.pi / 180.0 / 3600.0  # rad/s

# 2.5 % and 97.5 % quantiles of the chi-square distribution by degrees of freedom.
CHI_SQUARE_95 = {1: (0.000982, 5.024), 3: (0.2158, 9.348)}
NIS_COMPONENTS = {
    "forward_speed": 1, "yaw_rate": 1, "lateral": 1, "vertical": 1, "zero_velocity": 3, "zero_rate": 3,
}
AXIS_NAMES = ("forward", "left", "up")
NOT_MEASURED = dict.fromkeys(("zero_velocity", "zero_rate"), "no stop, or none was used")
LEAST_SHOWN = 1e-4  # of a logarithmic axis


def truth_speed(run, window_s=1.0):
    """Horizontal speed of truth by central differences over a window, at its epochs."""
    t, e, n = run.truth["t"], run.truth["e"], run.truth["n"]
    if len(t) < 2:
        return t, np.zeros(len(t))
    before, after = t - 0.5 * window_s, t + 0.5 * window_s
    inside = (before >= t[0]) & (after <= t[-1])
    way = np.hypot(np.interp(after, t, e) - np.interp(before, t, e), np.interp(after, t, n) - np.interp(before, t, n))
    return t[inside], way[inside] / window_s


def velocity(run):
    figure, axes = plt.subplots(figsize=(10, 4.5))
    axes.plot(*thinned(run.filter["t"], run.filter["wheel_speed"]), color=palette.DEAD_RECKONING, lw=0.8,
              label="wheels")
    axes.plot(*thinned(*truth_speed(run)), color=palette.TRUTH, lw=2.5, label="truth, over 1 s")
    axes.plot(*thinned(run.timeline["t"], run.timeline["speed"]), color=palette.ESTIMATE, lw=0.8, label="filter")
    shade_standstill(axes, run)
    axes.set_ylabel("forward speed [m/s]")
    axes.set_xlabel("time [s]; gray: stops")
    axes.grid(alpha=0.3)
    legend_beside(axes)
    return figure


def biases(run):
    figure, (accel, gyro) = plt.subplots(2, 1, sharex=True, figsize=(10, 7))
    for axes, sensor, unit, label in (
        (accel, "accel", MICRO_G, "accelerometer bias and ±3σ [µg]"),
        (gyro, "gyro", DEG_PER_H, "gyro bias and ±3σ [°/h]"),
    ):
        for axis, name, color in zip("xyz", AXIS_NAMES, palette.AXES):
            time, bias, bound = thinned(
                run.filter["t"],
                run.filter[f"{sensor}_bias_{axis}"] / unit,
                3.0 * run.filter[f"{sensor}_sigma_{axis}"] / unit,
            )
            band(axes, time, bias - bound, bias + bound, color=color, alpha=0.15, label="_")
            axes.plot(time, bias, color=color, lw=1.2, label=name)
        shade_standstill(axes, run)
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
        legend_beside(axes)
        if not has_values(run.filter[f"{sensor}_bias_x"]):
            say_why_empty(axes, "the filter made no update in this run")
    gyro.set_xlabel("time [s]; gray: stops")
    return figure


def draw_chi_square(axes, time, values, freedom, title, why_empty):
    """Values that are chi-square of `freedom` degrees when the filter is honest, with the 95 % bounds."""
    low, high = CHI_SQUARE_95[freedom]
    shade_range(axes, low, high, color=palette.SAFE, alpha=0.3)
    if not len(values):
        say_why_empty(axes, why_empty)
    axes.semilogy(*thinned(time, np.maximum(values, LEAST_SHOWN)), ".", color=palette.ESTIMATE, ms=1.5,
                  label=title)
    axes.set_ylim(LEAST_SHOWN, 1e3)
    inside = np.mean((values >= low) & (values <= high)) if len(values) else np.nan
    axes.set_title(f"{title}: mean/dof {np.mean(values) / freedom:.2f}, {100 * inside:.0f} % inside"
                   if len(values) else f"{title}: not measured", fontsize=9)
    axes.grid(alpha=0.3)


def consistency(run):
    figure, all_axes = plt.subplots(4, 2, sharex=True, figsize=(10, 9))
    grid = all_axes.ravel()
    for axes, (name, freedom) in zip(grid, NIS_COMPONENTS.items()):
        measured = np.isfinite(run.filter["nis_" + name])
        draw_chi_square(axes, run.filter["t"][measured], freedom * run.filter["nis_" + name][measured], freedom,
                        "NIS " + name.replace("_", " "),
                        NOT_MEASURED.get(name, "no such update was made; see filter.updates"))
    draw_chi_square(grid[6], run.nees["t"], run.nees["nees"], 3, "NEES position", "no truth in this recording")
    grid[7].axis("off")
    grid[7].text(0.0, 0.5, "Shaded: 95 % of a chi-square distribution with\nthe degrees of freedom of the measurement.\n"
                 "An honest filter has 95 % inside, mean/dof 1;\ncautious ones have less than 1.", va="center")
    for axes in all_axes[-1]:
        axes.set_xlabel("time [s]")
    return figure
