#include "io/rtklib_pos.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace slipnav {
namespace {

const char* const kDegreesHeader =
    "% program   : RTKPOST ver.2.4.2\n"
    "% obs start : 2020/10/15 15:00:00.0 GPST (week2127 399600.0s)\n"
    "%\n"
    "%  GPST                  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)   sdu(m)  sdne(m)  "
    "sdeu(m)  sdun(m) age(s)  ratio\n";

std::vector<RtklibSolution> parse(const std::string& text) {
  std::istringstream in(text);
  return readRtklibPos(in, "x.pos");
}

/// Message of the error that reading `text` throws; empty when it throws none.
std::string errorOf(const std::string& text) {
  try {
    parse(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(RtklibPos, readsDegreesInGpsTime) {
  const auto solutions = parse(std::string(kDegreesHeader) +
                               "2020/10/15 15:00:18.100   39.600000001  -79.900000002   250.1234   1   9   0.0100   "
                               "0.0200   0.0300   0.0050  -0.0060   0.0070   0.10    9.9\n"
                               "\n"
                               "2020/10/15 15:00:18.200   39.6  -79.9   250.2   4   8   1 2 3 0 0 0   0.10    1.0\n\n");
  ASSERT_EQ(solutions.size(), 2U);
  const RtklibSolution& first = solutions[0];
  // date -u -d '2020-10-15 15:00:00' +%s: GPS time led UTC by 18 s
  EXPECT_EQ(first.fix.stamp, 1'602'774'000 * kSecond + kSecond / 10);
  EXPECT_NEAR(first.fix.latitude_deg, 39.600000001, 1e-12);
  EXPECT_NEAR(first.fix.longitude_deg, -79.900000002, 1e-12);
  EXPECT_DOUBLE_EQ(first.fix.height_m, 250.1234);
  EXPECT_EQ(first.quality, RtklibQuality::kFix);
  EXPECT_EQ(first.satellites, 9);
  Matrix3 covariance_ned;
  covariance_ned << 1e-4, 25e-6, -49e-6, 25e-6, 4e-4, 36e-6, -49e-6, 36e-6, 9e-4;
  EXPECT_LT((first.fix.covariance_ned_m2 - covariance_ned).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(solutions[1].quality, RtklibQuality::kDgps);
}

TEST(RtklibPos, readsTheTimeSystems) {
  const std::string columns = " latitude(deg) longitude(deg) height(m) Q ns sdn sde sdu sdne sdeu sdun age ratio\n";
  const std::string rest = " 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0\n";
  const Nanoseconds expected = 1'602'774'000 * kSecond;
  EXPECT_EQ(parse("%  UTC" + columns + "2020/10/15 15:00:00.000" + rest)[0].fix.stamp, expected);
  EXPECT_EQ(parse("%  JST" + columns + "2020/10/16 00:00:00.000" + rest)[0].fix.stamp, expected);
  EXPECT_EQ(parse("%  GPST" + columns + "2127 399618.000" + rest)[0].fix.stamp, expected);
  EXPECT_EQ(parse("%  UTC" + columns + "2127 399600.000" + rest)[0].fix.stamp, expected);
}

TEST(RtklibPos, crossesALeapSecond) {
  const std::string rest = " 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0\n";
  const auto solutions =
      parse(std::string(kDegreesHeader) + "2017/01/01 00:00:16.900" + rest + "2017/01/01 00:00:18.100" + rest);
  const Nanoseconds midnight = 1'483'228'800 * kSecond;
  EXPECT_EQ(solutions[0].fix.stamp, midnight - kSecond / 10);
  EXPECT_EQ(solutions[1].fix.stamp, midnight + kSecond / 10);
}

TEST(RtklibPos, readsDegreesMinutesSecondsAndCommas) {
  const auto solutions = parse(
      "%  "
      "UTC,latitude(d'\"),longitude(d'\"),height(m),Q,ns,sdn(m),sde(m),sdu(m),sdne(m),sdeu(m),sdue(m),age(s),ratio\r\n"
      "2020/10/15 15:00:00.000,  39 36 36.00000, -0 30 36.00000, 250.5, 2, 7, 1, 2, 3, 0, 0, 0, 0.00, 1.0\r\n");
  ASSERT_EQ(solutions.size(), 1U);
  EXPECT_NEAR(solutions[0].fix.latitude_deg, 39.61, 1e-12);
  EXPECT_NEAR(solutions[0].fix.longitude_deg, -0.51, 1e-12);
  EXPECT_DOUBLE_EQ(solutions[0].fix.height_m, 250.5);
  EXPECT_EQ(solutions[0].quality, RtklibQuality::kFloat);
  EXPECT_NEAR(solutions[0].fix.covariance_ned_m2(1, 1), 4.0, 1e-12);
}

/// Earth-centered coordinates of 39.6° N, 79.9° W, 250 m, written with 0.1 mm, as RTKLIB does.
std::string ecefText() {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  GeographicLib::Geocentric::WGS84().Forward(39.6, -79.9, 250.0, x, y, z);
  char text[80];
  std::snprintf(text, sizeof text, "%.4f %.4f %.4f", x, y, z);
  return text;
}

TEST(RtklibPos, readsEarthCenterdCoordinates) {
  const auto solutions = parse(
      "%  GPST x-ecef(m) y-ecef(m) z-ecef(m) Q ns sdx(m) sdy(m) sdz(m) sdxy(m) sdyz(m) sdzx(m) age(s) ratio\n"
      "2020/10/15 15:00:18.000 " +
      ecefText() + " 1 9 0.2 0.2 0.2 0 0 0 0 0\n");
  ASSERT_EQ(solutions.size(), 1U);
  EXPECT_NEAR(solutions[0].fix.latitude_deg, 39.6, 2e-9);
  EXPECT_NEAR(solutions[0].fix.longitude_deg, -79.9, 2e-9);
  EXPECT_NEAR(solutions[0].fix.height_m, 250.0, 2e-4);
  EXPECT_LT((solutions[0].fix.covariance_ned_m2 - 0.04 * Matrix3::Identity()).norm(), 1e-12);
}

TEST(RtklibPos, turnsEarthCenterdCovariance) {
  // where equator and prime meridian meet x points up, y east, z north
  const auto solutions = parse(
      "%  GPST x-ecef(m) y-ecef(m) z-ecef(m) Q ns sdx(m) sdy(m) sdz(m) sdxy(m) sdyz(m) sdzx(m) age(s) ratio\n"
      "2020/10/15 15:00:18.000 6378137 0 0 1 9 1 2 3 0.5 0.6 0.7 0 0\n");
  Matrix3 covariance_ned;
  covariance_ned << 9.0, 0.36, -0.49, 0.36, 4.0, -0.25, -0.49, -0.25, 1.0;
  EXPECT_LT((solutions[0].fix.covariance_ned_m2 - covariance_ned).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(RtklibPos, readsBaselinesFromTheReferencePosition) {
  const std::string header =
      "%  GPST e-baseline(m) n-baseline(m) u-baseline(m) Q ns sde(m) sdn(m) sdu(m) sden(m) sdnu(m) sdue(m) age(s) "
      "ratio\n";
  const std::string row = "2020/10/15 15:00:18.000 0.0000 111.0360 -2.0000 1 9 1 2 3 0 0 0 0 0\n";
  const auto solutions = parse("% ref pos   : " + ecefText() + "\n" + header + row);
  ASSERT_EQ(solutions.size(), 1U);
  // a thousandth of a degree of latitude at 39.6° is 111.036 m
  EXPECT_NEAR(solutions[0].fix.latitude_deg, 39.601, 1e-7);
  EXPECT_NEAR(solutions[0].fix.longitude_deg, -79.9, 1e-9);
  EXPECT_NEAR(solutions[0].fix.height_m, 248.001, 1e-3);
  EXPECT_LT((solutions[0].fix.covariance_ned_m2.diagonal() - Vector3(4.0, 1.0, 9.0)).norm(), 1e-3);
  EXPECT_NE(errorOf(header + row).find("x.pos:2: a baseline, and no line '% ref pos"), std::string::npos);
}

/// A baseline of 111.036 m to the north from a base that is written in each way.
RtklibSolution fromBase(const std::string& base) {
  return parse("% ref pos   :" + base +
               "\n%  GPST e-baseline(m) n-baseline(m) u-baseline(m) Q ns sde(m) sdn(m) sdu(m) sden(m) sdnu(m) sdue(m) "
               "age(s) ratio ve(m/s) vn(m/s) vu(m/s) sdve sdvn sdvu sdven sdvnu sdvue\n"
               "2020/10/15 15:00:18.000 0.0000 111.0360 -2.0000 1 9 1 2 3 0 0 0 0.00 9.9\n")
      .at(0);
}

TEST(RtklibPos, readsTheReferencePositionAsItIsWritten) {
  // for baselines outrpos() writes degrees, a number of full width right behind the colon; header lines name columns of
  // velocity that outenu() does not write
  for (const char* base : {" 39.600000000  -79.900000000   250.0000", " 39,36,00.00000, -79,54,00.00000,  250.0000"}) {
    EXPECT_NEAR(fromBase(base).fix.latitude_deg, 39.601, 1e-7) << base;
    EXPECT_NEAR(fromBase(base).fix.longitude_deg, -79.9, 1e-9) << base;
    EXPECT_NEAR(fromBase(base).fix.height_m, 248.001, 1e-3) << base;
  }
  EXPECT_NEAR(fromBase("-39.600000000  -79.900000000   250.0000").fix.latitude_deg, -39.599, 1e-7);
}

TEST(RtklibPos, leavesABadReferenceAloneUnlessItIsNeeded) {
  const std::string reference = "% ref pos   : none\n";
  EXPECT_EQ(
      parse(reference + kDegreesHeader + "2020/10/15 15:00:18.000 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0\n").size(), 1U);
  EXPECT_NE(errorOf(reference + "%  GPST e-baseline(m) n-baseline(m) u-baseline(m) Q ns a b c d e f g h\n"
                                "2020/10/15 15:00:18.000 0 1 0 1 9 .1 .1 .1 0 0 0 0 0\n")
                .find("x.pos:3: the line '% ref pos' has 1 numbers"),
            std::string::npos);
}

TEST(RtklibPos, readsColumnsOfVelocityAndNamesInCapitals) {
  const auto solutions = parse(
      "\xEF\xBB\xBF% (LAT/LON/HEIGHT=WGS84/ELLIPSOIDAL,Q=1:FIX)\n"
      "%GPST\tLATITUDE(DEG)\tLONGITUDE(DEG)\tHEIGHT(M)\tQ\tNS\tSDN(M)\tSDE(M)\tSDU(M)\tSDNE(M)\tSDEU(M)\tSDUN(M)\t"
      "AGE(S)\tRATIO\tVN(M/S)\tVE(M/S)\tVU(M/S)\tSDVN\tSDVE\tSDVU\tSDVNE\tSDVEU\tSDVUN\n"
      "2127\t399618.000\t39.6\t-79.9\t250\t1\t9\t.1\t.2\t.3\t0\t0\t0\t0.00\t9.9\t1\t2\t3\t1\t1\t1\t0\t0\t0\n");
  ASSERT_EQ(solutions.size(), 1U);
  EXPECT_EQ(solutions[0].fix.stamp, 1'602'774'000 * kSecond);
  EXPECT_NEAR(solutions[0].fix.covariance_ned_m2(1, 1), 0.04, 1e-15);
}

TEST(RtklibPos, refusesWhatItWouldMistake) {
  EXPECT_NE(errorOf("% (lat/lon/height=Tokyo/ellipsoidal,Q=1:fix)\n").find("Tokyo datum"), std::string::npos);
  EXPECT_NE(errorOf("% (LAT/LON/HEIGHT=WGS84/GEODETIC,Q=1:FIX)\n").find("heights are geodetic"), std::string::npos);
  EXPECT_NE(errorOf("$GPGGA,150000.00,3936.0,N,07954.0,W,4,09,1.0,250.0,M,-33.0,M,0.1,0000*00\n")
                .find("x.pos:1: NMEA sentences"),
            std::string::npos);
}

TEST(RtklibPos, namesFileAndLineOfWhatItCannotRead) {
  const std::string header = kDegreesHeader;
  const std::string good = "2020/10/15 15:00:18.000 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0\n";
  EXPECT_EQ(errorOf(header + good), "");
  EXPECT_EQ(errorOf(header + good + "2020/10/15 15:00:18.100 39.6 -79.9 25"), "x.pos:6: 5 fields instead of 15");
  EXPECT_EQ(errorOf(header + "2020/10/15 15:00:18.000 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0\n"),
            "x.pos:5: 14 fields instead of 15");
  EXPECT_EQ(errorOf(header + "2020/10/15 15:00:18.000 39.6 -79.9x 250 1 9 .1 .1 .1 0 0 0 0 0\n"),
            "x.pos:5: '-79.9x' is not a number");
  EXPECT_EQ(errorOf(header + "2020/13/15 15:00:18.000 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0\n"),
            "x.pos:5: month 13 is out of range");
  EXPECT_EQ(errorOf(header + "2020/10/15 15:00 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0\n"),
            "x.pos:5: '2020/10/15 15:00' is not a date and time");
  EXPECT_EQ(errorOf(header + "2020/10/15 15:00:18.000 139.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0\n"),
            "x.pos:5: latitude or longitude is out of range");
  EXPECT_EQ(errorOf(header + "2020/10/15 15:00:18.000 39.6 -79.9 250 8 9 .1 .1 .1 0 0 0 0 0\n"),
            "x.pos:5: quality '8' is not in 1 to 7");
  EXPECT_EQ(errorOf(good), "x.pos:1: a solution before the header line that names the columns");
  EXPECT_EQ(errorOf("%  GPST northing(m) a b c d e f g h i j k l\n"), "x.pos:1: unknown coordinates 'northing(m)'");
  EXPECT_EQ(errorOf("%  GPST latitude(deg) longitude(deg) height(m)\n"),
            "x.pos:1: the header names 4 columns, fewer than 12");
}

TEST(RtklibPos, refusesHeightsAboveTheGeoid) {
  try {
    parse("% (lat/lon/height=WGS84/geodetic,Q=1:fix,ns=# of satellites)\n");
    FAIL() << "geodetic heights were taken for ellipsoidal ones";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("heights are geodetic"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(parse("% (lat/lon/height=WGS84/ellipsoidal,Q=1:fix,ns=# of satellites)\n").empty());
}

TEST(RtklibPos, marksEpochsWithoutSolution) {
  const auto solutions = parse(std::string(kDegreesHeader) +
                               "2020/10/15 15:00:18.000 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0\n"
                               "2020/10/15 15:00:18.100 0 0 0 0 0 0 0 0 0 0 0 0 0\n"
                               "2127   399618.200   Q=0, Time mark is not valid\n"
                               "2020/10/15 15:00:18.300 39.6 nan 250 1 9 .1 .1 .1 0 0 0 0 0\n"
                               "2020/10/15 15:00:18.400 39.6 -79.9 250 1 9 .1 -nan(ind) .1 0 0 0 0 0\n"
                               "2020/10/15 15:00:18.500 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 nan\n");
  ASSERT_EQ(solutions.size(), 6U);
  EXPECT_TRUE(solutions[0].solved());
  EXPECT_EQ(solutions[1].flaw, "of quality 0, without a solution");
  EXPECT_EQ(solutions[1].quality, RtklibQuality::kNone);
  EXPECT_EQ(solutions[2].flaw, solutions[1].flaw);
  EXPECT_EQ(solutions[3].flaw, "with numbers that are not finite");
  EXPECT_EQ(solutions[4].flaw, solutions[3].flaw);
  EXPECT_TRUE(solutions[5].solved());
}

TEST(RtklibPos, isKnownByItsEndingInAnyCase) {
  EXPECT_TRUE(isRtklibFile("X.POS"));
  EXPECT_TRUE(isRtklibFile("x.pos"));
  EXPECT_FALSE(isRtklibFile("truth/fix"));
  EXPECT_FALSE(isRtklibFile(".pos"));
}

TEST(RtklibPos, readsFilesAndNamesMissingOnes) {
  const std::string path = ::testing::TempDir() + "slipnav_rtklib_test.pos";
  std::ofstream(path) << kDegreesHeader << "2020/10/15 15:00:18.000 39.6 -79.9 250 1 9 .1 .1 .1 0 0 0 0 0";
  EXPECT_EQ(readRtklibPos(path).size(), 1U);
  std::remove(path.c_str());
  try {
    readRtklibPos(path);
    FAIL() << "a missing file was read";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "cannot read " + path);
  }
}

}  // namespace
}  // namespace slipnav
