"""ROS 1 messages as used by slipnav."""

import genpy
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, JointState, NavSatFix, NavSatStatus
from tf2_msgs.msg import TFMessage

BASE, IMU_FRAME, GPS_FRAME, TRUTH_FRAME = "base_link", "imu_link", "gps", "truth"
TRUTH_BODY = "truth_body"  # frame whose pose is the truth


def time_of(stamp_ns):
    return genpy.Time(*divmod(stamp_ns, 10**9))


def stamped(message, stamp_ns, frame):
    message.header.stamp = time_of(stamp_ns)
    message.header.frame_id = frame
    return message


def set_xyz(target, values):
    target.x, target.y, target.z = (float(value) for value in values)


def set_quaternion(target, xyzw):
    target.x, target.y, target.z, target.w = (float(value) for value in xyzw)


def imu(stamp_ns, rate, force):
    message = stamped(Imu(), stamp_ns, IMU_FRAME)
    message.orientation_covariance[0] = -1.0  # no attitude
    set_xyz(message.angular_velocity, rate)
    set_xyz(message.linear_acceleration, force)
    return message


def joints(stamp_ns, names, positions, velocities):
    message = stamped(JointState(), stamp_ns, "")
    message.name = list(names)
    message.position = [float(value) for value in positions]
    message.velocity = [float(value) for value in velocities]
    return message


def wheel_odometry(stamp_ns, forward_mps, yaw_rate_radps, child=BASE):
    message = stamped(Odometry(), stamp_ns, "odom")
    message.child_frame_id = child
    message.twist.twist.linear.x = float(forward_mps)
    message.twist.twist.angular.z = float(yaw_rate_radps)
    return message


def fix(stamp_ns, latitude_deg, longitude_deg, height_m, covariance_enu=None, status=NavSatStatus.STATUS_FIX):
    """@param covariance_enu nine elements by row [m²]; None if unknown"""
    message = stamped(NavSatFix(), stamp_ns, GPS_FRAME)
    message.status.status = status
    message.status.service = NavSatStatus.SERVICE_GPS
    message.latitude, message.longitude, message.altitude = float(latitude_deg), float(longitude_deg), float(height_m)
    if covariance_enu is not None:
        message.position_covariance = [float(value) for value in covariance_enu]
        message.position_covariance_type = NavSatFix.COVARIANCE_TYPE_KNOWN
    return message


def pose(stamp_ns, position, xyzw):
    """@param xyzw attitude; zeros if unknown"""
    message = stamped(PoseStamped(), stamp_ns, TRUTH_FRAME)
    set_xyz(message.pose.position, position)
    set_quaternion(message.pose.orientation, xyzw)
    return message


def odometry(stamp_ns, position, xyzw, velocity_body):
    message = stamped(Odometry(), stamp_ns, TRUTH_FRAME)
    message.child_frame_id = TRUTH_BODY
    set_xyz(message.pose.pose.position, position)
    set_quaternion(message.pose.pose.orientation, xyzw)
    set_xyz(message.twist.twist.linear, velocity_body)
    return message


def transform(stamp_ns, parent, child, translation, xyzw):
    message = stamped(TransformStamped(), stamp_ns, parent)
    message.child_frame_id = child
    set_xyz(message.transform.translation, translation)
    set_quaternion(message.transform.rotation, xyzw)
    return TFMessage([message])
