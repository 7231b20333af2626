"""Tasks on the workers of a Dask scheduler. They need the same paths as here, but not this project in memory."""

import logging
import os
import pickle
import subprocess
import sys
import time

from . import remote
from .task import Failure, Lost, failure_of

LONGEST_SILENCE_S = 10  # of a scheduler that is asked for the first time
LONGEST_WAIT_S = 60  # for the first worker
POLL_S = 0.5
MISSING = "--scheduler needs Dask, which is not installed: sudo apt-get install python3-distributed"


class SchedulerError(ConnectionError):
    """There is no cluster, or it is gone; one line."""


def look_at_scheduler(client):
    """({address: (threads, keys of its tasks)} of the workers, {key: how many workers it has lost})."""

    def state(dask_scheduler=None):  # a function within a function travels as it is
        workers = {address: (worker.nthreads, [task.key for task in worker.processing])
                   for address, worker in dask_scheduler.workers.items()}
        return workers, {key: task.suspicious for key, task in dask_scheduler.tasks.items() if task.suspicious}

    return client.run_on_scheduler(state)


class Cluster:
    """No more tasks are handed in than there are threads, so that a worker that is lost costs what it was doing."""

    def __init__(self, address):
        try:
            import distributed
        except ImportError:
            raise SchedulerError(MISSING) from None
        logging.disable(logging.CRITICAL)  # Dask tells losses by tracebacks; here they are said in a line
        self.distributed = distributed
        self.address = address
        self.names = {}  # of tasks, by key
        self.losses = {}  # of tasks, by key
        self.client = self.connected()
        self.workers = self.first_workers()

    def connected(self):
        try:
            return self.distributed.Client(self.address, timeout=LONGEST_SILENCE_S)
        except (OSError, ValueError, TypeError) as error:
            raise SchedulerError(f"no Dask scheduler answers at '{self.address}': {one_line(error)}; "
                                 "start one with dask-scheduler") from None

    def first_workers(self):
        try:
            self.client.wait_for_workers(1, timeout=LONGEST_WAIT_S)
            return look_at_scheduler(self.client)[0]
        except (OSError, self.distributed.TimeoutError):
            self.client.close()
            raise SchedulerError(f"the scheduler at '{self.address}' has no worker; "
                                 f"start one with dask-worker {self.address}") from None

    def slots(self):
        return sum(threads for threads, _ in self.workers.values())

    def submit(self, task):
        key = f"{task.name}-{os.urandom(8).hex()}"
        self.names[key] = task.name
        return self.client.submit(subprocess.run, [sys.executable, "-B", os.path.abspath(remote.__file__)],
                                  input=remote.packed(task), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  key=key, pure=False)

    def wait(self, futures, say):
        """Those of them that are done, if any. What is lost is said."""
        done = []
        try:
            if futures:
                done = self.distributed.wait(list(futures), timeout=POLL_S, return_when="FIRST_COMPLETED").done
            else:
                time.sleep(POLL_S)
        except self.distributed.TimeoutError:
            pass
        except (OSError, self.distributed.CancelledError) as error:
            raise self.gone() from error
        self.note_losses(say)
        return done

    def note_losses(self, say):
        try:
            workers, losses = look_at_scheduler(self.client)
        except (OSError, self.distributed.TimeoutError, self.distributed.CancelledError) as error:
            raise self.gone() from error
        lost = {key for key, count in losses.items() if count > self.losses.get(key, 0)}
        for address in sorted(set(self.workers) - set(workers)):
            say(f"worker {address} is lost, {len(workers)} left" + ("" if workers else "; waiting for another"))
            lost |= {key for key in self.workers[address][1] if self.is_unfinished(key, workers)}
        for key in sorted(lost & set(self.names)):
            say(f"{self.names[key]}: its worker was lost; it is rerun")
        self.workers, self.losses = workers, losses

    def is_unfinished(self, key, workers):
        return key in self.names and (not workers or any(key in keys for _, keys in workers.values()))

    def outcome(self, future):
        try:
            process = future.result()
        except self.distributed.KilledWorker:
            return Failure("every worker that had it was lost")
        except (OSError, self.distributed.CancelledError) as error:
            raise self.gone() from error
        finally:
            self.names.pop(future.key, None)
            future.release()
        if process.returncode == 0:
            return pickle.loads(process.stdout)
        failure = failure_of("the process of a worker", process.returncode,
                             process.stderr.decode(errors="replace").strip().splitlines())
        return failure if isinstance(failure, Lost) else Failure(f"on its worker: {failure}")

    def gone(self):
        return SchedulerError(f"the scheduler at '{self.address}' is lost")

    def close(self):
        self.client.close(timeout=LONGEST_SILENCE_S)


def one_line(error):
    return " ".join(str(error).split()) or type(error).__name__
