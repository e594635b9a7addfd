#include "posefusion/simulation/handheld_motion.h"

#include <gmock/gmock.h>

#include "test/simulation/motion_statistics.h"

namespace posefusion {
namespace {

constexpr double kSeconds = 30;
constexpr int kNumSeeds = 6;

/// Speeds of a recording of the TUM RGB-D benchmark (ground truth of freiburg3_walking_*), from
/// differences over 0.1 s.
struct Recorded {
  HandheldKind kind;
  SpeedStatistics speeds;
};

class HandheldSpeeds : public testing::TestWithParam<Recorded> {};

TEST_P(HandheldSpeeds, AreThoseOfTheRecording) {
  SpeedStatistics mean;
  for (int seed = 1; seed <= kNumSeeds; ++seed) {
    const auto speeds = SpeedsOf(HandheldMotion(GetParam().kind, seed, kSeconds), kSeconds);
    mean.median_m_s += speeds.median_m_s / kNumSeeds;
    mean.p95_m_s += speeds.p95_m_s / kNumSeeds;
    mean.median_deg_s += speeds.median_deg_s / kNumSeeds;
    mean.p95_deg_s += speeds.p95_deg_s / kNumSeeds;
  }
  const SpeedStatistics& recorded = GetParam().speeds;
  const auto near = [](double value) { return testing::DoubleNear(value, 0.2 * value); };
  EXPECT_THAT(mean.median_m_s, near(recorded.median_m_s));
  EXPECT_THAT(mean.p95_m_s, near(recorded.p95_m_s));
  EXPECT_THAT(mean.median_deg_s, near(recorded.median_deg_s));
  EXPECT_THAT(mean.p95_deg_s, near(recorded.p95_deg_s));
}

INSTANTIATE_TEST_SUITE_P(Fr3, HandheldSpeeds,
                         testing::Values(Recorded{HandheldKind::kStatic, {0.015, 0.039, 3.3, 9.1}},
                                         Recorded{HandheldKind::kXyz, {0.228, 0.371, 10.0, 23.0}},
                                         Recorded{HandheldKind::kRpy, {0.068, 0.353, 23.3, 50.3}},
                                         Recorded{HandheldKind::kHalfsphere,
                                                  {0.248, 0.445, 17.2, 58.5}}));

class HandheldKinds : public testing::TestWithParam<HandheldKind> {};

TEST_P(HandheldKinds, MoveSmoothly) {
  const HandheldMotion motion(GetParam(), 3, kSeconds);
  const double coarse = LargestVelocityStep(motion, kSeconds, 2e-3);
  const double fine = LargestVelocityStep(motion, kSeconds, 2e-4);
  EXPECT_LT(fine, 0.2 * coarse);
  EXPECT_LT(coarse, 0.02);  // m/s: 10 m/s2
}

TEST_P(HandheldKinds, DependOnTheSeedAlone) {
  const HandheldMotion motion(GetParam(), 3, kSeconds);
  const HandheldMotion same(GetParam(), 3, kSeconds);
  const HandheldMotion other(GetParam(), 4, kSeconds);
  const auto at = [](const HandheldMotion& m) { return m.T_map_camera(7.5).matrix(); };
  EXPECT_EQ(at(motion), at(same));
  EXPECT_GT((at(motion) - at(other)).norm(), 1e-3);
}

TEST_P(HandheldKinds, StayInTheFreePartOfTheRoom) {
  for (int seed = 1; seed <= kNumSeeds; ++seed) {
    const HandheldMotion motion(GetParam(), seed, kSeconds);
    for (double t = 0; t < kSeconds; t += 0.1) {
      const Eigen::Vector3d p = motion.T_map_camera(t).translation();
      ASSERT_GT(p.x(), -2.5);
      ASSERT_LT(p.x(), 0.6);
      ASSERT_LT(std::abs(p.y()), 1.5);
      ASSERT_GT(p.z(), 0.85);  // above the table
      ASSERT_LT(p.z(), 2.4);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, HandheldKinds,
                         testing::Values(HandheldKind::kStatic, HandheldKind::kXyz,
                                         HandheldKind::kRpy, HandheldKind::kHalfsphere));

TEST(LookAt, PutsTheTargetOnTheOpticalAxisWithTheHorizonLevel) {
  const Eigen::Isometry3d T = LookAt({1, 2, 1.5}, {-1, 0, 0.5});
  const Eigen::Vector3d target = T.inverse() * Eigen::Vector3d(-1, 0, 0.5);
  EXPECT_NEAR(target.head<2>().norm(), 0, 1e-12);
  EXPECT_GT(target.z(), 0);
  EXPECT_NEAR(T.linear().col(0).z(), 0, 1e-12);
  EXPECT_LT(T.linear().col(1).z(), 0);  // y is down
  EXPECT_NEAR(T.linear().determinant(), 1, 1e-12);
}

}  // namespace
}  // namespace posefusion
