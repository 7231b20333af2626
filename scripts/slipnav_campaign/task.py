"""What a campaign consists of, and how one task of it is run, wherever that is."""

import os
import signal
import subprocess
from dataclasses import dataclass
from typing import Callable, Tuple


class Failure(Exception):
    """Why a task has no outcome, in one line."""

    said = ()  # lines of the program before that


class Lost(Failure):
    """The process was killed from outside, for example when memory ran out: it may succeed another time."""


@dataclass(frozen=True)
class Task:
    name: str
    function: Callable  # of a module: function(call, *arguments), with `call` as in Caller
    arguments: Tuple
    weight: float = 1.0  # about how long it takes, in any unit


def perform(task, call):
    """Its outcome, or Failure."""
    try:
        return task.function(call, *task.arguments)
    except Failure as failure:
        return failure
    except (OSError, ValueError, KeyError) as error:
        return Failure(f"{type(error).__name__}: {error}")


class Caller:
    """Runs one program and waits for it."""

    def __call__(self, command):
        """What it wrote: (to its output, to its errors). Raises Failure with the last line of the latter."""
        process = self.start(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            output, errors = process.communicate()
        finally:
            self.ended(process)
        if process.returncode != 0:
            raise failure_of(os.path.basename(command[0]), process.returncode, errors.strip().splitlines())
        return output, errors

    def start(self, command, **options):
        return subprocess.Popen(command, **options)

    def ended(self, process):
        pass


def failure_of(program, status, lines):
    if status == -signal.SIGKILL:
        return Lost(f"{program} was killed")
    if status < 0:
        return Failure(f"{program} was ended by {signal.Signals(-status).name}")
    failure = Failure(lines[-1] if lines else f"{program} ended with status {status}")
    failure.said = tuple(lines[:-1])
    return failure


def output_of(call, command):
    """A task that is one program: what it wrote."""
    return call(command)[0]
