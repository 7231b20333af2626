#!/usr/bin/python3
"""Draws what a run has left in its output directory: track, errors with their bounds, speed and slip."""

import argparse
import csv
import os
import sys

import matplotlib

matplotlib.use("Agg")  # no display needed

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

AXES = ("e", "n", "u")
AXIS_NAMES = {"e": "east", "n": "north", "u": "up"}


def read_timeline(path):
    """Returns the columns of timeline.csv as arrays, by name."""
    with open(path, newline="", encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise ValueError(f"{path}: has no rows")
    return {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}


def shade_standstill(axes, time, stationary):
    """Behind what is drawn already, whose limits it keeps."""
    limits = axes.axis()
    axes.fill_between(
        time, 0, 1, where=stationary > 0.5, transform=axes.get_xaxis_transform(), color="0.9", lw=0, zorder=0
    )
    axes.axis(limits)


def plot_track(timeline, path):
    figure, axes = plt.subplots(figsize=(7, 7))
    axes.plot(timeline["truth_e"], timeline["truth_n"], color="0.5", lw=2, label="truth")
    axes.plot(timeline["est_e"], timeline["est_n"], color="tab:blue", lw=1, label="estimate")
    axes.plot(timeline["est_e"][0], timeline["est_n"][0], "o", color="tab:green", label="start")
    stops = timeline["stationary"] > 0.5
    axes.plot(timeline["est_e"][stops], timeline["est_n"][stops], ".", color="tab:red", ms=4, label="standstill")
    axes.set_aspect("equal", "datalim")
    axes.set_xlabel("east [m]")
    axes.set_ylabel("north [m]")
    axes.grid(alpha=0.3)
    axes.legend()
    save(figure, path)


def plot_errors(timeline, path):
    time = timeline["t"] - timeline["t"][0]
    figure, all_axes = plt.subplots(3, 1, sharex=True, figsize=(9, 8))
    for axes, axis in zip(all_axes, AXES):
        bound = 3.0 * timeline["sigma_" + axis]
        axes.fill_between(time, -bound, bound, color="tab:blue", alpha=0.15, lw=0, label="±3σ")
        axes.plot(time, timeline["est_" + axis] - timeline["truth_" + axis], color="tab:blue", lw=1, label="error")
        shade_standstill(axes, time, timeline["stationary"])
        axes.set_ylabel(AXIS_NAMES[axis] + " [m]")
        axes.grid(alpha=0.3)
    all_axes[0].legend(loc="upper left")
    all_axes[-1].set_xlabel("time [s]; grey: standstill")
    save(figure, path)


def plot_motion(timeline, path):
    time = timeline["t"] - timeline["t"][0]
    figure, (speed, slip) = plt.subplots(2, 1, sharex=True, figsize=(9, 6))
    speed.plot(time, timeline["speed"], lw=1)
    speed.set_ylabel("forward speed [m/s]")
    slip.plot(time, timeline["slip"], ".", ms=2)
    slip.set_ylabel("slip ratio")
    slip.set_xlabel("time [s]; grey: standstill")
    for axes in (speed, slip):
        shade_standstill(axes, time, timeline["stationary"])
        axes.grid(alpha=0.3)
    save(figure, path)


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", help="output directory of a run, with timeline.csv in it")
    directory = parser.parse_args().directory
    try:
        timeline = read_timeline(os.path.join(directory, "timeline.csv"))
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"plot_report: {error}")
    plot_track(timeline, os.path.join(directory, "track.png"))
    plot_errors(timeline, os.path.join(directory, "errors.png"))
    plot_motion(timeline, os.path.join(directory, "motion.png"))


if __name__ == "__main__":
    main()
