#pragma once
/// Calendar, GPS time and UTC to UNIX time.
///
/// UNIX time counts 86 400 s a day: an inserted leap second 23:59:60 shares its stamps with the following 00:00:00.

#include "slipnav/core/base/types.h"

namespace slipnav {

/// Date and time of day, in whatever time scale.
struct CalendarTime {
  int year = 1970;
  int month = 1;  ///< 1 to 12
  int day = 1;    ///< 1 to 31
  int hour = 0;
  int minute = 0;
  Nanoseconds second_ns = 0;  ///< within the minute; below 61 s, for a leap second
};

/// Nanoseconds since 1970-01-01 by a calendar whose days all have 86 400 s, in the time scale of the argument: for UTC
/// this is UNIX time. Throws std::invalid_argument for a date or time that does not exist.
Nanoseconds calendarNanoseconds(const CalendarTime& time);

/// The same for a week and a time of week counted from 1980-01-06 (weeks not rolled over). Throws
/// std::invalid_argument if out of range.
Nanoseconds calendarNanoseconds(int gps_week, Nanoseconds time_of_week_ns);

/// UNIX time of calendar nanoseconds in GPS time: less the leap seconds since 1980-01-06 (IERS Bulletin C; 18 s since
/// 2017-01-01). Throws std::invalid_argument before 1980-01-06.
Nanoseconds unixFromGpst(Nanoseconds gpst_calendar);

}  // namespace slipnav
