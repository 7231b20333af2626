#!/usr/bin/python3
"""Writes the binary inputs that fuzzing begins with: recordings, and messages as test/fuzz/message_reader.h reads them.

Needs the workspace: source build/devel/setup.bash, then test/fuzz/make_corpus.py.
"""

import io
import math
import pathlib
import re

import geometry_msgs.msg
import nav_msgs.msg
import rosbag
import rospy
import sensor_msgs.msg
import slipnav.msg
import slipnav.srv
import tf2_msgs.msg

CORPUS = pathlib.Path(__file__).resolve().parent / "corpus"
START_S = 102.0
ENGINES_S = 100.5  # how far the driving engines of internal_ros_fuzz.cpp have come
WHEELS = ("front_left_wheel", "front_right_wheel", "back_left_wheel", "back_right_wheel")
STATES = 22


def stamped(message, time_s):
    message.header.stamp = rospy.Time.from_sec(time_s)
    return message


def imu(time_s, forward_mps2=0.0):
    message = stamped(sensor_msgs.msg.Imu(), time_s)
    message.linear_acceleration.x = forward_mps2 + 1e-3 * math.sin(100.0 * time_s)
    message.linear_acceleration.z = 9.8
    message.angular_velocity.z = 1e-4 * math.cos(100.0 * time_s)
    return message


def joints(time_s, speed_radps):
    message = stamped(sensor_msgs.msg.JointState(), time_s)
    message.name = list(WHEELS)
    message.velocity = [speed_radps] * len(WHEELS)
    message.position = [speed_radps * time_s] * len(WHEELS)
    return message


def odometry(time_s, speed_mps):
    message = stamped(nav_msgs.msg.Odometry(), time_s)
    message.pose.pose.orientation.w = 1.0
    message.twist.twist.linear.x = speed_mps
    return message


def fix(time_s):
    message = stamped(sensor_msgs.msg.NavSatFix(), time_s)
    message.latitude, message.longitude, message.altitude = 39.65, -79.9, 300.0
    message.position_covariance_type = message.COVARIANCE_TYPE_KNOWN
    message.position_covariance = [1e-4, 0.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 0.0, 4e-4]
    return message


def velocity(time_s):
    message = stamped(geometry_msgs.msg.TwistWithCovarianceStamped(), time_s)
    message.twist.twist.linear.x = 0.8
    message.twist.covariance[0] = message.twist.covariance[7] = message.twist.covariance[14] = 1e-3
    return message


def pose(time_s):
    message = stamped(geometry_msgs.msg.PoseStamped(), time_s)
    message.pose.orientation.w = 1.0
    return message


def inertial_state(time_s):
    message = slipnav.msg.InertialState()
    message.stamp = rospy.Time.from_sec(time_s)
    message.q_b_to_n = [1.0, 0.0, 0.0, 0.0]
    message.latitude_rad, message.longitude_rad, message.height_m = 0.69, -1.39, 300.0
    message.v_eb_n = [0.8, 0.0, 0.0]
    return message


def covariance():
    return [1e-3 if row == column else 0.0 for row in range(STATES) for column in range(STATES)]


def start_state():
    message = slipnav.msg.StartState(start=1, known=True, state=inertial_state(START_S), covariance=covariance())
    message.origin_latitude_rad, message.origin_longitude_rad, message.origin_height_m = 0.69, -1.39, 300.0
    return message


def steps(begin_s, count):
    message = slipnav.msg.InsSteps(start=1)
    for i in range(count):
        interval = slipnav.msg.InsInterval(f_ib_b=[0.0, 0.0, -9.8])
        interval.start = rospy.Time.from_sec(begin_s + 0.02 * i)
        interval.state = inertial_state(begin_s + 0.02 * (i + 1))
        message.steps.append(interval)
    return message


def forecast_input(time_s, slip):
    message = slipnav.msg.ForecastInput(state=inertial_state(time_s), covariance=covariance())
    message.slip_factor = message.side_slip_factor = 1.0
    message.wheel_speed_used = True
    message.wheel_stamp = message.state.stamp
    message.wheel_speed_mps = 0.8 / (1.0 - slip)
    message.duration_s = 0.1
    message.v_eb_b = [0.8, 0.0, 0.0]
    return message


def nav_state(time_s):
    message = stamped(slipnav.msg.NavState(), time_s)
    message.covariance = [1e-6 if row == column else 0.0 for row in range(15) for column in range(15)]
    message.orientation.w = 1.0
    return message


def slip(time_s, speed_mps):
    message = stamped(slipnav.msg.Slip(), time_s)
    message.duration_s, message.forward_speed_mps = 0.1, speed_mps
    message.names, message.ratio, message.wheel_speed_mps = list(WHEELS), [0.0] * 4, [speed_mps] * 4
    return message


def twist(speed_mps):
    message = geometry_msgs.msg.Twist()
    message.linear.x = speed_mps
    return message


def write_messages(path, header, messages):
    path.parent.mkdir(parents=True, exist_ok=True)
    buffer = io.BytesIO(header)
    buffer.seek(0, io.SEEK_END)
    for kind, message in messages:
        buffer.write(bytes([kind]))
        message.serialize(buffer)
    path.write_bytes(buffer.getvalue())


def write_sensor_messages():
    folder = CORPUS / "messages"
    running, resting = b"\0", b"\1"
    rest = [(0, imu(START_S + 0.1 * i)) for i in range(8)]
    write_messages(folder / "imu_at_rest", resting, rest)
    drive = []
    for i in range(4):
        time_s = START_S + 0.1 * i
        drive += [(0, imu(time_s, 0.5)), (1, joints(time_s, 7.0))]
    write_messages(folder / "imu_and_joints", running, drive)
    write_messages(folder / "imu_and_odometry", running,
                   [part for i in range(3) for part in ((0, imu(START_S + 0.1 * i)), (2, odometry(START_S + 0.1 * i, 0.5)))])
    write_messages(folder / "fix_and_pose", running, [(3, fix(START_S)), (5, pose(START_S)), (0, imu(START_S))])
    for kind, name, message in ((0, "imu", imu(START_S)), (1, "joints", joints(START_S, 1.0)),
                                (2, "odometry", odometry(START_S, 1.0)), (3, "fix", fix(START_S)),
                                (4, "velocity", velocity(START_S)), (5, "pose", pose(START_S))):
        write_messages(folder / name, running, [(kind, message)])


def write_internal_messages():
    folder = CORPUS / "internal"
    driving, fresh = b"\0", b"\1"
    write_messages(folder / "filter", fresh, [(0, start_state()), (1, steps(START_S, 3)), (1, steps(START_S + 0.06, 1))])
    write_messages(folder / "steps", driving, [(1, steps(ENGINES_S, 4))])
    write_messages(folder / "forecast", driving, [(3, forecast_input(ENGINES_S + 0.1, 0.05))])
    place = slipnav.srv.SetStateRequest(position_std_m=0.1, has_heading=True, heading_deg=10.0, heading_std_deg=1.0)
    correction = slipnav.msg.FilterCorrection(start=1, corrects=True, epoch=1, state=inertial_state(ENGINES_S))
    write_messages(folder / "corrections", driving, [(4, place), (2, correction), (1, steps(ENGINES_S, 2))])
    stop = stamped(slipnav.msg.ErrorForecast(), START_S)
    stop.time_to_stop_s = 0.1
    write_messages(folder / "supervisor", fresh,
                   [(5, slip(START_S, 0.8)), (6, nav_state(START_S)), (7, stop), (8, twist(0.8)), (8, twist(0.8))])


def without_padding(bag):
    """The bytes of a recording without the 4 KB that its header reserves: changes there would change nothing."""
    header_end = 17 + int.from_bytes(bag[13:17], "little")
    padding = int.from_bytes(bag[header_end:header_end + 4], "little")
    small = bytearray(bag[:header_end] + bytes(4) + bag[header_end + 4 + padding:])
    for place in re.finditer(b"(index|chunk)_pos=", bytes(small)):
        number = slice(place.end(), place.end() + 8)
        small[number] = (int.from_bytes(small[number], "little") - padding).to_bytes(8, "little")
    return bytes(small)


def write_bag(name, messages, compression="none"):
    path = CORPUS / "bag" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    with rosbag.Bag(str(path), "w", chunk_threshold=1500, compression=compression) as bag:
        for topic, message in messages:
            # A definition of each type would be most of the file, and nothing reads it.
            header = {"topic": topic, "type": message._type, "md5sum": message._md5sum, "message_definition": " "}
            stamp = message.header.stamp if hasattr(message, "header") else rospy.Time.from_sec(START_S)
            bag.write(topic, message, stamp, connection_header=header)
    path.write_bytes(without_padding(path.read_bytes()))


def static_transform(child_frame):
    transform = stamped(geometry_msgs.msg.TransformStamped(), START_S)
    transform.header.frame_id, transform.child_frame_id = "base_link", child_frame
    transform.transform.rotation.w = 1.0
    return tf2_msgs.msg.TFMessage(transforms=[transform])


def write_bags():
    times_s = [START_S + 0.1 * i for i in range(8)]
    drive = [("imu/data", imu(t, 0.2)) for t in times_s]
    write_bag("joints.bag", drive + [("joint_states", joints(t, 1.0)) for t in times_s[-3:]]
              + [("truth/fix", fix(times_s[-1])), ("gps/fix", fix(times_s[-1]))])
    write_bag("odometry.bag", drive + [("wheel_odometry", odometry(t, 0.1)) for t in times_s[-2:]]
              + [("truth/odometry", odometry(times_s[-1], 0.1))], "lz4")
    write_bag("pose.bag", drive + [("wheel_odometry", odometry(times_s[-1], 0.1)), ("truth/pose", pose(times_s[-1]))],
              "bz2")
    write_bag("extrinsics.bag", [("/tf_static", static_transform("imu_link"))] + drive
              + [("wheel_odometry", odometry(times_s[-1], 0.1))])
    write_bag("imu_only.bag", [("imu/data", imu(times_s[0]))])


if __name__ == "__main__":
    write_sensor_messages()
    write_internal_messages()
    write_bags()
