#include "posefusion_ros/gravity_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

#include "test/ros/robot_tf.h"

namespace posefusion {
namespace {

constexpr double kStart = 1000;
constexpr double kLongS = 5;

class GravityFinderTest : public testing::Test {
 protected:
  std::optional<Eigen::Vector3f> Find(double time_s, double timeout_s = 0) {
    return finder_.Find(StampFromSeconds(time_s), kCameraLink, timeout_s, time_s);
  }

  /// Wall time of the same, seconds.
  double TimeToFind(double time_s, double timeout_s) {
    const auto start = std::chrono::steady_clock::now();
    Find(time_s, timeout_s);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }

  TfTree tree_{0.5};
  std::vector<std::string> told_;
  GravityFinder finder_{"odom", tree_, [this](const std::string& text) { told_.push_back(text); }};
};

TEST_F(GravityFinderTest, PointsDownwardsInTheCameraAtTheStampOfTheImage) {
  AddRobot(tree_, kStart, kStart + 1);
  for (const double time_s : {kStart + 0.2, kStart + 0.7}) {
    const auto gravity = Find(time_s);
    ASSERT_TRUE(gravity);
    const Eigen::Vector3d down = OdomToCameraTruth(time_s).linear() * gravity->cast<double>();
    EXPECT_TRUE(down.isApprox(-Eigen::Vector3d::UnitZ(), 1e-5)) << down.transpose();
  }
}

TEST_F(GravityFinderTest, IsUnknownWithoutAnOdometryFrame) {
  AddRobot(tree_, kStart, kStart + 1);
  GravityFinder finder("", tree_, [this](const std::string& text) { told_.push_back(text); });
  EXPECT_FALSE(finder.Find(StampFromSeconds(kStart), kCameraLink, kLongS, 0));
  EXPECT_TRUE(told_.empty());
}

TEST_F(GravityFinderTest, WaitsForATransformOnItsWay) {
  AddRobot(tree_, kStart, kStart + 0.1);
  std::thread robot([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    AddRobot(tree_, kStart + 0.1, kStart + 0.2);
  });
  EXPECT_TRUE(Find(kStart + 0.15, kLongS));
  robot.join();
}

TEST_F(GravityFinderTest, WaitsNoSecondTimeForARobotThatIsSilent) {
  AddRobot(tree_, kStart, kStart + 0.1);
  EXPECT_FALSE(Find(kStart + 0.2, 0.05));
  EXPECT_LT(TimeToFind(kStart + 0.3, kLongS), kLongS / 2);
  AddRobot(tree_, kStart + 0.1, kStart + 0.4);  // it speaks again
  EXPECT_TRUE(Find(kStart + 0.35));
  EXPECT_GT(TimeToFind(kStart + 0.5, 0.05), 0.04);
}

TEST_F(GravityFinderTest, WaitsAgainAsSoonAsWhatWasMissedHasCome) {
  EXPECT_FALSE(Find(kStart - 1, 0.01)) << "before anything was told";
  EXPECT_FALSE(Find(kStart + 0.15, kLongS));
  AddRobot(tree_, kStart, kStart + 0.2);
  EXPECT_GT(TimeToFind(kStart + 0.25, 0.05), 0.04);
}

TEST_F(GravityFinderTest, SaysOnceWhatIsMissing) {
  for (int i = 0; i < 100; ++i) Find(kStart + 0.1 * i);
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_THAT(told_[0],
              testing::AllOf(testing::HasSubstr("from odom to"), testing::HasSubstr(kCameraLink),
                             testing::HasSubstr("nobody publishes them")));
}

TEST_F(GravityFinderTest, SaysNothingOfAFewImagesWithoutAPose) {
  AddRobot(tree_, kStart, kStart + 3);
  for (int i = -5; i < 20; ++i) Find(kStart + 0.1 * i);
  for (int i = 0; i < 5; ++i) Find(kStart + 3.1 + 0.1 * i);
  EXPECT_TRUE(told_.empty());
}

}  // namespace
}  // namespace posefusion
