#!/usr/bin/python3
"""The paper's Tables I and II and its figure of stop intervals from simulated drives, next to the paper's own numbers.

Prints the tables, and writes tables.md, tables.json, tables.html and the figures. Ends with status 1 if a drive
failed; the tables then contain the others, and say which one it was.
"""

import argparse
import os
import shutil
import sys

import matplotlib

matplotlib.use("Agg")  # no display needed

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from slipnav_campaign import engine  # noqa: E402
from slipnav_tables import output, paper  # noqa: E402
from slipnav_tables.accuracy import Table1, Table2  # noqa: E402
from slipnav_tables.clock import Clock  # noqa: E402
from slipnav_tables.curve import Curve  # noqa: E402
from slipnav_tables.fleet import drive_all  # noqa: E402
from slipnav_tables.intervals import Intervals  # noqa: E402
from slipnav_tables.section import Options  # noqa: E402
from slipnav_tables.skill import Skill  # noqa: E402

SECTIONS = {section.NAME: section for section in (Table1, Table2, Clock, Skill, Curve, Intervals)}


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        self.exit(2, f"tables: {message}\n")


def positive_count(text):
    count = int(text)
    if count < 1:
        raise ValueError
    return count


def positive_length(text):
    length = float(text)
    if not 0.0 < length < float("inf"):
        raise ValueError
    return length


positive_count.__name__ = "count above zero"
positive_length.__name__ = "length above zero"


def section_names(text):
    names = text.split(",")
    for name in names:
        if name not in SECTIONS:
            raise argparse.ArgumentTypeError(f"unknown section '{name}', there are {', '.join(SECTIONS)}")
    return [name for name in SECTIONS if name in names]


def parse_arguments():
    parser = Parser(prog="tables", description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=positive_count, default=10, metavar="N",
                        help="drives of each row of a table (default %(default)s)")
    parser.add_argument("--curve-seeds", type=positive_count, metavar="N",
                        help="drives of each point of the curve (default: as --seeds)")
    parser.add_argument("--interval-tests", type=positive_count, default=paper.TESTS_PER_TERRAIN, metavar="N",
                        help="drives on each ground for the stop intervals (default %(default)s)")
    parser.add_argument("--interval-threshold", type=positive_length, default=3.0, metavar="M",
                        help="error bound for the stop intervals (default %(default)s)")
    parser.add_argument("--clock-threshold", type=positive_length, default=Options.clock_threshold_m, metavar="M",
                        help="error bound for the comparison with a clock (default %(default)s)")
    engine.add_options(parser, positive_count)
    parser.add_argument("--only", type=section_names, default=list(SECTIONS), metavar="NAME,...",
                        help="sections to make: " + ", ".join(SECTIONS) + " (default: all)")
    parser.add_argument("--out", default=os.path.join("out", "tables"), metavar="DIR",
                        help="where the files go (default %(default)s)")
    parser.add_argument("--simulate", default=beside_this("simulate"), metavar="FILE",
                        help="the executable (default: the one installed with this program)")
    arguments = parser.parse_args()
    if not arguments.simulate or not os.access(arguments.simulate, os.X_OK):
        parser.error(f"no executable '{arguments.simulate or 'simulate'}', name it by --simulate")
    return arguments


def beside_this(name):
    path = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), name)
    return path if os.access(path, os.X_OK) else shutil.which(name)


def all_outcomes(arguments, chosen, options):
    drives = list(dict.fromkeys(drive for section in chosen.values() for drive in section.drives(options)))
    with engine.pool_of(arguments) as pool:
        outcomes = drive_all(arguments.simulate, drives, pool)
        if Clock.NAME in chosen:  # the periodic drives follow from the results of the others
            clocks = list(dict.fromkeys(drive for drive in Clock.follow_up(outcomes, options) if drive not in outcomes))
            outcomes.update(drive_all(arguments.simulate, clocks, pool))
    return outcomes


def make_tables(arguments):
    options = Options(arguments.seeds, arguments.curve_seeds or arguments.seeds, arguments.interval_tests,
                      arguments.interval_threshold, arguments.clock_threshold)
    chosen = {name: SECTIONS[name] for name in arguments.only}
    os.makedirs(arguments.out, exist_ok=True)
    outcomes = all_outcomes(arguments, chosen, options)
    sections = {name: section.section(outcomes, options) for name, section in chosen.items()}
    output.write_all(arguments.out, sections, outcomes)
    print(output.markdown(list(sections.values()), outcomes))
    print(f"tables: {os.path.join(arguments.out, 'tables.html')}", file=sys.stderr)
    return 1 if output.failures_of(outcomes) else 0


def main():
    arguments = parse_arguments()
    return engine.status_of(lambda: make_tables(arguments), lambda text: print(f"tables: {text}", file=sys.stderr))


if __name__ == "__main__":
    sys.exit(main())
