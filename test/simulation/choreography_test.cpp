// What people do before the camera: pass close by, and come to a robot that has fallen.

#include "posefusion/simulation/choreography.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "posefusion/simulation/events.h"
#include "posefusion/simulation/person_view.h"
#include "posefusion/simulation/renderer.h"
#include "posefusion/simulation/simulator.h"
#include "test/simulation/turning_head.h"

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

/// Horizontally from the camera to the nearest person's hips.
double NearestPerson(const Rehearsal& run, double time_s) {
  const Eigen::Vector3d camera = run.mover.head->T_map_camera(time_s).translation();
  double nearest = 1e9;
  for (int i = 0; i < run.world.num_people(); ++i) {
    const Eigen::Vector3d hips = run.world.PersonAt(i, time_s).T_map_part[kPelvis].translation();
    nearest = std::min(nearest, (hips - camera).head<2>().norm());
  }
  return nearest;
}

TEST(Choreography, EveryMinuteSomebodyHidesMostOfTheView) {
  constexpr double kNobodyNearer = 0.29;
  constexpr double kClose = 0.5;
  int num_occlusions = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    const Rehearsal run("hrp_loop", 2, seed, 120);
    Renderer renderer(run.world);
    OcclusionRecorder recorder;
    std::array<double, 2> least_static = {1, 1};  // by minute
    for (double t = 0; t < 120; t += kFrameS) {
      const double nearest = NearestPerson(run, t);
      ASSERT_GT(nearest, kNobodyNearer) << "seed " << seed << " at " << t << " s";
      if (nearest > kClose) continue;
      const View view = renderer.RenderDepth(testing::QuarterCamera(),
                                             run.mover.head->T_map_camera(t), t, ParallelRunner(2));
      const double share = StaticShare(view.labels);
      recorder.Add(SimulationStamp(t), share);
      double& least = least_static[t < 60 ? 0 : 1];
      least = std::min(least, share);
    }
    EXPECT_LT(least_static[0], 0.3) << "seed " << seed;
    EXPECT_LT(least_static[1], 0.3) << "seed " << seed;
    num_occlusions += static_cast<int>(recorder.events().size());
  }
  EXPECT_GE(num_occlusions, 2) << "at some seeds hardly anything else is seen";
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
