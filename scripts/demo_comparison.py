#!/usr/bin/python3
"""What the stops of an autonomous drive gained, compared with as many periodic stops and with none.

Drives the other two, prints the table, and writes comparison.json.
"""

import argparse
import contextlib
import json
import os
import sys

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from slipnav_campaign.local import LocalPool  # noqa: E402
from slipnav_campaign.task import Failure  # noqa: E402
from slipnav_tables import clock, output, paper  # noqa: E402
from slipnav_tables.drive import Drive, read_outcome  # noqa: E402
from slipnav_tables.fleet import drive_all  # noqa: E402
from slipnav_tables.section import Table, number  # noqa: E402

GROUND = next(ground for ground in clock.GROUNDS if ground.name == "patches on paved")


def parse_arguments():
    parser = argparse.ArgumentParser(prog="demo_comparison", description=__doc__.splitlines()[0])
    parser.add_argument("directory", metavar="DIR", help="of the autonomous drive")
    parser.add_argument("--simulate", required=True, metavar="FILE", help="the executable")
    parser.add_argument("--distance", type=float, required=True, metavar="M")
    parser.add_argument("--seed", type=int, required=True, metavar="N")
    return parser.parse_args()


def row(name, outcome):
    found = clock.figures([outcome])
    return [name, number(found["stops"], 0), number(found["worst_growth_m"], 2),
            number(outcome.metrics["horizontal_max_m"], 2), number(outcome.metrics["enu_error_pct"], 2)]


def main():
    arguments = parse_arguments()
    drive = Drive(GROUND.terrain, arguments.distance, arguments.seed, paper.AUTONOMOUS, None, GROUND.settings)
    autonomous = read_outcome(drive, arguments.directory)
    others = {"periodic": clock.clock_drive(drive, autonomous),
              "never": Drive(GROUND.terrain, arguments.distance, arguments.seed, clock.NEVER, None, GROUND.settings,
                             with_stretches=True)}
    with contextlib.closing(LocalPool(2)) as pool:
        outcomes = drive_all(arguments.simulate, list(dict.fromkeys(others.values())), pool)
    named = {"autonomous": autonomous, **{name: outcomes[other] for name, other in others.items()}}
    for name, outcome in named.items():
        if isinstance(outcome, Failure):
            print(f"demo: the drive with stops {name}: {outcome}", file=sys.stderr)
            return 1
    heads = ["stops", "number", "error growth between two, worst [m]", "horizontal error, worst [m]", "ENU error [%]"]
    print(output.table_markdown(Table(heads, [row(name, outcome) for name, outcome in named.items()])))
    with open(os.path.join(arguments.directory, "comparison.json"), "w", encoding="utf-8") as file:
        json.dump({name: outcome.as_json() for name, outcome in named.items()}, file, indent=1, allow_nan=False)
    return 0


if __name__ == "__main__":
    sys.exit(main())
