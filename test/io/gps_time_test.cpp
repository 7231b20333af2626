#include "io/gps_time.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace slipnav {
namespace {

TEST(GpsTime, countsCalendarDays) {
  EXPECT_EQ(calendarNanoseconds({1970, 1, 1, 0, 0, 0}), 0);
  EXPECT_EQ(calendarNanoseconds({1980, 1, 6, 0, 0, 0}), 315'964'800 * kSecond);
  // date -u -d '2020-02-29 12:34:56' +%s, and the day after
  EXPECT_EQ(calendarNanoseconds({2020, 2, 29, 12, 34, 56 * kSecond + 7}), 1'582'979'696 * kSecond + 7);
  EXPECT_EQ(calendarNanoseconds({2020, 3, 1, 0, 0, 0}), 1'583'020'800 * kSecond);
  EXPECT_EQ(calendarNanoseconds({2021, 12, 31, 23, 59, 59 * kSecond}), 1'640'995'199 * kSecond);
}

TEST(GpsTime, leapSecondSharesStampsWithTheNextDay) {
  EXPECT_EQ(calendarNanoseconds({2016, 12, 31, 23, 59, 60 * kSecond}), calendarNanoseconds({2017, 1, 1, 0, 0, 0}));
}

TEST(GpsTime, countsWeeksFromTheGpsEpoch) {
  EXPECT_EQ(calendarNanoseconds(0, 0), calendarNanoseconds({1980, 1, 6, 0, 0, 0}));
  // RTKLIB's own header: 2015/06/01 23:59:30 GPST is week 1847, 172770 s
  EXPECT_EQ(calendarNanoseconds(1847, 172'770 * kSecond), calendarNanoseconds({2015, 6, 1, 23, 59, 30 * kSecond}));
}

TEST(GpsTime, refusesDatesThatDoNotExist) {
  EXPECT_THROW(calendarNanoseconds({2021, 2, 29, 0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds({1900, 2, 1, 0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds({2021, 13, 1, 0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds({2021, 4, 31, 0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds({2021, 4, 0, 0, 0, 0}), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds({2021, 4, 1, 24, 0, 0}), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds({2021, 4, 1, 0, 60, 0}), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds({2021, 4, 1, 0, 0, 61 * kSecond}), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds(-1, 0), std::invalid_argument);
  EXPECT_THROW(calendarNanoseconds(2000, 604'801 * kSecond), std::invalid_argument);
  EXPECT_NO_THROW(calendarNanoseconds({2000, 2, 29, 0, 0, 0}));
}

Nanoseconds leapAt(const CalendarTime& gpst) {
  const Nanoseconds calendar = calendarNanoseconds(gpst);
  return (calendar - unixFromGpst(calendar)) / kSecond;
}

TEST(GpsTime, knowsTheLeapSeconds) {
  // GPS time minus UTC as tabulated by the US Naval Observatory
  EXPECT_EQ(leapAt({1980, 1, 6, 0, 0, 0}), 0);
  EXPECT_EQ(leapAt({1982, 1, 1, 0, 0, 0}), 1);
  EXPECT_EQ(leapAt({1990, 6, 1, 0, 0, 0}), 6);
  EXPECT_EQ(leapAt({2000, 1, 1, 0, 0, 0}), 13);
  EXPECT_EQ(leapAt({2008, 12, 1, 0, 0, 0}), 14);
  EXPECT_EQ(leapAt({2014, 1, 1, 0, 0, 0}), 16);
  EXPECT_EQ(leapAt({2016, 6, 1, 0, 0, 0}), 17);
  EXPECT_EQ(leapAt({2020, 10, 15, 0, 0, 0}), 18);
}

TEST(GpsTime, changesAtTheLeapSecondItself) {
  const Nanoseconds midnight = calendarNanoseconds({2017, 1, 1, 0, 0, 0});
  // 23:59:59.5 UTC, the leap second 23:59:60.5, which UNIX time tells as 00:00:00.5, and 00:00:00.5
  EXPECT_EQ(unixFromGpst(midnight + 16 * kSecond + kSecond / 2), midnight - kSecond / 2);
  EXPECT_EQ(unixFromGpst(midnight + 17 * kSecond + kSecond / 2), midnight + kSecond / 2);
  EXPECT_EQ(unixFromGpst(midnight + 18 * kSecond + kSecond / 2), midnight + kSecond / 2);
  EXPECT_EQ(unixFromGpst(midnight + 18 * kSecond), midnight);
  EXPECT_THROW(unixFromGpst(calendarNanoseconds({1980, 1, 5, 23, 59, 0})), std::invalid_argument);
}

}  // namespace
}  // namespace slipnav
