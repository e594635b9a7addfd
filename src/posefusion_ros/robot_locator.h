#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "posefusion/common/lie.h"
#include "posefusion_ros/nodelets/frames_config.h"
#include "posefusion_ros/tf_tree.h"

namespace posefusion {

/// What tracking says of a frame.
struct TrackedPose {
  StampNs stamp_ns = 0;  ///< of the colour image
  std::string camera_frame;
  Eigen::Isometry3d T_map_camera = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_visual_camera = Eigen::Isometry3d::Identity();  ///< without the map's jumps
  Matrix6d covariance = Matrix6d::Zero();                             ///< as in TrackingResult
  Vector6d velocity = Vector6d::Zero();  ///< of the camera in its own axes, m/s and rad/s
  double interval_s = 0;                 ///< over which `velocity` is the mean; 0 = unknown
};

/// A frame that the map holds.
struct MapChild {
  std::string frame;
  Eigen::Isometry3d T_map_child = Eigen::Isometry3d::Identity();
};

/// A tracked pose with the robot around it, all at the stamp of the image.
struct LocatedPose {
  TrackedPose pose;
  std::optional<Eigen::Isometry3d> T_camera_head;  ///< nothing when tf does not tell
  std::optional<Eigen::Isometry3d> T_camera_base;  ///< likewise
  std::optional<MapChild> child;                   ///< nothing when it is not known or not ours
};

/// Puts tracked poses together with the robot's transforms at their image stamps. Poses whose
/// transforms are late wait for them; they come out in order. Not thread-safe; no ROS master.
class RobotLocator {
 public:
  using Clock = std::chrono::steady_clock;

  /// `tree` without what Mapping publishes itself; must outlive this.
  RobotLocator(const FramesConfig& frames, const TfConfig& tf, const TfTree& tree)
      : frames_(frames), tf_(tf), tree_(tree) {}

  void Add(TrackedPose pose, Clock::time_point now) { waiting_.push_back({std::move(pose), now}); }

  /// Poses whose transforms have come, and those that have waited long enough, with what there is.
  std::vector<LocatedPose> Take(Clock::time_point now);

  /// T_odom_camera when the image was taken; nothing without odometry or when tf does not tell.
  std::optional<Eigen::Isometry3d> OdomToCamera(StampNs stamp_ns,
                                                const std::string& camera_frame) const;

  /// Why the map may hold no frame of the robot; empty when it may.
  const std::string& refusal() const { return refusal_; }

  /// What was wrong with the robot's frames for the pose taken last; empty when nothing was.
  const std::string& trouble() const { return trouble_; }

  /// After a reset of the map: what waits is forgotten.
  void Reset();

 private:
  struct Waiting {
    TrackedPose pose;
    Clock::time_point since;
  };

  LocatedPose Locate(const TrackedPose& pose);
  bool IsComplete(const LocatedPose& located) const;
  std::optional<MapChild> FindChild(const TrackedPose& pose);
  std::optional<MapChild> FindOdom(const TrackedPose& pose);
  std::optional<MapChild> FindRoot(const TrackedPose& pose);
  void NoteMissing(const LocatedPose& located);
  void NoteJump(const TrackedPose& pose, const Eigen::Isometry3d& T_odom_camera);

  const FramesConfig frames_;
  const TfConfig tf_;
  const TfTree& tree_;
  std::deque<Waiting> waiting_;
  struct Step {
    TrackedPose pose;
    Eigen::Isometry3d T_odom_camera;
  };
  std::optional<Step> last_;
  std::string refusal_;  ///< why the map may not hold its child
  std::string trouble_;
};

}  // namespace posefusion
