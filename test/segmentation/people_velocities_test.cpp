#include "posefusion/segmentation/people_velocities.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace posefusion {
namespace {

constexpr CellPerson kSomebody = 7;
constexpr double kIntervalS = 0.1;
constexpr float kTolerance = 1e-4F;

/// Somebody who fills the left of the view, before a wall; the flow sees nothing move.
class VelocityMeterTest : public testing::Test {
 protected:
  VelocityMeterTest() {
    Show(before_, 2);
    people_.Forget(before_.size());
    Mark(10);
    motion_ = cv::Mat(before_.size(), CV_32FC2, cv::Scalar(0, 0));
  }

  static void Show(CellGrid& cells, float left_m) {
    const CameraModel camera{160, 120, 130, 130, 79.5, 59.5, {}};
    cv::Mat depth(camera.height, camera.width, CV_32FC1, cv::Scalar(4));
    depth.colRange(0, 40).setTo(left_m);
    cells.Build(depth, camera);
  }

  void Mark(int columns) {
    people_.person.Fill(kNobody);
    for (int y = 0; y < before_.height(); ++y) {
      for (int x = 0; x < columns; ++x) people_.person.at(x, y) = kSomebody;
    }
  }

  /// The person is now so far away; the camera has moved by T_before_now.
  void Step(float left_m, const Eigen::Isometry3f& T_before_now = Eigen::Isometry3f::Identity()) {
    Show(now_, left_m);
    meter_.Update({before_, now_, people_, motion_, T_before_now, kIntervalS}, velocities_);
  }

  VelocityMeter meter_;
  PeopleVelocities velocities_;
  CellGrid before_{CellGridConfig()};
  CellGrid now_{CellGridConfig()};
  CellPeople people_;
  cv::Mat motion_;
};

TEST_F(VelocityMeterTest, MeasuresHowSomebodyComesNearer) {
  Step(1.9F);
  ASSERT_TRUE(velocities_[kSomebody]);
  EXPECT_NEAR(velocities_[kSomebody]->z(), -1, kTolerance);
  EXPECT_FALSE(velocities_[kNobody]) << "the wall is nobody";
  EXPECT_FALSE(velocities_[kSomebody + 1]);
}

TEST_F(VelocityMeterTest, LeavesOutWhatTheCameraDoes) {
  Eigen::Isometry3f T_before_now = Eigen::Isometry3f::Identity();
  T_before_now.translation().z() = 0.1F;
  Step(1.9F, T_before_now);
  EXPECT_LT(velocities_[kSomebody]->z(), kTolerance) << "the camera has come nearer";
  EXPECT_GT(velocities_[kSomebody]->z(), -kTolerance);
}

TEST_F(VelocityMeterTest, SmoothsOverFrames) {
  Step(1.9F);
  Step(2);
  EXPECT_GT(velocities_[kSomebody]->z(), -0.9);
  EXPECT_LT(velocities_[kSomebody]->z(), -0.5);
}

TEST_F(VelocityMeterTest, FewCellsChangeNothing) {
  Mark(0);
  people_.person.at(0, 0) = kSomebody;
  velocities_[kSomebody] = Eigen::Vector3f(0, 0, 1);
  Step(1.9F);
  EXPECT_EQ(velocities_[kSomebody]->z(), 1);
}

TEST_F(VelocityMeterTest, VelocitiesTurnWithTheCamera) {
  Mark(0);
  velocities_[kSomebody] = Eigen::Vector3f(0, 0, 1);
  Eigen::Isometry3f T_before_now = Eigen::Isometry3f::Identity();
  T_before_now.rotate(
      Eigen::AngleAxisf(static_cast<float>(M_PI) / 2, Eigen::Vector3f::UnitY()));  // to the right
  Step(2, T_before_now);
  EXPECT_NEAR(velocities_[kSomebody]->x(), -1, kTolerance);
}

}  // namespace
}  // namespace posefusion
