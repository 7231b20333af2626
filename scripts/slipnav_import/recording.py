"""Topics into a bag of ROS 1, and a summary of it."""

import heapq
import os

import rosbag

from slipnav_import.failure import Failure
from slipnav_import.messages import time_of
from slipnav_import.table import counted, seconds_text

STATIC = "tf_static"


def require_time_in_common(streams):
    """The IMU and everything else must overlap in time."""
    imu = streams[0]
    for other in streams[1:]:
        if other.topic != STATIC and (other.stamps[-1] < imu.stamps[0] or other.stamps[0] > imu.stamps[-1]):
            raise Failure(f"{other.source} and {imu.source} do not overlap in time: {span(other)} and {span(imu)}; is "
                          "the unit of one wrong, or one in GPS time or local time? --imu-shift, --wheels-shift, "
                          "--truth-shift and --gps-shift add seconds to the stamps of one file")


def span(stream):
    return f"{seconds_text(stream.stamps[0])} s to {seconds_text(stream.stamps[-1])} s"


def write(path, streams):
    """All messages in the order of their stamps, which are also the recording times."""
    unfinished = path + ".part"
    merged = heapq.merge(*(stream.messages() for stream in streams), key=lambda item: item[0])
    try:
        with rosbag.Bag(unfinished, "w", compression="lz4") as bag:
            for stamp, topic, message in merged:
                bag.write("/" + topic, message, time_of(stamp), connection_header=latched(message, topic))
        os.replace(unfinished, path)
    except OSError as error:
        raise Failure(f"{path}: cannot be written: {error.strerror}") from error
    finally:
        if os.path.exists(unfinished):
            os.remove(unfinished)


def latched(message, topic):
    """Connection header that makes players latch the topic; None for topics that are not latched."""
    if topic != STATIC:
        return None
    return {"topic": "/" + topic, "type": message._type, "md5sum": message._md5sum,
            "message_definition": message._full_text, "latching": "1"}


def summary(path, streams):
    """What has been written, a line per topic."""
    begin = min(stream.stamps[0] for stream in streams)
    end = max(stream.stamps[-1] for stream in streams)
    total = sum(len(stream.stamps) for stream in streams)
    rows = [(stream.topic, type_of(stream), str(len(stream.stamps)),
             f"{stream.rate_hz:.1f} Hz" if stream.rate_hz else "", stream.source) for stream in streams]
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    lines = [f"  {row[0]:<{widths[0]}}  {row[1]:<{widths[1]}}  {row[2]:>{widths[2]}}  {row[3]:>{widths[3]}}  {row[4]}"
             for row in rows]
    head = f"{path}: {counted(total, 'message')}, {(end - begin) * 1e-9:.1f} s from {seconds_text(begin)} s"
    return "\n".join([head, *lines])


def type_of(stream):
    return next(stream.messages())[2]._type
