"""Tasks on this machine: a thread per core, which waits for the program it has started."""

import concurrent.futures
import threading

from .task import Caller, perform


class Cancelled(Exception):
    pass


class LocalPool(Caller):
    """When it is closed, every process that it started has ended."""

    def __init__(self, jobs):
        self.jobs = jobs
        self.lock = threading.Lock()
        self.cancelled = False
        self.processes = set()
        self.pool = concurrent.futures.ThreadPoolExecutor(jobs)

    def slots(self):
        return self.jobs

    def submit(self, task):
        return self.pool.submit(perform, task, self)

    def wait(self, futures, say):
        """Those of them that are done, at least one. No messages here: no worker gets lost."""
        return concurrent.futures.wait(futures, return_when=concurrent.futures.FIRST_COMPLETED).done

    def outcome(self, future):
        return future.result()

    def close(self):
        """Starts nothing new, and ends what is running."""
        with self.lock:
            self.cancelled = True
            for process in self.processes:
                process.terminate()
        self.pool.shutdown()

    def start(self, command, **options):
        with self.lock:
            if self.cancelled:
                raise Cancelled
            process = super().start(command, **options)
            self.processes.add(process)
            return process

    def ended(self, process):
        with self.lock:
            self.processes.discard(process)
