// Somebody who has sat motionless in view from the first frame on is not in the map.

#include <gtest/gtest.h>

#include "posefusion/dataset/ply_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/evaluation/map_evaluation.h"
#include "posefusion/pipeline/offline_run.h"
#include "posefusion/simulation/sim_source.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

constexpr double kSeatedS = 30;
/// As long as people leave something in the map when nobody takes them out.
constexpr double kShortS = 3;
constexpr double kMaxGhostsCm2 = 200;
constexpr double kSomebodyCm2 = 1000;

/// What people left in the map of a run in which one of two sits still (see MakeChoreography).
double GhostsCm2(double seconds, bool remove_people) {
  SimulationConfig simulation;
  simulation.preset = "fr3_xyz";
  simulation.seconds = seconds;
  SimSource source(CheckedConfig(simulation), 2);
  const auto keypoints = source.MakeKeypoints();
  SystemConfig config;
  config.human_removal.enabled = remove_people;
  const OfflineRun run = RunOffline(source, config, 2, {}, keypoints.get());
  const TemporaryFolder folder;
  source.run()->WriteTruth(folder / "truth");
  WritePly(run.map, folder / "map.ply");
  WriteTrajectory(run.trajectory, folder / "trajectory.txt");
  MapEvaluationFiles files;
  files.map = folder / "map.ply";
  files.truth = folder / "truth";
  return EvaluateMapFiles(files).people.value().area_cm2;
}

TEST(SeatedPerson, IsNotInTheMapAfterHalfAMinute) {
  EXPECT_LT(GhostsCm2(kSeatedS, true), kMaxGhostsCm2);
}

TEST(SeatedPerson, WouldBeInTheMapWithoutHumanRemoval) {
  EXPECT_GT(GhostsCm2(kShortS, false), kSomebodyCm2);
}

}  // namespace
}  // namespace posefusion
