#pragma once

#include "posefusion/image/rgbd_frame.h"

namespace posefusion {

/// Small rendered frames of a textured room corner, seen by a camera that drifts slowly; colour and
/// depth stamps differ by 10 ms as those of real cameras do.
/// Frame `index` is the same every time; 30 frames a second from `start_ns`.
RgbdFrame SyntheticFrame(int index, StampNs start_ns = 1'000'000'000'000);

}  // namespace posefusion
