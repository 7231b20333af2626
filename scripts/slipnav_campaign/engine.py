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


def status_of(work, say):
    """The exit status of a program whose work may be interrupted, or fail for a file or a connection."""
    heed_signals()
    try:
        return work()
    except KeyboardInterrupt:
        say("interrupted")
        return INTERRUPTED
    except OSError as error:
        say(error)
        return 1


class Campaign:
    """Tasks on a pool. One that is lost with its process is run once more."""

    def __init__(self, pool, say):
        self.pool = pool
        self.say = say
        self.waiting = collections.deque()
        self.running = {}  # tasks by what the pool has given for them
        self.repeated = set()  # tasks that have been lost, by identity

    def add(self, task):
        self.waiting.append(task)

    def is_busy(self):
        return bool(self.waiting or self.running)

    def step(self):
        """[(task, its outcome or Failure)] of those that have ended; waits a while for one."""
        while self.waiting and len(self.running) < self.pool.slots():
            task = self.waiting.popleft()
            self.running[self.pool.submit(task)] = task
        ended = []
        for future in self.pool.wait(self.running, self.say):
            task = self.running.pop(future)
            outcome = self.pool.outcome(future)
            if isinstance(outcome, Lost) and id(task) not in self.repeated:
                self.say(f"{task.name}: {outcome}; it is rerun")
                self.repeated.add(id(task))
                self.waiting.appendleft(task)
            else:
                self.repeated.discard(id(task))
                ended.append((task, outcome))
        return ended


def run_all(tasks, pool, what="drives"):
    """Outcome or Failure of each task, in order."""
    progress = Progress(tasks, what)
    campaign = Campaign(pool, progress.say)
    for task in sorted(tasks, key=lambda task: -task.weight):  # longest first
        campaign.add(task)
    outcomes = {}
    try:
        while campaign.is_busy():
            for task, outcome in campaign.step():
                outcomes[id(task)] = outcome
                progress.add(task, isinstance(outcome, Failure))
    finally:
        progress.finish()
    return [outcomes[id(task)] for task in tasks]
