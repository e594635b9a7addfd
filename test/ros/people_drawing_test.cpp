#include "posefusion_ros/people_drawing.h"

#include <gtest/gtest.h>

#include "posefusion/skeleton/joints.h"

namespace posefusion {
namespace {

using visualization_msgs::Marker;

/// Neck, right shoulder and left ankle were lifted; a point along a bone comes after them.
PersonSeeds ThreeJoints() {
  PersonSeeds person;
  person.found[kNeck] = person.found[kRightShoulder] = person.found[kLeftAnkle] = true;
  person.num_joints = 3;
  for (int i = 0; i < 4; ++i)
    person.seeds.push_back({{}, Eigen::Vector3f(0, 0, 1 + static_cast<float>(i))});
  return person;
}

TEST(PeopleDrawing, OldMarkersAreDeletedFirst) {
  const auto nobody = ToSkeletonMarkers({}, {});
  ASSERT_EQ(nobody.markers.size(), 1U);
  EXPECT_EQ(nobody.markers[0].action, Marker::DELETEALL);
}

TEST(PeopleDrawing, BonesJoinJointsThatWereFound) {
  std_msgs::Header header;
  header.frame_id = "camera";
  const auto array = ToSkeletonMarkers({ThreeJoints(), ThreeJoints()}, header);
  ASSERT_EQ(array.markers.size(), 5U) << "delete, and bones and joints of two people";
  const Marker& bones = array.markers[1];
  EXPECT_EQ(bones.type, Marker::LINE_LIST);
  EXPECT_EQ(bones.header.frame_id, "camera");
  EXPECT_TRUE(bones.frame_locked) << "rviz must not wait for the pose of the frame";
  ASSERT_EQ(bones.points.size(), 2U) << "one bone, from neck to shoulder";
  EXPECT_EQ(bones.points[0].z, 1);
  EXPECT_EQ(bones.points[1].z, 2);
  EXPECT_EQ(array.markers[2].points.size(), 3U);
  EXPECT_NE(array.markers[1].id, array.markers[3].id);
}

TEST(PeopleDrawing, MaskIsTintedAndTheRestStays) {
  const cv::Mat rgb(1, 2, CV_8UC3, cv::Scalar(100, 100, 100));
  const cv::Mat mask = (cv::Mat_<std::uint8_t>(1, 2) << 0, 255);
  const cv::Mat drawn = DrawMask(rgb, mask);
  EXPECT_EQ(drawn.at<cv::Vec3b>(0, 0), cv::Vec3b(100, 100, 100));
  EXPECT_GT(drawn.at<cv::Vec3b>(0, 1)[0], 150);
  EXPECT_EQ(rgb.at<cv::Vec3b>(0, 1), cv::Vec3b(100, 100, 100)) << "the image belongs to others";
}

}  // namespace
}  // namespace posefusion
