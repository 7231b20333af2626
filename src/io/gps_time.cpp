#include "io/gps_time.h"

#include <array>
#include <stdexcept>
#include <string>

namespace slipnav {
namespace {

constexpr Nanoseconds kDay = 86'400 * kSecond;
constexpr int kDaysPerWeek = 7;

/// Days since 1970-01-01 in the Gregorian calendar: years counted from March, so that the leap day comes last.
constexpr std::int64_t daysSince1970(int year, int month, int day) {
  const std::int64_t shifted_year = month > 2 ? year : year - 1;
  const std::int64_t shifted_month = month > 2 ? month - 3 : month + 9;
  const std::int64_t day_of_year = (153 * shifted_month + 2) / 5 + day - 1;
  const std::int64_t days = 365 * shifted_year + shifted_year / 4 - shifted_year / 100 + shifted_year / 400;
  constexpr std::int64_t kDaysFromYearZeroTo1970 = 719'468;
  return days + day_of_year - kDaysFromYearZeroTo1970;
}

constexpr Nanoseconds kGpsEpoch = daysSince1970(1980, 1, 6) * kDay;

/// The first day after each leap second since the GPS epoch; the i-th one makes GPS time lead UTC by i + 1 seconds.
constexpr std::array<std::int64_t, 18> kLeapDays = {
    daysSince1970(1981, 7, 1), daysSince1970(1982, 7, 1), daysSince1970(1983, 7, 1), daysSince1970(1985, 7, 1),
    daysSince1970(1988, 1, 1), daysSince1970(1990, 1, 1), daysSince1970(1991, 1, 1), daysSince1970(1992, 7, 1),
    daysSince1970(1993, 7, 1), daysSince1970(1994, 7, 1), daysSince1970(1996, 1, 1), daysSince1970(1997, 7, 1),
    daysSince1970(1999, 1, 1), daysSince1970(2006, 1, 1), daysSince1970(2009, 1, 1), daysSince1970(2012, 7, 1),
    daysSince1970(2015, 7, 1), daysSince1970(2017, 1, 1)};

int daysInMonth(int year, int month) {
  constexpr std::array<int, 12> kDays = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_leap_year = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  return month == 2 && is_leap_year ? 29 : kDays[static_cast<std::size_t>(month - 1)];
}

void require(bool holds, const std::string& what) {
  if (!holds) {
    throw std::invalid_argument(what + " is out of range");
  }
}

}  // namespace

Nanoseconds calendarNanoseconds(const CalendarTime& time) {
  // years whose nanoseconds since 1970 fit 64 bits
  require(time.year >= 1970 && time.year <= 2200, "year " + std::to_string(time.year));
  require(time.month >= 1 && time.month <= 12, "month " + std::to_string(time.month));
  require(time.day >= 1 && time.day <= daysInMonth(time.year, time.month), "day " + std::to_string(time.day));
  require(time.hour >= 0 && time.hour < 24, "hour " + std::to_string(time.hour));
  require(time.minute >= 0 && time.minute < 60, "minute " + std::to_string(time.minute));
  require(time.second_ns >= 0 && time.second_ns < 61 * kSecond, "second " + std::to_string(toSeconds(time.second_ns)));
  const Nanoseconds minutes = 60 * time.hour + time.minute;
  return daysSince1970(time.year, time.month, time.day) * kDay + minutes * 60 * kSecond + time.second_ns;
}

Nanoseconds calendarNanoseconds(int gps_week, Nanoseconds time_of_week_ns) {
  require(gps_week >= 0 && gps_week < 10'000, "GPS week " + std::to_string(gps_week));
  require(time_of_week_ns >= 0 && time_of_week_ns <= kDaysPerWeek * kDay,
          "time of week " + std::to_string(toSeconds(time_of_week_ns)));
  return kGpsEpoch + gps_week * (kDaysPerWeek * kDay) + time_of_week_ns;
}

Nanoseconds unixFromGpst(Nanoseconds gpst_calendar) {
  if (gpst_calendar < kGpsEpoch) {
    throw std::invalid_argument("GPS time before 1980-01-06");
  }
  Nanoseconds leap = 0;
  for (const std::int64_t day : kLeapDays) {
    if (gpst_calendar < day * kDay + leap + kSecond) {
      break;
    }
    leap += kSecond;
  }
  return gpst_calendar - leap;
}

}  // namespace slipnav
