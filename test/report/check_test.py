#!/usr/bin/python3
"""From a recorded drive to an estimate with nothing typed but wheel size and grade of the sensor: `check` writes the configuration.

The environment names the executable SLIPNAV_SIMULATE; slipnav's other programs lie beside it. Recordings are those of `foreign`;
a drive whose file is not there is skipped.
"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "scripts"))

from slipnav_zoo import catalog  # noqa: E402

PROGRAMS = os.path.dirname(os.environ.get("SLIPNAV_SIMULATE", shutil.which("simulate") or ""))
DATA = os.path.join(ROOT, "..", "shared", "data")
GRADE = os.path.join(ROOT, "config", "grades", "mems.yaml")

LARGEST_RATIO = 1.5  # of the final error to that of wheels and gyro
SPARE_PCT = 0.3
LEAST_COVERAGE_PCT = 95.0
RUNAWAY = "faster than any slip explains"
ACCEL_NOISES = (0.05, 0.08, 0.1, 0.14, 0.17)  # m/s/√h; at rest the sensor shows 0.14


def program(name, *arguments):
    return subprocess.run([os.path.join(PROGRAMS, name), *arguments], capture_output=True, text=True, check=False)


class CheckedDriveTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def checked(self, name, *options):
        """The recording, and options for `evaluate` with what check has written."""
        bag = os.path.join(DATA, name + ".bag")
        if not os.path.isfile(bag):
            self.skipTest(f"no recording {name}")
        written = os.path.join(self.folder, "robot.yaml")
        said = program("check", bag, "--sensor", GRADE, "--out", written, *options)
        self.assertIn(said.returncode, (0, 1), said.stdout)
        return [bag, "--config", GRADE, "--config", written]

    def metrics(self, arguments, *options):
        said = program("evaluate", *arguments, "--set", "forecast.interval_s=60", "--out", self.folder, *options)
        self.assertEqual(said.returncode, 0, said.stderr)
        with open(os.path.join(self.folder, "metrics.json"), encoding="utf-8") as file:
            return json.load(file)

    def assert_as_good_as_wheels(self, name, metrics):
        alone = next(drive.wheels_and_gyro_pct for drive in catalog.REAL if drive.bag == name)
        self.assertLessEqual(metrics["final_pct"], LARGEST_RATIO * alone + SPARE_PCT)
        self.assertGreaterEqual(metrics["coverage_3sigma_pct"], LEAST_COVERAGE_PCT)

    def test_uneven_floor(self):
        for name in ("husky_mocap_move6", "husky_mocap_move15"):
            with self.subTest(name):
                self.assert_as_good_as_wheels(name, self.metrics(self.checked(name)))

    def test_encoders(self):
        """Its truth, a laser map good to half a meter, does not judge 3σ."""
        metrics = self.metrics(self.checked("real_penn_20", "--wheel-radius", "0.127"))
        self.assertLessEqual(metrics["final_pct"], metrics["wheel_only_error_pct"] + SPARE_PCT)

    def test_noise_of_the_accelerometer_does_not_decide_whether_an_estimate_runs_away(self):
        arguments = self.checked("real_ugv_indoor")
        for noise in ACCEL_NOISES:
            with self.subTest(noise):
                metrics = self.metrics(arguments, "--set", f"imu.noise.accel_noise_mps_per_sqrt_h={noise}")
                self.assertFalse([alarm for alarm in metrics["alarms"] if RUNAWAY in alarm["what"]])
                self.assertGreaterEqual(metrics["coverage_3sigma_pct"], LEAST_COVERAGE_PCT)


if __name__ == "__main__":
    unittest.main()
