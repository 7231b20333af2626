#!/usr/bin/python3
"""Several recordings at once give what each gives alone, and no loss of a worker is silent.

The environment names the executable: SLIPNAV_SIMULATE; `evaluate` is beside it.
"""

import functools
import glob
import importlib
import importlib.util
import itertools
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from drives_fixture import FolderTest, PROGRAM, ROOT, wait_for_children  # noqa: E402

TUNE = os.path.join(ROOT, "scripts", "tune_drives.py")


def is_running(process):
    """A process that has ended may have nobody to ask for its status."""
    try:
        with open(f"/proc/{process}/stat", encoding="utf-8") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


def split_bag(path, parts, pauses):
    """Writes the messages before the first pause to the first part, and so on."""
    import rosbag

    with rosbag.Bag(path) as source:
        begin = source.get_start_time()
        targets = [rosbag.Bag(part, "w") for part in parts]
        for topic, message, stamp in source.read_messages():
            place = sum(stamp.to_sec() - begin >= pause for pause in pauses)
            targets[place].write(topic, message, stamp)
        for target in targets:
            target.close()


@functools.lru_cache(maxsize=None)
def recorded_drives():
    """A folder of four."""
    folder = tempfile.mkdtemp(prefix="slipnav_evaluate_drives_")
    unittest.addModuleCleanup(shutil.rmtree, folder, ignore_errors=True)
    for terrain, seed in itertools.product(("paved", "rough"), "12"):
        subprocess.run([os.environ["SLIPNAV_SIMULATE"], "--terrain", terrain, "--distance", "40", "--seed", seed,
                        "--policy", "periodic:15:3", "--bag", os.path.join(folder, f"{terrain}{seed}.bag")],
                       check=True, capture_output=True)
    return folder


class DrivesTest(FolderTest):
    """With the executables, on drives that were recorded in simulation."""

    def setUp(self):
        super().setUp()
        self.drives = recorded_drives()
        self.bags = sorted(glob.glob(os.path.join(self.drives, "*.bag")))
        self.evaluate = os.path.join(os.path.dirname(os.environ["SLIPNAV_SIMULATE"]), "evaluate")

    def run_program(self, *arguments, evaluate=None):
        result = subprocess.run([sys.executable, PROGRAM, "--evaluate", evaluate or self.evaluate, *arguments],
                                capture_output=True,
                                text=True, check=False, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result


class RecordedDrivesTest(DrivesTest):
    def alone(self, bag):
        """Lines of its table, and figures."""
        out = self.path("alone", os.path.basename(bag))
        result = subprocess.run([self.evaluate, bag, "--out", out], check=True, capture_output=True, text=True)
        return result.stdout.splitlines(), self.read(out, "metrics.json")

    def test_the_table_is_that_of_single_runs(self):
        result = self.run_program("--out", "out", "--jobs", "3", *self.bags)
        lines = result.stdout.splitlines()
        singles = [self.alone(bag) for bag in self.bags]
        self.assertEqual(lines, singles[0][0][:2] + [single[2] for single, _ in singles]
                         + [single[3] for single, _ in singles])
        for bag, row, (_, metrics_json) in zip(self.bags, self.rows(), singles):
            figures = json.loads(metrics_json, parse_float=str, parse_int=str)
            for key in set(row) & set(figures) - {"problems", "alarms"}:
                self.assertEqual(row[key], figures[key] or "", key)
            name = os.path.basename(bag)
            for file in ("estimate.tum", "timeline.csv", "filter.csv"):
                self.assertEqual(self.read("out", name[:-4], file), self.read("alone", name, file))

    def test_the_number_of_workers_changes_no_bit(self):
        groups_of = ("--group", "firm=paved*", "--group", "soft=rough*")
        one, three = (self.run_program("--out", out, "--jobs", jobs, *groups_of, self.drives)
                      for out, jobs in (("one", "1"), ("three", "3")))
        self.assertEqual(one.stdout, three.stdout)
        self.assertIn("## Stop intervals by group", one.stdout)
        for name in ("rows.csv", "index.html", "groups.json", "groups.md", "stop_intervals.png"):
            with open(self.path("one", name), "rb") as first, open(self.path("three", name), "rb") as other:
                self.assertEqual(first.read(), other.read(), name)
        self.assertEqual([row["group"] for row in self.rows("one")], ["firm", "firm", "soft", "soft"])
        data = json.loads(self.read("one", "groups.json"))
        self.assertEqual(len(data["intervals"]["real"]["groups"]["soft"]["intervals_s"]), 2)
        self.assertAlmostEqual(data["intervals"]["real"]["groups"]["firm"]["intervals_s"][0], 15.0, delta=3.5)

    def test_parts_are_the_whole(self):
        parts = [self.path(f"paved1_{number}.bag") for number in range(3)]
        split_bag(self.bags[0], parts, (30.0, 60.0))
        result = self.run_program(*parts, self.bags[2], "--out", "out")
        self.assertIn(f"evaluate: paved1: one recording of 3 parts, which --separate would keep apart: {', '.join(parts)}",
                      result.stderr)
        lines, _ = self.alone(self.bags[0])
        self.assertIn(lines[2], result.stdout.splitlines())
        self.assertEqual(self.read("out", "paved1", "estimate.tum"), self.read("alone", "paved1.bag", "estimate.tum"))
        apart = subprocess.run([sys.executable, PROGRAM, "--evaluate", self.evaluate, "--separate", *parts],
                               capture_output=True,
                               text=True, check=False)
        self.assertNotIn("one recording", apart.stderr)
        self.assertEqual([line.split()[0] for line in apart.stdout.splitlines() if line.startswith("paved1_")][:3],
                         ["paved1_0", "paved1_1", "paved1_2"])


@unittest.skipUnless(importlib.util.find_spec("distributed"), "Dask is not installed (python3-distributed)")
class ClusterTest(DrivesTest):
    """A scheduler and three workers on this machine."""

    def setUp(self):
        super().setUp()
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
        self.begin("dask_scheduler", "--host", "127.0.0.1", "--port", self.address.rpartition(":")[2])
        self.workers = [self.begin("dask_worker", self.address, "--nthreads", "1", "--no-nanny", "--local-directory",
                                   self.folder) for _ in range(3)]
        with importlib.import_module("distributed").Client(self.address) as client:
            client.wait_for_workers(len(self.workers), timeout=120)  # only what has joined can be reported as lost

    def begin(self, program, *arguments):
        environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}  # not that of ROS
        process = subprocess.Popen([sys.executable, "-m", f"distributed.cli.{program}", "--no-dashboard", *arguments],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=self.folder, env=environment)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def test_a_worker_that_is_killed_costs_its_task_once(self):
        slow = self.executable("evaluate", f'#!/bin/bash\n[[ "$1" == --help ]] || echo "$1" >>"{self.path("calls")}"\n'
                                           f'[[ "$1" == --help ]] || sleep 5\nexec "{self.evaluate}" "$@"\n')
        process = subprocess.Popen([sys.executable, PROGRAM, "--evaluate", slow, "--scheduler", self.address,
                                    "--out", "cluster", *self.bags],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                   cwd=self.folder)
        child = wait_for_children(self.workers[1].pid, 1)[0]
        grandchild = wait_for_children(child, 1)[0]
        self.workers[1].kill()
        time.sleep(0.5)
        self.assertFalse(is_running(grandchild))  # what the worker had begun ends with it
        output, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, errors)
        self.assertRegex(errors, r"worker tcp://127\.0\.0\.1:\d+ is lost, [12] left\n")
        self.assertEqual(errors.count("its worker was lost; it is rerun"), 1, errors)
        self.assertEqual(len(self.read("calls").splitlines()), len(self.bags) + 1)
        here = self.run_program("--out", "here", *self.bags)
        self.assertEqual(output, here.stdout)
        self.assertEqual(self.read("cluster", "rows.csv"), self.read("here", "rows.csv"))
        self.assertEqual(self.read("cluster", "rough2", "timeline.csv"), self.read("here", "rough2", "timeline.csv"))

    def test_tuning_is_the_same_with_a_worker_killed(self):
        tune = os.path.join(os.path.dirname(self.evaluate), "tune")
        slow = self.executable("tune", f'#!/bin/bash\n[[ "$*" == *--run* ]] && sleep 1\nexec "{tune}" "$@"\n')
        arguments = [*self.bags[:2], "--only", "wheel.speed_std_mps"]
        process = subprocess.Popen([sys.executable, "-B", TUNE, "--tune", slow, "--scheduler", self.address, *arguments],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=self.folder)
        wait_for_children(self.workers[1].pid, 1)
        self.workers[1].kill()
        output, errors = process.communicate(timeout=300)
        self.assertEqual(process.returncode, 0, errors)
        self.assertRegex(errors, r"tune: worker tcp://127\.0\.0\.1:\d+ is lost, [12] left\n")
        self.assertRegex(errors, r"tune: run \d+: its worker was lost; it is rerun\n")
        here = subprocess.run([tune, *arguments], check=True, capture_output=True, text=True)
        self.assertIn("log likelihood", output)
        self.assertEqual(output, here.stdout)


if __name__ == "__main__":
    unittest.main()
