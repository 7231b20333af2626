#include "config/frames.h"

namespace slipnav {

void FrameNames::visit(ParameterVisitor& v) {
  v.text("map", map, "frame_id of the map, east-north-up about the start");
  v.text("odom", odom, "frame_id of odometry; TF has it equal to map");
  v.text("base", base, "the vehicle: forward, left, up, at the middle of its wheels");
  v.text("imu", imu, "the IMU, for extrinsics: tf");
  v.text("gps", gps, "the antenna of gps/fix, for extrinsics: tf");
  v.choice("extrinsics", extrinsics, {"parameters", "tf"},
           "sensor poses from parameters (imu.mount, gps_mount) or from TF; with tf, everything waits for it");
  v.flag("publish_tf", publish_tf,
         "whether map → odom → base_link is published; false if another node publishes the vehicle's transforms");
}

}  // namespace slipnav
