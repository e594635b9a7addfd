#include "posefusion/pipeline/start_pose.h"

#include <stdexcept>

namespace posefusion {
namespace {

/// Directions closer to the vertical than this (sine) say nothing about a heading.
constexpr double kMinHorizontal = 0.05;

}  // namespace

Eigen::Isometry3d LevelStartPose() { return StartPoseFromUp(-Eigen::Vector3d::UnitY()); }

Eigen::Isometry3d StartPoseFromUp(const Eigen::Vector3d& up_camera) {
  if (!up_camera.allFinite() || up_camera.norm() < 1e-9) {
    throw std::invalid_argument("the upward direction has no length");
  }
  const Eigen::Vector3d up = up_camera.normalized();
  const auto horizontal = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(v - v.dot(up) * up);
  };
  Eigen::Vector3d ahead = horizontal(Eigen::Vector3d::UnitZ());
  if (ahead.norm() < kMinHorizontal) ahead = horizontal(-Eigen::Vector3d::UnitY());
  ahead.normalize();
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  T_map_camera.linear() << ahead.transpose(), up.cross(ahead).transpose(), up.transpose();
  return T_map_camera;
}

}  // namespace posefusion
