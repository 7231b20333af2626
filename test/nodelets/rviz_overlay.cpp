/// A short recording, seen in rviz: what is drawn where, in which color, without errors and fast enough.
///
/// rviz is the library that the program of that name is made of, with the configuration that replay.launch gives it.

#include <gtest/gtest.h>
#include <ros/ros.h>

#include <OgreCamera.h>
#include <OgreRenderWindow.h>
#include <rviz/display.h>
#include <rviz/display_group.h>
#include <rviz/properties/status_property.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_frame.h>
#include <rviz/visualization_manager.h>
#include <QApplication>
#include <QImage>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "overlay/palette.h"
#include "ros/bag/bag_evaluation.h"
#include "ros/replay/replay_session.h"
#include "ros/runtime/child_process.h"
#include "ros/runtime/parameters.h"
#include "ros/simulated_bag.h"

namespace slipnav::test {
namespace {

constexpr double kRate = 5.0;
constexpr double kPixelsPerMetre = 50.0;
constexpr double kSettling_s = 4.0;
constexpr double kLeastFrameRate_hz = 10.0;
constexpr double kShareOfTrack = 0.85;  // where tracks run into one another, one hides the other
constexpr double kSpacing_m = 0.05;     // of the points of a track that are looked at
constexpr double kRoverSize_m = 1.0;    // what lies under the model cannot be seen
constexpr int kSearchRadius_px = 6;
constexpr int kColorTolerance = 40;  // of 255; edges are blended

/// Serves rviz while `condition` holds, at most for the time given.
template <class Condition>
void serveWhile(Condition condition, double most_s) {
  const ros::SteadyTime begin = ros::SteadyTime::now();
  while (condition() && (ros::SteadyTime::now() - begin).toSec() < most_s) {
    QApplication::processEvents(QEventLoop::AllEvents, 20);
    ros::WallDuration(0.002).sleep();
  }
}

bool isNear(const QColor& pixel, const Color& color) {
  const auto differs = [](int component, float wanted) {
    return std::abs(component - static_cast<int>(std::lround(255.0F * wanted))) > kColorTolerance;
  };
  return !differs(pixel.red(), color.red) && !differs(pixel.green(), color.green) && !differs(pixel.blue(), color.blue);
}

class RvizOverlay : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const Config config = configFromParameters(ros::NodeHandle(), "slipnav");
    const TemporaryBag bag;
    writeShortDrive(bag.path(), config);
    report_ = evaluateBag(bag.path(), config, "", {}).report;
    ReplaySession(config.topics).waitForNodelets();
    frame_ = std::make_unique<rviz::VisualizationFrame>();
    frame_->setSplashPath("");
    frame_->initialize(QString(SLIPNAV_SOURCE_DIR) + "/rviz/replay.rviz");
    frame_->show();
    view()->subProp("Scale")->setValue(kPixelsPerMetre);
    play(bag.path());
    takePicture();
  }

  static void TearDownTestSuite() { frame_.reset(); }

  static rviz::VisualizationManager* manager() { return frame_->getManager(); }
  static rviz::ViewController* view() { return manager()->getViewManager()->getCurrent(); }

  static void play(const std::string& bag) {
    ChildProcess player({"rosbag", "play", "--quiet", "--clock", "--rate=" + std::to_string(kRate), bag});
    const ros::SteadyTime begin = ros::SteadyTime::now();
    const std::uint64_t frames_before = manager()->getFrameCount();
    serveWhile([&player] { return !player.poll(); }, 120.0);
    const double played_s = (ros::SteadyTime::now() - begin).toSec();
    frame_rate_hz_ = static_cast<double>(manager()->getFrameCount() - frames_before) / played_s;
    serveWhile([] { return true; }, kSettling_s);
  }

  static void takePicture() {
    const std::string file = ::testing::TempDir() + "slipnav_rviz_overlay.png";
    manager()->getRenderPanel()->getRenderWindow()->writeContentsToFile(file);
    picture_ = QImage(QString::fromStdString(file));
  }

  /// Where a point of the map is in the picture; it may lie outside.
  static QPoint pixelOf(const Vector3& position) {
    const Ogre::Camera* camera = view()->getCamera();
    const Ogre::Vector3 point(static_cast<Ogre::Real>(position.x()), static_cast<Ogre::Real>(position.y()),
                              static_cast<Ogre::Real>(position.z()));
    const Ogre::Vector3 screen = camera->getProjectionMatrix() * (camera->getViewMatrix() * point);
    return {static_cast<int>(0.5 * (1.0 + screen.x) * picture_.width()),
            static_cast<int>(0.5 * (1.0 - screen.y) * picture_.height())};
  }

  static bool isThereNear(const QPoint& center, const Color& color) {
    for (int y = center.y() - kSearchRadius_px; y <= center.y() + kSearchRadius_px; ++y) {
      for (int x = center.x() - kSearchRadius_px; x <= center.x() + kSearchRadius_px; ++x) {
        if (picture_.valid(x, y) && isNear(picture_.pixelColor(x, y), color)) {
          return true;
        }
      }
    }
    return false;
  }

  /// Of the points that the picture covers, most have the color of their track.
  static void expectTrack(const std::vector<Vector3>& track, const Color& color) {
    const Vector3 rover = report_.estimates.back().position_enu_m;
    std::optional<Vector3> last;
    int covered = 0;
    int colored = 0;
    for (const Vector3& position : track) {
      const QPoint pixel = pixelOf(position);
      const bool is_new = !last || (position - *last).head<2>().norm() > kSpacing_m;
      const bool under_rover = (position - rover).head<2>().norm() < kRoverSize_m;
      if (is_new && !under_rover && picture_.rect().adjusted(20, 20, -20, -20).contains(pixel)) {
        last = position;
        ++covered;
        colored += isThereNear(pixel, color) ? 1 : 0;
      }
    }
    EXPECT_GT(covered, 50);
    EXPECT_GE(colored, kShareOfTrack * covered) << "of " << covered;
  }

  /// Names of all status lines below a property that are errors.
  static std::string errorsBelow(rviz::Property* property) {
    std::string errors;
    const auto* status = dynamic_cast<rviz::StatusProperty*>(property);
    if (status != nullptr && status->getLevel() == rviz::StatusProperty::Error) {
      errors += property->getParent()->getNameStd() + ": " + property->getNameStd() + ": " +
                property->getValue().toString().toStdString() + "\n";
    }
    for (int i = 0; i < property->numChildren(); ++i) {
      errors += errorsBelow(property->childAt(i));
    }
    return errors;
  }

  inline static RunReport report_;
  inline static std::unique_ptr<rviz::VisualizationFrame> frame_;
  inline static QImage picture_;
  inline static double frame_rate_hz_ = 0.0;
};

TEST_F(RvizOverlay, ShowsTheEstimateWhereItIs) {
  std::vector<Vector3> track;
  for (const EstimateSample& estimate : report_.estimates) {
    track.push_back(estimate.position_enu_m);
  }
  expectTrack(track, kEstimateColor);
}

TEST_F(RvizOverlay, ShowsTheTruthWhereItIs) {
  std::vector<Vector3> track;
  for (const TruthSample& truth : report_.truth.samples()) {
    if (truth.stamp >= report_.estimates.front().stamp) {
      track.push_back(truth.position_enu_m);
    }
  }
  expectTrack(track, kTruthColor);
}

TEST_F(RvizOverlay, ShowsTheDeadReckoningWhereItIs) {
  std::vector<Vector3> track;
  for (const PlanarSample& pose : report_.diagnostics.wheel_only) {
    track.emplace_back(pose.east_m, pose.north_m, 0.0);
  }
  expectTrack(track, kDeadReckoningColor);
}

TEST_F(RvizOverlay, ShowsEveryPartOfTheOverlay) {
  std::set<std::string> names;
  rviz::DisplayGroup* displays = manager()->getRootDisplayGroup();
  for (int i = 0; i < displays->numDisplays(); ++i) {
    if (displays->getDisplayAt(i)->getNameStd() == "Overlay") {
      rviz::Property* parts = displays->getDisplayAt(i)->subProp("Namespaces");
      for (int j = 0; j < parts->numChildren(); ++j) {
        names.insert(parts->childAt(j)->getNameStd());
      }
    }
  }
  for (const char* name : {"slip", "ellipse", "error", "stops", "stop labels", "legend"}) {
    EXPECT_EQ(names.count(name), 1U) << name;
  }
}

TEST_F(RvizOverlay, HasNoDisplayInError) {
  EXPECT_GE(manager()->getRootDisplayGroup()->numDisplays(), 7);
  EXPECT_EQ(errorsBelow(manager()->getRootDisplayGroup()), "");
}

TEST_F(RvizOverlay, IsFastEnough) { EXPECT_GE(frame_rate_hz_, kLeastFrameRate_hz); }

}  // namespace
}  // namespace slipnav::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rviz_overlay");
  const ros::NodeHandle keep_alive;
  QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
