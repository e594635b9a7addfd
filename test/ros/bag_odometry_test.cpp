#include "posefusion_ros/bag_odometry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

#include <stdexcept>

#include "posefusion_ros/bag_writer.h"
#include "posefusion_ros/topic_names.h"
#include "test/ros/robot_tf.h"
#include "test/ros/synthetic_room.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kStartS = 1000;  ///< of the synthetic frames
/// tf between two samples 10 ms apart is a straight line.
constexpr double kInterpolationError = 2e-3;
constexpr double kRounding = 1e-8;

/// A robot that tells about itself for two seconds; messages are recorded `late_s` later. The
/// camera's place in the head may be told once and for all.
class BagOdometryTest : public testing::Test {
 protected:
  void WriteBag(double late_s, bool camera_is_static) {
    BagWriter writer(path_, kCameraLink);
    writer.Write(SyntheticFrame(0));
    writer.WriteOther([&](rosbag::Bag& bag) {
      tf2_msgs::TFMessage fixed;
      for (int i = 0; i <= 200; ++i) {
        const double time_s = kStartS + kSmallStepS * i;
        tf2_msgs::TFMessage moving;
        for (const auto& transform : RobotTransforms(time_s)) {
          const bool is_fixed = camera_is_static && transform.child_frame_id == kCameraLink;
          (is_fixed ? fixed : moving).transforms.push_back(transform);
        }
        bag.write("/tf", ros::Time(time_s + late_s), moving);
      }
      // at the end: it counts for the whole bag all the same
      if (camera_is_static) bag.write("/tf_static", ros::Time(kStartS + 2), fixed);
    });
    writer.Close();
  }

  static double ErrorAt(const BagOdometry& odometry, double time_s) {
    const auto pose = odometry.PoseAt(StampFromSeconds(time_s));
    if (!pose) return std::numeric_limits<double>::infinity();
    return (pose->matrix() - OdomToCameraTruth(time_s).matrix()).norm();
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "a.bag";
};

TEST_F(BagOdometryTest, IsWhatTfSaysAtTheStampHoweverLateItCame) {
  for (const double late_s : {0.0, 0.15, 50.0}) {
    WriteBag(late_s, late_s > 0.1);
    const BagOdometry odometry(path_, "odom", kCameraRgbTopic);
    EXPECT_LT(ErrorAt(odometry, kStartS + 0.5), kRounding) << late_s;
    EXPECT_LT(ErrorAt(odometry, kStartS + 0.505), kInterpolationError) << late_s;
    EXPECT_LT(ErrorAt(odometry, kStartS + 1.99), kRounding) << late_s;
  }
}

TEST_F(BagOdometryTest, IsUnknownBeforeAndAfterTf) {
  WriteBag(0, false);
  const BagOdometry odometry(path_, "odom", kCameraRgbTopic);
  EXPECT_FALSE(odometry.PoseAt(StampFromSeconds(kStartS - 0.02)));
  EXPECT_TRUE(odometry.PoseAt(StampFromSeconds(kStartS + 1)));
  EXPECT_FALSE(odometry.PoseAt(StampFromSeconds(kStartS + 2.02)));
}

TEST_F(BagOdometryTest, FramesThatNothingConnectsAreNamed) {
  WriteBag(0, false);
  const auto open = [&](const std::string& odom) { BagOdometry(path_, odom, kCameraRgbTopic); };
  EXPECT_THAT([&] { open("odom_init"); },
              ThrowsMessage<std::runtime_error>(AllOf(
                  HasSubstr(path_), HasSubstr("no way from odom_init to the camera"),
                  HasSubstr(std::string(kCameraLink) + " below"), HasSubstr("BODY below odom"))));
  EXPECT_NO_THROW(open("/odom"));
}

TEST_F(BagOdometryTest, ABagWithoutTfIsNamed) {
  BagWriter writer(path_, kCameraLink);
  writer.Write(SyntheticFrame(0));
  writer.Close();
  EXPECT_THAT([&] { BagOdometry(path_, "odom", kCameraRgbTopic); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr(path_), HasSubstr("no messages on topic /tf"))));
}

}  // namespace
}  // namespace posefusion
