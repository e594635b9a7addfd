#include "test/support/rendered_room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace posefusion::testing {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Entry and exit of a ray through a box, as multiples of the direction.
std::pair<double, double> Slab(const SceneBox& box, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction) {
  double enter = -kNever;
  double leave = kNever;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min[axis] - origin[axis]) / direction[axis];
    const double b = (box.max[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return {enter, leave};
}

double DistanceToBoxSurface(const SceneBox& box, const Eigen::Vector3d& p) {
  const Eigen::Vector3d nearest = p.cwiseMax(box.min).cwiseMin(box.max);
  const double outside = (p - nearest).norm();
  if (outside > 0) return outside;
  return std::min((p - box.min).minCoeff(), (box.max - p).minCoeff());
}

}  // namespace

RenderedRoom RenderedRoom::Furnished() {
  RenderedRoom room;
  room.room_ = {{-2, -2, -1}, {2, 2, 1.5}};
  room.AddBox({{0.6, -0.6, -1}, {1.4, 0.4, -0.3}});
  room.AddBox({{1.5, 0.7, -1}, {1.9, 1.5, 0.8}});
  room.AddBox({{0.9, -0.2, -0.3}, {1.1, 0.0, -0.1}});
  return room;
}

RenderedRoom RenderedRoom::Wall(double distance_m) {
  RenderedRoom room;
  room.has_room_ = false;
  room.wall_m_ = distance_m;
  return room;
}

RenderedRoom::Hit RenderedRoom::Cast(const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction) const {
  double nearest = kNever;
  if (has_room_) {
    nearest = Slab(room_, origin, direction).second;
  } else if (direction.x() > 0) {
    nearest = (wall_m_ - origin.x()) / direction.x();
  }
  for (const SceneBox& box : boxes_) {
    const auto [enter, leave] = Slab(box, origin, direction);
    if (enter < leave && enter > 0) nearest = std::min(nearest, enter);
  }
  return {nearest, nearest > 0 && nearest < kNever};
}

Eigen::Vector3d RenderedRoom::ColorAt(const Eigen::Vector3d& p) const {
  if (!textured_) return Eigen::Vector3d::Constant(128);
  Eigen::Vector3d color;
  for (int c = 0; c < 3; ++c) {
    const double phase = 0.7 * c;
    color[c] = 128 +
               45 * std::sin(4 * p.x() + 3 * p.y() + phase) * std::cos(5 * p.z() - 2 * p.y()) +
               40 * std::sin(8 * p.y() - 6 * p.z() + 5 * p.x() + phase) +
               25 * std::cos(13 * p.z() + 11 * p.x() - 3 * p.y());
  }
  return color.cwiseMax(1).cwiseMin(255);
}

RgbdFrame RenderedRoom::Render(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera,
                               StampNs stamp_ns) const {
  RgbdFrame frame;
  frame.stamp_ns = stamp_ns;
  frame.depth_stamp_ns = stamp_ns;
  frame.camera = camera;
  frame.rgb = cv::Mat(camera.height, camera.width, CV_8UC3, cv::Scalar::all(0));
  frame.depth_m = cv::Mat(camera.height, camera.width, CV_32FC1, cv::Scalar::all(0));
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d direction = T_map_camera.linear() * camera.Unproject(x, y, 1);
      const Hit hit = Cast(T_map_camera.translation(), direction);
      if (!hit.found) continue;
      frame.depth_m.at<float>(y, x) = static_cast<float>(hit.distance);
      const Eigen::Vector3d color = ColorAt(T_map_camera.translation() + hit.distance * direction);
      for (int c = 0; c < 3; ++c) {
        frame.rgb.at<cv::Vec3b>(y, x)[c] = static_cast<std::uint8_t>(std::lround(color[c]));
      }
    }
  }
  return frame;
}

double RenderedRoom::DistanceTo(const Eigen::Vector3d& p_map) const {
  double nearest = has_room_ ? DistanceToBoxSurface(room_, p_map) : std::abs(p_map.x() - wall_m_);
  for (const SceneBox& box : boxes_) {
    nearest = std::min(nearest, DistanceToBoxSurface(box, p_map));
  }
  return nearest;
}

CameraModel SmallCamera() {
  CameraModel camera;
  camera.width = 160;
  camera.height = 120;
  camera.fx = camera.fy = 138.6;
  camera.cx = 79.5;
  camera.cy = 59.5;
  return camera;
}

Eigen::Isometry3d LookAlong(const Eigen::Vector3d& position, double yaw_rad, double pitch_rad) {
  Eigen::Matrix3d level;
  level << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * level *
                          Eigen::AngleAxisd(-pitch_rad, Eigen::Vector3d::UnitX());
  T_map_camera.translation() = position;
  return T_map_camera;
}

}  // namespace posefusion::testing
