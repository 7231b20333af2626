"""The engine of all campaigns: gives tasks to a pool, and gives back what becomes of each.

An outcome depends on its task alone, and outcomes come in the order of the tasks: any pool gives the same.
"""

import collections
import contextlib
import os
import signal

from .cluster import Cluster
from .local import LocalPool
from .progress import Progress
from .task import Failure, Lost

INTERRUPTED = 130  # the exit status


def add_options(parser, positive_count=int):
    """Of every program with a campaign."""
    parser.add_argument("--jobs", type=positive_count, default=os.cpu_count() or 1, metavar="N",
                        help="drives at the same time (default: one per core)")
    parser.add_argument("--scheduler", metavar="ADDRESS",
                        help="of a Dask scheduler, whose workers replace the cores of this machine")


@contextlib.contextmanager
def pool_of(arguments):
    """The requested workers. On exit, also by an interrupt, nothing keeps running here."""
    pool = Cluster(arguments.scheduler) if arguments.scheduler else LocalPool(arguments.jobs)
    try:
        yield pool
    finally:
        pool.close()


def heed_signals():
    """The end of a terminal or a session interrupts, as Ctrl-C does."""
    def interrupt(*_):
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, interrupt)
    signal.signal(signal.SIGHUP, interrupt)


def run_all(tasks, pool, what="drives"):
    """Outcome or Failure of each task, in order. A task lost with its process is run once more."""
    waiting = collections.deque(sorted(range(len(tasks)), key=lambda number: -tasks[number].weight))  # longest first
    running, outcomes, repeated = {}, [None] * len(tasks), set()
    progress = Progress(tasks, what)
    try:
        while waiting or running:
            while waiting and len(running) < pool.slots():
                number = waiting.popleft()
                running[pool.submit(tasks[number])] = number
            for future in pool.wait(running, progress.say):
                number = running.pop(future)
                outcome = pool.outcome(future)
                if isinstance(outcome, Lost) and number not in repeated:
                    progress.say(f"{tasks[number].name}: {outcome}; it is rerun")
                    repeated.add(number)
                    waiting.appendleft(number)
                    continue
                outcomes[number] = outcome
                progress.add(tasks[number], isinstance(outcome, Failure))
    finally:
        progress.finish()
    return outcomes
