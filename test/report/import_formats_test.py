#!/usr/bin/python3
"""Recordings in the formats of others come out of `import` as they went in.

The environment names the executable SLIPNAV_SIMULATE; slipnav's other programs lie beside it.
"""

import math
import os
import subprocess
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from import_fixture import IMU, ImportTestCase, POS_HEAD, PROGRAMS, T0  # noqa: E402


class KittiTest(ImportTestCase):
    NUMBERS = [49.0, 8.4, 115.5, 0.01, 0.02, 0.03, 1, 2, 3.5, 0.1, 0.2, 0.11, 0.12, 9.81, 0.21, 0.22, 9.82, 0.031, 0.032,
               0.033, 0.041, 0.042, 0.043, 0.05, 0.02, 4, 11, 4, 4, 0]

    def make(self, count=3, interval_ms=10):
        self.write("drive/oxts/timestamps.txt", "".join(f"2011-09-26 13:02:25.{100 + i * interval_ms:03d}360375\n"
                                                        for i in range(count)))
        for i in range(count):
            self.write(f"drive/oxts/data/{i:010d}.txt", " ".join(map(str, self.NUMBERS)) + "\n")

    def test_imu_and_truth(self):
        self.make()
        messages = self.imported("drive")
        self.assertEqual(set(messages), {"/imu/data", "/truth/fix"})
        # date -u -d '2011-09-26 13:02:25' +%s
        self.assertEqual([time for time, _ in messages["/imu/data"]],
                         [1317042145_100360375, 1317042145_110360375, 1317042145_120360375])
        imu = messages["/imu/data"][0][1]
        self.assert_xyz(imu.linear_acceleration, [0.11, 0.12, 9.81])
        self.assert_xyz(imu.angular_velocity, [0.031, 0.032, 0.033])
        fix = messages["/truth/fix"][0][1]
        self.assert_close([fix.latitude, fix.longitude, fix.altitude], [49.0, 8.4, 115.5])
        self.assert_close(fix.position_covariance, [0.0025, 0, 0, 0, 0.0025, 0, 0, 0, 0.0025])

    def test_speed_only_when_asked_and_named(self):
        self.make()
        messages = self.imported("drive", "--oxts-speed")
        self.assertEqual(messages["/wheel_odometry"][0][1].twist.twist.linear.x, 3.5)
        self.assertEqual(messages["/wheel_odometry"][0][1].child_frame_id, "oxts_speed")
        self.assertIn("speed from its inertial and satellite navigation, not from wheels", self.printed)

    def test_what_is_missing_is_named(self):
        self.make(interval_ms=100)
        os.remove(self.path("drive/oxts/data/0000000001.txt"))
        self.assertEqual(len(self.imported("drive/oxts")["/imu/data"]), 2)
        self.assertIn("1 file of 3 stamps missing: skipped", self.said)
        self.assertIn("the IMU has 5.0 Hz, and slipnav needs 20 or more", self.said)
        os.remove(self.out)
        self.write("drive/oxts/data/0000000002.txt", "1 2 3")
        self.assertIn("0000000002.txt:1: 3 fields instead of 30", self.refused("drive"))
        self.write("drive/oxts/timestamps.txt", "26.9.2011\n")
        self.assertIn("timestamps.txt:1: '26.9.2011' is not a date", self.refused("drive"))


class EurocTest(ImportTestCase):
    SENSOR = """%YAML:1.0
#Default imu sensor yaml file
sensor_type: imu
T_BS: !!opencv-matrix
  cols: 4
  rows: 4
  data: [0.0, -1.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.2, 0.0, 0.0, 1.0, 0.3, 0.0, 0.0, 0.0, 1.0]
rate_hz: 200
gyroscope_noise_density: 1.6968e-04
gyroscope_random_walk: 1.9393e-05
accelerometer_noise_density: 2.0e-3
accelerometer_random_walk: 3.0e-3
"""

    def make(self):
        start = T0 * 10**9
        self.write("seq/mav0/imu0/data.csv", "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
                   "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\r\n"
                   + "".join(f"{start + i * 5_000_000},0.1,0.2,0.3,1,2,9.8\r\n" for i in range(100)))
        self.write("seq/mav0/imu0/sensor.yaml", self.SENSOR)
        half = math.sqrt(0.5)  # a quarter turn to the left
        self.write("seq/mav0/state_groundtruth_estimate0/data.csv",
                   "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
                   "v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], "
                   "b_w_RS_S_z [rad s^-1], b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]\n"
                   f"{start},1,2,3,{half},0,0,{half},0.5,2,-1,0,0,0,0,0,0\n")

    def test_imu_truth_and_mounting(self):
        self.make()
        messages = self.imported("seq")
        imu = messages["/imu/data"]
        self.assertEqual((len(imu), imu[1][0]), (100, T0 * 10**9 + 5_000_000))
        self.assert_xyz(imu[0][1].angular_velocity, [0.1, 0.2, 0.3])
        self.assert_xyz(imu[0][1].linear_acceleration, [1, 2, 9.8])
        truth = messages["/truth/odometry"][0][1]
        self.assert_xyz(truth.pose.pose.position, [1, 2, 3])
        self.assert_close([truth.pose.pose.orientation.z, truth.pose.pose.orientation.w], [math.sqrt(0.5)] * 2)
        self.assert_xyz(truth.twist.twist.linear, [2, -0.5, -1])  # in axes of the body
        mount = messages["/tf_static"][0][1].transforms[0]
        self.assertEqual((mount.header.frame_id, mount.child_frame_id), ("base_link", "imu_link"))
        self.assert_xyz(mount.transform.translation, [0.1, 0.2, 0.3])
        self.assert_close([mount.transform.rotation.z, mount.transform.rotation.w], [math.sqrt(0.5)] * 2)
        self.assertIn("accel_noise_mps_per_sqrt_h: 0.12\n", self.printed)
        self.assertIn("gyro_noise_deg_per_sqrt_h: 0.583317\n", self.printed)
        self.assertIn("accel_bias_walk_ug_per_sqrt_h: 18354.9\n", self.printed)
        self.assertIn("gyro_bias_walk_deg_per_h_per_sqrt_h: 240.006\n", self.printed)

    def test_quarter_turns_of_every_kind(self):
        self.make()
        for data, wanted in (("1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,0,1", [1, 0, 0, 0]),
                             ("-1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,0,1", [0, 1, 0, 0]),
                             ("-1,0,0,0, 0,-1,0,0, 0,0,1,0, 0,0,0,1", [0, 0, 1, 0]),
                             ("0,0,1,0, 1,0,0,0, 0,1,0,0, 0,0,0,1", [0.5, 0.5, 0.5, 0.5])):
            self.write("seq/mav0/imu0/sensor.yaml", f"T_BS: {{data: [{data}]}}\n")
            turn = self.imported("seq")["/tf_static"][0][1].transforms[0].transform.rotation
            found = np.array([turn.x, turn.y, turn.z, turn.w])
            self.assert_close(found * np.sign(found[np.argmax(np.abs(found))]), wanted)

    def test_what_is_wrong_is_named(self):
        self.make()
        self.write("seq/mav0/imu0/sensor.yaml", "rate_hz: 400\n")
        self.imported("seq")
        self.assertIn("has 200.0 Hz, and sensor.yaml says 400 Hz", self.said)
        os.remove(self.out)
        for text, wanted in (("T_BS: {data: [1, 2]}\n", "T_BS is not a matrix of 4 x 4"),
                             ("T_BS: {data: [2,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}\n", "T_BS does not contain a rotation"),
                             ("rate_hz: fast\n", "rate_hz is not a number"), ("a: b: c\n", "is not YAML")):
            self.write("seq/mav0/imu0/sensor.yaml", text)
            self.assertIn(wanted, self.refused("seq"))


class TumTest(ImportTestCase):
    def test_a_trajectory(self):
        self.write("imu.csv", IMU)
        self.write("truth.txt", f"# timestamp tx ty tz qx qy qz qw\n{T0}.000000001 1 2 3 0.6 0 0 0.8\n"
                                f"{T0}.5 nan 2 3 0 0 0 1\n")
        poses = self.imported("--imu", "imu.csv", "--truth", "truth.txt")["/truth/pose"]
        self.assertEqual([time for time, _ in poses], [T0 * 10**9 + 1])
        self.assert_xyz(poses[0][1].pose.position, [1, 2, 3])
        self.assert_close([poses[0][1].pose.orientation.x, poses[0][1].pose.orientation.w], [0.6, 0.8])
        self.assertIn("truth.txt: 1 row with NaN", self.said)


@unittest.skipUnless(os.access(os.path.join(PROGRAMS, "positions"), os.X_OK), "needs slipnav's programs")
class RtklibTest(ImportTestCase):
    def test_solutions(self):
        rows = "".join(f"2020/09/13 12:26:{58 + 0.1 * i:06.3f} 39.6 -79.9 {250 + (5 if i == 6 else 0)} {q} 9 .01 .02 .03 "
                       f"{-0.01 if i == 1 else 0} 0 0 0 9\n" for i, q in enumerate([2, 1, 0, 5, 1, 1, 1, 1, 1, 1, 1, 1]))
        self.write("imu.csv", IMU)
        self.write("X.POS", POS_HEAD + rows)
        fixes = self.imported("--imu", "imu.csv", "--truth", "X.POS")["/truth/fix"]
        self.assertEqual([time % 10**10 // 10**8 for time, _ in fixes], [0, 1, 3, 4, 5, 7, 8, 9, 10, 11])
        self.assertEqual(fixes[0][0], T0 * 10**9)  # GPS time leads by 18 s
        fix = fixes[1][1]
        self.assert_close([fix.latitude, fix.longitude, fix.altitude], [39.6, -79.9, 250])
        self.assert_close(fix.position_covariance, [4e-4, -1e-4, 0, -1e-4, 1e-4, 0, 0, 0, 9e-4])
        self.assertEqual([message.status.status for _, message in fixes[:3]], [2, 2, 0])
        self.assertIn("X.POS: rows of quality 0, without a solution: 1 skipped", self.said)
        self.assertIn("X.POS: rows far off their neighbors: 1 skipped", self.said)
        fixes = self.imported("--imu", "imu.csv", "--gps", "X.POS")["/gps/fix"]
        self.assertEqual(len(fixes), 11)  # the filter judges its fixes itself

    def test_what_cannot_be_read_is_named(self):
        self.write("imu.csv", IMU)
        self.write("x.pos", POS_HEAD.replace("ellipsoidal", "geodetic"))
        self.assertIn("import: x.pos:1: heights are geodetic", self.refused("--imu", "imu.csv", "--truth", "x.pos"))
        self.write("x.pos", POS_HEAD)
        self.assertIn("x.pos: has no solution", self.refused("--imu", "imu.csv", "--truth", "x.pos"))


@unittest.skipUnless(os.access(os.path.join(PROGRAMS, "check"), os.X_OK), "needs slipnav's programs")
class OtherRecordingsTest(ImportTestCase):
    def test_recordings_of_ros_2_are_named_alike_by_all(self):
        with open(self.path("a.mcap"), "wb") as file:
            file.write(b"\x89MCAP0\r\n" + bytes(100))
        with open(self.path("b.db3"), "wb") as file:
            file.write(b"SQLite format 3\0" + bytes(100))
        self.write("folder/metadata.yaml", "rosbag2_bagfile_information:\n  version: 9\n  storage_identifier: mcap\n")
        for name, wanted in (
                ("a.mcap", "rosbags-convert --src a.mcap --dst a.bag --dst-typestore ros1_noetic"),
                ("b.db3", "rosbags-convert --src b.db3 --src-typestore ros2_humble --dst b.bag --dst-typestore ros1_noetic"),
                ("folder", "rosbags-convert --src folder --dst folder.bag --dst-typestore ros1_noetic")):
            said = self.refused(name)
            self.assertIn(f"import: {name}: is a recording of ROS 2 (", said)
            self.assertTrue(said.endswith(wanted), said)
            for tool in ("evaluate", "check", "tune", "calibrate"):
                process = subprocess.run([os.path.join(PROGRAMS, tool), name], cwd=self.folder, stdout=subprocess.PIPE,
                                         stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(process.stderr.strip(), said.replace("import", tool, 1))
                self.assertEqual(process.returncode, 2)

    def test_a_bag_needs_no_import(self):
        self.write("a.bag", "")
        self.assertIn("is already a recording", self.refused("a.bag"))


if __name__ == "__main__":
    unittest.main()
