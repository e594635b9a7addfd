#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "posefusion/common/stamp.h"

namespace posefusion {

/// How the frames of other people hang together, as told on /tf and /tf_static. Looking up never
/// throws: what is missing, broken or a loop gives nothing. Names may begin with a slash, which
/// does not count. Thread-safe; needs no ROS master.
class TfTree {
 public:
  /// Who holds a frame.
  struct Link {
    std::string parent;
    std::string publisher;
  };

  /// Stamps of a frame that go back by more than `jump_back_s` mean that a bag was restarted: what
  /// was known of moving frames is forgotten.
  explicit TfTree(double jump_back_s);

  void Add(const geometry_msgs::TransformStamped& transform, const std::string& publisher,
           bool is_static);

  /// T_target_source at that time: interpolated, never extrapolated.
  std::optional<Eigen::Isometry3d> Find(const std::string& target, const std::string& source,
                                        StampNs stamp_ns) const;

  /// Waits until Find has it. Nothing after `timeout_s` seconds of wall time.
  std::optional<Eigen::Isometry3d> WaitFor(const std::string& target, const std::string& source,
                                           StampNs stamp_ns, double timeout_s) const;

  /// Why Find has nothing, in words that stay the same while it stays so; empty when it has.
  std::string WhyNot(const std::string& target, const std::string& source, StampNs stamp_ns) const;

  /// Nothing for a frame without a parent.
  std::optional<Link> LinkOf(const std::string& frame) const;

  /// The frame, its parent, and so on up to the root; ends before a frame would come twice.
  std::vector<std::string> ChainOf(const std::string& frame) const;

  /// Forgets what is known of moving frames.
  void Clear();

 private:
  struct Known {
    Link link;
    bool is_static = false;
    ros::Time newest;
  };

  void ClearLocked();

  const double jump_back_s_;
  tf2::BufferCore buffer_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::map<std::string, Known> known_;  ///< by frame
};

/// Name without a slash at the beginning, as tf2 wants it.
std::string TfName(const std::string& frame);

}  // namespace posefusion
