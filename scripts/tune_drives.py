#!/usr/bin/python3
"""Tunes a robot from its drives on a cluster: the executable `tune` asks for runs, and its workers make them.

Without --scheduler the executable is called unchanged, which runs the drives on all cores itself.
"""

import argparse
import os
import queue
import shutil
import subprocess
import sys
import threading

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from slipnav_campaign import engine  # noqa: E402
from slipnav_campaign.task import Failure, Task, output_of  # noqa: E402

REQUEST = "run "


def say(text):
    print(f"tune: {text}", file=sys.stderr)


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        self.exit(2, f"tune: {message}\n")


def parse_arguments():
    """(options of this program, arguments of the executable)"""
    beside = os.path.join(os.path.dirname(os.path.abspath(sys.argv[0])), "tune")
    parser = Parser(prog="tune", add_help=False, allow_abbrev=False, usage=argparse.SUPPRESS)
    parser.add_argument("--scheduler", metavar="ADDRESS",
                        help="of a Dask scheduler, whose workers replace the cores of this machine")
    parser.add_argument("--tune", metavar="FILE", default=shutil.which("tune") or beside,
                        help="the executable (default: in PATH, or next to this program)")
    arguments, words = parser.parse_known_args()
    if not os.access(arguments.tune, os.X_OK):
        parser.error(f"no executable '{arguments.tune}', name it by --tune")
    if "--help" in words or "-h" in words:
        print(subprocess.run([arguments.tune, "--help"], check=True, capture_output=True, text=True).stdout)
        print(parser.format_help().strip())
        sys.exit(0)
    return arguments, words


def read_lines(stream, lines):
    """From a thread of its own; None at the end."""
    for line in stream:
        lines.put(line)
    lines.put(None)


class Service:
    """Answers the requests of one process until it ends; its other lines are printed."""

    def __init__(self, command, pool):
        self.command = command
        self.campaign = engine.Campaign(pool, say)
        self.process = subprocess.Popen([*command, "--ask", str(pool.slots())], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE, text=True)
        self.lines = queue.Queue()
        threading.Thread(target=read_lines, args=(self.process.stdout, self.lines), daemon=True).start()
        self.ended = False

    def take(self, line):
        if line is None:
            self.ended = True
        elif line.startswith(REQUEST):
            number, run = line[len(REQUEST):].strip().split(" ", 1)
            self.campaign.add(Task(f"run {number}", output_of, ([*self.command, "--run", run],)))
        else:
            print(line, end="", flush=True)

    def take_all(self):
        """Waits for a line only if there is nothing else to do."""
        if not self.campaign.is_busy():
            self.take(self.lines.get())
        while not self.lines.empty():
            self.take(self.lines.get())

    def answer(self, task, outcome):
        number = task.name.rpartition(" ")[2]
        text = f"failed {number} {outcome}" if isinstance(outcome, Failure) else f"done {number} {outcome.strip()}"
        try:
            self.process.stdin.write(text + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # it has ended, and has said why

    def serve(self):
        """The exit status of the process."""
        try:
            while not self.ended:
                self.take_all()
                if self.campaign.is_busy():
                    for task, outcome in self.campaign.step():
                        self.answer(task, outcome)
            return self.process.wait()
        finally:
            self.process.terminate()
            self.process.wait()


def main():
    arguments, words = parse_arguments()
    command = [arguments.tune, *words]
    if not arguments.scheduler:
        os.execv(arguments.tune, command)

    def work():
        with engine.pool_of(arguments) as pool:
            return Service([os.path.abspath(arguments.tune), *words], pool).serve()

    return engine.status_of(work, say)


if __name__ == "__main__":
    sys.exit(main())
