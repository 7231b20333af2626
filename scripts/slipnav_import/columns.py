"""Meaning and unit of each column of a file:  "t=time[ns],wx=gyro_x[deg/s]", or the same keys in YAML."""

import difflib
import re
from dataclasses import dataclass
from typing import Optional

from slipnav_import.failure import Failure


@dataclass(frozen=True)
class Column:
    key: str  # what it is: t, wx, or the name of a joint
    name: str  # of the column in the file, or #NUMBER from 1
    unit: Optional[str]  # as given; None: from the file's header, or the default

    @property
    def number(self):
        return int(self.name[1:]) if re.fullmatch(r"#\d+", self.name) else None


def split_unit(text):
    """Name and unit of "gyro_x [deg/s]"; None if no unit is given."""
    match = re.fullmatch(r"(.*?)\s*\[([^\[\]]*)\]", text.strip())
    return (match.group(1).strip(), match.group(2).strip()) if match else (text.strip(), None)


def column(key, text, where):
    name, unit = split_unit(str(text))
    if not name:
        raise Failure(f"{where}: '{key}={text}' names no column")
    return Column(key.strip(), name, unit)


def parse(given, where):
    """Columns from text, or from a YAML mapping; a key may occur twice, as a list in YAML."""
    if isinstance(given, dict):
        pairs = [(str(key), text) for key, texts in given.items()
                 for text in (texts if isinstance(texts, list) else [texts])]
        return [column(key, text, where) for key, text in pairs]
    columns = []
    for part in re.split(r",(?![^\[]*\])", str(given)):
        key, equals, text = part.partition("=")
        if not equals or not key.strip():
            raise Failure(f"{where}: '{part.strip()}' is not KEY=COLUMN[UNIT], as in t=time[ns]")
        columns.append(column(key, text, where))
    return columns


def require_keys(columns, known, required, where):
    """Checks that each key is known, none occurs twice, and all required ones are present."""
    keys = [column.key for column in columns]
    for key in keys:
        if key not in known:
            raise Failure(f"{where}: '{key}' is not one of {', '.join(known)}{nearest(key, known)}")
        if keys.count(key) > 1:
            raise Failure(f"{where}: '{key}' is given twice")
    missing = [key for key in required if key not in keys]
    if missing:
        raise Failure(f"{where}: lacks {', '.join(missing)}")


def nearest(word, known):
    close = difflib.get_close_matches(word, known, 1)
    return f"; did you mean {close[0]}?" if close else ""
