#!/usr/bin/python3
"""Plots the output directory of a run: report.html, which is self-contained, and its figures as PNG."""

import argparse
import os
import sys

import matplotlib

matplotlib.use("Agg")  # no display needed

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from slipnav_report.page import write_report  # noqa: E402
from slipnav_report.run_data import RunData  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("directory", help="output directory of a run, with timeline.csv in it")
    directory = parser.parse_args().directory
    try:
        run = RunData(directory)
        write_report(run, progress=lambda title: print("drawing:", title, file=sys.stderr))
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"plot_report: {error}")


if __name__ == "__main__":
    main()
