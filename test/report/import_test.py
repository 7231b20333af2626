#!/usr/bin/python3
"""Tables come out of `import` as they went in: values in SI, stamps to the nanosecond, and what is odd by name.

The environment names the executable SLIPNAV_SIMULATE; slipnav's other programs lie beside it.
"""

import math
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from import_fixture import DEG, G, IMU, ImportTestCase, T0  # noqa: E402


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


if __name__ == "__main__":
    unittest.main()
