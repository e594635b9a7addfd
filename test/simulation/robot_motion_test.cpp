#include "posefusion/simulation/robot_motion.h"

#include <gmock/gmock.h>

#include <map>

#include "posefusion/simulation/simulation_config.h"
#include "test/simulation/motion_statistics.h"

namespace posefusion {
namespace {

Mover MoverOf(const std::string& preset, int seed, double seconds = 0) {
  SimulationConfig config;
  config.preset = preset;
  config.seed = seed;
  config.seconds = seconds;
  return MakeMover(CheckedConfig(config));
}

double HeightAt(const HeadMotion& motion, double time_s) {
  return motion.T_map_camera(time_s).translation().z();
}

double WayOf(const RobotMotion& robot, double seconds) {
  double way_m = 0;
  for (double t = 0; t < seconds; t += 0.1) {
    way_m += (robot.T_map_footprint(t + 0.1).translation() - robot.T_map_footprint(t).translation())
                 .norm();
  }
  return way_m;
}

/// Share of the frames in which the picture's centre moves more than 4 px in an exposure of 12 ms.
double BlurredShare(const HeadMotion& motion, double seconds) {
  constexpr double kHalfExposureS = 0.006;
  constexpr double kFocalPx = 525;
  int num_blurred = 0;
  int num_frames = 0;
  for (double t = 0; t < seconds; t += 1.0 / 30, ++num_frames) {
    const Eigen::Vector3d turn =
        LogSO3(motion.T_map_camera(t - kHalfExposureS).linear().transpose() *
               motion.T_map_camera(t + kHalfExposureS).linear());
    if (kFocalPx * turn.head<2>().norm() > 4) ++num_blurred;
  }
  return static_cast<double>(num_blurred) / num_frames;
}

class RobotPresets : public testing::TestWithParam<const char*> {};

TEST_P(RobotPresets, CarryTheCameraAtHeadHeightWhileWalking) {
  const Mover mover = MoverOf(GetParam(), 2, 20);
  const auto& falls = mover.robot->falls();
  const double until_s = falls.empty() ? 20 : falls.front().start_s;
  for (double t = 0; t < until_s; t += 0.05) {
    ASSERT_NEAR(HeightAt(*mover.head, t), 1.48, 0.06) << t;
  }
}

TEST_P(RobotPresets, MoveSmoothly) {
  const Mover mover = MoverOf(GetParam(), 2, 20);
  const double coarse = LargestVelocityStep(*mover.head, 20, 1e-3);
  const double fine = LargestVelocityStep(*mover.head, 20, 1e-4);
  EXPECT_LT(fine, 0.25 * coarse);
}

TEST_P(RobotPresets, StayClearOfFurniture) {
  for (int seed = 1; seed <= 4; ++seed) {
    const SimulationPreset& preset = FindPreset(GetParam());
    const Mover mover = MoverOf(GetParam(), seed);
    const auto obstacles = FloorObstacles(preset.room);
    for (double t = 0; t < preset.seconds; t += 0.1) {
      const Eigen::Vector2d p = mover.robot->T_map_footprint(t).translation().head<2>();
      for (const auto& box : obstacles) {
        ASSERT_GT(box.exteriorDistance(p), 0.2)
            << "seed " << seed << " at " << t << " s: " << p.transpose();
      }
    }
  }
}

TEST_P(RobotPresets, DependOnTheSeedAlone) {
  const auto at = [](const Mover& mover) { return mover.head->T_map_camera(7.5).matrix(); };
  EXPECT_EQ(at(MoverOf(GetParam(), 5, 20)), at(MoverOf(GetParam(), 5, 20)));
  EXPECT_GT((at(MoverOf(GetParam(), 5, 20)) - at(MoverOf(GetParam(), 6, 20))).norm(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, RobotPresets,
                         testing::Values("hrp_loop", "hrp_room", "hrp_falls", "corridor"));

// Table I of the paper: 3.1 and 5.2 % of the frames of HRP-4's recordings were too blurred.
TEST(RobotMotion, ShakesAsMuchAsTheRealRobot) {
  double share = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    share += BlurredShare(*MoverOf("hrp_loop", seed, 40).head, 40) / 4;
  }
  EXPECT_GT(share, 0.02);
  EXPECT_LT(share, 0.055);
}

TEST(RobotMotion, WalksStopsAndTurnsInPlace) {
  const Mover mover = MoverOf("hrp_room", 1);
  double standing_s = 0;
  double turning_s = 0;
  constexpr double kStepS = 0.1;
  for (double t = 0; t < 100; t += kStepS) {
    const Eigen::Isometry3d step =
        mover.robot->T_map_footprint(t).inverse() * mover.robot->T_map_footprint(t + kStepS);
    const double speed = step.translation().norm() / kStepS;
    const double turn_rate = LogSO3(step.linear()).norm() / kStepS;
    EXPECT_LT(speed, 0.45);
    EXPECT_LT(turn_rate, 0.5);
    if (speed < 0.01) (turn_rate > 0.1 ? turning_s : standing_s) += kStepS;
  }
  EXPECT_GT(standing_s, 3);
  EXPECT_GT(turning_s, 5);
}

TEST(RobotMotion, GoesThroughTheCorridorAndBack) {
  const Mover mover = MoverOf("corridor", 1);
  const double seconds = FindPreset("corridor").seconds;
  EXPECT_GE(WayOf(*mover.robot, seconds), 60);
  const auto place = [&](double t) -> Eigen::Vector3d {
    return mover.robot->T_map_footprint(t).translation();
  };
  EXPECT_LT((place(seconds) - place(0)).norm(), 0.3);
}

TEST(RobotMotion, FallsByAboutAMetreInLessThanASecond) {
  for (int seed = 1; seed <= 4; ++seed) {
    const Mover mover = MoverOf("hrp_falls", seed);
    ASSERT_GE(mover.robot->falls().size(), 2u);
    for (const Fall& fall : mover.robot->falls()) {
      double drop = 0;
      for (double t = fall.start_s; t < fall.start_s + 0.2; t += 0.01) {
        drop = std::max(drop, HeightAt(*mover.head, t) - HeightAt(*mover.head, t + 0.7));
      }
      EXPECT_GT(drop, 0.8);
      EXPECT_LT(drop, 1.4);
      EXPECT_GE(fall.lying_s, 2);
      EXPECT_LE(fall.lying_s, 4);
      for (double t = fall.start_s; t < fall.standing_s(); t += 0.02) {
        EXPECT_GT(HeightAt(*mover.head, t), 0.1) << "through the floor";
      }
    }
  }
}

TEST(RobotMotion, LiesFacingFloorWallOrPasserBy) {
  constexpr double kDownwards = -0.5;  // z of the line of sight
  constexpr double kLevel = 0.5;
  std::map<FallView, int> count;
  for (int seed = 1; seed <= 6; ++seed) {
    const Mover mover = MoverOf("hrp_falls", seed);
    for (const Fall& fall : mover.robot->falls()) {
      ++count[fall.view];
      const double slope = mover.head->T_map_camera(fall.raise_s() - 0.5).linear()(2, 2);
      if (fall.view == FallView::kFloor) {
        EXPECT_LT(slope, kDownwards) << "seed " << seed << " at " << fall.start_s;
      } else {
        EXPECT_LT(std::abs(slope), kLevel) << "seed " << seed << " at " << fall.start_s;
      }
    }
  }
  for (const FallView view : {FallView::kFloor, FallView::kWall, FallView::kPasserBy}) {
    EXPECT_GE(count[view], 5);
  }
}

TEST(RobotMotion, StandsElsewhereAfterAFall) {
  const Mover mover = MoverOf("hrp_falls", 1);
  const Fall& fall = mover.robot->falls().front();
  const Eigen::Isometry3d moved = mover.robot->T_map_footprint(fall.carry_s() - 0.3).inverse() *
                                  mover.robot->T_map_footprint(fall.standing_s());
  EXPECT_GT(LogSO3(moved.linear()).norm(), 0.5);
  EXPECT_LT(moved.translation().norm(), 0.5);
  EXPECT_NEAR(HeightAt(*mover.head, fall.standing_s() + 0.9), 1.49, 0.04);
}

TEST(RobotModel, ChainEndsAtTheCameraLookingAhead) {
  const Eigen::Isometry3d T = T_body_camera({});
  EXPECT_NEAR(T.translation().z() + kBodyHeightM, 1.5, 1e-9);
  EXPECT_TRUE(T.linear().col(2).isApprox(Eigen::Vector3d::UnitX()));   // z is forward
  EXPECT_TRUE(T.linear().col(1).isApprox(-Eigen::Vector3d::UnitZ()));  // y is down
  EXPECT_LT(T_body_camera({0, 0.3}).linear().col(2).z(), -0.2);        // pitch is down
  EXPECT_GT(T_body_camera({0.3, 0}).linear().col(2).y(), 0.2);         // yaw is to the left
}

}  // namespace
}  // namespace posefusion
