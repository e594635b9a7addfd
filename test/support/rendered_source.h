#pragma once

#include <vector>

#include "posefusion/dataset/frame_source.h"
#include "test/support/rendered_room.h"

namespace posefusion::testing {

constexpr StampNs kRenderedInterval = 33'333'333;

/// A camera that sways and turns while it walks through the furnished room.
inline Eigen::Isometry3d SwayingPose(int i) {
  const double t = i * 0.0333;
  return LookAlong({-1.2 + 0.15 * t, 0.1 * std::sin(2 * t), 0.2 + 0.03 * std::sin(9 * t)},
                   0.25 * std::sin(1.5 * t), 0.3 + 0.05 * std::sin(4 * t));
}

/// Rendered frames of that walk, with true poses.
class RenderedSource : public FrameSource {
 public:
  explicit RenderedSource(int num_frames, StampNs first_stamp_ns = 1'000'000'000)
      : num_frames_(num_frames), first_stamp_ns_(first_stamp_ns) {}

  std::optional<RgbdFrame> Next() override {
    if (next_ >= num_frames_) return std::nullopt;
    const int i = next_++;
    return room_.Render(SmallCamera(), SwayingPose(i), first_stamp_ns_ + i * kRenderedInterval);
  }
  std::optional<int> NumFrames() const override { return num_frames_; }

 private:
  int num_frames_;
  StampNs first_stamp_ns_;
  int next_ = 0;
  RenderedRoom room_ = RenderedRoom::Furnished();
};

}  // namespace posefusion::testing
