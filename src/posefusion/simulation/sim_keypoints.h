#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "posefusion/simulation/simulator.h"
#include "posefusion/skeleton/arrival_queue.h"
#include "posefusion/skeleton/skeleton_source.h"

namespace posefusion {

/// Keypoints of a frame exactly as SkeletonFolder reads them from the folder that FolderWriter
/// makes; empty for frames that the network leaves out.
std::optional<Skeletons> KeypointsAsWritten(const SimulatedFrame& frame,
                                            const Simulator& simulator);

/// Hands keypoints from the thread that simulates to the one that uses them. Thread-safe.
class KeypointMailbox {
 public:
  void Put(Skeletons skeletons);

  /// Those of that stamp, if there are any; forgets them and all earlier ones.
  std::optional<Skeletons> Take(StampNs stamp_ns);

 private:
  std::mutex mutex_;
  std::map<StampNs, Skeletons> by_stamp_;
};

/// The simulator's keypoints, with the timing of its configuration.
class SimKeypoints : public SkeletonSource {
 public:
  /// The simulator puts keypoints of a frame into the mailbox before it gives out the frame.
  explicit SimKeypoints(std::shared_ptr<KeypointMailbox> mailbox);

  void Offer(const RgbdFrame& frame) override;
  std::vector<Skeletons> Take(StampNs now_ns) override { return waiting_.Take(now_ns); }
  SkeletonCounts counts() const override { return {num_frames_, 0}; }

 private:
  std::shared_ptr<KeypointMailbox> mailbox_;
  ArrivalQueue waiting_;
  int num_frames_ = 0;
};

}  // namespace posefusion
