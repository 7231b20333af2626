"""Drives many drives at once, with a progress bar, and leaves no process behind."""

import concurrent.futures
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from .drive import read_outcome

BAR_CHARACTERS = 30
STEP_WITHOUT_TERMINAL = 0.1  # of all the work, between two lines of progress


class Failure(Exception):
    """Why a drive has no outcome, in one line."""


class Cancelled(Exception):
    pass


class Progress:
    """Counts metres, for the time of a drive is in proportion to its length."""

    def __init__(self, drives, stream=sys.stderr):
        self.stream = stream
        self.count = len(drives)
        self.total_m = sum(drive.distance_m for drive in drives)
        self.done = 0
        self.done_m = 0.0
        self.failures = 0
        self.begin = time.monotonic()
        self.shown = 0.0

    def add(self, drive, failed):
        self.done += 1
        self.done_m += drive.distance_m
        self.failures += failed
        part = self.done_m / self.total_m
        if self.stream.isatty():
            self.stream.write("\r\033[K" + self.line(part))
        elif part >= self.shown + STEP_WITHOUT_TERMINAL or self.done == self.count:
            self.shown = part
            self.stream.write(self.line(part) + "\n")
        self.stream.flush()

    def line(self, part):
        filled = int(part * BAR_CHARACTERS)
        left_s = (time.monotonic() - self.begin) * (1.0 / part - 1.0)
        failed = f", {self.failures} failed" if self.failures else ""
        return (f"[{'#' * filled}{'.' * (BAR_CHARACTERS - filled)}] {self.done} of {self.count} drives{failed}, "
                f"{int(left_s) // 60}:{int(left_s) % 60:02d} left")

    def finish(self):
        if self.stream.isatty() and self.done:
            self.stream.write("\n")


class Fleet:
    def __init__(self, simulate, jobs):
        self.simulate = simulate
        self.jobs = jobs
        self.lock = threading.Lock()
        self.cancelled = False
        self.processes = set()

    def drive_all(self, drives):
        """Outcome or Failure of each drive. When it is interrupted, every process has ended before this returns."""
        drives = sorted(drives, key=lambda drive: -drive.distance_m)  # a long one that is last keeps all waiting
        progress = Progress(drives)
        outcomes = {}
        folder = tempfile.mkdtemp(prefix="slipnav_tables_")
        pool = concurrent.futures.ThreadPoolExecutor(self.jobs)
        try:
            pending = {pool.submit(self.drive_one, drive, os.path.join(folder, str(number))): drive
                       for number, drive in enumerate(drives)}
            for future in concurrent.futures.as_completed(pending):
                drive = pending[future]
                outcomes[drive] = future.result()
                progress.add(drive, isinstance(outcomes[drive], Failure))
        finally:
            self.cancel()
            pool.shutdown()
            shutil.rmtree(folder, ignore_errors=True)
            progress.finish()
        return outcomes

    def drive_one(self, drive, directory):
        try:
            self.call([self.simulate] + drive.arguments(directory))
            return read_outcome(drive, directory)
        except Failure as failure:
            return failure
        except (OSError, ValueError, KeyError) as error:
            return Failure(f"{type(error).__name__}: {error}")
        finally:
            shutil.rmtree(directory, ignore_errors=True)

    def call(self, command):
        with self.lock:
            if self.cancelled:
                raise Cancelled
            process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            self.processes.add(process)
        try:
            _, errors = process.communicate()
        finally:
            with self.lock:
                self.processes.discard(process)
        if process.returncode != 0:
            words = errors.strip().splitlines()
            raise Failure(words[-1] if words else f"simulate ended with status {process.returncode}")

    def cancel(self):
        """Nothing new begins, and what is under way ends."""
        with self.lock:
            self.cancelled = True
            for process in self.processes:
                process.terminate()
