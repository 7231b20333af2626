"""What the tests of `import` share: a folder of files, and what becomes of it."""

import contextlib
import io
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import rosbag

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

import import_recording  # noqa: E402

SIMULATE = os.environ.get("SLIPNAV_SIMULATE", shutil.which("simulate") or "")
PROGRAMS = os.path.dirname(SIMULATE)

DEG = math.pi / 180.0
G = 9.80665
T0 = 1_600_000_000
CLOSE = 1e-9

IMU = "t,wx,wy,wz,ax,ay,az\n" + "".join(f"{T0 + i / 100:.2f},0.1,0.2,0.3,1,2,9.8\n" for i in range(200))
POS_HEAD = ("% (lat/lon/height=WGS84/ellipsoidal,Q=1:fix,2:float,ns=# of satellites)\n"
            "%  GPST                  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)   sdu(m)  sdne(m)  "
            "sdeu(m)  sdun(m) age(s)  ratio\n")


class ImportTestCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.out = self.path("out.bag")

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def run_import(self, *arguments, out=True):
        """Status and words of one import in the folder of the files; what would be a traceback fails the test."""
        words = ["--programs", PROGRAMS, *arguments] + (["--out", self.out] if out else [])
        stdout, stderr = io.StringIO(), io.StringIO()
        before = os.getcwd()
        os.chdir(self.folder)
        try:
            with contextlib.redirect_stdout(stdout), contextlib.redirect_stderr(stderr):
                status = import_recording.main(words)
        except SystemExit as end:
            status = end.code
        finally:
            os.chdir(before)
        return subprocess.CompletedProcess(words, status, stdout.getvalue(), stderr.getvalue())

    def imported(self, *arguments, out=True):
        """Messages of the recording by topic: (time of the recording, message)."""
        process = self.run_import(*arguments, out=out)
        self.assertEqual(process.returncode, 0, process.stderr)
        self.said = process.stderr
        self.printed = process.stdout
        messages = {}
        before = 0
        with rosbag.Bag(self.out) as bag:
            for topic, message, time in bag:
                self.assertGreaterEqual(time.to_nsec(), before)
                before = time.to_nsec()
                if hasattr(message, "header"):
                    self.assertEqual(message.header.stamp, time)
                messages.setdefault(topic, []).append((before, message))
        return messages

    def refused(self, *arguments, out=True):
        """What is said of an import that fails; nothing is written."""
        process = self.run_import(*arguments, out=out)
        self.assertEqual(process.returncode, 2, process.stdout + process.stderr)
        self.assertEqual(len(process.stderr.strip().splitlines()), 1, process.stderr)
        self.assertFalse(os.path.exists(self.out))
        self.assertEqual([name for name in os.listdir(self.folder) if name.endswith(".part")], [])
        return process.stderr.strip()

    def assert_close(self, found, wanted):
        np.testing.assert_allclose(np.array(found, dtype=float), np.array(wanted, dtype=float), rtol=0, atol=CLOSE)

    def assert_xyz(self, vector, wanted):
        self.assert_close([vector.x, vector.y, vector.z], wanted)
