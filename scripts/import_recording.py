#!/usr/bin/python3
"""Makes a recording that slipnav can evaluate from other formats: CSV, KITTI raw, EuRoC, TUM, RTKLIB.

Prints what has been written and what was odd about the files; ends with status 2 if a file cannot be understood.
"""

import argparse
import math
import os
import sys

# The packages next to this file, also when a build folder runs it through a wrapper.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import yaml  # noqa: E402

from slipnav_import import euroc, kitti, programs, recording, rtklib, tables  # noqa: E402
from slipnav_import.columns import nearest  # noqa: E402
from slipnav_import.failure import Failure  # noqa: E402

EPILOG = """columns:
  KEY=COLUMN[UNIT],...    COLUMN: a name of the file's header, or #3 for the third; UNIT: see below
  imu      t, wx, wy, wz, ax, ay, az
  wheels   t and each joint by its name (LEFT=enc_l[counts]; angles and rates may both be given), or t, v, yaw_rate
  truth    t, lat, lon, h and optionally se, sn, su; or t, x, y, z and optionally qx, qy, qz, qw or roll, pitch, yaw
  gps      t, lat, lon, h and optionally se, sn, su
units:
  time s ms us ns date; rates rad/s deg/s rpm; angles rad deg counts; acceleration m/s2 g; speed m/s km/h; length m mm
examples:
  ./run import --imu imu.csv --imu-columns 't=time[ns],wx=gx[deg/s],wy=gy[deg/s],wz=gz[deg/s],ax=ax[g],ay=ay[g],az=az[g]' \\
    --wheels enc.csv --wheels-columns 't=t[ms],left=l[counts],right=r[counts]' --counts-per-turn 4096 \\
    --truth RTKLIB.pos --out drive.bag
  ./run import files.yaml               # the same keys in a file, without dashes before them
  ./run import 2011_09_26_drive_0001_extract --oxts-speed --out kitti.bag
"""

# Options that are not allowed in a YAML file.
COMMAND_LINE_ONLY = {"help", "source", "programs"}
FILES = ["imu", "wheels", "truth", "gps"]
BAG, ROS2 = ".bag", (".mcap", ".db3", ".mcap.zstd", ".db3.zstd")


class Parser(argparse.ArgumentParser):
    def error(self, message):
        """One line, without the usage."""
        self.exit(2, f"import: {message}\n")


def number(text):
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(text)
    return value


def make_parser():
    parser = Parser(prog="import", description=__doc__.splitlines()[0], epilog=EPILOG, allow_abbrev=False,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source", nargs="?", metavar="SOURCE",
                        help="folder of KITTI raw (with oxts) or EuRoC (with mav0), or a YAML file with these options")
    parser.add_argument("--out", metavar="BAG", help="recording to write")
    parser.add_argument("--imu", metavar="CSV", help="file with the IMU")
    parser.add_argument("--imu-columns", metavar="COLUMNS", help="its columns; default: by their keys, in SI")
    parser.add_argument("--imu-shift", type=number, default=0.0, metavar="S", help="seconds to add to its stamps")
    parser.add_argument("--wheels", metavar="CSV", help="file with wheels or forward speed")
    parser.add_argument("--wheels-columns", metavar="COLUMNS", help="its columns")
    parser.add_argument("--wheels-shift", type=number, default=0.0, metavar="S", help="seconds to add to its stamps")
    parser.add_argument("--counts-per-turn", type=number, metavar="N", help="of an encoder, per turn of the wheel")
    parser.add_argument("--wheel-radius", type=number, metavar="M", help="where wheels are in meters")
    parser.add_argument("--truth", metavar="FILE",
                        help="truth: CSV with --truth-columns, .pos of RTKLIB, .tum or .txt of TUM")
    parser.add_argument("--truth-columns", metavar="COLUMNS", help="its columns, if it is CSV")
    parser.add_argument("--truth-shift", type=number, default=0.0, metavar="S", help="seconds to add to its stamps")
    parser.add_argument("--gps", metavar="FILE", help="fixes of the rover's own receiver, for its start: CSV or .pos")
    parser.add_argument("--gps-columns", metavar="COLUMNS", help="its columns, if it is CSV")
    parser.add_argument("--gps-shift", type=number, default=0.0, metavar="S", help="seconds to add to its stamps")
    parser.add_argument("--oxts-speed", action="store_true",
                        help="KITTI: use the forward speed of its satellite navigation as wheel speed")
    parser.add_argument("--shift-time", type=number, default=0.0, metavar="S", help="seconds to add to all stamps")
    parser.add_argument("--programs", default=os.path.dirname(os.path.abspath(sys.argv[0])), metavar="DIR",
                        help="folder of slipnav's programs (default: that of this one)")
    return parser


def read_description(path):
    """Options from a YAML file; paths in it are relative to it."""
    try:
        with open(path, encoding="utf-8") as file:
            content = yaml.safe_load(file)
    except (OSError, UnicodeDecodeError) as error:
        raise Failure(f"{path}: cannot be read") from error
    except yaml.YAMLError as error:
        raise Failure(f"{path}: is not YAML: {' '.join(str(error).split())}") from error
    if not isinstance(content, dict):
        raise Failure(f"{path}: has no keys, as in imu: imu.csv")
    folder = os.path.dirname(path)
    return {str(key): os.path.join(folder, str(value)) if key in FILES + ["out"] else value
            for key, value in content.items()}


def apply_description(path, parser):
    """Makes the options of a YAML file the defaults of the command line."""
    known = {option.lstrip("-"): action for action in parser._actions for option in action.option_strings
             if option.startswith("--") and action.dest not in COMMAND_LINE_ONLY}
    defaults = {}
    for key, value in read_description(path).items():
        if key not in known:
            raise Failure(f"{path}: unknown key '{key}'{nearest(key, list(known))}; keys are the "
                          "options of the command line")
        action = known[key]
        if isinstance(value, (list, dict)) != (isinstance(value, dict) and key.endswith("-columns")):
            raise Failure(f"{path}: {key} cannot be a list or mapping")
        if action.type is number:
            defaults[action.dest] = number_at(value, f"{path}: {key}")
        elif action.nargs == 0 and not isinstance(value, bool):
            raise Failure(f"{path}: {key} must be true or false")
        else:
            defaults[action.dest] = value
    parser.set_defaults(**defaults)


def number_at(value, where):
    try:
        return number(value)
    except (TypeError, ValueError) as error:
        raise Failure(f"{where}: '{value}' is not a number") from error


def parse_arguments(words):
    parser = make_parser()
    arguments = parser.parse_args(words)
    if arguments.source and arguments.source.endswith((".yaml", ".yml")):
        apply_description(arguments.source, parser)
        arguments = parser.parse_args(words)
        arguments.source = None
    if not arguments.out:
        parser.error("--out names no recording to write, as in --out drive.bag")
    for name in ("counts_per_turn", "wheel_radius"):
        value = getattr(arguments, name)
        if value is not None and not value > 0:
            parser.error(f"--{name.replace('_', '-')} must be above zero")
    return arguments


def nanoseconds(*seconds):
    return sum(round(value * 1e9) for value in seconds)


def shift_of(arguments, name):
    return nanoseconds(arguments.shift_time, getattr(arguments, f"{name}_shift"))


def refuse_recording(source, folder):
    """A recording needs no import, or a conversion that `check` names."""
    if not source.endswith(BAG):
        programs.run(folder, "check", source)
    raise Failure(f"{source}: is already a recording: ./run check {source}")


def source_streams(arguments):
    """Topics of a folder, and advice."""
    source = arguments.source
    if source is None:
        return [], []
    if not os.path.exists(source):
        raise Failure(f"{source}: does not exist")
    if source.endswith((BAG,) + ROS2) or os.path.isfile(os.path.join(source, "metadata.yaml")):
        refuse_recording(source, arguments.programs)
    oxts, sensors = kitti.find(source), euroc.find(source)
    if oxts:
        return kitti.streams(oxts, nanoseconds(arguments.shift_time), arguments.oxts_speed), []
    if sensors:
        return euroc.streams(sensors, nanoseconds(arguments.shift_time))
    raise Failure(f"{source}: is neither KITTI raw (oxts/timestamps.txt, oxts/data) nor EuRoC (mav0/imu0/data.csv) nor "
                  "a YAML file; name single files by --imu, --wheels, --truth")


def is_pos(path):
    return path.lower().endswith(".pos")


def truth_stream(arguments):
    path, shift = arguments.truth, shift_of(arguments, "truth")
    if is_pos(path):
        return rtklib.fixes(path, arguments.programs, "truth/fix", shift, as_truth=True)
    if not arguments.truth_columns and path.lower().endswith((".tum", ".txt")):
        return tables.tum(path, shift, "--truth", "truth/pose")
    return tables.positions(path, arguments.truth_columns, shift, "--truth-columns", "truth/fix", "truth/pose")


def gps_stream(arguments):
    path, shift = arguments.gps, shift_of(arguments, "gps")
    if is_pos(path):
        return rtklib.fixes(path, arguments.programs, "gps/fix", shift)
    return tables.positions(path, arguments.gps_columns, shift, "--gps-columns", "gps/fix", None)


def all_streams(arguments):
    """The IMU first."""
    streams, advice = source_streams(arguments)
    if arguments.imu:
        streams.append(tables.imu(arguments.imu, arguments.imu_columns, shift_of(arguments, "imu")))
    if arguments.wheels:
        streams.append(tables.wheels(arguments.wheels, arguments.wheels_columns, shift_of(arguments, "wheels"),
                                     arguments.counts_per_turn, arguments.wheel_radius))
    if arguments.truth:
        streams.append(truth_stream(arguments))
    if arguments.gps:
        streams.append(gps_stream(arguments))
    topics = [stream.topic for stream in streams]
    twice = next((topic for topic in topics if topics.count(topic) > 1), None)
    if twice:
        sources = " and from ".join(stream.source for stream in streams if stream.topic == twice)
        raise Failure(f"'{twice}' comes from {sources}: omit one")
    if "imu/data" not in topics:
        raise Failure("there is no IMU: give its file by --imu, or a folder of KITTI or EuRoC")
    return sorted(streams, key=lambda stream: stream.topic != "imu/data"), advice


def report(out, streams, advice):
    for stream in streams:
        for note in stream.notes:
            print(f"import: {note}", file=sys.stderr)
    print(recording.summary(out, streams))
    topics = {stream.topic for stream in streams}
    if not topics & {"joint_states", "wheel_odometry"}:
        print("no wheels: evaluate needs them, give their file by --wheels")
    if not any(topic.startswith("truth/") for topic in topics):
        print("no truth: evaluate gives no errors without it, give its file by --truth")
    print("\n".join(advice + [f"next: ./run check {out}"]))


def main(words=None):
    """@param words of the command line; None: those of this process"""
    try:
        arguments = parse_arguments(words)
        streams, advice = all_streams(arguments)
        recording.require_time_in_common(streams)
        recording.write(arguments.out, streams)
    except Failure as failure:
        print(f"import: {failure}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    report(arguments.out, streams, advice)
    return 0


if __name__ == "__main__":
    sys.exit(main())
