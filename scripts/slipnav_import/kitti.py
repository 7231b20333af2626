"""Recordings of KITTI raw: the folder oxts of a drive, with the solution of its inertial and satellite navigation.

A file of data has 30 numbers (dataformat.txt of the data set): 0 to 2 latitude, longitude [°] and altitude [m], 8
forward speed [m/s], 11 to 13 specific force and 17 to 19 rates in the vehicle (forward, left, up), 23 accuracy of
position [m].
"""

import os

from slipnav_import import messages
from slipnav_import.failure import Failure
from slipnav_import.stream import Stream
from slipnav_import.table import counted, date_ns, open_lines, usable_stamp

FIELDS = 30
LATITUDE, SPEED, FORCE, RATE, ACCURACY = 0, 8, 11, 17, 23
LEAST_RATE_HZ = 20.0  # of an IMU, doc/topics.md


def find(folder):
    """The folder oxts of a drive, or None."""
    return next((path for path in (os.path.join(folder, "oxts"), folder)
                 if os.path.isfile(os.path.join(path, "timestamps.txt")) and os.path.isdir(os.path.join(path, "data"))),
                None)


def read_stamps(path, shift_ns):
    stamps = []
    for number, line in open_lines(path):
        stamp = date_ns(line.strip())
        if stamp is None:
            raise Failure(f"{path}:{number}: '{line.strip()}' is not a date like 2011-09-26 13:02:25.594360375")
        stamps.append(usable_stamp(stamp + shift_ns, f"{path}:{number}"))
    return stamps


def read_numbers(path):
    lines = open_lines(path)
    fields = [field for _, line in lines for field in line.split()]
    if len(fields) < FIELDS:
        raise Failure(f"{path}:1: {len(fields)} fields instead of {FIELDS}")
    try:
        return [float(field) for field in fields]
    except ValueError as error:
        raise Failure(f"{path}:1: a field is not a number") from error


def read_rows(folder, shift_ns):
    """Stamps and numbers of all existing files, and notes."""
    stamps = read_stamps(os.path.join(folder, "timestamps.txt"), shift_ns)
    paths = [os.path.join(folder, "data", f"{i:010d}.txt") for i in range(len(stamps))]
    there = [i for i, path in enumerate(paths) if os.path.isfile(path)]
    rows = [(stamps[i], read_numbers(paths[i])) for i in there]
    good = [row for row in rows if all(abs(number) < float("inf") for number in row[1])]
    notes = []
    if len(there) < len(paths):
        notes.append(f"{folder}: {counted(len(paths) - len(there), 'file')} of {len(paths)} stamps missing: skipped")
    if len(good) < len(rows):
        notes.append(f"{folder}: {counted(len(rows) - len(good), 'file')} with NaN skipped")
    if not good:
        raise Failure(f"{folder}: has no data: {os.path.join('data', '0000000000.txt')} is the first one needed")
    return [stamp for stamp, _ in good], [numbers for _, numbers in good], notes


def streams(folder, shift_ns=0, speed_as_wheels=False):
    """IMU and truth; the forward speed in place of wheels only when asked, since it is not from wheels."""
    stamps, rows, notes = read_rows(folder, shift_ns)

    def imu(i, stamp):
        return messages.imu(stamp, rows[i][RATE:RATE + 3], rows[i][FORCE:FORCE + 3])

    def truth(i, stamp):
        variance = rows[i][ACCURACY] ** 2
        return messages.fix(stamp, *rows[i][LATITUDE:LATITUDE + 3],
                            [variance, 0, 0, 0, variance, 0, 0, 0, variance] if variance > 0 else None)

    def speed(i, stamp):
        return messages.wheel_odometry(stamp, rows[i][SPEED], 0.0, "oxts_speed")
    result = [Stream("imu/data", folder, stamps, imu), Stream("truth/fix", folder, stamps, truth)]
    for other in result[1:]:
        other.notes = []  # they are those of the IMU
    if speed_as_wheels:
        source = f"{folder}, vf: speed from its inertial and satellite navigation, not from wheels"
        result.append(Stream("wheel_odometry", source, stamps, speed))
        result[-1].notes = []
    if 0.0 < result[0].rate_hz < LEAST_RATE_HZ:
        notes.append(f"{folder}: the IMU has {result[0].rate_hz:.1f} Hz, and slipnav needs {LEAST_RATE_HZ:.0f} or "
                     "more: the data set has the same drive unsynchronized, at 100 Hz (extract)")
    result[0].notes = notes + result[0].notes
    return result
