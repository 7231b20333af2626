#!/usr/bin/python3
"""Runs one task of a campaign for a worker of a cluster: reads it from standard input, writes its outcome.

A separate process, so that a worker needs nothing of this project and never keeps an old version of it.
"""

import ctypes
import os
import pickle
import signal
import subprocess
import sys

# The packages are next to the one of this file.
sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

from slipnav_campaign.task import Caller, Failure, perform  # noqa: E402

PR_SET_PDEATHSIG = 1  # of <linux/prctl.h>
ENVIRONMENT = ("PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "CMAKE_PREFIX_PATH")


def die_with_parent():
    """A killed worker leaves no process running, which would write alongside its replacement."""
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


class RemoteCaller(Caller):
    def start(self, command, **options):
        return subprocess.Popen(command, preexec_fn=die_with_parent, **options)


def packed(task):
    """A task with what it needs from this process: its folder, and the ROS environment."""
    environment = {name: value for name, value in os.environ.items() if name in ENVIRONMENT or name.startswith("ROS_")}
    return pickle.dumps((os.getcwd(), environment, pickle.dumps(task)))


def unpacked_and_done(packet):
    folder, environment, task = pickle.loads(packet)
    os.environ.update(environment)
    try:
        os.chdir(folder)
    except OSError as error:
        return Failure(f"{os.uname().nodename}: {error}; a cluster needs the same paths on every machine")
    return perform(pickle.loads(task), RemoteCaller())


def main():
    die_with_parent()
    outcome = unpacked_and_done(sys.stdin.buffer.read())
    sys.stdout.buffer.write(pickle.dumps(outcome))


if __name__ == "__main__":
    main()
