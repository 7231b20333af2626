"""Figures of where the rover was: ground track and position error."""

import itertools

import matplotlib.pyplot as plt
import numpy as np

from . import palette
from .plotting import band, legend_beside, shade_standstill
from .run_data import errors_of, thinned

AXIS_NAMES = ("east", "north", "up")
OTHER_STYLES = ("-.", ":", "--")  # of tracks that the estimate is compared with


def ground_track(run):
    figure, axes = plt.subplots(figsize=(10, 7))
    line = run.timeline
    axes.plot(*thinned(run.wheel_track["east"], run.wheel_track["north"]), color=palette.DEAD_RECKONING, lw=1.2,
              label="wheels and gyro only")
    axes.plot(*thinned(run.truth["e"], run.truth["n"]), color=palette.TRUTH, lw=3, label="truth")
    time, east, north = thinned(line["t"], line["est_e"], line["est_n"])
    axes.plot(east, north, color=palette.ESTIMATE, lw=1.2, label="estimate")[0].times = time
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
    legend_beside(axes)
    return figure


def position_errors(run):
    figure, all_axes = plt.subplots(3, 1, sharex=True, figsize=(10, 7))
    errors = run.errors()
    for axes, error, axis, name in zip(all_axes, errors, "enu", AXIS_NAMES):
        time, error, bound = thinned(run.timeline["t"], error, 3.0 * run.timeline["sigma_" + axis])
        band(axes, time, -bound, bound, color=palette.SAFE, alpha=0.35, label="±3σ")
        draw_truth_noise(axes, run, axis)
        axes.plot(time, error, color=palette.ESTIMATE, lw=1, label="error")
        if run.smoothed:
            draw_smoothed_error(axes, run.smoothed, axis)
        for (name, track), style in zip(run.compared.items(), itertools.cycle(OTHER_STYLES)):
            axes.plot(*thinned(track["t"], errors_of(track)["enu".index(axis)]), color=palette.TEXT, lw=1, ls=style,
                      label=name)
        shade_standstill(axes, run)
        axes.set_ylabel(name + " [m]")
        axes.grid(alpha=0.3)
        legend_beside(axes)
    if np.isnan(errors).all():
        all_axes[0].set_title("no truth in this recording: bounds only")
    all_axes[-1].set_xlabel("time [s]; gray: stops")
    return figure


def draw_truth_noise(axes, run, axis):
    """±3σ of truth by its own covariance, where that is mostly larger than the estimate's."""
    time, sigma = run.nees["t"], run.nees.get("truth_sigma_" + axis, np.zeros(0))
    if not len(sigma) or np.median(sigma) <= np.median(run.timeline["sigma_" + axis]):
        return
    time, bound = thinned(time, 3.0 * sigma)
    for i, side in enumerate((bound, -bound)):
        axes.plot(time, side, color=palette.TRUTH, lw=1, ls=":", label="_" if i else "±3σ of truth itself")


def draw_smoothed_error(axes, smoothed, axis):
    time, error, bound = thinned(smoothed["t"], errors_of(smoothed)["enu".index(axis)], 3.0 * smoothed["sigma_" + axis])
    axes.plot(time, error, color=palette.ERROR, lw=1, label="smoothed")
    axes.plot(time, bound, color=palette.ERROR, lw=0.8, ls=":", label="its ±3σ")
    axes.plot(time, -bound, color=palette.ERROR, lw=0.8, ls=":")
