"""The future messages of one topic: stamps in order, and their oddities."""

from slipnav_import.table import counted, seconds_text

# As in ./run check.
GAP_INTERVALS = 3.0
LEAST_GAP_NS = 500_000_000


class Stream:
    """Stamps [ns] in order, and a message for each.

    @param make the message for an index of the rows as they were given, and its stamp
    @param lines of the rows in their file, for notes; None where a row is a file
    """

    def __init__(self, topic, source, stamps, make, lines=None):
        self.topic = topic
        self.source = source
        self.notes = backward_notes(source, stamps, lines)
        self._order = sorted(range(len(stamps)), key=stamps.__getitem__)
        self.stamps = [stamps[i] for i in self._order]
        self.notes += interval_notes(source, self.stamps)
        self._make = make

    def messages(self):
        """(stamp, topic, message) in order."""
        for stamp, index in zip(self.stamps, self._order):
            yield stamp, self.topic, self._make(index, stamp)

    @property
    def duration_s(self):
        return (self.stamps[-1] - self.stamps[0]) * 1e-9

    @property
    def rate_hz(self):
        return (len(self.stamps) - 1) / self.duration_s if self.duration_s > 0 else 0.0


def backward_notes(source, stamps, lines):
    """Stamps that go back in time, in the order of the file."""
    back = [i for i in range(1, len(stamps)) if stamps[i] < stamps[i - 1]]
    if not back:
        return []
    most = max(stamps[i - 1] - stamps[i] for i in back)
    place = f"line {lines[back[0]]}" if lines else f"row {back[0] + 1}"
    return [f"{source}: {counted(len(back), 'stamp')} before the one above, by {most * 1e-9:.3g} s at most, the first "
            f"in {place}: rows are sorted by stamp"]


def interval_notes(source, stamps):
    """Gaps and equal stamps after sorting."""
    intervals = [later - earlier for earlier, later in zip(stamps, stamps[1:])]
    equal = intervals.count(0)
    notes = [f"{source}: {counted(equal, 'stamp')} equal to the one before"] if equal else []
    if not intervals:
        return notes
    usual = sorted(intervals)[len(intervals) // 2]
    limit = max(LEAST_GAP_NS, GAP_INTERVALS * usual)
    gaps = [i for i, interval in enumerate(intervals) if interval > limit]
    if gaps:
        longest = max(gaps, key=intervals.__getitem__)
        notes.append(f"{source}: {counted(len(gaps), 'gap')}, the longest {intervals[longest] * 1e-9:.3g} s after "
                     f"{seconds_text(stamps[longest])} s")
    return notes
