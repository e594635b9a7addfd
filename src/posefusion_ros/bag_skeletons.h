#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "posefusion/skeleton/arrival_queue.h"
#include "posefusion/skeleton/clock_check.h"
#include "posefusion/skeleton/skeleton_source.h"
#include "posefusion_ros/skeleton_messages.h"

namespace posefusion {

/// Keypoints from posefusion/Skeletons messages of a rosbag. A message belongs to the frame less
/// than kSameImageNs away and arrives when it was recorded, or with its image where the bag was
/// recorded by another clock.
class BagSkeletons : public SkeletonSource {
 public:
  /// @throws std::runtime_error naming the bag when it cannot be read, and the topic when it has
  /// no messages or others.
  BagSkeletons(const std::string& path, const std::string& topic);

  /// @throws std::invalid_argument naming the topic for a message that cannot be used.
  void Offer(const RgbdFrame& frame) override;
  std::vector<Skeletons> Take(StampNs now_ns) override { return waiting_.Take(now_ns); }
  std::vector<std::string> TakeNotes() override;
  SkeletonCounts counts() const override;

 private:
  struct Recorded {
    boost::shared_ptr<const SkeletonsMessage> message;
    StampNs arrival_ns = 0;
  };

  void CheckClock(const RgbdFrame& frame);

  std::string topic_;
  std::map<StampNs, Recorded> recorded_;  ///< by the stamp of the image
  std::set<StampNs> used_;                ///< of messages whose frame has come
  ArrivalQueue waiting_;
  ClockCheck clock_check_;
  std::vector<std::string> notes_;
};

/// There are such messages on the topic. @throws std::runtime_error as BagSkeletons.
bool HasSkeletons(const std::string& path, const std::string& topic);

}  // namespace posefusion
