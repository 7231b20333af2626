"""A bar on a terminal; otherwise a line now and then."""

import sys
import time

BAR_CHARACTERS = 30
STEP_WITHOUT_TERMINAL = 0.1  # of all the work, between two lines of progress


class Progress:
    """Counts weights, to which the time of a task is proportional."""

    def __init__(self, tasks, what, stream=None):
        self.stream = stream or sys.stderr
        self.what = what
        self.count = len(tasks)
        self.total = sum(task.weight for task in tasks)
        self.done = 0
        self.done_weight = 0.0
        self.failures = 0
        self.begin = time.monotonic()
        self.shown = 0.0

    def add(self, task, failed):
        self.done += 1
        self.done_weight += task.weight
        self.failures += failed
        part = self.done_weight / self.total if self.total > 0.0 else 1.0
        if self.stream.isatty():
            self.stream.write("\r\033[K" + self.line(part))
        elif part >= self.shown + STEP_WITHOUT_TERMINAL or self.done == self.count:
            self.shown = part
            self.stream.write(self.line(part) + "\n")
        self.stream.flush()

    def say(self, text):
        """A separate line, above the bar."""
        self.stream.write(("\r\033[K" if self.stream.isatty() else "") + text + "\n")
        self.stream.flush()

    def line(self, part):
        filled = int(part * BAR_CHARACTERS)
        left_s = (time.monotonic() - self.begin) * (1.0 / part - 1.0) if part > 0.0 else 0.0
        failed = f", {self.failures} failed" if self.failures else ""
        return (f"[{'#' * filled}{'.' * (BAR_CHARACTERS - filled)}] {self.done} of {self.count} {self.what}{failed}, "
                f"{int(left_s) // 60}:{int(left_s) % 60:02d} left")

    def finish(self):
        if self.stream.isatty() and self.done:
            self.stream.write("\n")
