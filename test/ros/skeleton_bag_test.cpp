#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "posefusion_ros/bag_source.h"
#include "posefusion_ros/bag_writer.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/skeleton_conversions.h"
#include "posefusion_ros/topic_names.h"
#include "test/ros/synthetic_room.h"
#include "test/skeleton/sample_skeletons.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

TEST(SkeletonBag, KeypointsArePlayedWhenTheyArrive) {
  const TemporaryFolder folder;
  Skeletons written;
  written.stamp_ns = kSyntheticStartNs;
  written.arrival_ns = kSyntheticStartNs + 300'000'000;
  written.people = {testing::PersonAt(10, 20)};
  BagWriter writer(folder / "a.bag", "camera");
  writer.Write(written);
  writer.Close();

  const rosbag::Bag bag(folder / "a.bag");
  rosbag::View view(bag, rosbag::TopicQuery(std::string("/") + kSkeletonsInTopic));
  ASSERT_EQ(view.size(), 1U);
  const rosbag::MessageInstance message = *view.begin();
  EXPECT_EQ(ToStampNs(message.getTime()), written.arrival_ns);
  const auto content = message.instantiate<SkeletonsMessage>();
  ASSERT_TRUE(content);
  const Skeletons read = ToSkeletons(*content, "topic").skeletons;
  EXPECT_EQ(read.stamp_ns, written.stamp_ns);
  EXPECT_EQ(testing::Numbers(read.people), testing::Numbers(written.people));
}

TEST(SkeletonBag, FramesKnowTheirPlaceAmongTheColourImages) {
  const TemporaryFolder folder;
  BagWriter writer(folder / "a.bag", "camera");
  for (const int i : {0, 1, 2}) {
    RgbdFrame frame = SyntheticFrame(i);
    if (i == 1) frame.depth_stamp_ns -= 100'000'000'000;  // no partner for the second image
    writer.Write(frame);
  }
  writer.Close();
  BagSource source(folder / "a.bag");
  std::vector<int> indices;
  while (const auto frame = source.Next()) indices.push_back(frame->index);
  EXPECT_EQ(indices, (std::vector<int>{0, 2}));
}

}  // namespace
}  // namespace posefusion
