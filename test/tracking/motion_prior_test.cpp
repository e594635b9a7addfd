#include "posefusion/tracking/motion_prior.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "posefusion/tracking/odometry_motion.h"
#include "posefusion/tracking/prior_trust.h"

namespace posefusion {
namespace {

Eigen::Isometry3d Pose(double x, double y, double z, double rx, double ry, double rz) {
  return ExpSE3((Vector6d() << x, y, z, rx, ry, rz).finished());
}

const Eigen::Isometry3d kViewLast = Pose(0.1, -0.2, 0.3, 0.2, -0.4, 0.3);

MotionPrior SomePrior() {
  MotionPrior prior;
  prior.T_last_camera = Pose(0.2, 0.1, -0.05, 0.1, 0.3, -0.2);
  Vector6d sigmas;
  sigmas << 0.01, 0.02, 0.03, 0.002, 0.004, 0.006;
  prior.covariance = sigmas.cwiseAbs2().asDiagonal();
  return prior;
}

/// The prior's pose perturbed at the camera's centre in the axes of the last camera.
Eigen::Isometry3d PerturbedInView(const MotionPrior& prior, const Vector6d& perturbation) {
  Eigen::Isometry3d T = prior.T_last_camera;
  T.translation() += perturbation.head<3>();
  T.linear() = ExpSO3(perturbation.tail<3>()) * T.linear();
  return kViewLast * T;
}

TEST(MotionPrior, ASigmaAlongAnyAxisOfTheLastCameraIsASigmaInTheView) {
  const MotionPrior prior = SomePrior();
  const PosePrior in_view = PriorInView(prior, kViewLast, Matrix6d::Zero());
  for (int axis = 0; axis < 6; ++axis) {
    const double sigma = std::sqrt(prior.covariance(axis, axis));
    const Vector6d step = sigma * Vector6d::Unit(axis);
    EXPECT_NEAR(SquaredSigmas(in_view, PerturbedInView(prior, step), Matrix6d::Zero()), 1, 0.01)
        << axis;
  }
}

TEST(MotionPrior, TheLastPosesDoubtTurnsAboutTheLastCamera) {
  MotionPrior prior = SomePrior();
  prior.T_last_camera = Pose(0, 0, 1, 0, 0, 0);
  prior.covariance = 1e-12 * Matrix6d::Identity();
  Matrix6d last = Matrix6d::Zero();
  last(4, 4) = 0.01 * 0.01;  // about y of the last camera
  const PosePrior in_view = PriorInView(prior, Eigen::Isometry3d::Identity(), last);
  const Eigen::Isometry3d T_turned = Pose(0, 0, 0, 0, 0.01, 0) * in_view.T_view_camera;
  EXPECT_NEAR(SquaredSigmas(in_view, T_turned, Matrix6d::Zero()), 1, 0.01);
}

TEST(MotionPrior, GradientPullsBackToThePriorAndNoFurtherThanItsWeight) {
  const PosePrior prior = PriorInView(SomePrior(), kViewLast, Matrix6d::Zero());
  const Vector6d off = (Vector6d() << 0.003, -0.002, 0.004, 0.001, 0.002, -0.001).finished();
  const PriorTerm term = Linearize(prior, ExpSE3(off) * prior.T_view_camera, 3);
  const Vector6d step = -term.information.ldlt().solve(term.gradient);
  EXPECT_LT((step + off).norm(), 1e-9);
  EXPECT_TRUE(term.information.isApprox(3 * prior.information, 1e-9)) << "near by: full weight";
}

TEST(MotionPrior, FarAwayItPullsLess) {
  const PosePrior prior = PriorInView(SomePrior(), kViewLast, Matrix6d::Zero());
  const auto pull = [&](double metres) {
    return Linearize(prior, Pose(metres, 0, 0, 0, 0, 0) * prior.T_view_camera, 1).gradient.norm();
  };
  EXPECT_LT(pull(2), 0.2 * pull(0.05));
}

TEST(MotionPrior, DirectionsThatTheImagesDoNotSeeContradictNothing) {
  const PosePrior prior = PriorInView(SomePrior(), kViewLast, Matrix6d::Zero());
  const Eigen::Isometry3d T_off = Pose(1, 0, 0, 0, 0, 0) * prior.T_view_camera;
  Matrix6d blind = Matrix6d::Zero();
  EXPECT_GT(SquaredSigmas(prior, T_off, blind), 100);
  blind(0, 0) = 4;  // 2 m along x
  EXPECT_LT(SquaredSigmas(prior, T_off, blind), 1);
}

TEST(OdometryMotion, IsTheMotionSinceTheLastTrackedFrame) {
  OdometryMotion odometry{MotionPriorConfig()};
  const Eigen::Isometry3d first = Pose(5, 3, 0, 0, 0, 2), last = Pose(5.2, 3.1, 0, 0, 0, 2.2);
  odometry.Advance(first);
  odometry.NoteTracked();
  odometry.Advance(Pose(5.1, 3, 0, 0, 0, 2.1));  // not tracked
  odometry.Advance(last);
  const auto prior = odometry.SinceLastTracked();
  ASSERT_TRUE(prior);
  EXPECT_TRUE(prior->T_last_camera.isApprox(first.inverse() * last, 1e-9));
}

TEST(OdometryMotion, DoubtGrowsWithTheWayEvenWhereItComesBack) {
  OdometryMotion odometry{MotionPriorConfig()};
  const Eigen::Isometry3d home = Eigen::Isometry3d::Identity();
  odometry.Advance(home);
  odometry.NoteTracked();
  odometry.Advance(home);
  const Matrix6d standing = odometry.SinceLastTracked()->covariance;
  odometry.Advance(Pose(2, 0, 0, 0, 0, 0));
  odometry.Advance(home);
  const Matrix6d back = odometry.SinceLastTracked()->covariance;
  const MotionPriorConfig config;
  EXPECT_NEAR(std::sqrt(standing(0, 0)), config.sigma_floor_m, 1e-9);
  EXPECT_NEAR(std::sqrt(back(0, 0)), std::hypot(config.sigma_floor_m, 4 * config.sigma_m_per_m),
              1e-9);
  EXPECT_GT(back(5, 5), standing(5, 5));
}

TEST(OdometryMotion, SaysNothingWhereOdometryIsMissingOrOff) {
  const Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  OdometryMotion odometry{MotionPriorConfig()};
  odometry.Advance(pose);
  EXPECT_FALSE(odometry.SinceLastTracked()) << "nothing was tracked yet";
  odometry.NoteTracked();
  odometry.Advance(std::nullopt);
  EXPECT_FALSE(odometry.SinceLastTracked());
  Eigen::Isometry3d broken = pose;
  broken.translation().x() = std::numeric_limits<double>::quiet_NaN();
  odometry.Advance(broken);
  EXPECT_FALSE(odometry.SinceLastTracked());
  odometry.NoteTracked();  // a frame without odometry
  odometry.Advance(pose);
  EXPECT_FALSE(odometry.SinceLastTracked());

  MotionPriorConfig config;
  config.enabled = false;
  OdometryMotion off{config};
  off.Advance(pose);
  off.NoteTracked();
  off.Advance(pose);
  EXPECT_FALSE(off.SinceLastTracked());
}

TEST(PriorTrust, IsLostByAContradictionAndComesBackAfterEnoughAgreement) {
  PriorTrust trust(3);
  EXPECT_TRUE(trust.trusted());
  trust.Note(false);
  trust.Note(true);
  trust.Note(true);
  EXPECT_FALSE(trust.trusted());
  trust.Note(false);
  trust.Note(true);
  trust.Note(true);
  EXPECT_FALSE(trust.trusted()) << "must agree in a row";
  trust.Note(true);
  EXPECT_TRUE(trust.trusted());
}

}  // namespace
}  // namespace posefusion
