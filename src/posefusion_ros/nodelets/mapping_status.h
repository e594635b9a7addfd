#pragma once

#include <posefusion/Status.h>

#include <optional>

#include "posefusion/pipeline/slam.h"
#include "posefusion_ros/nodelets/mapping_worker.h"

namespace posefusion {

/// Puts Status messages together. All calls from the worker's thread.
class MappingStatus {
 public:
  MappingStatus();

  Status OfFrame(const FrameResult& result, const std_msgs::Header& rgb_header, const Slam& slam,
                 const MappingCounts& counts);

  /// Once a second while no frames come (and once when they stop coming).
  std::optional<Status> OfIdle(const MappingCounts& counts);

 private:
  void FillCounts(const MappingCounts& counts);
  void FillPeople(const HumanInfoConstPtr& info);

  Status status_;
  double last_s_;
};

}  // namespace posefusion
