#include "posefusion/tracking/residual_kernel.h"

#include <gtest/gtest.h>

#include <random>

#include "posefusion/common/lie.h"

namespace posefusion {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr int kSamples = 500;
/// Central differences of sums of floats.
constexpr double kStep = 1e-3;
constexpr double kRelativeTolerance = 0.02;

/// A frame of random points before a model that is one plane with a linear intensity, so that the
/// residuals are smooth in the pose.
class Problem {
 public:
  Problem() {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (auto* values : {&x_, &y_, &z_, &nx_, &ny_, &nz_, &intensity_, &inverse_sigma_}) {
      values->assign(kSamples + 16, 0.0F);
    }
    for (std::size_t i = 0; i < kSamples; ++i) {
      x_[i] = 0.35F * uniform(random);
      y_[i] = 0.25F * uniform(random);
      z_[i] = 1.5F + 0.02F * uniform(random);
      nz_[i] = -1;
      intensity_[i] = 100 + 20 * uniform(random);
      inverse_sigma_[i] = 100 + 20 * uniform(random);
    }
    planes_.Resize(kWidth, kHeight);
    depth_.Resize(kWidth, kHeight);
    pixels_.Resize(kWidth, kHeight);
    const Eigen::Vector3f normal = Eigen::Vector3f(0.1F, -0.15F, -1).normalized();
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        planes_.at(u, v) = {normal.x(), normal.y(), normal.z(), normal.z() * 1.5F};
        depth_.at(u, v) = 1.5F;
        pixels_.at(u, v) = {2.0F * static_cast<float>(u) + 1.5F * static_cast<float>(v), 2, 1.5F,
                            0};
      }
    }
  }

  ResidualInput Input(const Eigen::Isometry3d& T, bool icp, bool intensity) const {
    ResidualInput in{};
    in.x = x_.data();
    in.y = y_.data();
    in.z = z_.data();
    in.nx = nx_.data();
    in.ny = ny_.data();
    in.nz = nz_.data();
    in.intensity = intensity_.data();
    in.inverse_sigma = inverse_sigma_.data();
    in.end = kSamples;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) in.rotation[3 * r + c] = static_cast<float>(T(r, c));
      in.translation[r] = static_cast<float>(T(r, 3));
    }
    in.model_depth_m = depth_.data();
    in.model_planes = planes_.data();
    in.model_intensity = pixels_.data();
    in.width = in.intensity_width = kWidth;
    in.height = in.intensity_height = kHeight;
    in.fx = in.fy = in.intensity_fx = in.intensity_fy = 80;
    in.cx = in.intensity_cx = 31.5F;
    in.cy = in.intensity_cy = 23.5F;
    in.icp_distance_m = in.intensity_distance_m = 1;
    in.icp_cosine = 0.1F;
    in.icp_inverse_scale = in.intensity_inverse_scale = 1;
    in.icp_information = 1;
    in.student_t_dof = 1e9F;  // all weights are one
    in.use_icp = icp;
    in.use_intensity = intensity;
    return in;
  }

  ResidualSums Evaluate(const Eigen::Isometry3d& T, bool icp, bool intensity) const {
    ResidualSums sums;
    AccumulateResiduals(Input(T, icp, intensity), sums);
    return sums;
  }

  /// Half the sum of squares whose gradient the normal equations hold.
  double Cost(const Eigen::Isometry3d& T, bool icp) const {
    const ResidualSums sums = Evaluate(T, icp, !icp);
    return 0.5 * (icp ? sums.icp_weighted_squares : sums.intensity_weighted_squares);
  }

 private:
  std::vector<float> x_, y_, z_, nx_, ny_, nz_, intensity_, inverse_sigma_;
  Grid<ModelPlane> planes_;
  Grid<float> depth_;
  Grid<ModelIntensity> pixels_;
};

Vector6d Unit(int axis) {
  Vector6d unit = Vector6d::Zero();
  unit[axis] = 1;
  return unit;
}

void ExpectAnalyticGradientIsNumeric(bool icp) {
  const Problem problem;
  const Eigen::Isometry3d T =
      ExpSE3((Vector6d() << 0.01, -0.02, 0.015, 0.01, 0.02, -0.015).finished());
  const ResidualSums sums = problem.Evaluate(T, icp, !icp);
  const double* gradient = icp ? sums.icp.b : sums.intensity.b;
  for (int axis = 0; axis < 6; ++axis) {
    const double numeric = (problem.Cost(ExpSE3(kStep * Unit(axis)) * T, icp) -
                            problem.Cost(ExpSE3(-kStep * Unit(axis)) * T, icp)) /
                           (2 * kStep);
    EXPECT_NEAR(gradient[axis], numeric, kRelativeTolerance * std::abs(numeric) + 1) << axis;
  }
}

TEST(ResidualKernel, PointToPlaneGradientIsNumericGradient) {
  ExpectAnalyticGradientIsNumeric(true);
}

TEST(ResidualKernel, PhotometricGradientIsNumericGradient) {
  ExpectAnalyticGradientIsNumeric(false);
}

TEST(ResidualKernel, SamplesBeyondTheEndDoNotCount) {
  const Problem problem;
  ResidualInput in = problem.Input(Eigen::Isometry3d::Identity(), true, true);
  in.end = 13;
  ResidualSums sums;
  AccumulateResiduals(in, sums);
  EXPECT_LE(sums.icp_rows, 13);
  EXPECT_GT(sums.icp_rows, 10);
}

TEST(ResidualKernel, RobustWeightsTameAnOutlier) {
  const Problem problem;
  ResidualInput in = problem.Input(Eigen::Isometry3d::Identity(), true, false);
  in.student_t_dof = 5;
  ResidualSums robust;
  AccumulateResiduals(in, robust);
  in.student_t_dof = 1e9F;
  ResidualSums plain;
  AccumulateResiduals(in, plain);
  EXPECT_LT(robust.icp_weighted_squares, plain.icp_weighted_squares);
}

TEST(ResidualKernel, PointsBehindTheCameraGiveNoRows) {
  const Problem problem;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation().z() = -5;
  const ResidualSums sums = problem.Evaluate(T, true, true);
  EXPECT_EQ(sums.icp_rows, 0);
  EXPECT_EQ(sums.intensity_rows, 0);
}

}  // namespace
}  // namespace posefusion
