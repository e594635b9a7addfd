#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

namespace posefusion {

/// Pinhole camera with optional plumb_bob distortion, as in sensor_msgs/CameraInfo.
/// Camera frame: RGB optical (x right, y down, z forward). Pixel centres are at whole numbers.
struct CameraModel {
  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  /// k1 k2 p1 p2 k3; all zero for a rectified image.
  std::array<double, 5> distortion{};

  bool HasDistortion() const;

  /// The same camera without distortion.
  CameraModel Undistorted() const;

  /// Camera of pyramid level `level`, each level halving the resolution: pixel (u, v) of the level
  /// is the mean of the 2x2 block at (2u, 2v) of the level below.
  CameraModel AtLevel(int level) const;

  /// How many of `wanted` levels have at least 8 pixels in height and width, level 0 included.
  int UsefulLevels(int wanted) const;

  /// Pixel (u, v) of a point in the camera frame with z > 0, ignoring distortion.
  Eigen::Vector2d Project(const Eigen::Vector3d& p_camera) const;

  /// Point at depth z metres on the ray of pixel (u, v), ignoring distortion.
  Eigen::Vector3d Unproject(double u, double v, double z) const;

  /// @throws std::invalid_argument naming `source` when size or focal lengths make no camera.
  void Check(const std::string& source) const;
};

bool operator==(const CameraModel& a, const CameraModel& b);
inline bool operator!=(const CameraModel& a, const CameraModel& b) { return !(a == b); }

}  // namespace posefusion
