// The program evaluate_map, run as its users run it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/mesh_file.h"
#include "posefusion/dataset/people_file.h"
#include "posefusion/dataset/ply_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "test/evaluation/sample_room.h"
#include "test/support/program_run.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::HasSubstr;

class EvaluateMapTest : public ::testing::Test {
 protected:
  EvaluateMapTest() {
    const MapTruth truth = RoomTruth();
    std::filesystem::create_directories(folder_ / "truth");
    std::filesystem::create_directories(folder_ / "run");
    WriteMesh(truth.world, folder_ / "truth/world.ply");
    WriteTrajectory(truth.trajectory, folder_ / "truth/groundtruth.txt");
    WriteFileAtomically(
        folder_ / "truth/camera.yaml",
        "{width: 160, height: 120, fx: 138.6, fy: 138.6, cx: 79.5, cy: 59.5, depth_scale: 5000}");
    WriteTrajectory(truth.trajectory, folder_ / "run/trajectory.txt");
    WritePly(WallMap(0.01F), folder_ / "run/map.ply");
  }

  std::string Files() const {
    return "--map " + (folder_ / "run/map.ply") + " --truth " + (folder_ / "truth");
  }

  TemporaryFolder folder_;
};

TEST_F(EvaluateMapTest, PrintsTheFiguresAndWritesThem) {
  WritePeople({}, folder_ / "truth/people_capsules.txt");
  WriteFileAtomically(folder_ / "truth/events.txt", "0.5 0.9 fall\n");
  const ProgramRun run = RunProgram(EVALUATE_MAP, Files() + " --out " + (folder_ / "a/b"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("completeness"));
  const auto json = nlohmann::json::parse(ReadWholeFile(folder_ / "a/b/map_evaluation.json"));
  EXPECT_NEAR(json.at("surface_error").at("near").at("median_m").get<double>(), 0.01, 1e-5);
  EXPECT_EQ(json.at("completeness").at("ratio").get<double>(), 1);
  EXPECT_EQ(json.at("ghosts").at("people").at("count").get<int>(), 0);
}

TEST_F(EvaluateMapTest, ReadsWhatWasMoved) {
  const std::string options = Files() + " --out " + (folder_ / "out");
  const auto ghosts = [&] {
    EXPECT_EQ(RunProgram(EVALUATE_MAP, options).exit_code, 0);
    const auto json = nlohmann::json::parse(ReadWholeFile(folder_ / "out/map_evaluation.json"));
    return json.at("ghosts").at("off_surface").at("count").get<int>();
  };
  SurfelCloud map = WallMap(0.01F);
  AddSurfel({1, 0.5F, 0.5F}, -Eigen::Vector3f::UnitX(), map);
  WritePly(map, folder_ / "run/map.ply");
  EXPECT_EQ(ghosts(), 1);
  MovedSurfaces screen{"screen", kRoomStartNs + 1'000, kRoomStartNs + 2'000, {}, {}, {}};
  AddRectangle({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, screen.before);
  AddRectangle({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, screen.after);
  WriteMovedObjects({screen}, folder_ / "truth");
  EXPECT_EQ(ghosts(), 0);
}

TEST_F(EvaluateMapTest, OnlyFramesOfTheRunCountAsSeen) {
  WriteFileAtomically(folder_ / "truth/rgb.txt", "1.0 a.png\n1.666667 b.png\n");
  const std::string both = RunProgram(EVALUATE_MAP, Files()).output;
  WriteFileAtomically(folder_ / "run/frames.txt", "1.0 tracked\n1.666667 dropped_blur\n");
  EXPECT_NE(RunProgram(EVALUATE_MAP, Files()).output, both);
}

TEST_F(EvaluateMapTest, ErrorsHaveTheirExitCodes) {
  EXPECT_EQ(RunProgram(EVALUATE_MAP, "").exit_code, 2);
  EXPECT_EQ(RunProgram(EVALUATE_MAP, "--help").exit_code, 0);
  const ProgramRun missing = RunProgram(EVALUATE_MAP, Files() + " --estimate /nowhere.txt");
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.output, HasSubstr("/nowhere.txt: cannot be read"));
  std::filesystem::remove(folder_ / "truth/world.ply");
  const ProgramRun no_world = RunProgram(EVALUATE_MAP, Files());
  EXPECT_EQ(no_world.exit_code, 1);
  EXPECT_THAT(no_world.output, HasSubstr("world.ply: cannot be read"));
}

}  // namespace
}  // namespace posefusion
