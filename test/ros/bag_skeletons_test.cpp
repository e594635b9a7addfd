#include "posefusion_ros/bag_skeletons.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <stdexcept>

#include "posefusion_ros/bag_writer.h"
#include "posefusion_ros/conversions.h"
#include "posefusion_ros/skeleton_conversions.h"
#include "posefusion_ros/topic_names.h"
#include "test/ros/synthetic_room.h"
#include "test/skeleton/sample_skeletons.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

constexpr StampNs kFrameNs = 33'333'333;
constexpr StampNs kLatencyNs = 300'000'000;

Skeletons PeopleAt(StampNs stamp_ns, StampNs arrival_ns) {
  Skeletons skeletons;
  skeletons.stamp_ns = stamp_ns;
  skeletons.arrival_ns = arrival_ns;
  skeletons.people = {testing::PersonAt(10, 20)};
  return skeletons;
}

class BagSkeletonsTest : public ::testing::Test {
 protected:
  void WriteBag(const std::vector<Skeletons>& recorded) {
    BagWriter writer(path_, "camera");
    writer.Write(SyntheticFrame(0));
    for (const Skeletons& skeletons : recorded) writer.Write(skeletons);
    writer.Close();
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "a.bag";
  const StampNs start_ns_ = kSyntheticStartNs;
};

TEST_F(BagSkeletonsTest, BelongToTheirFrameAndArriveWhenTheyWereRecorded) {
  WriteBag({PeopleAt(start_ns_, start_ns_ + kLatencyNs),
            PeopleAt(start_ns_ + 2 * kFrameNs, start_ns_ + 2 * kFrameNs + kLatencyNs)});
  BagSkeletons source(path_, kSkeletonsInTopic);
  source.Offer(testing::FrameAt(start_ns_));
  source.Offer(testing::FrameAt(start_ns_ + kFrameNs));
  EXPECT_THAT(source.Take(start_ns_ + kLatencyNs - 1), IsEmpty());
  const auto arrived = source.Take(start_ns_ + kLatencyNs);
  ASSERT_THAT(arrived, SizeIs(1));
  EXPECT_EQ(arrived[0].stamp_ns, start_ns_);
  EXPECT_EQ(testing::Numbers(arrived[0].people), testing::Numbers({testing::PersonAt(10, 20)}));
  EXPECT_EQ(source.counts().frames_with_keypoints, 1);
  EXPECT_EQ(source.counts().without_frame, 1);
  EXPECT_THAT(source.TakeNotes(), IsEmpty());
}

TEST_F(BagSkeletonsTest, ComeWithTheirImageWhereTheBagHasAnotherClock) {
  WriteBag({PeopleAt(start_ns_, start_ns_ + 1'000'000'000'000)});
  BagSkeletons source(path_, kSkeletonsInTopic);
  source.Offer(testing::FrameAt(start_ns_));
  EXPECT_THAT(source.Take(start_ns_), SizeIs(1));
}

TEST_F(BagSkeletonsTest, StampsOfAnotherClockAreToldOnce) {
  WriteBag({PeopleAt(start_ns_ + 1'000'000'000'000, start_ns_)});
  BagSkeletons source(path_, kSkeletonsInTopic);
  source.Offer(testing::FrameAt(start_ns_));
  source.Offer(testing::FrameAt(start_ns_ + kFrameNs));
  const auto notes = source.TakeNotes();
  ASSERT_THAT(notes, SizeIs(1));
  EXPECT_THAT(notes[0], HasSubstr("another clock"));
}

TEST_F(BagSkeletonsTest, AMessageThatCannotBeUsedIsNamedAndTheNextOneIs) {
  BagWriter writer(path_, "camera");
  writer.Write(PeopleAt(start_ns_ + kFrameNs, start_ns_ + kFrameNs));
  writer.WriteOther([&](rosbag::Bag& bag) {
    SkeletonsMessage message;
    message.header.stamp = ToRosTime(start_ns_);
    message.layout = "coco17";
    bag.write("/skeletons_in", message.header.stamp, message);
  });
  writer.Close();
  BagSkeletons source(path_, kSkeletonsInTopic);
  EXPECT_THAT([&] { source.Offer(testing::FrameAt(start_ns_)); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("/skeletons_in: layout 'coco17'")));
  source.Offer(testing::FrameAt(start_ns_ + kFrameNs));
  EXPECT_THAT(source.Take(start_ns_ + kFrameNs), SizeIs(1));
}

TEST_F(BagSkeletonsTest, MissingAndOtherTopicsAreNamed) {
  WriteBag({PeopleAt(start_ns_, start_ns_)});
  EXPECT_THAT([&] { BagSkeletons(path_, "people"); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr(path_), HasSubstr("/people"), HasSubstr("/skeletons_in"))));
  EXPECT_THAT([&] { BagSkeletons(path_, kCameraRgbTopic); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is sensor_msgs/Image, not")));
  EXPECT_TRUE(HasSkeletons(path_, kSkeletonsInTopic));
  EXPECT_FALSE(HasSkeletons(path_, "people"));
}

}  // namespace
}  // namespace posefusion
