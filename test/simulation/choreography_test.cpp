// What people do before the camera: pass close by, and come to a robot that has fallen.

#include "posefusion/simulation/choreography.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "posefusion/simulation/person_view.h"
#include "posefusion/simulation/simulation_config.h"

namespace posefusion {
namespace {

constexpr double kFrameS = 1.0 / 15;

struct Rehearsal {
  explicit Rehearsal(const std::string& preset, int humans, int seed, double seconds)
      : config(CheckedConfig({preset, humans, seed, seconds, {}, {}, {}})),
        mover(MakeMover(config)),
        world(MakeWorldConfig(config, mover)) {}

  /// The greatest share of the picture that one person within `reach_m` covers.
  double Covered(double time_s, double reach_m) const {
    const Eigen::Isometry3d T = mover.head->T_map_camera(time_s);
    double covered = 0;
    for (int i = 0; i < world.num_people(); ++i) {
      const PersonPose person = world.PersonAt(i, time_s);
      const double distance = (person.joints[kNeck] - T.translation()).head<2>().norm();
      if (distance < reach_m) covered = std::max(covered, CoveredShare(person, T));
    }
    return covered;
  }

  SimulationConfig config;
  Mover mover;
  World world;
};

TEST(Choreography, SomebodyComesToTheFallenRobot) {
  for (int seed = 1; seed <= 5; ++seed) {
    const Rehearsal run("hrp_falls", 1, seed, 0);
    int num_visits = 0;
    for (const Fall& fall : run.mover.robot->falls()) {
      if (fall.view != FallView::kPasserBy) continue;
      double covered = 0;
      for (double t = fall.impact_s(); t < fall.raise_s(); t += kFrameS) {
        covered = std::max(covered, run.Covered(t, 2.7));
      }
      EXPECT_GT(covered, 0.03) << "seed " << seed << " at " << fall.start_s << " s";
      ++num_visits;
    }
    EXPECT_GE(num_visits, 1) << "seed " << seed;
  }
}

TEST(Choreography, EveryMinuteSomebodyHidesMostOfTheView) {
  constexpr double kLensToSpine = 0.28;  // nobody walks through the camera
  double most = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    const Rehearsal run("hrp_loop", 2, seed, 120);
    for (double start_s = 0; start_s < 120; start_s += 60) {
      double covered = 0;
      for (double t = start_s; t < start_s + 60; t += kFrameS) {
        covered = std::max(covered, run.Covered(t, 0.7));
        for (int i = 0; i < 2; ++i) {
          const Eigen::Vector3d hips = run.world.PersonAt(i, t).T_map_part[kPelvis].translation();
          const Eigen::Vector3d camera = run.mover.head->T_map_camera(t).translation();
          ASSERT_GT((hips - camera).head<2>().norm(), kLensToSpine) << "seed " << seed << " " << t;
        }
      }
      EXPECT_GT(covered, 0.7) << "seed " << seed << " from " << start_s << " s";
      most = std::max(most, covered);
    }
  }
  EXPECT_GT(most, 0.95) << "at some seeds nothing else is seen";
}

TEST(CoveredShare, IsThatOfTheProjectedBody) {
  PersonPose person;
  person.present = true;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (Capsule& capsule : person.capsules) capsule = {{0, 0, -1}, {0, 0, -1}, 0.1};
  EXPECT_EQ(CoveredShare(person, T), 0) << "behind the camera";
  person.capsules[0] = {{-0.3, 0, 2}, {0.3, 0, 2}, 0.2};  // a lying bar
  const double width = (0.6 * 0.4 + 3.1416 * 0.04) / 4;   // in a distance of 1
  const double picture = (640 * 480) / (525.0 * 525.0);
  EXPECT_NEAR(CoveredShare(person, T), width / picture, 0.02);
  person.capsules[0] = {{0, 0, 0.3}, {0, 0, 0.3}, 0.29};
  EXPECT_EQ(CoveredShare(person, T), 1);
  person.present = false;
  EXPECT_EQ(CoveredShare(person, T), 0);
}

}  // namespace
}  // namespace posefusion
