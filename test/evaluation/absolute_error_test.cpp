#include "posefusion/evaluation/absolute_error.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <stdexcept>

#include "test/evaluation/sample_trajectories.h"

namespace posefusion {
namespace {

constexpr double kTolerance = 1e-9;          ///< roundings of the alignment
constexpr double kAngleToleranceDeg = 1e-5;  ///< the arc cosine doubles them

Eigen::Isometry3d AnyMotion() {
  Vector6d twist;
  for (double& value : twist) value = *rc::gen::inRange(-3000, 3001) / 1000.0;
  return ExpSE3(twist);
}

TEST(AbsoluteError, OfTheTruthItselfIsZeroInAnyMap) {
  EXPECT_TRUE(rc::check([] {
    const Trajectory truth = WavyTrajectory(60);
    const AbsoluteError error = ComputeAbsoluteError(truth, InOtherMap(truth, AnyMotion()));
    RC_ASSERT(error.pairs.size() == 60U);
    RC_ASSERT(error.translation_m.max < kTolerance);
    RC_ASSERT(error.rotation_deg.max < kAngleToleranceDeg);
  }));
}

TEST(AbsoluteError, DoesNotDependOnTheMapsOfTheEstimateAndTheTruth) {
  Trajectory estimate = WavyTrajectory(90);
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].T_map_camera.translation().x() += 0.02 * std::sin(7.0 * static_cast<double>(i));
  }
  const double rmse_m = ComputeAbsoluteError(WavyTrajectory(90), estimate).translation_m.rmse;
  EXPECT_GT(rmse_m, 0.005);
  EXPECT_TRUE(rc::check([&] {
    const Trajectory moved = InOtherMap(estimate, AnyMotion());
    const Trajectory truth = InOtherMap(WavyTrajectory(90), AnyMotion());
    const double moved_rmse_m = ComputeAbsoluteError(truth, moved).translation_m.rmse;
    RC_ASSERT(std::abs(moved_rmse_m - rmse_m) < kTolerance);
  }));
}

TEST(AbsoluteError, FastSinusoidalOffsetGivesItsRootMeanSquare) {
  constexpr int kNumPoses = 3000;
  constexpr double kAmplitudeM = 0.01;
  const Trajectory truth = WavyTrajectory(kNumPoses);
  Trajectory estimate = truth;
  for (int i = 0; i < kNumPoses; ++i) {
    // About seven periods a second: no alignment can absorb that.
    estimate[static_cast<std::size_t>(i)].T_map_camera.translation().z() +=
        kAmplitudeM * std::sin(2 * M_PI * 7 * i / 30.5);
  }
  const AbsoluteError error = ComputeAbsoluteError(truth, estimate);
  EXPECT_NEAR(error.translation_m.rmse, kAmplitudeM / std::sqrt(2.0), 0.001 * kAmplitudeM);
}

TEST(AbsoluteError, AgreesWithACaseComputedByHand) {
  // The corners of a square of 2 m, estimated as one of 2.2 m about the first corner. The best fit
  // lays the centres upon each other and keeps the directions.
  Trajectory truth;
  Trajectory estimate;
  const double corners[][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (int i = 0; i < 4; ++i) {
    truth.push_back({i * 100'000'000LL, Eigen::Isometry3d::Identity()});
    truth.back().T_map_camera.translation() << corners[i][0], corners[i][1], 0;
    estimate.push_back(truth.back());
    estimate.back().T_map_camera.translation() *= 1.1;
  }
  // Every corner of the larger square is 0.1 m further out in x and y than that of the smaller.
  const AbsoluteError error = ComputeAbsoluteError(truth, estimate);
  EXPECT_NEAR(error.translation_m.rmse, 0.1 * std::sqrt(2.0), kTolerance);
  EXPECT_NEAR(error.translation_m.min, 0.1 * std::sqrt(2.0), kTolerance);
}

TEST(AbsoluteError, LaysFirstPosesTogetherWhereTheTruthHardlyMoves) {
  Trajectory truth = WavyTrajectory(30);
  for (StampedPose& pose : truth) {
    pose.T_map_camera = Eigen::Isometry3d::Identity();
    pose.T_map_camera.translation().x() = 1e-4 * static_cast<double>(pose.stamp_ns % 7);
  }
  Trajectory estimate = truth;
  estimate.back().T_map_camera = ExpSE3((Vector6d() << 0.05, 0, 0, 0, 0, 0.1).finished());
  const Trajectory moved = InOtherMap(estimate, ExpSE3(Vector6d::Constant(0.7)));
  const AbsoluteError error = ComputeAbsoluteError(truth, moved);
  EXPECT_EQ(error.alignment, TrajectoryAlignment::kFirstPose);
  EXPECT_NEAR(error.translation_m.max, 0.05, 0.001);
  EXPECT_NEAR(error.rotation_deg.max, 0.1 * 180 / M_PI, 0.001);
}

TEST(AbsoluteError, LeavesOutExcludedIntervals) {
  const Trajectory truth = WavyTrajectory(60);
  Trajectory estimate = truth;
  for (int i = 20; i < 30; ++i) {
    estimate[static_cast<std::size_t>(i)].T_map_camera.translation().x() += 5;
  }
  const StampInterval fall{estimate[20].stamp_ns, estimate[29].stamp_ns, "fall"};
  const AbsoluteError error = ComputeAbsoluteError(truth, estimate, {fall});
  EXPECT_EQ(error.pairs.size(), 50U);
  EXPECT_LT(error.translation_m.max, kTolerance);
}

TEST(AbsoluteError, CountsAllPosesOfAStamp) {
  const Trajectory truth = WavyTrajectory(30);
  Trajectory estimate = truth;
  estimate.insert(estimate.begin() + 10, estimate[10]);
  EXPECT_EQ(ComputeAbsoluteError(truth, estimate).pairs.size(), 31U);
}

TEST(AbsoluteError, NeedsThreeCommonPoses) {
  const Trajectory truth = WavyTrajectory(30);
  EXPECT_THROW(ComputeAbsoluteError(truth, WavyTrajectory(2)), std::runtime_error);
  EXPECT_NO_THROW(ComputeAbsoluteError(truth, WavyTrajectory(3)));
  EXPECT_THROW(ComputeAbsoluteError(truth, {}), std::runtime_error);
}

}  // namespace
}  // namespace posefusion
