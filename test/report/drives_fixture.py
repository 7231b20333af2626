"""What the tests of several recordings share."""

import csv
import os
import shutil
import signal
import stat
import subprocess
import tempfile
import time
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))

PROGRAM = os.path.join(ROOT, "scripts", "evaluate_drives.py")


def heed_interrupts():
    """Processes that a shell runs in the background are told to ignore them, and hand that on."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class FolderTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="slipnav_evaluate_test_")
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def executable(self, name, text):
        with open(self.path(name), "w", encoding="ascii") as file:
            file.write(text)
        os.chmod(self.path(name), os.stat(self.path(name)).st_mode | stat.S_IXUSR)
        return self.path(name)

    def read(self, *names):
        with open(self.path(*names), encoding="utf-8") as file:
            return file.read()

    def rows(self, folder="out"):
        with open(self.path(folder, "rows.csv"), newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))


def wait_for_children(parent, count):
    for _ in range(300):
        found = subprocess.run(["pgrep", "-P", str(parent)], capture_output=True, text=True, check=False).stdout
        if len(found.split()) >= count:
            return found.split()
        time.sleep(0.1)
    raise AssertionError(f"{parent} began nothing")
