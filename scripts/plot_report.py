#!/usr/bin/python3
"""Plots the output directory of a run: report.html, which is self-contained, and its figures as PNG."""

import argparse
import os
import sys

import matplotlib

matplotlib.use("Agg")  # no display needed

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from slipnav_report.page import png_of, write_report  # noqa: E402
from slipnav_report.run_data import RunData  # noqa: E402
from slipnav_report.stop_picture import stop_figure  # noqa: E402


def write_stop(run, number):
    """The paper's figure of one stop, as stop_NUMBER.png."""
    with open(os.path.join(run.directory, f"stop_{number}.png"), "wb") as file:
        file.write(png_of(stop_figure(run, number)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", help="output directory of a run, with timeline.csv in it")
    parser.add_argument("--figure", type=int, metavar="STOP", help="instead of them the paper's figure of one stop, by its "
                        "number from 1, as stop_STOP.png")
    arguments = parser.parse_args()
    try:
        run = RunData(arguments.directory)
        if arguments.figure is None:
            write_report(run, progress=lambda title: print("drawing:", title, file=sys.stderr))
        else:
            write_stop(run, arguments.figure)
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"plot_report: {error}")


if __name__ == "__main__":
    main()
