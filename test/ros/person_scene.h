#pragma once

#include "posefusion/image/rgbd_frame.h"
#include "posefusion/skeleton/skeletons.h"
#include "test/ros/synthetic_room.h"

namespace posefusion {

/// A frame with somebody in it.
struct PersonFrame {
  RgbdFrame frame;
  Skeletons skeletons;  ///< of the frame, in time
};

/// SyntheticFrame with a box of a person's size that walks through the room, and its joints.
PersonFrame SyntheticPerson(int index, StampNs start_ns = kSyntheticStartNs);

}  // namespace posefusion
