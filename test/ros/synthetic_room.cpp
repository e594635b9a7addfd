#include "test/ros/synthetic_room.h"

#include "test/support/rendered_source.h"

namespace posefusion {
RgbdFrame SyntheticFrame(int index, StampNs start_ns) {
  static const testing::RenderedRoom room = testing::RenderedRoom::Furnished();
  RgbdFrame frame = room.Render(testing::SmallCamera(), testing::SwayingPose(index),
                                start_ns + index * testing::kRenderedInterval);
  frame.depth_stamp_ns = frame.stamp_ns + kDepthLagNs;
  return frame;
}

}  // namespace posefusion
