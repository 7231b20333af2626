#!/usr/bin/python3
"""Runs the executable `forecast` and plots the result if --report FILE.png is given.

All other arguments are those of the executable.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

HELP = "  --report FILE.png             a plot of samples and forecast\n"


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        self.exit(2, f"forecast: {message}\n")


def own_parser():
    parser = Parser(prog="forecast", usage=argparse.SUPPRESS, add_help=False, allow_abbrev=False)
    parser.add_argument("--report", metavar="FILE.png")
    parser.add_argument("--forecast", metavar="FILE")
    return parser


def option(words, name):
    """The last value of an option of the executable, or None."""
    found = None
    for word, following in zip(words, words[1:] + [""]):
        if word == name:
            found = following
        elif word.startswith(name + "="):
            found = word.partition("=")[2]
    return found


def samples_of(words):
    """The argument that is neither an option of the executable nor its value: all of them take one."""
    return next(word for before, word in zip([""] + words, words)
                if not word.startswith("--") and (not before.startswith("--") or "=" in before))


def run(words):
    own, others = own_parser().parse_known_args(words)
    beside = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "forecast")
    executable = own.forecast or shutil.which("forecast") or beside
    if "--help" in others or not own.report:
        status = subprocess.run([executable, *others], check=False).returncode
        print(HELP if "--help" in others else "", end="")
        return status
    with tempfile.TemporaryDirectory(prefix="slipnav_forecast_") as folder:
        out = option(others, "--out")
        path = os.path.join(folder, "forecast.json") if out in (None, "-") else out
        status = subprocess.run([executable, *others, "--out", path], check=False,
                                stdout=subprocess.DEVNULL if out == "-" else None).returncode
        if status:
            return status
        with open(path, encoding="utf-8") as file:
            text = file.read()
    if out == "-":
        print(text, end="")
    from slipnav_report.slip_picture import picture, read_samples  # takes a second, which a summary does not need
    png = picture(read_samples(samples_of(others)), json.loads(text))
    with open(own.report, "wb") as file:
        file.write(png)
    return 0


def main():
    try:
        sys.exit(run(sys.argv[1:]))
    except OSError as error:
        sys.exit(f"forecast: {error.filename}: {error.strerror}")


if __name__ == "__main__":
    main()
