"""Files of rows and columns as topics."""

import math

import numpy as np

from slipnav_import import columns, messages, units
from slipnav_import.failure import Failure
from slipnav_import.stream import Stream
from slipnav_import.table import Table

IMU_KEYS = ["t", "wx", "wy", "wz", "ax", "ay", "az"]
IMU_KINDS = {"t": (units.TIME,), **{key: (units.RATE,) for key in IMU_KEYS[1:4]},
             **{key: (units.FORCE,) for key in IMU_KEYS[4:]}}
SPEED_KINDS = {"t": (units.TIME,), "v": (units.SPEED,), "yaw_rate": (units.RATE,)}
WHEEL_KINDS = {"t": (units.TIME,), None: (units.WHEEL_ANGLE, units.WHEEL_RATE, units.WHEEL_SPEED, units.WHEEL_WAY)}
FIX_KEYS = ["t", "lat", "lon", "h"]
FIX_SIGMAS = ["se", "sn", "su"]
FIX_KINDS = {"t": (units.TIME,), "lat": (units.DEGREES,), "lon": (units.DEGREES,), "h": (units.LENGTH,),
             **{key: (units.LENGTH,) for key in FIX_SIGMAS}}
POSE_KEYS = ["t", "x", "y", "z"]
QUATERNION = ["qx", "qy", "qz", "qw"]
EULER = ["roll", "pitch", "yaw"]
POSE_KINDS = {"t": (units.TIME,), **{key: (units.LENGTH,) for key in POSE_KEYS[1:]},
              **{key: (units.NUMBER,) for key in QUATERNION}, **{key: (units.ANGLE,) for key in EULER}}
QUATERNION_TOLERANCE = 0.01  # of the length, which is 1


def chosen(given, usual, where):
    """The columns that were named, else those with the names of the keys."""
    return columns.parse(given if given else ",".join(f"{key}={key}" for key in usual), where)


def picked(table, parsed, keys):
    """Values of some keys, by row."""
    names = [column.key for column in parsed]
    return table.values[:, [names.index(key) for key in keys]]


def imu(path, given, shift_ns=0, topic="imu/data"):
    where = "--imu-columns"
    parsed = chosen(given, IMU_KEYS, where)
    columns.require_keys(parsed, IMU_KEYS, IMU_KEYS, where)
    table = Table(path, parsed, IMU_KINDS, where, shift_ns)
    values = picked(table, parsed, IMU_KEYS[1:])
    return finish(table, topic, lambda i, stamp: messages.imu(stamp, values[i, :3], values[i, 3:]))


def finish(table, topic, make):
    stream = Stream(topic, table.path, table.stamps, make, table.lines)
    stream.notes = table.notes + stream.notes
    return stream


def wheels(path, given, shift_ns=0, counts_per_turn=None, radius_m=None):
    """Joint states by the names of the joints, or forward speed by the key v."""
    where = "--wheels-columns"
    if not given:
        raise Failure(f"{where} is missing: t=TIME[s] and each joint, as left=COLUMN[rad/s], or v=COLUMN[m/s]")
    parsed = columns.parse(given, where)
    keys = [column.key for column in parsed]
    if "t" not in keys or len(keys) < 2:
        raise Failure(f"{where}: needs t and at least one wheel")
    return (speed if "v" in keys else joints)(path, parsed, shift_ns, where, counts_per_turn, radius_m)


def speed(path, parsed, shift_ns, where, _counts_per_turn, _radius_m):
    keys = [column.key for column in parsed]
    columns.require_keys(parsed, list(SPEED_KINDS), ["t", "v"], where)
    table = Table(path, parsed, SPEED_KINDS, where, shift_ns)
    values = picked(table, parsed, ["v"])
    rates = picked(table, parsed, ["yaw_rate"]) if "yaw_rate" in keys else np.zeros((len(values), 1))
    return finish(table, "wheel_odometry",
                  lambda i, stamp: messages.wheel_odometry(stamp, values[i, 0], rates[i, 0]))


def joints(path, parsed, shift_ns, where, counts_per_turn, radius_m):
    table = Table(path, parsed, WHEEL_KINDS, where, shift_ns)
    angles, rates = {}, {}
    for i, column in enumerate(parsed):
        if column.key == "t":
            continue
        target = angles if table.unit(i)[0] in (units.WHEEL_ANGLE, units.WHEEL_WAY) else rates
        if column.key in target:
            raise Failure(f"{where}: '{column.key}' has two columns of the same kind")
        factor = wheel_factor(column.key, table.unit(i), counts_per_turn, radius_m, where)
        target[column.key] = table.values[:, i] * factor
    if angles and rates and set(angles) != set(rates):
        raise Failure(f"{where}: {', '.join(sorted(set(angles) ^ set(rates)))}: give angles of all joints or of none, "
                      "and rates likewise")
    names = list(dict.fromkeys(column.key for column in parsed if column.key != "t"))
    turned = np.column_stack([angles[name] for name in names]) if angles else np.zeros((len(table.stamps), 0))
    turning = np.column_stack([rates[name] for name in names]) if rates else np.zeros((len(table.stamps), 0))
    return finish(table, "joint_states", lambda i, stamp: messages.joints(stamp, names, turned[i], turning[i]))


def wheel_factor(key, unit, counts_per_turn, radius_m, where):
    """The remaining factor to radians, for columns whose unit is not enough."""
    kind, factor = unit
    if kind in (units.WHEEL_SPEED, units.WHEEL_WAY):
        if not radius_m:
            raise Failure(f"{where}: '{key}' is in meters, but a wheel turns in radians: give --wheel-radius M")
        return 1.0 / radius_m
    if factor is None:
        if not counts_per_turn:
            raise Failure(f"{where}: '{key}' is in counts: give --counts-per-turn N, of the wheel's turn")
        return 2.0 * math.pi / counts_per_turn
    return 1.0


def positions(path, given, shift_ns, where, fix_topic, pose_topic):
    """Latitude, longitude, height as fixes; x, y, z as poses."""
    parsed = chosen(given, FIX_KEYS, where)
    if any(column.key in POSE_KEYS[1:] for column in parsed):
        if pose_topic is None:
            raise Failure(f"{where}: receiver fixes need lat, lon, h")
        return poses(path, parsed, shift_ns, where, pose_topic)
    return fixes(path, parsed, shift_ns, where, fix_topic)


def fixes(path, parsed, shift_ns, where, topic):
    keys = [column.key for column in parsed]
    with_sigma = any(key in keys for key in FIX_SIGMAS)
    columns.require_keys(parsed, FIX_KEYS + FIX_SIGMAS, FIX_KEYS + (FIX_SIGMAS if with_sigma else []), where)
    table = Table(path, parsed, FIX_KINDS, where, shift_ns)
    latitude, longitude = picked(table, parsed, FIX_KEYS[1:3]).T
    height = picked(table, parsed, ["h"])[:, 0]
    beyond = np.flatnonzero((np.abs(latitude) > 90.0) | (np.abs(longitude) > 360.0))
    if beyond.size:
        raise Failure(f"{path}:{table.lines[beyond[0]]}: latitude or longitude is out of range: is it in degrees, and "
                      "are the two in the right order?")
    sigmas = picked(table, parsed, FIX_SIGMAS) if with_sigma else None

    def make(i, stamp):
        covariance = None if sigmas is None else np.diag(sigmas[i] ** 2).ravel()
        return messages.fix(stamp, latitude[i], longitude[i], height[i], covariance)
    return finish(table, topic, make)


def poses(path, parsed, shift_ns, where, topic):
    keys = [column.key for column in parsed]
    attitude = next((group for group in (QUATERNION, EULER) if any(key in keys for key in group)), [])
    columns.require_keys(parsed, POSE_KEYS + (attitude or QUATERNION + EULER),
                         POSE_KEYS + (QUATERNION if attitude is QUATERNION else []), where)
    table = Table(path, parsed, POSE_KINDS, where, shift_ns)
    position = picked(table, parsed, POSE_KEYS[1:])
    xyzw = quaternions(table, parsed, attitude)
    return finish(table, topic, lambda i, stamp: messages.pose(stamp, position[i], xyzw[i]))


def quaternions(table, parsed, attitude):
    """x, y, z, w by row; zeros if there is no attitude."""
    if not attitude:
        return np.zeros((len(table.stamps), 4))
    if attitude is EULER:
        keys = [column.key for column in parsed]
        roll, pitch, yaw = (0.5 * (picked(table, parsed, [key])[:, 0] if key in keys else np.zeros(len(table.stamps)))
                            for key in EULER)
        return from_euler(roll, pitch, yaw)
    xyzw = picked(table, parsed, QUATERNION)
    wrong = np.flatnonzero(np.abs(np.linalg.norm(xyzw, axis=1) - 1.0) > QUATERNION_TOLERANCE)
    if wrong.size:
        raise Failure(f"{table.path}:{table.lines[wrong[0]]}: the quaternion does not have length 1: are "
                      "these its columns?")
    return xyzw


def from_euler(roll, pitch, yaw):
    """Of halves of the angles: about x, then y, then z of the truth's frame (forward, left, up)."""
    cr, sr, cp, sp, cy, sy = (f(angle) for angle in (roll, pitch, yaw) for f in (np.cos, np.sin))
    return np.column_stack([sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
                            cr * cp * cy + sr * sp * sy])


def tum(path, shift_ns, where, topic):
    """A trajectory: t x y z qx qy qz qw."""
    parsed = [columns.Column(key, f"#{i}", None) for i, key in enumerate(POSE_KEYS + QUATERNION, 1)]
    return poses(path, parsed, shift_ns, where, topic)
