"""Recordings in the layout of EuRoC: mav0/imu0 with data.csv and sensor.yaml, mav0/state_groundtruth_estimate0.

Columns stand in the order of the data set: t, wx, wy, wz, ax, ay, az; and t, x, y, z, qw, qx, qy, qz, vx, vy, vz.
"""

import math
import os

import numpy as np
import yaml

from slipnav_import import columns, messages, tables, units
from slipnav_import.failure import Failure
from slipnav_import.stream import Stream
from slipnav_import.table import Table, open_lines

IMU_UNITS = dict(zip(tables.IMU_KEYS, ["ns"] + 3 * ["rad/s"] + 3 * ["m/s2"]))
TRUTH_KEYS = ["t", "x", "y", "z", "qw", "qx", "qy", "qz", "vx", "vy", "vz"]
TRUTH_FOLDERS = ["state_groundtruth_estimate0", "mocap0", "vicon0"]
VELOCITY = TRUTH_KEYS[8:]
TRUTH_KINDS = {**tables.POSE_KINDS, **{key: (units.SPEED,) for key in VELOCITY}}
RATE_TOLERANCE = 0.1
MOST_OF_ROTATION = 1e-3  # tolerance of a rotation matrix
PER_ROOT_HOUR = 60.0
RADPS_IN_DEG_PER_H = math.degrees(1.0) * 3600.0
# Key in sensor.yaml, slipnav's name for it, and the factor from SI.
NOISE = {
    "accelerometer_noise_density": ("accel_noise_mps_per_sqrt_h", PER_ROOT_HOUR),
    "gyroscope_noise_density": ("gyro_noise_deg_per_sqrt_h", math.degrees(1.0) * PER_ROOT_HOUR),
    "accelerometer_random_walk": ("accel_bias_walk_ug_per_sqrt_h", 1e6 / units.GRAVITY_MPS2 * PER_ROOT_HOUR),
    "gyroscope_random_walk": ("gyro_bias_walk_deg_per_h_per_sqrt_h", RADPS_IN_DEG_PER_H * PER_ROOT_HOUR),
}


def find(folder):
    """The folder of the sensors, or None."""
    return next((path for path in (os.path.join(folder, "mav0"), folder)
                 if os.path.isfile(os.path.join(path, "imu0", "data.csv"))), None)


def by_number(units_by_key):
    return [columns.Column(key, f"#{i}", unit) for i, (key, unit) in enumerate(units_by_key.items(), 1)]


def streams(folder, shift_ns=0):
    """IMU, truth if there is one, pose of the IMU; and advice for the configuration."""
    imu_folder = os.path.join(folder, "imu0")
    imu = imu_stream(os.path.join(imu_folder, "data.csv"), shift_ns)
    sensor_path = os.path.join(imu_folder, "sensor.yaml")
    sensor = read_sensor(sensor_path) if os.path.isfile(sensor_path) else {}
    rate_hz = number_of(sensor, "rate_hz", sensor_path)
    if rate_hz and abs(imu.rate_hz - rate_hz) > RATE_TOLERANCE * rate_hz:
        imu.notes.append(f"{imu.source}: has {imu.rate_hz:.1f} Hz, and sensor.yaml says {rate_hz:g} Hz: are samples "
                         "missing?")
    truth = truth_path(folder)
    result = [imu] + ([truth_stream(truth, shift_ns)] if truth else [])
    if "T_BS" in sensor:
        result.append(transform_stream(sensor["T_BS"], sensor_path, imu.stamps[0]))
    return result, noise_advice(sensor, sensor_path)


def imu_stream(path, shift_ns):
    parsed = by_number(IMU_UNITS)
    table = Table(path, parsed, tables.IMU_KINDS, path, shift_ns)
    values = tables.picked(table, parsed, tables.IMU_KEYS[1:])
    return tables.finish(table, "imu/data", lambda i, stamp: messages.imu(stamp, values[i, :3], values[i, 3:]))


def truth_path(folder):
    paths = [os.path.join(folder, name, "data.csv") for name in TRUTH_FOLDERS]
    return next((path for path in paths if os.path.isfile(path)), None)


def truth_stream(path, shift_ns):
    """With velocities as odometry, otherwise as poses."""
    count = min(columns_in(path), len(TRUTH_KEYS))
    keys = TRUTH_KEYS if count == len(TRUTH_KEYS) else TRUTH_KEYS[:8]
    parsed = by_number({key: "ns" if key == "t" else None for key in keys})
    table = Table(path, parsed, TRUTH_KINDS, path, shift_ns)
    position = tables.picked(table, parsed, tables.POSE_KEYS[1:])
    xyzw = tables.quaternions(table, parsed, tables.QUATERNION)
    if keys is not TRUTH_KEYS:
        return tables.finish(table, "truth/pose", lambda i, stamp: messages.pose(stamp, position[i], xyzw[i]))
    velocity = tables.picked(table, parsed, VELOCITY)
    return tables.finish(table, "truth/odometry", lambda i, stamp: messages.odometry(
        stamp, position[i], xyzw[i], rotation(xyzw[i]).T @ velocity[i]))


def columns_in(path):
    return len(next((line for _, line in open_lines(path) if not line.startswith("#")), "").split(","))


def rotation(xyzw):
    """From the body to the frame of the truth."""
    x, y, z, w = xyzw / np.linalg.norm(xyzw)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def quaternion(matrix):
    """x, y, z, w of a rotation matrix: of four formulas the one that divides by the largest number."""
    m = matrix
    squares = 1.0 + np.array([m[0, 0] - m[1, 1] - m[2, 2], m[1, 1] - m[0, 0] - m[2, 2], m[2, 2] - m[0, 0] - m[1, 1],
                              np.trace(m)])
    symmetric = [[squares[0], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
                 [m[0, 1] + m[1, 0], squares[1], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]],
                 [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], squares[2], m[1, 0] - m[0, 1]],
                 [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], squares[3]]]
    row = np.array(symmetric[int(np.argmax(squares))])
    return row / np.linalg.norm(row)


def read_sensor(path):
    """sensor.yaml, also with the header and the types of OpenCV."""
    lines = [line.replace("!!opencv-matrix", "") for _, line in open_lines(path) if not line.startswith("%")]
    try:
        sensor = yaml.safe_load("\n".join(lines))
    except yaml.YAMLError as error:
        raise Failure(f"{path}: is not YAML: {str(error).splitlines()[0]}") from error
    if not isinstance(sensor, dict):
        raise Failure(f"{path}: has no keys")
    return sensor


def number_of(sensor, key, path):
    value = sensor.get(key)
    if value is None:
        return None
    try:
        return float(value)
    except (TypeError, ValueError) as error:
        raise Failure(f"{path}: {key} is not a number") from error


def transform_stream(t_bs, path, stamp):
    """The pose of the IMU in the vehicle."""
    try:
        matrix = np.array(t_bs["data"] if isinstance(t_bs, dict) else t_bs, dtype=float).reshape(4, 4)
    except (KeyError, TypeError, ValueError) as error:
        raise Failure(f"{path}: T_BS is not a matrix of 4 x 4 numbers") from error
    turned = matrix[:3, :3]
    if np.abs(turned @ turned.T - np.eye(3)).max() > MOST_OF_ROTATION or np.linalg.det(turned) < 0:
        raise Failure(f"{path}: T_BS does not contain a rotation")
    return Stream("tf_static", path, [stamp], lambda _, at: messages.transform(
        at, messages.BASE, messages.IMU_FRAME, matrix[:3, 3], quaternion(turned)))


def noise_advice(sensor, path):
    """Configuration lines with the noise of the sensor."""
    found = [(name, number_of(sensor, key, path) * factor) for key, (name, factor) in NOISE.items()
             if sensor.get(key) is not None]
    lines = [f"    {name}: {value:.6g}" for name, value in found]
    advice = [f"noise from {path}, for your configuration:", "imu:", "  noise:"] + lines if lines else []
    if "T_BS" in sensor:
        advice += ["the pose of the IMU from it is in /tf_static; to use it:", "frames:", "  extrinsics: tf"]
    return advice
