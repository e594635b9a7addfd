#pragma once

#include "posefusion/image/rgbd_frame.h"

namespace posefusion {

constexpr StampNs kSyntheticStartNs = 1'000'000'000'000;
constexpr StampNs kDepthLagNs = 10'000'000;

/// Frame `index` of a camera that sways through a rendered room; the same every time, 30 a second.
/// Colour and depth stamps differ by 10 ms as those of real cameras do.
RgbdFrame SyntheticFrame(int index, StampNs start_ns = kSyntheticStartNs);

}  // namespace posefusion
