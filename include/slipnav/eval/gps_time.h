#pragma once
/// GPS time and civil UTC to UNIX time.
///
/// UNIX time counts 86 400 s a day: an inserted leap second 23:59:60 shares its stamps with the 00:00:00 that follows.

#include "slipnav/types.h"

namespace slipnav {

/// UTC, or any other time scale told in days of 86 400 s.
struct CivilTime {
  int year = 1970;
  int month = 1;  ///< 1 to 12
  int day = 1;    ///< 1 to 31
  int hour = 0;
  int minute = 0;
  Nanoseconds second_ns = 0;  ///< within the minute; up to 61 s, for a leap second
};

/// UNIX nanoseconds of a civil UTC time. Throws std::invalid_argument for a date or time that does not exist.
Nanoseconds unixFromUtc(const CivilTime& utc);

/// UNIX nanoseconds of a civil time in GPS time (no leap seconds). Throws as unixFromUtc(), and before 1980-01-06.
Nanoseconds unixFromGpst(const CivilTime& gpst);

/// UNIX nanoseconds of GPS week (not rolled over) and time of week. Throws std::invalid_argument when out of range.
Nanoseconds unixFromGpsWeek(int week, Nanoseconds time_of_week_ns);

/// GPS time minus UTC [s] at a GPS time since 1980-01-06 (IERS Bulletin C; 18 s since 2017-01-01).
int leapSecondsAtGps(Nanoseconds since_gps_epoch);

}  // namespace slipnav
