"""Changes single lines of the core at random, and counts which of these mutants the unit tests notice.

Prints the mutants that survive and the rate of those that do not; ends with status 1 if that is too low.
"""

import argparse
import os
import pathlib
import sys

from slipnav_campaign.engine import status_of

from . import campaign
from .draw import CORE, draw
from .workshop import Broken, Workshop

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        self.exit(2, f"mutate: {message}\n")


def parse_arguments():
    parser = Parser(prog="mutate", description=__doc__.splitlines()[0])
    parser.add_argument("only", nargs="*", metavar="PATH", help=f"only these files or folders of {CORE}")
    parser.add_argument("--count", type=int, default=100, metavar="N", help="mutants (default %(default)s)")
    parser.add_argument("--seed", type=int, default=1, metavar="N", help="of the draw (default %(default)s)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="at once (default: one per core)")
    parser.add_argument("--least", type=float, default=90.0, metavar="PERCENT",
                        help="rate below which the status is 1 (default %(default)g)")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build", metavar="DIR", help="folder of the build")
    arguments = parser.parse_args()
    if arguments.count < 1 or arguments.jobs < 1:
        parser.error("--count and --jobs are at least 1")
    for path in arguments.only:
        if not (ROOT / path).exists() or CORE not in (pathlib.Path(path), *pathlib.Path(path).parents):
            parser.error(f"no file or folder '{path}' in {CORE}")
    return arguments


def say(what):
    print(f"mutate: {what}", file=sys.stderr, flush=True)


def tell(result, tested):
    say(f"{tested}: {result.outcome}{' by ' + result.test if result.test else ''}: {result.mutant}")


def try_mutants(arguments):
    mutants = draw(ROOT, arguments.seed, arguments.only)
    build = arguments.build.resolve()
    try:
        workshop = Workshop(ROOT, build, build / "mutants")
    except Broken as error:
        say(error)
        return 1
    done = campaign.Campaign(mutants, arguments.count, workshop.examine, tell).run(arguments.jobs)
    text, is_enough = campaign.report(done, arguments.least)
    print(text)
    return 0 if is_enough else 1


def main():
    arguments = parse_arguments()
    return status_of(lambda: try_mutants(arguments), say)


if __name__ == "__main__":
    sys.exit(main())
