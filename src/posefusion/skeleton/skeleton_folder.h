#pragma once

#include <set>
#include <string>
#include <vector>

#include "posefusion/skeleton/arrival_queue.h"
#include "posefusion/skeleton/clock_check.h"
#include "posefusion/skeleton/keypoint_files.h"
#include "posefusion/skeleton/skeleton_source.h"

namespace posefusion {

/// Keypoints from a folder of OpenPose's JSON files (see ListKeypointFiles). Files named by stamp
/// belong to the frame less than kSameImageNs away, numbered ones to the frame of that
/// RgbdFrame::index. A file is read when its frame is offered.
class SkeletonFolder : public SkeletonSource {
 public:
  /// @throws std::invalid_argument as ListKeypointFiles does.
  explicit SkeletonFolder(const std::string& folder);

  void Offer(const RgbdFrame& frame) override;
  std::vector<Skeletons> Take(StampNs now_ns) override { return waiting_.Take(now_ns); }
  std::vector<std::string> TakeNotes() override;
  SkeletonCounts counts() const override;

 private:
  using Entry = std::map<std::int64_t, std::string>::const_iterator;

  Entry FindFile(const RgbdFrame& frame) const;
  void CheckClock(const RgbdFrame& frame);
  Skeletons ReadFile(const std::string& path, const RgbdFrame& frame);

  KeypointFiles files_;
  std::set<std::int64_t> used_;  ///< keys of files whose frame has come
  ArrivalQueue waiting_;
  ClockCheck clock_check_;
  std::vector<std::string> notes_;
  bool said_too_many_ = false;
};

}  // namespace posefusion
