"""Files of rows and columns: numbers in SI by key, stamps in nanoseconds, and what was skipped."""

import csv
import math
import os
import re
from datetime import datetime, timezone
from decimal import Decimal, InvalidOperation

import numpy as np

from slipnav_import import units
from slipnav_import.columns import nearest, split_unit
from slipnav_import.failure import Failure

SEPARATORS = ",;\t"
ABSENT = {"", "nan", "-nan", "+nan", "nan(ind)", "-nan(ind)", "inf", "-inf", "+inf", "infinity", "-infinity", "null",
          "none", "na", "n/a"}
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
DATE = re.compile(r"(\d{4})[-/](\d\d?)[-/](\d\d?)[ T](\d\d?):(\d\d?):(\d\d?)(\.\d+)?Z?", re.ASCII)
NANOSECONDS = Decimal(10**9)
MOST_OF_TIME = 1e25  # in any unit; far beyond the end below
END_OF_TIME_NS = 2**32 * 10**9  # of the seconds that ROS counts


def open_lines(path):
    """The lines of a text file with their numbers, or Failure."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            text = file.read()
    except OSError as error:
        raise Failure(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise Failure(f"{path}: is not a text file") from error
    if "\0" in text:
        raise Failure(f"{path}: is not a text file")
    return [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]


def fields_of(line, separator):
    if separator is None:
        return line.split()
    return [field.strip() for field in next(csv.reader([line], delimiter=separator, skipinitialspace=True))]


def separator_of(line):
    """The separator used in a line; None for white space."""
    return next((separator for separator in SEPARATORS if separator in line), None)


def is_number(field):
    return bool(NUMBER.fullmatch(field))


def is_word(field):
    """Neither a number, nor a date, nor a placeholder for one."""
    return not is_number(field) and not date_ns(field) and field.lower() not in ABSENT


def date_ns(field):
    """UNIX time of a UTC date; None for anything else."""
    match = DATE.fullmatch(field)
    if not match:
        return None
    try:
        day = datetime(*(int(part) for part in match.groups()[:6]), tzinfo=timezone.utc)
    except ValueError:
        return None
    return int(day.timestamp()) * 10**9 + int(Decimal(match.group(7) or "0") * NANOSECONDS)


def split_heading(heading):
    """Name and unit of a column of a file; the unit is in brackets or, if it is one, in parentheses."""
    match = re.fullmatch(r"(.*?)\s*\(([^()]*)\)", heading)
    return match.groups() if match and units.is_known(match.group(2)) else split_unit(heading)


class Heading:
    """Names and units of the columns of a file."""

    def __init__(self, path, names):
        self.path = path
        self.whole = names
        self.names = [split_heading(name) for name in names]

    def place(self, column, where):
        """Index of a column, and the unit that applies."""
        if column.number is not None:
            if not 1 <= column.number <= len(self.names):
                raise Failure(f"{where}: {self.path} has {len(self.names)} columns, but no {column.name}")
            return column.number - 1, column.unit or self.known_unit(column.number - 1)
        places = [place for place, (name, _) in enumerate(self.names) if column.name in (name, self.whole[place])]
        if len(places) != 1:
            raise Failure(self.complaint(column, len(places), where))
        said = self.known_unit(places[0])
        if column.unit is not None and said is not None and units.plain(said) != units.plain(column.unit):
            raise Failure(f"{where}: the header of {self.path} says {said} of column '{column.name}', not "
                          f"{column.unit}; if the header is wrong, name the column by its number: "
                          f"#{places[0] + 1}[{column.unit}]")
        return places[0], column.unit if column.unit is not None else said

    def known_unit(self, place):
        unit = self.names[place][1]
        return unit if unit and units.is_known(unit) else None

    def complaint(self, column, count, where):
        if count > 1:
            return f"{where}: {self.path} has {count} columns '{column.name}'; name one by its number, as #2"
        names = [name for name, _ in self.names]
        if not any(is_word(name) for name in names):
            return (f"{where}: {self.path} has no header line, so no '{column.name}'; "
                    f"name columns by number, as {column.key}=#1")
        return (f"{where}: {self.path} has no column '{column.name}'; it has {', '.join(names)}"
                f"{nearest(column.name, names)}")


class Table:
    """Stamps [ns], columns by key, and notes on skipped rows.

    @param columns of columns.parse()
    @param kinds by key: the kinds of units that a column may be of; a key that is not there takes those of None
    """

    def __init__(self, path, columns, kinds, where, shift_ns=0):
        self.path = path
        self.notes = []
        self.lines = []  # of each row in the file
        self.stamps = []
        self._shift_ns = shift_ns
        rows = self._rows(columns, kinds, where)
        self._read(rows, columns)
        if not self.stamps:
            raise Failure(f"{path}: has no usable row")
        self.values = np.array(self._values, dtype=float).reshape(len(self.stamps), len(columns))

    def unit(self, place):
        """(kind, factor) of a column; the factor of counts is None."""
        return self._units[place]

    def _rows(self, columns, kinds, where):
        """(line number, fields) of all data rows; detects header and separator first."""
        lines = open_lines(self.path)
        data = [(number, line) for number, line in lines if line.lstrip()[0] not in "#%"]
        if not data:
            raise Failure(f"{self.path}: is empty" if not lines else f"{self.path}: has no rows")
        separator = separator_of(data[0][1])
        first = fields_of(data[0][1], separator)
        has_header = any(is_word(field) for field in first) and not any(is_number(field) for field in first)
        comments = [line.lstrip().lstrip("#%") for number, line in lines if number < data[0][0]]
        named = first if has_header else self._named_by(comments, separator, len(first)) or first
        heading = Heading(self.path, named)
        self._places, self._units = [], []
        for column in columns:
            place, unit = heading.place(column, where)
            allowed = kinds.get(column.key, kinds.get(None))
            if unit is None:
                if allowed[0] not in units.USUAL:
                    known = units.listed(allowed)
                    raise Failure(f"{where}: '{column.key}={column.name}' needs a unit, one of {known}, "
                                  f"as in {column.key}={column.name}[{known.split(',')[0]}]")
                unit = units.USUAL[allowed[0]]
            kind, factor = units.kind_and_factor(unit, allowed, f"{where}: {column.key}")
            self._places.append(place)
            self._units.append((kind, factor))
        self._names = [column.name for column in columns]
        self._count = len(first)
        return [(number, fields_of(line, separator)) for number, line in data[1 if has_header else 0:]]

    @staticmethod
    def _named_by(comments, separator, count):
        """Names of columns from the last comment that has as many as there are."""
        for comment in reversed(comments):
            names = fields_of(comment, separator)
            if len(names) == count and any(is_word(name) for name in names):
                return names
        return None

    def _read(self, rows, columns):
        self._values = []
        absent = []
        time_at = next(i for i, column in enumerate(columns) if column.key == "t")
        for index, (number, fields) in enumerate(rows):
            if len(fields) == self._count + 1 and not fields[-1]:
                fields.pop()  # a separator at the end
            if len(fields) != self._count:
                if index + 1 == len(rows) and len(fields) < self._count and index > 0:
                    self.notes.append(f"{self.path}:{number}: the last row is cut off: skipped")
                    continue
                raise Failure(f"{self.path}:{number}: {len(fields)} fields instead of {self._count}")
            wanted = [fields[place] for place in self._places]
            if any(field.lower() in ABSENT for field in wanted):
                absent.append(number)
                continue
            self.stamps.append(self._stamp(wanted[time_at], self._units[time_at][1], number))
            self.lines.append(number)
            self._values.append([0.0 if i == time_at else self._number(field, i, number)
                                 for i, field in enumerate(wanted)])
        if absent:
            self.notes.append(f"{self.path}: {counted(len(absent), 'row')} with NaN or empty fields skipped, "
                              f"the first in line {absent[0]}")

    def _number(self, field, i, number):
        value = float(field) if NUMBER.fullmatch(field) else math.inf
        if not math.isfinite(value):
            comma = " (a decimal comma? use points)" if re.fullmatch(r"-?\d+,\d+", field) else ""
            raise Failure(f"{self.path}:{number}: '{field}' in column '{self._names[i]}' is not a number{comma}")
        factor = self._units[i][1]
        return value if factor is None else value * factor

    def _stamp(self, field, seconds, number):
        if seconds is None:
            stamp = date_ns(field)
            if stamp is None:
                raise Failure(f"{self.path}:{number}: '{field}' is not a date like 2020-10-15 15:00:00.123")
        else:
            stamp = decimal_ns(field, seconds, f"{self.path}:{number}")
        return usable_stamp(stamp + self._shift_ns, f"{self.path}:{number}")


def decimal_ns(field, seconds, where):
    """Nanoseconds of a decimal number, exact."""
    try:
        if not NUMBER.fullmatch(field) or abs(float(field)) > MOST_OF_TIME:
            raise InvalidOperation
        return int((Decimal(field) * seconds * NANOSECONDS).to_integral_value())
    except InvalidOperation as error:
        raise Failure(f"{where}: '{field}' is not a time") from error


def usable_stamp(stamp, where):
    """A stamp that a recording can hold."""
    if stamp <= 0:
        raise Failure(f"{where}: the stamp is {seconds_text(stamp)} s, but a recording holds only times above zero: "
                      "shift all by --shift-time 1000000000")
    if stamp >= END_OF_TIME_NS:
        raise Failure(f"{where}: the stamp is {seconds_text(stamp)} s, beyond what ROS counts: is the unit of t right?")
    return stamp


def seconds_text(stamp_ns):
    return f"{'-' if stamp_ns < 0 else ''}{abs(stamp_ns) // 10**9}.{abs(stamp_ns) % 10**9:09d}"


def counted(count, what):
    return f"{count} {what}{'' if count == 1 else 's'}"


def base_name(path):
    return os.path.basename(os.path.normpath(path))
