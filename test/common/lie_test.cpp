#include "posefusion/common/lie.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace posefusion {
namespace {

/// Double precision, lost a little by products of a few matrices.
constexpr double kTolerance = 1e-11;

Vector6d RandomTwist(std::mt19937& random, double scale) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = uniform(random);
  return twist;
}

TEST(Lie, LogInvertsExpForSmallAndLargeTwists) {
  std::mt19937 random(1);
  for (const double scale : {1e-9, 1e-5, 1e-3, 0.1, 1.0, 1.7}) {
    for (int i = 0; i < 50; ++i) {
      const Vector6d twist = RandomTwist(random, scale);
      EXPECT_LT((LogSE3(ExpSE3(twist)) - twist).norm(), kTolerance * (1 + scale)) << scale;
    }
  }
}

TEST(Lie, LogOfHalfTurnHasNormPi) {
  const Eigen::Vector3d omega = Eigen::Vector3d(1, 2, -2) / 3 * M_PI;
  EXPECT_NEAR(LogSO3(ExpSO3(omega)).norm(), M_PI, 1e-7);
}

TEST(Lie, ExpIsOrthonormal) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Matrix3d R = ExpSE3(RandomTwist(random, 2)).linear();
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), kTolerance);
    EXPECT_NEAR(R.determinant(), 1, kTolerance);
  }
}

TEST(Lie, AdjointMovesTwistThroughPose) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Isometry3d T = ExpSE3(RandomTwist(random, 1));
    const Vector6d twist = RandomTwist(random, 0.5);
    const Eigen::Isometry3d left = T * ExpSE3(twist) * T.inverse();
    const Eigen::Isometry3d right = ExpSE3(AdjointSE3(T) * twist);
    EXPECT_LT((left.matrix() - right.matrix()).norm(), kTolerance);
  }
}

TEST(Lie, CovarianceBesideIsThatOfThePointThatMovesAlong) {
  std::mt19937 random(4);
  const Matrix6d root = Matrix6d::NullaryExpr([&] { return RandomTwist(random, 0.001)[0]; });
  const Matrix6d covariance = root * root.transpose();
  const Eigen::Vector3d lever(0.3, -0.2, 0.5);
  // Columns of the root are perturbations whose mean square is the covariance.
  Matrix6d expected = Matrix6d::Zero();
  for (int i = 0; i < 6; ++i) {
    Vector6d moved = root.col(i);
    moved.head<3>() += Eigen::Vector3d(moved.tail<3>()).cross(lever);
    expected += moved * moved.transpose();
  }
  EXPECT_LT((CovarianceBeside(covariance, lever) - expected).norm(), 1e-6 * expected.norm());
}

TEST(Lie, CovarianceInAxesTurnsTranslationAndRotationAlike) {
  // A quarter turn about z takes x to y and y to -x.
  const Eigen::Matrix3d R = ExpSO3({0, 0, M_PI / 2});
  const Vector6d old_variances = (Vector6d() << 1, 2, 3, 4, 5, 6).finished();
  const Vector6d new_variances = (Vector6d() << 2, 1, 3, 5, 4, 6).finished();
  const Matrix6d turned = CovarianceInAxes(R, Matrix6d(old_variances.asDiagonal()));
  EXPECT_LT((turned - Matrix6d(new_variances.asDiagonal())).norm(), kTolerance);
}

TEST(Lie, WorstPositionSigmaIsThatOfTheLongestAxisWhereverItPoints) {
  const Vector6d variances = (Vector6d() << 0.01, 0.09, 0.04, 100, 100, 100).finished();
  const Matrix6d covariance = CovarianceInAxes(ExpSO3({0.3, -0.2, 0.9}), variances.asDiagonal());
  EXPECT_NEAR(WorstPositionSigma(covariance), 0.3, kTolerance);
}

TEST(Lie, StepsAreWithinLimitsOfBothWayAndTurn) {
  const Eigen::Isometry3d T =
      ExpSE3((Vector6d() << 0, 0, 0, 0, 0.2, 0).finished()) * Eigen::Translation3d(0.3, 0, 0.4);
  EXPECT_TRUE(IsWithin(T, 0.51, 0.21));
  EXPECT_FALSE(IsWithin(T, 0.49, 0.21));
  EXPECT_FALSE(IsWithin(T, 0.51, 0.19));
}

TEST(Lie, SkewIsCrossProduct) {
  const Eigen::Vector3d a(1, -2, 3);
  const Eigen::Vector3d b(0.5, 4, -1);
  EXPECT_LT((Skew(a) * b - a.cross(b)).norm(), kTolerance);
}

}  // namespace
}  // namespace posefusion
