"""The recordings: files and folders as named, with the parts of a split recording joined."""

import os
import re
from dataclasses import dataclass
from typing import Dict, Tuple

ENDING = ".bag"
# In folders: files that are not ROS 1 recordings, by their ending.
LEFT_OUT = {".mcap": "a ROS 2 recording; convert it, for example with rosbags-convert",
            ".db3": "a ROS 2 recording; convert it, for example with rosbags-convert",
            ".bag.active": "it was not finished; rosbag reindex may repair it, without the ending .active"}
LONGEST_GAP_S = 3.0  # from the last message of a part to the first of the next
LONGEST_OVERLAP_S = 0.5  # messages of several sensors are not written in perfect order
EXPECTED = 3  # messages of a topic in a part, by its rate in the other: fewer may be none


@dataclass(frozen=True)
class Recording:
    name: str
    parts: Tuple[str, ...]  # files, in the order of time

    def __str__(self):
        return self.name

    @property
    def size(self):
        return sum(os.path.getsize(part) for part in self.parts if os.path.isfile(part))


@dataclass(frozen=True)
class Span:
    begin: float
    end: float
    topics: Dict[str, Tuple[str, int]]  # type and number of messages


def files_in(folder, say):
    """Recordings in it and below. Raises ValueError if there are none."""
    inside = sorted(os.path.join(path, name) for path, _, names in os.walk(folder) for name in names)
    for path in inside:
        for ending, cause in LEFT_OUT.items():
            if path.endswith(ending):
                say(f"{path} is skipped: {cause}")
    found = [path for path in inside if path.endswith(ENDING)]
    if not found:
        raise ValueError(f"no recording (*{ENDING}) in the folder '{folder}'")
    return found


def files_of(arguments, say):
    """Files, each once, with folders replaced by their contents."""
    files = {}
    for argument in arguments:
        for file in files_in(argument, say) if os.path.isdir(argument) else [argument]:
            files.setdefault(os.path.realpath(file), file)
    return list(files.values())


def span_of(path):
    """None for a file that cannot be read: its evaluation says why."""
    import rosbag  # slow to load, and needed for more than one recording only

    try:
        with rosbag.Bag(path, skip_index=True) as bag:
            topics = {name.lstrip("/"): (topic.msg_type, topic.message_count)
                      for name, topic in bag.get_type_and_topic_info().topics.items()}
            return Span(bag.get_start_time(), bag.get_end_time(), topics)
    except Exception:  # of any kind, for a file that is damaged
        return None


def lacks(span, other):
    """Whether a topic of `other` is missing, or of another type, that should be in it at its rate."""
    share = (span.end - span.begin) / max(other.end - other.begin, 1e-9)
    return any(span.topics.get(name, (kind,))[0] != kind or (name not in span.topics and count * share >= EXPECTED)
               for name, (kind, count) in other.topics.items())


def continues(span, before):
    """Whether it was recorded next."""
    return (-LONGEST_OVERLAP_S <= span.begin - before.end <= LONGEST_GAP_S
            and span.begin > before.begin and span.end > before.end
            and bool(set(span.topics) & set(before.topics)) and not lacks(span, before) and not lacks(before, span))


def stem(path):
    name = os.path.basename(path)
    return name[:-len(ENDING)] if name.endswith(ENDING) else name


def family(path):
    """The name without the number and time of a part."""
    return re.sub(r"(_?\d{4}(-\d\d){5})?_\d+$", "", stem(path))


def nearest(path, others, spans):
    """Of the candidates the nearest with that name; the only one of another name; None."""
    kin = [other for other in others if family(other) == family(path)]
    if kin:
        return min(kin, key=lambda other: abs(spans[other].begin - spans[path].begin))
    return others[0] if len(others) == 1 else None


def successors(files, spans, say):
    """{part: the next}"""
    known = [file for file in files if spans[file]]
    after = {one: [other for other in known if continues(spans[other], spans[one])] for one in known}
    before = {other: [one for one in known if other in after[one]] for other in known}
    found = {}
    for one in known:
        other = nearest(one, after[one], spans)
        if other is None and after[one]:
            say(f"{one} may be continued by {' or '.join(after[one])}: kept apart")
        elif other is not None and nearest(other, before[other], spans) == one:
            found[one] = other
    return found


def joined(files, say):
    """Tuples of parts, in the order of the first one named."""
    spans = {file: span_of(file) for file in files}
    following = successors(files, spans, say)
    preceding = {other: one for one, other in following.items()}
    chains = {}
    for file in files:
        first = file
        while first in preceding:
            first = preceding[first]
        if first not in chains:
            chain = [first]
            while chain[-1] in following:
                chain.append(following[chain[-1]])
            chains[first] = tuple(chain)
    return list(chains.values())


def named(groups_of_parts):
    """Recordings by file name, with the folder name if several share it."""
    names = [stem(parts[0]) if len(parts) == 1 else re.sub(r"_\d+$", "", stem(parts[0])) or stem(parts[0])
             for parts in groups_of_parts]
    recordings, taken = [], set()
    for name, parts in zip(names, groups_of_parts):
        if names.count(name) > 1:
            name = os.path.basename(os.path.dirname(os.path.abspath(parts[0]))) + "_" + name
        wanted, number = name, 2
        while name in taken:
            name, number = f"{wanted}_{number}", number + 1
        taken.add(name)
        recordings.append(Recording(name, parts))
    return recordings


def recordings_of(arguments, separate, say):
    files = files_of(arguments, say)
    parts = [(file,) for file in files] if separate or len(files) == 1 else joined(files, say)
    recordings = named(parts)
    for recording in recordings:
        if len(recording.parts) > 1:
            say(f"{recording}: one recording of {len(recording.parts)} parts, which --separate would keep apart: "
                + ", ".join(recording.parts))
    return recordings
