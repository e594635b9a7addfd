#include "posefusion/evaluation/relative_error.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "test/evaluation/sample_trajectories.h"

namespace posefusion {
namespace {

constexpr double kTolerance = 1e-9;

Eigen::Isometry3d AnyMotion() {
  Vector6d twist;
  for (double& value : twist) value = *rc::gen::inRange(-3000, 3001) / 1000.0;
  return ExpSE3(twist);
}

TEST(RelativeError, OfTheTruthItselfIsZeroInAnyMap) {
  EXPECT_TRUE(rc::check([] {
    const Trajectory truth = WavyTrajectory(90);
    const RelativeError error = ComputeRelativeError(truth, InOtherMap(truth, AnyMotion()));
    RC_ASSERT(error.samples.size() > 50U);
    RC_ASSERT(error.translation_mps.max < kTolerance);
  }));
}

TEST(RelativeError, SteadyDriftIsTheDriftPerSecond) {
  const Trajectory truth = WavyTrajectory(150);
  Trajectory estimate = truth;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const double t = SecondsBetween(kSampleStartNs, estimate[i].stamp_ns);
    estimate[i].T_map_camera.translation() += Eigen::Vector3d(0.03 * t, 0.04 * t, 0);
  }
  const RelativeError error = ComputeRelativeError(truth, estimate);
  EXPECT_NEAR(error.translation_mps.rmse, 0.05, 1e-6);
  EXPECT_NEAR(error.translation_mps.max, 0.05, 1e-6);
  EXPECT_LT(error.rotation_degps.max, 1e-5);
}

TEST(RelativeError, TurnOfTheCameraIsTheAnglePerSecond) {
  Trajectory truth;
  Trajectory estimate;
  for (int i = 0; i < 100; ++i) {
    truth.push_back({i * 20'000'000LL, Eigen::Isometry3d::Identity()});
    estimate.push_back(truth.back());
    estimate.back().T_map_camera.linear() = ExpSO3({0, 0, 0.1 * 0.02 * i});
  }
  const RelativeError error = ComputeRelativeError(truth, estimate);
  // 2 s at 50 Hz: those of the first half, and those for which the closest is not the last pose.
  EXPECT_EQ(error.samples.size(), 49U);
  EXPECT_NEAR(error.rotation_degps.median, 0.1 * 180 / M_PI, 1e-6);
  EXPECT_LT(error.translation_mps.max, kTolerance);
}

TEST(RelativeError, PairsThatTouchAnExcludedIntervalDoNotCount) {
  const Trajectory truth = WavyTrajectory(150);
  Trajectory estimate = truth;
  for (std::size_t i = 75; i < estimate.size(); ++i) {
    estimate[i].T_map_camera.translation().x() += 1;  // recovered elsewhere after a fall
  }
  EXPECT_GT(ComputeRelativeError(truth, estimate).translation_mps.max, 0.9);
  const StampInterval fall{truth[70].stamp_ns, truth[80].stamp_ns, "fall"};
  const RelativeError error = ComputeRelativeError(truth, estimate, {fall});
  EXPECT_LT(error.translation_mps.max, kTolerance);
  EXPECT_GT(error.samples.size(), 60U);
}

TEST(RelativeError, ShortOrForeignTrajectoriesHaveNone) {
  EXPECT_TRUE(ComputeRelativeError(WavyTrajectory(20), WavyTrajectory(20)).samples.empty());
  EXPECT_TRUE(ComputeRelativeError({}, WavyTrajectory(90)).samples.empty());
  Trajectory later = WavyTrajectory(90);
  for (StampedPose& pose : later) pose.stamp_ns += 3'600'000'000'000;
  EXPECT_TRUE(ComputeRelativeError(WavyTrajectory(90), later).samples.empty());
}

}  // namespace
}  // namespace posefusion
