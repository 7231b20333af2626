"""Figures of where the rover was: ground track and position error."""

import itertools

import matplotlib.pyplot as plt
import numpy as np

from . import palette
from .run_data import errors_of, thinned

AXIS_NAMES = ("east", "north", "up")
OTHER_STYLES = ("-.", ":", "--")  # of tracks that the estimate is compared with


def shade_standstill(axes, run):
    """Behind what is drawn already, whose limits it keeps."""
    limits = axes.axis()
    for begin, end, _, _ in run.stops():
        axes.axvspan(begin, end, color=palette.STANDSTILL, lw=0, zorder=0)
    axes.axis(limits)


def ground_track(run):
    figure, axes = plt.subplots(figsize=(8, 7))
    line = run.timeline
    axes.plot(*thinned(run.wheel_track["east"], run.wheel_track["north"]), color=palette.DEAD_RECKONING, lw=1.2,
              label="wheels and gyro alone")
    axes.plot(*thinned(run.truth["e"], run.truth["n"]), color=palette.TRUTH, lw=3, label="truth")
    axes.plot(*thinned(line["est_e"], line["est_n"]), color=palette.ESTIMATE, lw=1.2, label="estimate")
    if run.smoothed:
        axes.plot(*thinned(run.smoothed["est_e"], run.smoothed["est_n"]), color=palette.ERROR, lw=1, ls="--",
                  label="smoothed")
    for (name, track), style in zip(run.compared.items(), itertools.cycle(OTHER_STYLES)):
        axes.plot(*thinned(track["est_e"], track["est_n"]), color=palette.TEXT, lw=1, ls=style, label=name)
    stops = run.stops()
    axes.plot([stop[2] for stop in stops], [stop[3] for stop in stops], "o", color=palette.STOP, ms=5,
              label=f"stops ({len(stops)})", ls="none")
    axes.plot(line["est_e"][0], line["est_n"][0], "^", color=palette.TEXT, ms=8, label="start", ls="none")
    axes.set_aspect("equal", "datalim")
    axes.set_xlabel("east [m]")
    axes.set_ylabel("north [m]")
    axes.grid(alpha=0.3)
    axes.legend()
    return figure


def position_errors(run):
    figure, all_axes = plt.subplots(3, 1, sharex=True, figsize=(9, 7))
    errors = run.errors()
    for axes, error, axis, name in zip(all_axes, errors, "enu", AXIS_NAMES):
        time, error, bound = thinned(run.timeline["t"], error, 3.0 * run.timeline["sigma_" + axis])
        axes.fill_between(time, -bound, bound, color=palette.SAFE, alpha=0.35, lw=0, label="±3σ")
        axes.plot(time, error, color=palette.ESTIMATE, lw=1, label="error")
        if run.smoothed:
            draw_smoothed_error(axes, run.smoothed, axis)
        for (name, track), style in zip(run.compared.items(), itertools.cycle(OTHER_STYLES)):
            axes.plot(*thinned(track["t"], errors_of(track)["enu".index(axis)]), color=palette.TEXT, lw=1, ls=style,
                      label=name)
        shade_standstill(axes, run)
        axes.set_ylabel(name + " [m]")
        axes.grid(alpha=0.3)
    if np.isnan(errors).all():
        all_axes[0].set_title("no truth in this recording: bounds only")
    all_axes[0].legend(loc="upper left", ncol=4)
    all_axes[-1].set_xlabel("time [s]; grey: stops")
    return figure


def draw_smoothed_error(axes, smoothed, axis):
    time, error, bound = thinned(smoothed["t"], errors_of(smoothed)["enu".index(axis)], 3.0 * smoothed["sigma_" + axis])
    axes.plot(time, error, color=palette.ERROR, lw=1, label="smoothed")
    axes.plot(time, bound, color=palette.ERROR, lw=0.8, ls=":", label="its ±3σ")
    axes.plot(time, -bound, color=palette.ERROR, lw=0.8, ls=":")
