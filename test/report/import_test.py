#!/usr/bin/python3
"""Files of others come out of `import` as they went in: values in SI, stamps to the nanosecond, and what is odd by name.

The environment names the executable SLIPNAV_SIMULATE; slipnav's other programs lie beside it.
"""

import contextlib
import csv
import io
import json
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


class CsvTest(ImportTestCase):
    def test_imu_in_odd_units(self):
        self.write("imu.csv", "\ufefftime [ns];temp;gyro x (deg/s);gyro_y;gyro_z;ax;ay;az\n"
                              "1600000000000000001;20;10;-20;30;1;-0.5;0.25\n"
                              "1600000000010000001;20;nan;0;0;0;0;1\n"
                              "1600000000020000001;n/a;1;0;0;0;0;1\n")
        messages = self.imported("--imu", "imu.csv", "--imu-columns",
                                 "t=time,wx=gyro x,wy=gyro_y[°/s],wz=#5[rad/s],ax=ax[g],ay=ay[mg],az=az[m/s²]")["/imu/data"]
        self.assertEqual([time for time, _ in messages], [1600000000000000001, 1600000000020000001])
        imu = messages[0][1]
        self.assertEqual(imu.header.frame_id, "imu_link")
        self.assertEqual(imu.orientation_covariance[0], -1.0)
        self.assert_xyz(imu.angular_velocity, [10 * DEG, -20 * DEG, 30.0])
        self.assert_xyz(imu.linear_acceleration, [G, -0.5e-3 * G, 0.25])
        self.assertIn("imu.csv: 1 row with NaN or empty fields skipped, the first in line 3", self.said)

    def test_units_of_time(self):
        for unit, text in (("s", "1600000000.123456789"), ("ms", "1600000000123.456789"), ("us", "1600000000123456.789"),
                           ("µs", "1.600000000123456789e15"), ("ns", "1600000000123456789"),
                           ("date", "2020-09-13 12:26:40.123456789")):
            self.write("imu.csv", f"{text},1,2,3,4,5,6\n")
            columns = f"t=#1[{unit}]," + ",".join(f"{key}=#{i}" for i, key in enumerate("wx wy wz ax ay az".split(), 2))
            messages = self.imported("--imu", "imu.csv", "--imu-columns", columns)["/imu/data"]
            self.assertEqual(messages[0][0], 1600000000123456789, unit)

    def wheels(self, text, columns, *more):
        self.write("imu.csv", IMU)
        self.write("wheels.csv", text)
        return self.imported("--imu", "imu.csv", "--wheels", "wheels.csv", "--wheels-columns", columns, *more)

    def test_encoders(self):
        messages = self.wheels(f"stamp l r vl vr\n{T0} 1024 -2048 60 -30\n{T0}.5 1025 -2048 0 0\n",
                               "t=stamp,left=l[counts],right=r[counts],left=vl[rpm],right=vr[deg/s]",
                               "--counts-per-turn", "4096")["/joint_states"]
        joints = messages[0][1]
        self.assertEqual(joints.name, ["left", "right"])
        self.assert_close(joints.position, [math.pi / 2, -math.pi])
        self.assert_close(joints.velocity, [2 * math.pi, -30 * DEG])
        self.assert_close(messages[1][1].position, [1025 / 4096 * 2 * math.pi, -math.pi])

    def test_wheels_in_meters_turn_by_their_radius(self):
        joints = self.wheels(f"t,l,r\n{T0},0.5,7.2\n", "t=t,l=l[m/s],r=r[km/h]", "--wheel-radius", "0.1")["/joint_states"]
        self.assert_close(joints[0][1].velocity, [5.0, 20.0])
        self.assertEqual(list(joints[0][1].position), [])

    def test_forward_speed(self):
        odometry = self.wheels(f"t\tspeed\tturn\n{T0}\t3.6\t90\n", "t=t,v=speed[km/h],yaw_rate=turn[deg/s]")["/wheel_odometry"]
        self.assertEqual(odometry[0][1].twist.twist.linear.x, 1.0)
        self.assert_close(odometry[0][1].twist.twist.angular.z, math.pi / 2)

    def truth(self, text, columns, option="--truth"):
        self.write("imu.csv", IMU)
        self.write("truth.csv", text)
        return self.imported("--imu", "imu.csv", option, "truth.csv", option + "-columns", columns)

    def test_truth_by_latitude_and_longitude(self):
        row = f"t,lat,lon,h,se,sn,su\n{T0},0.7,-79.9,250000,1,2,3\n"
        columns = "t=t,lat=lat[rad],lon=lon[deg],h=h[mm],se=se[cm],sn=sn[cm],su=su[cm]"
        for option, topic in (("--truth", "/truth/fix"), ("--gps", "/gps/fix")):
            fix = self.truth(row, columns, option)[topic][0][1]
            self.assert_close([fix.latitude, fix.longitude, fix.altitude], [0.7 / DEG, -79.9, 250.0])
            self.assert_close(fix.position_covariance, [1e-4, 0, 0, 0, 4e-4, 0, 0, 0, 9e-4])
            self.assertEqual(fix.position_covariance_type, 3)

    def test_truth_by_position(self):
        pose = self.truth(f"t,x,y,z,heading\n{T0},1000,2,3,90\n", "t=t,x=x[mm],y=y,z=z,yaw=heading[deg]")["/truth/pose"][0][1]
        self.assert_xyz(pose.pose.position, [1.0, 2.0, 3.0])
        self.assert_close([pose.pose.orientation.z, pose.pose.orientation.w], [math.sqrt(0.5), math.sqrt(0.5)])
        pose = self.truth(f"t,x,y,z\n{T0},1,2,3\n", "t=t,x=x,y=y,z=z")["/truth/pose"][0][1]
        self.assertEqual([getattr(pose.pose.orientation, axis) for axis in "xyzw"], [0, 0, 0, 0])  # not known

    def test_attitude_by_all_three_angles(self):
        roll, pitch, yaw = 0.3, -0.2, 2.0
        pose = self.truth(f"t,x,y,z,a,b,c\n{T0},1,2,3,{roll},{pitch},{yaw}\n",
                          "t=t,x=x,y=y,z=z,roll=a[rad],pitch=b[rad],yaw=c[rad]")["/truth/pose"][0][1]
        x, y, z, w = (getattr(pose.pose.orientation, axis) for axis in "xyzw")
        found = [math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), math.asin(2 * (w * y - z * x)),
                 math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))]
        self.assert_close(found, [roll, pitch, yaw])

    def test_a_yaml_file_says_the_same(self):
        self.write("data/imu.csv", IMU)
        self.write("data/wheels.csv", f"t,l\n{T0},4\n{T0}.1,8\n")
        self.write("data/files.yaml", """
            out: ../out.bag
            imu: imu.csv
            wheels: wheels.csv
            wheels-columns: {t: t, left: ["l[counts]", "l[rad/s]"]}
            counts-per-turn: 8
            shift-time: -1600000000
            wheels-shift: 0.25
        """)
        messages = self.imported("data/files.yaml", "--shift-time", "-1599999999", out=False)
        time, joints = messages["/joint_states"][0]
        self.assertEqual(time, 1_250_000_000)
        self.assert_close([joints.position[0], joints.velocity[0]], [math.pi, 4.0])
        self.assertEqual(messages["/imu/data"][0][0], 10**9)


class StampsTest(ImportTestCase):
    def test_rows_are_sorted_and_what_is_odd_is_counted(self):
        stamps = [0, 0.1, 0.3, 0.2, 0.4, 0.4, 2.4, 2.6, 2.5]
        self.write("imu.csv", "t,wx,wy,wz,ax,ay,az\n" + "".join(f"{T0 + t},{i},0,0,0,0,9.8\n" for i, t in enumerate(stamps)))
        messages = self.imported("--imu", "imu.csv")["/imu/data"]
        self.assertEqual([message.angular_velocity.x for _, message in messages], [0, 1, 3, 2, 4, 5, 6, 8, 7])
        self.assertIn("imu.csv: 2 stamps before the one above, by 0.1 s at most, the first in line 5", self.said)
        self.assertIn("imu.csv: 1 stamp equal to the one before", self.said)
        self.assertIn("imu.csv: 1 gap, the longest 2 s after 1600000000.400000000 s", self.said)
        self.assertIn("out.bag: 9 messages, 2.6 s from 1600000000.000000000 s", self.printed)
        self.assertIn("imu/data  sensor_msgs/Imu  9  3.1 Hz  imu.csv", self.printed)
        self.assertIn("no wheels", self.printed)
        self.assertIn(f"next: ./run check {self.out}", self.printed)

    def test_a_good_file_is_not_spoken_of(self):
        self.write("imu.csv", IMU)
        self.imported("--imu", "imu.csv")
        self.assertEqual(self.said, "")

    def test_a_row_that_is_cut_off_at_the_end_is_left_out(self):
        self.write("imu.csv", IMU + "1600000002.00,0.1,0.2")
        self.assertEqual(len(self.imported("--imu", "imu.csv")["/imu/data"]), 200)
        self.assertIn("imu.csv:202: the last row is cut off: skipped", self.said)


class RefusalTest(ImportTestCase):
    def imu(self, text, *more):
        self.write("imu.csv", text)
        return self.refused("--imu", "imu.csv", *more)

    def test_files_that_cannot_be_understood_are_named_with_their_line(self):
        row = f"{T0},1,2,3,4,5,6\n"
        for text, wanted in (
                ("", "imu.csv: is empty"),
                ("# nothing\n", "imu.csv: has no rows"),
                ("t,wx,wy,wz,ax,ay,az\n", "imu.csv: has no usable row"),
                ("t,wx,wy,wz,ax,ay,az\n" + row + f"{T0},1,2\n" + row, "imu.csv:3: 3 fields instead of 7"),
                ("t,wx,wy,wz,ax,ay,az\n" + row + f"{T0},1,2,3,4,5,6,7\n", "imu.csv:3: 8 fields instead of 7"),
                ("t,wx,wy,wz,ax,ay,az\n" + row + f"{T0},1,2,x3,4,5,6\n", "imu.csv:3: 'x3' in column 'wz' is not a number"),
                ("t;wx;wy;wz;ax;ay;az\n1;1,5;2;3;4;5;6\n", "'1,5' in column 'wx' is not a number (a decimal comma"),
                ("t,wx,wy,wz,ax,ay,az\nnow,1,2,3,4,5,6\n", "imu.csv:2: 'now' is not a time"),
                ("t,wx,wy,wz,ax,ay,az\n1e99999,1,2,3,4,5,6\n", "imu.csv:2: '1e99999' is not a time"),
                ("t,wx,wy,wz,ax,ay,az\n0,1,2,3,4,5,6\n", "imu.csv:2: the stamp is 0.000000000 s"),
                ("t,wx,wy,wz,ax,ay,az\n1e18,1,2,3,4,5,6\n", "beyond what ROS counts: is the unit of t right?"),
                ("t,wx,wy,wz,ax,ay\n1,1,2,3,4,5\n", "imu.csv has no column 'az'; it has t, wx, wy, wz, ax, ay"),
                ("1,1,2,3,4,5,6\n", "imu.csv has no header line"),
                ("t,wx,wy,wz,ax,ay,ay\n1,1,2,3,4,5,6\n", "imu.csv has 2 columns 'ay'"),
                ("t [fortnights],wx [rpm],wy,wz,ax,ay,az\n1,1,2,3,4,5,6\n", "wx: unit 'rpm' is not one of rad/s, deg/s"),
                ("t\0", "imu.csv: is not a text file")):
            self.assertIn(wanted, self.imu(text), text)

    def test_columns_that_cannot_be_understood_are_named(self):
        rest = ",wy=wy,wz=wz,ax=ax,ay=ay,az=az"
        for columns, wanted in (
                ("t=t[min],wx=wx" + rest, "--imu-columns: t: unit 'min' is not one of s, ms, us, ns, date"),
                ("t=t,wx=wx[m/s]" + rest, "wx: unit 'm/s' is not one of rad/s, deg/s"),
                ("t=t" + rest, "--imu-columns: lacks wx"),
                ("t=t,wx=wx,vx=wx" + rest, "'vx' is not one of t, wx, wy, wz, ax, ay, az"),
                ("t=t,wx=wx,wx=wx" + rest, "'wx' is given twice"),
                ("t=t,wx=#9" + rest, "imu.csv has 7 columns, but no #9"),
                ("t=t,wx" + rest, "'wx' is not KEY=COLUMN[UNIT]"),
                ("t=t,wx=[rad/s]" + rest, "names no column")):
            self.assertIn(wanted, self.imu(IMU, "--imu-columns", columns), columns)
        self.assertIn("the header of imu.csv says deg/s of column 'wx', not rad/s",
                      self.imu(IMU.replace("wx", "wx[deg/s]", 1), "--imu-columns", "t=t,wx=wx[rad/s]" + rest))

    def test_wheels_that_lack_something(self):
        self.write("imu.csv", IMU)
        self.write("w.csv", f"t,l,r\n{T0},1,2\n")
        for columns, wanted in (
                ("t=t,left=l", "'left=l' needs a unit, one of rad, deg, counts, rad/s"),
                ("t=t,left=l[counts]", "give --counts-per-turn"),
                ("t=t,left=l[m/s]", "give --wheel-radius"),
                ("t=t,left=l[rad],right=r[rad/s]", "left, right: give angles of all joints or of none"),
                ("t=t,left=l[rad],left=r[deg]", "'left' has two columns of the same kind"),
                ("t=t", "needs t and at least one wheel")):
            said = self.refused("--imu", "imu.csv", "--wheels", "w.csv", "--wheels-columns", columns)
            self.assertIn(wanted, said)
        self.assertIn("--wheels-columns is missing", self.refused("--imu", "imu.csv", "--wheels", "w.csv"))

    def test_truth_that_makes_no_sense(self):
        self.write("imu.csv", IMU)
        self.write("t.csv", f"t,lat,lon,h\n{T0},-179.9,39.6,250\n")
        self.assertIn("t.csv:2: latitude or longitude is out of range", self.refused("--imu", "imu.csv", "--truth", "t.csv"))
        self.write("t.csv", "t,lat,lon,h\n1500000000,39.6,-79.9,250\n")
        self.assertIn("t.csv and imu.csv do not overlap in time", self.refused("--imu", "imu.csv", "--truth", "t.csv"))
        self.write("t.tum", f"{T0} 1 2 3 1 1 1 1\n")
        self.assertIn("t.tum:1: the quaternion does not have length 1", self.refused("--imu", "imu.csv", "--truth", "t.tum"))

    def test_other_arguments(self):
        self.write("imu.csv", IMU)
        self.write("x.yaml", "imuu: imu.csv\n")
        self.write("list.yaml", "[1, 2]\n")
        self.write("empty/readme", "")
        for arguments, wanted in ((["x.yaml"], "x.yaml: unknown key 'imuu'; did you mean imu?"),
                                  (["list.yaml"], "list.yaml: has no keys"),
                                  (["missing.yaml"], "missing.yaml: cannot be read"),
                                  (["empty"], "empty: is neither KITTI raw"),
                                  (["--truth", "imu.csv"], "has no column 'lat'"),
                                  ([], "there is no IMU"),
                                  (["--imu", "none.csv"], "none.csv: cannot be read: No such file"),
                                  (["--imu", "imu.csv", "--shift-time", "nan"], "--shift-time: invalid number value"),
                                  (["--imu", "imu.csv", "--wheel-radius", "-1"], "--wheel-radius must be above zero")):
            self.assertIn(wanted, self.refused(*arguments))
        self.assertIn("--out names no recording", self.refused("--imu", "imu.csv", out=False))
        self.assertIn("cannot be written", self.refused("--imu", "imu.csv", "--out", self.path("no", "x.bag"), out=False))


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
