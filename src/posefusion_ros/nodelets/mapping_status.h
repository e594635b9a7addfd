#pragma once

#include <posefusion/Status.h>

#include <optional>
#include <string>

#include "posefusion/pipeline/slam.h"
#include "posefusion_ros/nodelets/mapping_worker.h"
#include "posefusion_ros/pace_meter.h"

namespace posefusion {

/// Puts Status messages together. All calls from the worker's thread.
class MappingStatus {
 public:
  MappingStatus();

  /// To be called when the pose has just been published. `tf_trouble` as in Status.
  Status OfFrame(const FrameResult& result, const std_msgs::Header& rgb_header, const Slam& slam,
                 const MappingCounts& counts, const std::string& tf_trouble);

  /// Once a second while no frames come (and once when they stop coming).
  std::optional<Status> OfIdle(const MappingCounts& counts);

 private:
  void FillPace(bool has_pose);
  void FillCounts(const MappingCounts& counts);
  void FillPeople(const HumanInfoConstPtr& info);

  Status status_;
  PaceMeter pace_;
  double last_s_;
};

}  // namespace posefusion
