"""Tries mutants side by side. Which ones are tried does not depend on how many at once."""

import collections
import concurrent.futures
import threading

from .workshop import KILLED, NOT_COMPILED, SAME, SURVIVED, TIMEOUT

Result = collections.namedtuple("Result", "mutant outcome test")


class Campaign:
    """Tries as many mutants, in their order, as it takes until `count` of them were compiled into other code."""

    def __init__(self, mutants, count, examine, tell):
        self.mutants, self.count, self.examine, self.tell = iter(mutants), count, examine, tell
        self.results = []
        self.running = 0
        self.changed = threading.Condition()

    def tested(self):
        return [result for result in self.results if result.outcome not in (NOT_COMPILED, SAME)]

    def take(self):
        """The next mutant, once it is certain to be needed; None if there is none."""
        with self.changed:
            self.changed.wait_for(lambda: len(self.tested()) + self.running < self.count or self.running == 0 or
                                  len(self.tested()) >= self.count)
            mutant = next(self.mutants, None) if len(self.tested()) < self.count else None
            self.running += mutant is not None
            return mutant

    def give(self, result):
        with self.changed:
            self.running -= 1
            self.results.append(result)
            self.tell(result, len(self.tested()))
            self.changed.notify_all()

    def stop(self):
        with self.changed:
            self.count = 0
            self.changed.notify_all()

    def work(self):
        try:
            while (mutant := self.take()) is not None:
                self.give(Result(mutant, *self.examine(mutant)))
        except BaseException:
            self.stop()
            raise

    def run(self, jobs):
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            try:
                for future in [pool.submit(self.work) for _ in range(jobs)]:
                    future.result()
            except BaseException:
                self.stop()
                raise
        self.results.sort()
        return self


def report(campaign, least_percent):
    """The survivors and the rate; whether it is high enough."""
    counts = collections.Counter(result.outcome for result in campaign.results)
    tested = len(campaign.tested())
    killed = counts[KILLED] + counts[TIMEOUT]
    percent = 100.0 * killed / tested if tested else 0.0
    lines = [f"survived: {result.mutant}" for result in campaign.results if result.outcome == SURVIVED]
    lines.append(f"{killed} of {tested} mutants noticed ({percent:.1f} %), {counts[TIMEOUT]} of them because the tests did "
                 f"not end; skipped: {counts[NOT_COMPILED]} that do not compile, {counts[SAME]} that change no code")
    return "\n".join(lines), percent >= least_percent
