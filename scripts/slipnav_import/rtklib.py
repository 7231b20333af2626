"""Solutions of RTKLIB as fixes; slipnav's own program `positions` reads them."""

from sensor_msgs.msg import NavSatStatus

from slipnav_import import messages, programs
from slipnav_import.failure import Failure
from slipnav_import.stream import Stream
from slipnav_import.table import usable_stamp

# Quality 1 and 2 come with corrections of a base, 3 with those of satellites.
STATUS = {1: NavSatStatus.STATUS_GBAS_FIX, 2: NavSatStatus.STATUS_GBAS_FIX, 3: NavSatStatus.STATUS_SBAS_FIX}


def fixes(path, folder, topic, shift_ns=0, as_truth=False):
    """@param folder of slipnav's programs
    @param as_truth skip outlier rows, as an evaluation does with its truth"""
    lines, notes = programs.run(folder, "positions", path, *(["--truth"] if as_truth else []))
    rows = [line.split(",") for line in lines[1:]]
    if not rows:
        raise Failure(f"{path}: has no solution" + (f": {'; '.join(notes)}" if notes else ""))
    stamps = [usable_stamp(int(row[0]) + shift_ns, path) for row in rows]

    def make(i, stamp):
        latitude, longitude, height = (float(field) for field in rows[i][1:4])
        ee, en, eu, nn, nu, uu = (float(field) for field in rows[i][5:])
        return messages.fix(stamp, latitude, longitude, height, [ee, en, eu, en, nn, nu, eu, nu, uu],
                            STATUS.get(int(rows[i][4]), NavSatStatus.STATUS_FIX))
    stream = Stream(topic, path, stamps, make)
    stream.notes = notes + stream.notes
    return stream
