#include "posefusion_ros/skeleton_conversions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "posefusion_ros/conversions.h"
#include "test/skeleton/sample_skeletons.h"

namespace posefusion {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::Numbers;
using testing::PersonAt;
using ::testing::ThrowsMessage;

std_msgs::Header ImageHeader() {
  std_msgs::Header header;
  header.frame_id = "camera";
  header.stamp = ros::Time(5, 123456789);
  return header;
}

SkeletonsMessage MessageOf(const std::vector<Skeleton>& people) {
  Skeletons skeletons;
  skeletons.people = people;
  return ToSkeletonsMessage(skeletons, ImageHeader());
}

void ExpectRefused(const SkeletonsMessage& message, const std::string& why) {
  EXPECT_THAT(
      [&] { ToSkeletons(message, "/skeletons_in"); },
      ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr("/skeletons_in: "), HasSubstr(why))));
}

TEST(SkeletonConversions, ThereAndBackIsTheSame) {
  const std::vector<Skeleton> people = {PersonAt(10.25F, 20), PersonAt(100, 50, 0.125F)};
  const SkeletonsMessage message = MessageOf(people);
  EXPECT_EQ(message.layout, "coco18");
  EXPECT_EQ(message.header.frame_id, "camera");
  const Skeletons back = ToSkeletons(message, "topic").skeletons;
  EXPECT_EQ(back.stamp_ns, 5'123'456'789);
  EXPECT_EQ(Numbers(back.people), Numbers(people));
}

TEST(SkeletonConversions, Body25IsMapped) {
  SkeletonsMessage message;
  message.layout = "body25";
  message.people.resize(1);
  message.people[0].joints.resize(25);
  message.people[0].joints[9].u = 90;  // right hip
  message.people[0].joints[9].p = 1;
  const Skeletons skeletons = ToSkeletons(message, "topic").skeletons;
  EXPECT_EQ(skeletons.layout, SkeletonLayout::kBody25);
  EXPECT_EQ(skeletons.people.at(0)[kRightHip].u, 90);
}

TEST(SkeletonConversions, WrongLayoutsAndNumbersOfJointsAreRefused) {
  SkeletonsMessage message = MessageOf({PersonAt(1, 2)});
  message.layout = "mpii";
  ExpectRefused(message, "layout 'mpii' is neither coco18 nor body25");
  message.layout = "body25";
  ExpectRefused(message, "18 joints, but layout body25 has 25");
  message.layout = "coco18";
  message.people[0].joints.clear();
  ExpectRefused(message, "0 joints");
}

TEST(SkeletonConversions, JointsThatMakeNoSenseAreNotFound) {
  SkeletonsMessage message = MessageOf({PersonAt(1, 2)});
  message.people[0].joints[0].u = std::nanf("");
  message.people[0].joints[1].v = INFINITY;
  message.people[0].joints[2].p = -1;
  const Skeleton person = ToSkeletons(message, "topic").skeletons.people.at(0);
  for (const std::size_t j : {0, 1, 2}) EXPECT_EQ(person[j].p, 0) << j;
  EXPECT_GT(person[3].p, 0);
}

TEST(SkeletonConversions, MoreThanFifteenPeopleAreCutAndCounted) {
  const auto received = ToSkeletons(MessageOf(std::vector<Skeleton>(18, PersonAt(1, 2))), "topic");
  EXPECT_EQ(received.num_left_out, 3);
  EXPECT_EQ(received.skeletons.people.size(), 15U);
}

}  // namespace
}  // namespace posefusion
