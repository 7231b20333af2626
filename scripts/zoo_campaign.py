#!/usr/bin/python3
"""Drives over the zoo of simulated worlds: every world with and without stops, a grid, or random configurations.

Prints a table and the broken limits; ends with status 1 if there are any.
"""

import argparse
import os
import shutil
import subprocess
import sys

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from slipnav_campaign import engine  # noqa: E402
from slipnav_zoo import adversary, grid, worlds  # noqa: E402
from slipnav_zoo.simulation import drive_all, names  # noqa: E402


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        self.exit(2, f"zoo: {message}\n")


def parse_arguments():
    parser = Parser(prog="zoo", description=__doc__.splitlines()[0])
    parser.add_argument("--worlds", metavar="NAME,...", help="only these (default: all)")
    parser.add_argument("--grades", metavar="NAME,...", help="only these (default: all)")
    parser.add_argument("--seeds", type=int, metavar="N", help="drives of each row (default: 10; of a grid cell 4)")
    parser.add_argument("--grid", action="store_true", help="cells of speeds, rates, grounds and sensors, drawn once")
    parser.add_argument("--cells", type=int, default=grid.CELLS, metavar="N", help="of the grid (default %(default)s)")
    parser.add_argument("--adversarial", type=int, metavar="N", help="N drives with random configurations")
    engine.add_options(parser)
    parser.add_argument("--out", metavar="DIR", help="also write the table and the broken limits here")
    parser.add_argument("--simulate", default=shutil.which("simulate"), metavar="FILE", help="the executable")
    arguments = parser.parse_args()
    if not arguments.simulate or not os.access(arguments.simulate, os.X_OK):
        parser.error(f"no executable '{arguments.simulate or 'simulate'}', name it by --simulate")
    arguments.worlds = chosen(parser, arguments.worlds, names(arguments.simulate, "world"), "world")
    arguments.grades = chosen(parser, arguments.grades, names(arguments.simulate, "grade"), "grade")
    return arguments


def chosen(parser, text, known, kind):
    if text is None:
        return known
    for name in text.split(","):
        if name not in known:
            parser.error(f"unknown {kind} '{name}', there are {', '.join(known)}")
    return text.split(",")


def run(arguments, pool):
    """Name of the mode, its table and its limits."""
    if arguments.adversarial:
        configuration = os.path.join(os.path.dirname(arguments.simulate), "configuration")
        known = adversary.parameters(subprocess.run([configuration], check=True, capture_output=True, text=True).stdout)
        drives = adversary.drives(arguments.adversarial, arguments.worlds, arguments.grades, known)
        return "adversarial", *adversary.report(drive_all(arguments.simulate, drives, pool))
    if arguments.grid:
        drives = grid.drives(arguments.cells, arguments.seeds or grid.SEEDS)
        return "grid", *grid.report(drive_all(arguments.simulate, drives, pool), arguments.cells)
    drives = worlds.drives(arguments.worlds, arguments.grades, arguments.seeds or 10)
    return "worlds", *worlds.report(drive_all(arguments.simulate, drives, pool))


def campaign(arguments):
    with engine.pool_of(arguments) as pool:
        mode, table, limits = run(arguments, pool)
    text = table + "\n\n" + limits.text() + "\n"
    print(text, end="")
    if arguments.out:
        os.makedirs(arguments.out, exist_ok=True)
        with open(os.path.join(arguments.out, f"{mode}.md"), "w", encoding="utf-8") as file:
            file.write(text)
    return 1 if limits.broken else 0


def main():
    arguments = parse_arguments()
    return engine.status_of(lambda: campaign(arguments), lambda text: print(f"zoo: {text}", file=sys.stderr))


if __name__ == "__main__":
    sys.exit(main())
