"""The paper's figure of one stop: (a) speeds, (b) slip and its prediction, (c) wheel speeds by sigma points, (d) predicted
and actual error with ε and the countdown."""

import matplotlib.pyplot as plt
import numpy as np

from . import palette
from .filter_health import truth_speed
from .plotting import band, has_values, legend_beside, level, say_why_empty, shade_standstill

SIGMAS = 2.0  # of the slip band, as the paper draws it
WINDOW_S = 15.0  # of slip that a forecast learns from: the paper's, and the default of forecast.window_s
BEFORE_S, AFTER_S = 5.0, 10.0  # shown before the drive and after the stop


class Stop:
    """A stop by its number from 1, the drive before it, and the forecast that announced it."""

    def __init__(self, run, number):
        stops = run.stops()
        if not 1 <= number <= len(stops):
            raise ValueError(f"there is no stop {number}: the drive has {len(stops)}")
        self.number, self.begin, self.end = number, stops[number - 1][0], stops[number - 1][1]
        self.driving_since = stops[number - 2][1] if number > 1 else first_motion(run)
        self.forecast = announcement(run.forecasts, self.driving_since, self.begin)

    def rows(self, table):
        """Rows of the table that belong to the forecast; empty if there is no forecast."""
        return np.flatnonzero(table["t"] == self.forecast) if self.forecast is not None else np.zeros(0, int)


def first_motion(run):
    moving = np.flatnonzero(run.timeline["stationary"] < 0.5)
    return run.timeline["t"][moving[0]]


def announcement(table, since, until):
    """Time of the first forecast from which on every forecast before the stop predicted a stop; the last forecast before
    it if none did; None if there was no forecast."""
    made, first = np.unique(table["t"], return_index=True)
    inside = (made >= since) & (made < until)
    if not inside.any():
        return None
    made, due = made[inside], np.isfinite(table["time_to_stop_s"][first[inside]])
    silent = np.flatnonzero(~due)
    begin = silent[-1] + 1 if len(silent) else 0
    return made[min(begin, len(made) - 1)]


def realized(run, stop):
    """Horizontal error over the drive before the stop: grown since its start, and total."""
    time = run.timeline["t"]
    errors = run.errors()[:2]
    shown = (time >= stop.driving_since) & (time <= stop.end + AFTER_S) & np.isfinite(errors[0])
    if not shown.any():
        return time[:0], time[:0], time[:0]
    grown = errors[:, shown] - errors[:, np.flatnonzero(shown)[0]][:, None]
    return time[shown], np.hypot(*grown), np.hypot(*errors[:, shown])


def draw_speeds(axes, run, stop):
    axes.plot(run.filter["t"], run.filter["wheel_speed"], color=palette.DEAD_RECKONING, lw=0.8, label="wheels")
    axes.plot(*truth_speed(run), color=palette.TRUTH, lw=2.0, label="truth, over 1 s")
    axes.plot(run.timeline["t"], run.timeline["speed"], color=palette.ESTIMATE, lw=0.8, label="filter")
    if stop.forecast is not None:
        begin = max(stop.driving_since, stop.forecast - WINDOW_S)
        axes.axvspan(begin, stop.forecast, color=palette.SAFE, alpha=0.25, lw=0, label="window")
    axes.set_ylabel("(a) speed [m/s]")


def draw_slip(axes, run, stop):
    table, rows = run.slip_forecasts, stop.rows(run.slip_forecasts)
    axes.plot(run.timeline["t"], run.timeline["slip"], ".", color=palette.TEXT, ms=2, label="slip ratio")
    if len(rows):
        time = table["t"][rows] + table["horizon_s"][rows]
        mean, spread = table["mean"][rows], SIGMAS * table["stddev"][rows]
        band(axes, time, mean - spread, mean + spread, color=palette.SAFE, alpha=0.4, label=f"prediction ±{SIGMAS:.0f}σ")
        axes.plot(time, mean, color=palette.ESTIMATE, lw=1.5, label="predicted mean")
    elif not has_values(run.timeline["slip"]):
        say_why_empty(axes, "no slip: the wheels never turned fast enough to compute it")
    axes.set_ylabel("(b) slip ratio")


def draw_wheel_speeds(axes, run, stop):
    table, rows = run.slip_forecasts, stop.rows(run.slip_forecasts)
    axes.plot(run.filter["t"], run.filter["wheel_speed"], color=palette.DEAD_RECKONING, lw=0.8, label="wheels")
    if len(rows):
        time = table["t"][rows] + table["horizon_s"][rows]
        above, below = table["wheel_speed_above"][rows], table["wheel_speed_below"][rows]
        band(axes, time, np.minimum(above, below), np.maximum(above, below), color=palette.SAFE, alpha=0.4,
             label="sigma points")
        axes.plot(time, table["wheel_speed"][rows], color=palette.ESTIMATE, lw=1.5, label="of the mean slip")
    axes.set_ylabel("(c) wheel speed [m/s]")


def draw_errors(axes, run, stop):
    table, rows = run.forecasts, stop.rows(run.forecasts)
    time, grown, whole = realized(run, stop)
    axes.plot(time, whole, color=palette.TEXT, lw=0.8, ls=":", label="error")
    axes.plot(time, grown, color=palette.ESTIMATE, lw=1.2, label="error grown since the last stop")
    if len(rows):
        axes.plot(table["t"][rows] + table["horizon_s"][rows], table["horizontal_bound_m"][rows], color=palette.ERROR,
                  lw=1.5, label="predicted bound")
        draw_countdown(axes, table["time_to_stop_s"][rows[0]], stop)
    if run.metrics.get("threshold_m") is not None:
        level(axes, run.metrics["threshold_m"], color=palette.TEXT, lw=1, ls="--",
              label=f"ε = {run.metrics['threshold_m']:g} m")
    if not len(time) and not len(rows):
        say_why_empty(axes, "no forecast and no truth")
    axes.set_ylim(bottom=0.0)
    axes.set_ylabel("(d) horizontal [m]")


def draw_countdown(axes, time_to_stop_s, stop):
    """From the forecast to the time for which it announced the stop."""
    if not np.isfinite(time_to_stop_s):
        return
    due = stop.forecast + time_to_stop_s
    axes.axvline(due, color=palette.STOP, lw=1.2, label=f"stop due after {time_to_stop_s:.1f} s")
    axes.annotate("", (due, 0.9), (stop.forecast, 0.9), xycoords=("data", "axes fraction"),
                  textcoords=("data", "axes fraction"), arrowprops={"arrowstyle": "->", "color": palette.STOP})


def stop_figure(run, number):
    stop = Stop(run, number)
    figure, panels = plt.subplots(4, 1, sharex=True, figsize=(10, 11))
    for axes, draw in zip(panels, (draw_speeds, draw_slip, draw_wheel_speeds, draw_errors)):
        draw(axes, run, stop)
        if stop.forecast is not None:
            axes.axvline(stop.forecast, color=palette.ESTIMATE, lw=1.0, ls=":")
        shade_standstill(axes, run)
        axes.grid(alpha=0.3)
        legend_beside(axes)
    horizon = run.forecasts["horizon_s"][stop.rows(run.forecasts)]
    last = max([stop.end + AFTER_S] + [stop.forecast + value for value in horizon[-1:]])
    panels[0].set_xlim(stop.driving_since - BEFORE_S, last)
    forecast = "no forecast before it" if stop.forecast is None else f"forecast at {stop.forecast:.1f} s"
    panels[0].set_title(f"stop {number} at {stop.begin:.1f} s, {forecast}", fontsize=10)
    panels[-1].set_xlabel("time [s]; gray: stops")
    return figure
