#!/usr/bin/python3
"""A drive that went through files of others gives the same estimate.

The environment names the executable SLIPNAV_SIMULATE; slipnav's other programs lie beside it.
"""

import csv
import json
import math
import os
import subprocess
import sys
import unittest

import numpy as np
import rosbag

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from import_fixture import DEG, G, ImportTestCase, POS_HEAD, PROGRAMS, SIMULATE  # noqa: E402


@unittest.skipUnless(os.access(os.path.join(PROGRAMS, "evaluate"), os.X_OK), "needs slipnav's programs")
class DriveTest(ImportTestCase):
    """A drive that was written as files of others, in their units, is the same drive."""

    LARGEST_DIFFERENCE_M = 1e-6

    def setUp(self):
        super().setUp()
        self.drive = self.path("drive.bag")
        subprocess.run([SIMULATE, "--terrain", "paved", "--distance", "30", "--seed", "1", "--policy", "periodic:20:4",
                        "--bag", self.drive], stdout=subprocess.DEVNULL, check=True)
        self.messages = {}
        with rosbag.Bag(self.drive) as bag:
            for topic, message, _ in bag:
                self.messages.setdefault(topic, []).append(message)

    def export(self, name, heads, rows):
        with open(self.path(name), "w", newline="", encoding="ascii") as file:
            out = csv.writer(file)
            out.writerow(heads)
            out.writerows(rows)

    def export_all(self):
        self.export("imu.csv", ["time", "gx", "gy", "gz", "ax", "ay", "az"],
                    [[m.header.stamp.to_nsec()] + [repr(getattr(m.angular_velocity, axis) / DEG) for axis in "xyz"]
                     + [repr(getattr(m.linear_acceleration, axis) / G) for axis in "xyz"]
                     for m in self.messages["/imu/data"]])
        self.names = self.messages["/joint_states"][0].name
        self.export("wheels.csv", ["ms"] + [f"{kind}{i}" for kind in "pv" for i in range(4)],
                    [[f"{m.header.stamp.to_nsec() / 1e6:.3f}"] + [repr(angle / DEG) for angle in m.position]
                     + [repr(rate * 30 / math.pi) for rate in m.velocity] for m in self.messages["/joint_states"]])
        for name in ("gps", "truth"):
            self.export(f"{name}.csv", ["us", "lat", "lon", "h", "s", "su"],
                        [[m.header.stamp.to_nsec() // 1000, repr(m.latitude * DEG), repr(m.longitude), repr(m.altitude * 1000),
                          repr(math.sqrt(m.position_covariance[0]) * 100), repr(math.sqrt(m.position_covariance[8]))]
                         for m in self.messages[f"/{name}/fix"]])

    def import_all(self, *truth):
        wheels = ",".join(f"{name}=p{i}[deg],{name}=v{i}[rpm]" for i, name in enumerate(self.names))
        fix = "t=us[us],lat=lat[rad],lon=lon[deg],h=h[mm],se=s[cm],sn=s[cm],su=su[m]"
        return self.imported("--imu", "imu.csv", "--imu-columns",
                             "t=time[ns],wx=gx[deg/s],wy=gy[deg/s],wz=gz[deg/s],ax=ax[g],ay=ay[g],az=az[g]",
                             "--wheels", "wheels.csv", "--wheels-columns", "t=ms[ms]," + wheels,
                             "--gps", "gps.csv", "--gps-columns", fix,
                             *(truth or ("--truth", "truth.csv", "--truth-columns", fix)))

    def evaluated(self, bag, *arguments):
        """Metrics, estimate and truth of a recording."""
        out = self.path(os.path.basename(bag) + "-" + str(len(arguments)))
        subprocess.run([os.path.join(PROGRAMS, "evaluate"), bag, "--out", out, *arguments], stdout=subprocess.DEVNULL,
                       check=True)
        with open(os.path.join(out, "metrics.json"), encoding="utf-8") as file:
            metrics = json.load(file)
        return metrics, np.loadtxt(os.path.join(out, "estimate.tum")), np.loadtxt(os.path.join(out, "truth.tum"))

    def assert_same(self, found, wanted):
        for mine, others in zip(found[1:], wanted[1:]):
            self.assertEqual(mine.shape, others.shape)
            np.testing.assert_array_equal(mine[:, 0], others[:, 0])
            self.assertLess(np.abs(mine[:, 1:4] - others[:, 1:4]).max(), self.LARGEST_DIFFERENCE_M)
        for key in ("imu_samples", "wheel_samples", "rejected_samples", "stops_seen", "stops_used"):
            self.assertEqual(found[0][key], wanted[0][key], key)
        for key in ("enu_error_pct", "horizontal_final_m", "position_nees_mean", "distance_m"):
            self.assertAlmostEqual(found[0][key], wanted[0][key], 6, key)

    def test_the_estimate_is_the_same(self):
        self.export_all()
        self.import_all()
        self.assert_same(self.evaluated(self.out, "--truth", "truth/fix"), self.evaluated(self.drive, "--truth", "truth/fix"))

    def test_a_solution_in_the_bag_is_the_truth_that_it_is_beside_it(self):
        self.export_all()
        self.write("truth.pos", self.pos_text())
        self.import_all("--truth", "truth.pos")
        self.assertIn("truth.pos: rows far off their neighbors: 1 skipped", self.said)
        self.assert_same(self.evaluated(self.out), self.evaluated(self.drive, "--truth", self.path("truth.pos")))

    def pos_text(self):
        """The drive's truth as RTKLIB would write it, by week and seconds of UTC, with one row 20 m too high."""
        rows = []
        for i, m in enumerate(self.messages["/truth/fix"]):
            week, nanoseconds = divmod(m.header.stamp.to_nsec() - 315964800 * 10**9, 604800 * 10**9)
            rows.append(f"{week} {nanoseconds / 1e9:.3f} {m.latitude:.9f} {m.longitude:.9f} "
                        f"{m.altitude + (20 if i == 300 else 0):.4f} 1 9 .01 .01 .02 0 0 0 0 9\n")
        return POS_HEAD.replace("GPST", "UTC ") + "".join(rows)


if __name__ == "__main__":
    unittest.main()
