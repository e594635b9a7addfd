#include "posefusion/simulation/folder_writer.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/mesh_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/simulation/sim_source.h"
#include "posefusion/skeleton/openpose_json.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::ThrowsMessage;

SimulationConfig ShortRun() {
  SimulationConfig config;
  config.preset = "hrp_loop";
  config.humans = 1;
  config.seconds = 0.2;
  return config;
}

/// Writes the run; `num_frames` < 0 means all of it and closes the folder.
void WriteRun(const std::string& path, const SimulationConfig& config, int num_threads,
              bool force = false, int num_frames = -1) {
  FolderWriter writer(path, force);
  Simulator simulator(config, num_threads);
  for (int i = 0; i != num_frames; ++i) {
    const auto frame = simulator.Next();
    if (!frame) break;
    writer.Write(*frame, simulator);
  }
  if (num_frames < 0) writer.Close(simulator);
}

bool SameBytes(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type() || !a.isContinuous() || !b.isContinuous()) {
    return false;
  }
  return std::equal(a.datastart, a.dataend, b.datastart, b.dataend);
}

/// Contents of all files below a folder, by relative path.
std::map<std::string, std::string> Contents(const std::string& folder) {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    contents[fs::relative(entry.path(), folder).string()] = ReadWholeFile(entry.path().string());
  }
  return contents;
}

TEST(FolderWriter, FolderEqualsStreamByteByByte) {
  const TemporaryFolder folder;
  WriteRun(folder / "run", ShortRun(), 1);
  TumFolderSource from_folder(folder / "run");
  SimSource streamed(ShortRun(), 2);
  ASSERT_EQ(from_folder.NumFrames(), streamed.NumFrames());
  int num_frames = 0;
  while (const auto a = from_folder.Next()) {
    const auto b = streamed.Next();
    ASSERT_TRUE(b);
    EXPECT_EQ(a->stamp_ns, b->stamp_ns);
    EXPECT_EQ(a->depth_stamp_ns, b->depth_stamp_ns);
    EXPECT_EQ(a->camera, b->camera);
    EXPECT_TRUE(SameBytes(a->rgb, b->rgb));
    EXPECT_TRUE(SameBytes(a->depth_m, b->depth_m));
    ++num_frames;
  }
  EXPECT_FALSE(streamed.Next());
  EXPECT_EQ(num_frames, 6);
}

TEST(FolderWriter, WritesTheSameFilesForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  WriteRun(folder / "one", ShortRun(), 1);
  WriteRun(folder / "two", ShortRun(), 2);
  const auto one = Contents(folder / "one");
  EXPECT_EQ(one, Contents(folder / "two"));
  for (const char* name :
       {"rgb.txt", "depth.txt", "camera.yaml", "groundtruth.txt", "groundtruth_body.txt",
        "odometry.txt", "odometry_camera.txt", "imu.txt", "joint_states.txt", "tf.txt",
        "blur.txt", "events.txt", "moved_objects.txt", "people_capsules.txt", "world.ply",
        "simulation.yaml",
        "rgb/1000000000.000000.png", "labels/1000000000.000000.png",
        "keypoints/1000000000.000000.json", "joints/1000000000.000000.json"}) {
    EXPECT_EQ(one.count(name), 1u) << name;
  }
}

TEST(SimSource, WritesTheTruthOfTheFramesGivenOut) {
  const TemporaryFolder folder;
  WriteRun(folder / "run", ShortRun(), 2);
  SimSource source(ShortRun(), 2);
  while (source.Next()) continue;
  source.run()->WriteTruth(folder / "truth");
  const auto whole = Contents(folder / "run");
  const auto truth = Contents(folder / "truth");
  EXPECT_GE(truth.size(), 13u);
  for (const auto& [name, text] : truth) EXPECT_EQ(whole.at(name), text) << name;
}

TEST(FolderWriter, TruthCoversEveryFrame) {
  const TemporaryFolder folder;
  WriteRun(folder / "run", ShortRun(), 2);
  const Trajectory truth = ReadTrajectory(folder / "run/groundtruth.txt");
  EXPECT_EQ(truth.front().stamp_ns, kSimulationStartNs);
  EXPECT_GT(truth.back().stamp_ns, SimulationStamp(0.2));
  EXPECT_NEAR(SecondsBetween(truth[0].stamp_ns, truth[1].stamp_ns), 0.005, 1e-9);
  EXPECT_GT(ReadMesh(folder / "run/world.ply").triangles.size(), 100u);
}

TEST(FolderWriter, JointsAreThoseOfThePeopleInEveryFrame) {
  const TemporaryFolder folder;
  WriteRun(folder / "run", ShortRun(), 2);
  Simulator simulator(ShortRun(), 2);
  while (const auto frame = simulator.Next()) {
    const std::string name = "run/joints/" + FormatStamp(frame->frame.stamp_ns) + ".json";
    EXPECT_EQ(ReadWholeFile(folder / name), ToOpenPoseJson(PerfectKeypoints(frame->people)));
  }
}

TEST(FolderWriter, HandheldCameraHasNoOdometry) {
  const TemporaryFolder folder;
  SimulationConfig config = ShortRun();
  config.preset = "fr3_static";
  config.seconds = 0.1;
  WriteRun(folder / "run", config, 2);
  EXPECT_FALSE(fs::exists(folder / "run/odometry.txt"));
  EXPECT_TRUE(fs::exists(folder / "run/imu.txt"));
}

TEST(FolderWriter, LeavesNothingWithoutClose) {
  const TemporaryFolder folder;
  WriteRun(folder / "run", ShortRun(), 2, false, 1);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(FolderWriter, RefusesAFolderWithSomethingInIt) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "run");
  std::ofstream(folder / "run/notes.txt") << "mine";
  const auto open = [&](bool force) { return [&, force] { FolderWriter(folder / "run", force); }; };
  EXPECT_THAT(open(false), ThrowsMessage<std::runtime_error>(HasSubstr("is not empty")));
  EXPECT_THAT(open(true), ThrowsMessage<std::runtime_error>(HasSubstr("something else")));
  EXPECT_TRUE(fs::exists(folder / "run/notes.txt"));
}

TEST(FolderWriter, ReplacesAnEarlierRunOnlyWhenForcedAndFinished) {
  const TemporaryFolder folder;
  SimulationConfig config = ShortRun();
  config.seconds = 0.1;
  WriteRun(folder / "run", config, 2);
  const auto before = Contents(folder / "run");
  EXPECT_THAT([&] { FolderWriter(folder / "run", false); },
              ThrowsMessage<std::runtime_error>(HasSubstr("--force")));
  config.seed = 2;
  WriteRun(folder / "run", config, 2, true, 1);
  EXPECT_EQ(Contents(folder / "run"), before);
  WriteRun(folder / "run", config, 2, true);
  EXPECT_NE(Contents(folder / "run"), before);
  EXPECT_FALSE(fs::exists(folder / "run.partial"));
  EXPECT_FALSE(fs::exists(folder / "run.old"));
}

TEST(FolderWriter, NamesAPlaceThatCannotBeWritten) {
  EXPECT_THAT([] { FolderWriter("/proc/run", false); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/proc/run: cannot be made")));
}

}  // namespace
}  // namespace posefusion
