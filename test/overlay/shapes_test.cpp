/// Outlines, forecast fan and colors.

#include "overlay/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "overlay/palette.h"

namespace slipnav {
namespace {

TEST(ErrorEllipse, EveryPointIsAsManySigmasAway) {
  Matrix3 covariance;
  covariance << 4.0, 1.5, 0.3, 1.5, 1.0, 0.2, 0.3, 0.2, 9.0;
  const Vector3 center(10.0, 20.0, 30.0);
  const std::vector<Vector3> outline = errorEllipse(center, covariance, 3.0);
  ASSERT_GT(outline.size(), 16U);
  EXPECT_EQ(outline.front(), outline.back());
  const Eigen::Matrix2d inverse = covariance.topLeftCorner<2, 2>().inverse();
  for (const Vector3& point : outline) {
    const Vector2 d = (point - center).head<2>();
    EXPECT_NEAR(std::sqrt(d.dot(inverse * d)), 3.0, 1e-9);
    EXPECT_EQ(point.z(), 30.0);
  }
}

TEST(ErrorEllipse, NoVarianceIsAPoint) {
  for (const Vector3& point : errorEllipse(Vector3::Ones(), Matrix3::Zero(), 3.0)) {
    EXPECT_EQ(point, Vector3::Ones());
  }
}

constexpr Nanoseconds kStep = 20'000'000;

CourseEstimate courseAfter(double direction_rad, double turn_rate_radps, double seconds) {
  CourseEstimate estimate;
  Vector3 position = Vector3::Zero();
  const int steps = static_cast<int>(seconds / toSeconds(kStep));
  for (int i = 0; i <= steps; ++i) {
    const double angle = direction_rad + turn_rate_radps * toSeconds(i * kStep);
    const Vector3 velocity(0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.0);
    estimate.add(1 + i * kStep, position, velocity);
    position += velocity * toSeconds(kStep);
  }
  return estimate;
}

TEST(CourseEstimate, FollowsAStraightDriveAndATurn) {
  const CourseEstimate straight = courseAfter(3.0, 0.0, 10.0);
  EXPECT_NEAR(straight.course().direction_rad, 3.0, 1e-6);
  EXPECT_NEAR(straight.course().speed_mps, 0.8, 1e-6);
  EXPECT_NEAR(straight.course().turn_rate_radps, 0.0, 1e-6);
  const CourseEstimate turning = courseAfter(0.0, 0.1, 30.0);  // through ±180°
  EXPECT_NEAR(turning.course().turn_rate_radps, 0.1, 0.005);
  EXPECT_NEAR(std::remainder(turning.course().direction_rad - 3.0, 2.0 * kPi), 0.0, 0.05);
}

TEST(CourseEstimate, StandingKeepsTheLastMotion) {
  CourseEstimate estimate = courseAfter(1.0, 0.0, 5.0);
  estimate.add(10'000'000'000, Vector3(9.0, 9.0, 0.0), Vector3::Zero());
  EXPECT_NEAR(estimate.course().direction_rad, 1.0, 1e-6);
  EXPECT_NEAR(estimate.course().speed_mps, 0.8, 1e-6);
  EXPECT_EQ(estimate.course().position_enu_m.x(), 9.0);
}

TEST(ForecastFan, LiesAlongTheCourseAsWideAsTheBound) {
  const Course course{{5.0, 0.0, 1.0}, 0.5 * kPi, 0.8, 0.0};  // north
  const std::vector<FanSection> fan = forecastFan(course, {10.0, 20.0}, {0.5, 2.0});
  ASSERT_EQ(fan.size(), 2U);
  EXPECT_NEAR((fan[1].center_enu_m - Vector3(5.0, 16.0, 1.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((fan[1].left_enu_m - Vector3(3.0, 16.0, 1.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((fan[1].right_enu_m - Vector3(7.0, 16.0, 1.0)).norm(), 0.0, 1e-9);
}

TEST(ForecastFan, ATurnFades) {
  const Course course{Vector3::Zero(), 0.0, 1.0, 0.2};
  const Vector3 late = positionAfter(course, 60.0) - positionAfter(course, 50.0);
  EXPECT_NEAR(std::atan2(late.y(), late.x()), 0.2 * 5.0, 0.01);
}

TEST(ForecastFan, HasNoMoreSectionsThanAskedForAndEndsAtTheHorizon) {
  std::vector<double> times_s;
  std::vector<double> bounds_m;
  for (int i = 1; i <= 600; ++i) {
    times_s.push_back(0.1 * i);
    bounds_m.push_back(0.01 * i);
  }
  const std::vector<FanSection> fan = forecastFan({Vector3::Zero(), 0.0, 1.0, 0.0}, times_s, bounds_m, 61);
  EXPECT_LE(fan.size(), 61U);
  EXPECT_GE(fan.size(), 40U);
  EXPECT_EQ(fan.back().time_s, times_s.back());
  EXPECT_TRUE(forecastFan({Vector3::Zero(), 0.0, 1.0, 0.0}, {}, {}).empty());
}

void expectSame(const Color& a, const Color& b) {
  EXPECT_NEAR(a.red, b.red, 1e-6);
  EXPECT_NEAR(a.green, b.green, 1e-6);
  EXPECT_NEAR(a.blue, b.blue, 1e-6);
}

TEST(Palette, BoundsAndSlipRunThroughTheirColors) {
  expectSame(boundColor(0.0), kSafeColor);
  expectSame(boundColor(0.5), kWarningColor);
  expectSame(boundColor(1.0), kLimitColor);
  expectSame(boundColor(7.0), kLimitColor);
  expectSame(slipColor(0.0, 0.3), kNoSlipColor);
  expectSame(slipColor(0.9, 0.3), kSpinningColor);
  expectSame(slipColor(-0.3, 0.3), kSkiddingColor);
  expectSame(slipColor(0.15, 0.3), mix(kNoSlipColor, kSpinningColor, 0.5));
}

std::string contentOf(const std::string& name) {
  std::ifstream file(std::string(SLIPNAV_SOURCE_DIR) + "/" + name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

int level(float component) { return static_cast<int>(std::lround(255.0F * component)); }

std::string asRviz(const Color& color) {
  return "Color: " + std::to_string(level(color.red)) + "; " + std::to_string(level(color.green)) + "; " +
         std::to_string(level(color.blue)) + "\n";
}

std::string asHex(const Color& color) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02X%02X%02X", level(color.red), level(color.green), level(color.blue));
  return text;
}

TEST(Palette, RvizHasTheSameColors) {
  for (const char* name : {"rviz/replay.rviz", "rviz/rover.rviz"}) {
    const std::string text = contentOf(name);
    for (const Color& color : {kEstimateColor, kTruthColor, kDeadReckoningColor}) {
      EXPECT_NE(text.find(asRviz(color)), std::string::npos) << name << " lacks " << asRviz(color);
    }
  }
}

TEST(Palette, ReportsHaveTheSameColors) {
  const std::string text = contentOf("scripts/slipnav_report/palette.py");
  const auto expectColor = [&text](const std::string& name, const Color& color) {
    const std::string line = "\n" + name + " = \"" + asHex(color) + "\"\n";
    EXPECT_NE(text.find(line), std::string::npos) << line;
  };
  expectColor("ESTIMATE", kEstimateColor);
  expectColor("TRUTH", kTruthColor);
  expectColor("DEAD_RECKONING", kDeadReckoningColor);
  expectColor("STOP", kStopColor);
  expectColor("ERROR", kErrorColor);
  expectColor("TEXT", kTextColor);
  expectColor("SAFE", kSafeColor);
  expectColor("WARNING", kWarningColor);
}

}  // namespace
}  // namespace slipnav
