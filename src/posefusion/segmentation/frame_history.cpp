#include "posefusion/segmentation/frame_history.h"

#include <utility>

namespace posefusion {

PastFrame& FrameHistory::Push(const RgbdFrame& frame,
                              const std::optional<Eigen::Vector3f>& gravity) {
  std::unique_ptr<PastFrame> entry;
  while (!frames_.empty() &&
         SecondsBetween(frames_.front()->frame.stamp_ns, frame.stamp_ns) > duration_s_) {
    entry = std::move(frames_.front());
    frames_.pop_front();
  }
  if (!entry) entry = std::make_unique<PastFrame>(cells_);
  entry->frame = frame;
  entry->gravity = gravity;
  frames_.push_back(std::move(entry));
  return *frames_.back();
}

std::size_t FrameHistory::Find(StampNs stamp_ns) const {
  std::size_t index = frames_.size();
  while (index > 0 && frames_[index - 1]->frame.stamp_ns > stamp_ns) --index;
  const bool found = index > 0 && frames_[index - 1]->frame.stamp_ns == stamp_ns;
  return found ? index - 1 : frames_.size();
}

}  // namespace posefusion
