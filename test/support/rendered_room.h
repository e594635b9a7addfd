#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "posefusion/image/rgbd_frame.h"

namespace posefusion::testing {

/// A box in the map frame, metres.
struct SceneBox {
  Eigen::Vector3d min;
  Eigen::Vector3d max;
};

/// A room with boxes in it, seen through a pinhole camera without noise: exact truth for tests.
/// Surfaces carry a smooth procedural texture that depends on the place only.
class RenderedRoom {
 public:
  /// 4 m x 4 m x 2.5 m around the origin of the map, with a table-like box and a shelf-like box.
  static RenderedRoom Furnished();

  /// A single wall, the plane x = `distance_m`, without end.
  static RenderedRoom Wall(double distance_m);

  void AddBox(const SceneBox& box) { boxes_.push_back(box); }

  /// What stands in the room, and the room itself.
  const std::vector<SceneBox>& boxes() const { return boxes_; }
  const SceneBox& room() const { return room_; }

  /// Without texture every surface is of one grey.
  void SetTextured(bool textured) { textured_ = textured; }

  /// The frame that a camera at T_map_camera sees.
  RgbdFrame Render(const CameraModel& camera, const Eigen::Isometry3d& T_map_camera,
                   StampNs stamp_ns) const;

  /// Distance of a point from the nearest surface, metres.
  double DistanceTo(const Eigen::Vector3d& p_map) const;

 private:
  struct Hit {
    double distance;
    bool found;
  };
  Hit Cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  Eigen::Vector3d ColorAt(const Eigen::Vector3d& p_map) const;

  bool has_room_ = true;
  SceneBox room_{};
  double wall_m_ = 0;
  bool textured_ = true;
  std::vector<SceneBox> boxes_;
};

/// 160x120, 60 degrees wide.
CameraModel SmallCamera();

/// Camera at `position`, looking along the horizontal direction `yaw_rad` (0 = map x), tilted down
/// by `pitch_rad`.
Eigen::Isometry3d LookAlong(const Eigen::Vector3d& position, double yaw_rad, double pitch_rad);

}  // namespace posefusion::testing
