#include "posefusion/simulation/sim_keypoints.h"

#include <utility>

#include "posefusion/skeleton/openpose_json.h"
#include "posefusion/skeleton/skeleton_checks.h"

namespace posefusion {

std::optional<Skeletons> KeypointsAsWritten(const SimulatedFrame& frame,
                                            const Simulator& simulator) {
  const auto detected = DetectKeypoints(frame, simulator);
  if (!detected) return std::nullopt;
  OpenPosePeople read = ReadOpenPoseJson(ToOpenPoseJson(detected->people), "simulator");
  DropUnusable(read.people, simulator.camera().width, simulator.camera().height);
  return Skeletons{frame.frame.stamp_ns, read.layout, std::move(read.people), detected->arrival_ns};
}

void KeypointMailbox::Put(Skeletons skeletons) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const StampNs stamp_ns = skeletons.stamp_ns;
  by_stamp_.insert_or_assign(stamp_ns, std::move(skeletons));
}

std::optional<Skeletons> KeypointMailbox::Take(StampNs stamp_ns) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::optional<Skeletons> taken;
  const auto found = by_stamp_.find(stamp_ns);
  if (found != by_stamp_.end()) taken = std::move(found->second);
  by_stamp_.erase(by_stamp_.begin(), by_stamp_.upper_bound(stamp_ns));
  return taken;
}

SimKeypoints::SimKeypoints(std::shared_ptr<KeypointMailbox> mailbox)
    : mailbox_(std::move(mailbox)) {}

void SimKeypoints::Offer(const RgbdFrame& frame) {
  auto skeletons = mailbox_->Take(frame.stamp_ns);
  if (!skeletons) return;
  ++num_frames_;
  waiting_.Add(std::move(*skeletons));
}

}  // namespace posefusion
