#pragma once

#include <memory>
#include <string>

#include "posefusion/dataset/odometry_source.h"

namespace posefusion {

/// T_odom_camera from /tf and /tf_static of a rosbag, as a robot's own odometry and joints told it:
/// at exactly the stamps asked for, interpolated as tf does, also where tf came late.
///
/// Reads the bag along with the questions, which are to come in order of their stamps: what is more
/// than a minute or so before the newest one is forgotten. Not thread-safe.
class BagOdometry : public OdometrySource {
 public:
  /// `odom_frame` is the root of the odometry, the camera's frame is that of the first image on
  /// `rgb_topic`.
  /// @throws std::runtime_error naming the bag when it cannot be read, has no tf or no image, and
  /// naming the frames when nothing in the whole bag connects them.
  BagOdometry(const std::string& path, const std::string& odom_frame, const std::string& rgb_topic);
  ~BagOdometry() override;

  std::optional<Eigen::Isometry3d> PoseAt(StampNs stamp_ns) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace posefusion
