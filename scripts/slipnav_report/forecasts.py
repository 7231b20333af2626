"""Figures of predictions against outcomes: slip, and the growth of the position error."""

import matplotlib.pyplot as plt
import numpy as np

from . import palette
from .plotting import band, has_values, legend_beside, level, say_why_empty, shade_standstill
from .run_data import single_forecasts, thinned

SIGMAS = 2.0  # of the slip band, as the paper draws it


def slip_and_forecast(run):
    figure, axes = plt.subplots(figsize=(10, 4.5))
    axes.plot(*thinned(run.timeline["t"], run.timeline["slip"]), ".", color=palette.TEXT, ms=2, label="slip ratio")
    table = run.slip_forecasts
    for i, rows in enumerate(single_forecasts(table)):
        time = table["t"][rows] + table["horizon_s"][rows]
        mean, spread = table["mean"][rows], SIGMAS * table["stddev"][rows]
        band(axes, time, mean - spread, mean + spread, color=palette.SAFE, alpha=0.4,
             label="_" if i else f"forecast ±{SIGMAS:.0f}σ")
        axes.plot(time, mean, color=palette.ESTIMATE, lw=1.5, label="_" if i else "forecast mean")
    shade_standstill(axes, run)
    if not len(table["t"]):
        axes.set_title("no slip was forecast in this run: too few slip samples before each forecast")
    if not has_values(run.timeline["slip"]) and not len(table["t"]):
        say_why_empty(axes, "no slip: the wheels never turned fast enough to compute it")
    axes.set_ylabel("slip ratio")
    axes.set_xlabel("time [s]; gray: stops")
    axes.grid(alpha=0.3)
    legend_beside(axes)
    return figure


def growth_since_stop(run):
    """Horizontal length of the change of the error since the end of the last stop, at each epoch of the timeline."""
    errors = run.errors()[:2]
    time = run.timeline["t"]
    reference = np.zeros_like(errors)
    for begin in [0.0] + [end for _, end, _, _ in run.stops()]:
        index = np.searchsorted(time, begin)
        known = np.flatnonzero(np.isfinite(errors[0, index:]))
        if len(known):
            reference[:, index:] = errors[:, index + known[0]][:, None]
    return np.hypot(*(errors - reference))


def predicted_and_realized(run):
    figure, (error, countdown) = plt.subplots(2, 1, sharex=True, figsize=(10, 7), gridspec_kw={"height_ratios": (2, 1)})
    table = run.forecasts
    for i, rows in enumerate(single_forecasts(table)):
        error.plot(table["t"][rows] + table["horizon_s"][rows], table["horizontal_bound_m"][rows],
                   color=palette.ERROR, lw=1.2, label="_" if i else "forecast bound")
    error.plot(*thinned(run.timeline["t"], growth_since_stop(run)), color=palette.ESTIMATE, lw=1,
               label="error grown since the last stop")
    error.plot(*thinned(run.timeline["t"], np.hypot(*run.errors()[:2])), color=palette.TEXT, lw=0.8, ls=":",
               label="horizontal error")
    threshold = run.metrics.get("threshold_m")
    if threshold is not None and len(table["t"]):
        level(error, threshold, color=palette.TEXT, lw=1, ls="--", label=f"ε = {threshold:g} m")
    error.set_ylabel("horizontal [m]")
    legend_beside(error)
    starts, first = np.unique(table["t"], return_index=True)
    countdown.plot(starts, table["time_to_stop_s"][first], ".", color=palette.ERROR, ms=3)
    countdown.set_ylabel("time to stop [s]")
    countdown.set_xlabel("time [s]; gray: stops")
    if not len(starts):
        error.set_title("no error was forecast in this run")
        say_why_empty(countdown, "no forecast, no countdown")
        if not has_values(run.errors()):
            say_why_empty(error, "no forecast and no truth")
    elif not np.isfinite(table["time_to_stop_s"]).any():
        say_why_empty(countdown, "no stop was due: no bound reached ε within the horizon")
    for axes in (error, countdown):
        shade_standstill(axes, run)
        axes.grid(alpha=0.3)
    return figure
