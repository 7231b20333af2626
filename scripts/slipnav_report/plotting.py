"""What the figures have in common. The artists drawn here carry the data for the page's own plots."""

import numpy as np

from . import palette


def shade_standstill(axes, run):
    """Behind what is drawn already, whose limits it keeps."""
    limits = axes.axis()
    for begin, end, _, _ in run.stops():
        axes.axvspan(begin, end, color=palette.STANDSTILL, lw=0, zorder=0)
    axes.axis(limits)


def band(axes, time, low, high, **style):
    """A filled band between two curves."""
    axes.fill_between(time, low, high, lw=0, **style).band = (time, low, high)


def level(axes, value, **style):
    """A line at one value, from side to side."""
    axes.axhline(value, **style).level = value


def shade_range(axes, low, high, **style):
    """What lies between two values, from side to side."""
    axes.axhspan(low, high, lw=0, **style).range = (low, high)


def legend_beside(axes):
    """Never over the curves."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False, fontsize=9)


def say_why_empty(axes, reason):
    """In the middle of axes in which nothing is drawn."""
    axes.empty = reason
    axes.text(0.5, 0.5, reason, transform=axes.transAxes, ha="center", va="center", wrap=True, fontsize=9)


def has_values(*columns):
    return any(np.isfinite(column).any() for column in columns)
