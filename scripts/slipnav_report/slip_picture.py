"""The plot of one slip forecast with the samples it was made from."""

import csv

import matplotlib

matplotlib.use("Agg")  # no display needed

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

from . import palette  # noqa: E402
from .page import png_of  # noqa: E402
from .plotting import band, legend_beside  # noqa: E402

SIGMAS = 2.0  # of the band, as the paper draws it


def read_samples(path):
    """Times and slips of the numeric rows; the executable has rejected all others except a header."""
    rows = []
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.reader(file):
            try:
                rows.append([float(row[0]), float(row[1])])
            except (ValueError, IndexError):
                continue
    return np.array(rows).reshape(-1, 2).T


def draw(samples, forecast):
    """Of times and slips, and of what the executable has written."""
    figure, axes = plt.subplots(figsize=(10, 4.5))
    time, mean, spread = (np.array(forecast[key]) for key in ("t", "mean", "stddev"))
    band(axes, time, mean - SIGMAS * spread, mean + SIGMAS * spread, color=palette.SAFE, alpha=0.4,
         label=f"forecast ±{SIGMAS:.0f}σ")
    axes.plot(*samples, ".", color=palette.TEXT, ms=3, label="slip ratio")
    axes.plot(time, mean, color=palette.ESTIMATE, lw=1.5, label="forecast mean")
    axes.set_title(f"model {forecast['model']}: {forecast['status']}", fontsize=10)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("slip ratio")
    axes.grid(alpha=0.3)
    legend_beside(axes)
    return figure


def picture(samples, forecast):
    return png_of(draw(samples, forecast))
