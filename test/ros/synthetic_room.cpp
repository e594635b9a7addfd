#include "test/ros/synthetic_room.h"

#include <algorithm>
#include <cmath>

namespace posefusion {
namespace {

constexpr StampNs kFramePeriodNs = 33'333'333;
constexpr StampNs kDepthLagNs = 10'000'000;

CameraModel SmallCamera() {
  CameraModel camera;
  camera.width = 320;
  camera.height = 240;
  camera.fx = camera.fy = 260;
  camera.cx = 159.5;
  camera.cy = 119.5;
  return camera;
}

/// Grey value of a wall point: several wave lengths, so that every level has gradients, and tiles
/// with sharp edges.
double Texture(const Eigen::Vector3d& p) {
  const bool tile =
      std::sin(30 * p.x() + 1) * std::sin(30 * p.y() + 1) * std::sin(30 * p.z() + 1) > 0;
  return 128 + 45 * std::sin(9 * p.x() + 3 * p.z()) * std::cos(8 * p.y()) +
         25 * std::sin(23 * p.y() + 17 * p.x() - 11 * p.z()) + (tile ? 25 : -25);
}

}  // namespace

RgbdFrame SyntheticFrame(int index, StampNs start_ns) {
  RgbdFrame frame;
  frame.camera = SmallCamera();
  frame.stamp_ns = start_ns + index * kFramePeriodNs;
  frame.depth_stamp_ns = frame.stamp_ns + kDepthLagNs;
  frame.rgb.create(frame.camera.height, frame.camera.width, CV_8UC3);
  frame.depth_m.create(frame.camera.height, frame.camera.width, CV_32FC1);
  const Eigen::Vector3d centre(0.004 * index, 0.1 * std::sin(0.03 * index), 0.003 * index);
  for (int v = 0; v < frame.camera.height; ++v) {
    for (int u = 0; u < frame.camera.width; ++u) {
      const Eigen::Vector3d ray = frame.camera.Unproject(u, v, 1);
      // Back wall, right wall and floor of the room; z forward, x right, y down.
      double z = 2.5 - centre.z();
      if (ray.x() > 0) z = std::min(z, (0.9 - centre.x()) / ray.x());
      if (ray.y() > 0) z = std::min(z, (0.7 - centre.y()) / ray.y());
      const double grey = Texture(centre + z * ray);
      const auto level = static_cast<std::uint8_t>(std::clamp(grey, 0.0, 255.0));
      frame.rgb.at<cv::Vec3b>(v, u) = {level, static_cast<std::uint8_t>(255 - level), 128};
      frame.depth_m.at<float>(v, u) = static_cast<float>(z);
    }
  }
  return frame;
}

}  // namespace posefusion
