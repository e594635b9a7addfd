#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "posefusion/common/atomic_file.h"
#include "posefusion/dataset/ply_file.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/skeleton/openpose_json.h"
#include "test/support/rendered_folder.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

constexpr int kFrames = 12;

class RunDataset : public ::testing::Test {
 protected:
  void SetUp() override { testing::WriteRenderedFolder(folder_ / "data", kFrames); }

  /// Exit code; what is printed goes into Log().
  int Run(const std::string& arguments) const {
    const std::string command =
        std::string(POSEFUSION_RUN_DATASET) + " " + arguments + " > " + (folder_ / "log") + " 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  int RunInto(const std::string& out, const std::string& options = "") const {
    return Run((folder_ / "data") + " --out " + (folder_ / out) + " " + options);
  }
  bool LogHas(const std::string& text) const {
    return ReadWholeFile(folder_ / "log").find(text) != std::string::npos;
  }
  /// Nobody seen in any frame.
  void WriteKeypoints(const std::string& subfolder) const {
    std::filesystem::create_directories(folder_ / subfolder);
    for (int n = 0; n < kFrames; ++n) {
      const std::string stamp = FormatStamp(1'000'000'000 + n * testing::kRenderedInterval);
      std::ofstream((folder_ / subfolder) + "/" + stamp + ".json") << ToOpenPoseJson({});
    }
  }
  /// The n-th image of data/SUBFOLDER in the order of stamps.
  std::string Image(const std::string& subfolder, int n) const {
    return (folder_ / "data/") + subfolder + "/" +
           FormatStamp(1'000'000'000 + n * testing::kRenderedInterval) + ".png";
  }

  TemporaryFolder folder_;
};

TEST_F(RunDataset, WritesTrajectoriesMapAndReport) {
  ASSERT_EQ(RunInto("out", "--preset ef --threads 2"), 0) << ReadWholeFile(folder_ / "log");
  EXPECT_EQ(ReadTrajectory(folder_ / "out/trajectory.txt").size(), kFrames);
  EXPECT_EQ(ReadTrajectory(folder_ / "out/trajectory_live.txt").size(), kFrames);
  EXPECT_GT(ReadPly(folder_ / "out/map.ply").size(), 1000U);
  const auto report = nlohmann::json::parse(ReadWholeFile(folder_ / "out/report.json"));
  EXPECT_EQ(report["frames"]["total"], kFrames);
  EXPECT_EQ(report["frames"]["tracked"], kFrames);
  EXPECT_EQ(report["frames"]["lost"], 0);
  EXPECT_EQ(report["config"]["blur_filter"]["enabled"], false);
  EXPECT_EQ(report["config"]["mapping"]["tracking"]["so3"]["enabled"], true);
  EXPECT_GT(report["stage_ms"]["track"]["median"], 0);
  EXPECT_GE(report["frame_ms"]["max"], report["frame_ms"]["median"]);
  EXPECT_GT(report["peak_rss_mb"], 1);
  for (const char* key :
       {"keyframes", "loops", "relocalisations", "surfels", "wall_s", "version"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
}

TEST_F(RunDataset, TakesOdometryForPeopleWhereTrackingHasNoUseForIt) {
  WriteTrajectory({{1'000'000'000, Eigen::Isometry3d::Identity()}},
                  folder_ / "data/odometry_camera.txt");
  const auto odometry = [&](const std::string& out) {
    return nlohmann::json::parse(
        ReadWholeFile((folder_ / out) + "/report.json"))["config"]["odometry"];
  };
  ASSERT_EQ(RunInto("nobody", "--preset pf"), 0);
  EXPECT_EQ(odometry("nobody"), "none");
  WriteKeypoints("data/keypoints");
  ASSERT_EQ(RunInto("people", "--preset pf"), 0);
  EXPECT_EQ(odometry("people"), folder_ / "data/odometry_camera.txt");
}

TEST_F(RunDataset, TakesOdometryFromFileOrFolderAndSaysWhatBecameOfIt) {
  Trajectory odometry;
  for (int n = 0; n < kFrames; ++n) {
    odometry.push_back({1'000'000'000 + n * testing::kRenderedInterval, testing::SwayingPose(n)});
  }
  WriteTrajectory(odometry, folder_ / "odometry.txt");
  const auto report = [&](const std::string& out) {
    return nlohmann::json::parse(ReadWholeFile((folder_ / out) + "/report.json"));
  };
  ASSERT_EQ(RunInto("none"), 0);
  EXPECT_EQ(report("none")["config"]["odometry"], "none");
  EXPECT_EQ(report("none")["odometry_prior"]["used"], 0);
  ASSERT_EQ(RunInto("file", "--odometry " + (folder_ / "odometry.txt")), 0);
  EXPECT_EQ(report("file")["config"]["odometry"], folder_ / "odometry.txt");
  EXPECT_EQ(report("file")["odometry_prior"]["used"], kFrames - 1);
  WriteTrajectory(odometry, folder_ / "data/odometry_camera.txt");
  ASSERT_EQ(RunInto("own"), 0);
  EXPECT_EQ(report("own")["odometry_prior"]["used"], kFrames - 1);
  ASSERT_EQ(RunInto("own_off", "--odometry none"), 0);
  EXPECT_EQ(report("own_off")["config"]["odometry"], "none");
  ASSERT_EQ(RunInto("ef", "--preset ef"), 0);
  EXPECT_EQ(report("ef")["config"]["odometry"], "none");
  EXPECT_EQ(RunInto("ef", "--preset ef --odometry " + (folder_ / "odometry.txt")), 1);
  EXPECT_TRUE(LogHas("mapping.tracking.prior.enabled")) << ReadWholeFile(folder_ / "log");
  EXPECT_EQ(RunInto("missing", "--odometry " + (folder_ / "nowhere.txt")), 1);
  EXPECT_TRUE(LogHas("nowhere.txt"));
}

TEST_F(RunDataset, SameBytesTwiceAndForAnyNumberOfThreads) {
  ASSERT_EQ(RunInto("a", "--threads 1"), 0);
  ASSERT_EQ(RunInto("b", "--threads 2"), 0);
  ASSERT_EQ(RunInto("c", "--threads 2"), 0);
  for (const char* file : {"/trajectory.txt", "/trajectory_live.txt", "/map.ply", "/frames.txt"}) {
    EXPECT_EQ(ReadWholeFile((folder_ / "a") + file), ReadWholeFile((folder_ / "b") + file)) << file;
    EXPECT_EQ(ReadWholeFile((folder_ / "b") + file), ReadWholeFile((folder_ / "c") + file)) << file;
  }
}

TEST_F(RunDataset, MasksAreTheSameBytesTwiceAndForAnyNumberOfThreads) {
  const auto run = [&](const std::string& out, const std::string& threads) {
    return Run("\"sim:fr3_xyz?humans=2&seconds=0.4\" --masks --out " + (folder_ / out) +
               " --threads " + threads);
  };
  ASSERT_EQ(run("a", "1"), 0) << ReadWholeFile(folder_ / "log");
  ASSERT_EQ(run("b", "4"), 0);
  ASSERT_EQ(run("c", "4"), 0);
  int num_masks = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "a/masks")) {
    const std::string name = "/masks/" + entry.path().filename().string();
    const std::string mask = ReadWholeFile(entry.path());
    EXPECT_EQ(mask, ReadWholeFile((folder_ / "b") + name)) << name;
    EXPECT_EQ(mask, ReadWholeFile((folder_ / "c") + name)) << name;
    ++num_masks;
  }
  EXPECT_EQ(num_masks, 12);
}

TEST_F(RunDataset, StartAndMaxFramesChooseTheFrames) {
  ASSERT_EQ(RunInto("out", "--start 0.1 --max-frames 4"), 0);
  const Trajectory trajectory = ReadTrajectory(folder_ / "out/trajectory.txt");
  ASSERT_EQ(trajectory.size(), 4U);
  EXPECT_GE(trajectory.front().stamp_ns, 1'099'000'000);
}

TEST_F(RunDataset, ConfigFilesOverrideDefaults) {
  std::ofstream(folder_ / "mine.yaml") << "mapping: {tracking: {icp_weight: 0.25}}\n";
  ASSERT_EQ(RunInto("out", "--config " + (folder_ / "mine.yaml")), 0);
  const auto report = nlohmann::json::parse(ReadWholeFile(folder_ / "out/report.json"));
  EXPECT_EQ(report["config"]["mapping"]["tracking"]["icp_weight"], 0.25);
}

TEST_F(RunDataset, WrongUsageExitsWithTwo) {
  EXPECT_EQ(Run(""), 2);
  EXPECT_EQ(Run(folder_ / "data"), 2);
  EXPECT_EQ(RunInto("out", "--preset nonsense"), 2);
  EXPECT_EQ(RunInto("out", "--threads 0"), 2);
  EXPECT_EQ(RunInto("out", "--max-frames -3"), 2);
  EXPECT_EQ(Run("--help"), 0);
}

TEST_F(RunDataset, NamesWhatIsMissing) {
  EXPECT_EQ(Run("/nonexistent/data --out " + (folder_ / "out")), 1);
  EXPECT_TRUE(LogHas("/nonexistent/data"));
  EXPECT_EQ(Run("/nonexistent/a.bag --out " + (folder_ / "out")), 1);
  EXPECT_TRUE(LogHas("/nonexistent/a.bag"));
  std::filesystem::remove(folder_ / "data/depth.txt");
  EXPECT_EQ(RunInto("out"), 1);
  EXPECT_TRUE(LogHas("depth.txt"));
}

TEST_F(RunDataset, NamesTheKeyOfABadValue) {
  std::ofstream(folder_ / "bad.yaml") << "mapping: {fusion: {spawn_stride_px: 99}}\n";
  EXPECT_EQ(RunInto("out", "--config " + (folder_ / "bad.yaml")), 1);
  EXPECT_TRUE(LogHas("mapping.fusion.spawn_stride_px"));
}

TEST_F(RunDataset, FolderThatCannotBeWrittenIsNamedBeforeTheRun) {
  EXPECT_EQ(Run((folder_ / "data") + " --out /proc/nowhere"), 1);
  EXPECT_TRUE(LogHas("/proc/nowhere"));
}

TEST_F(RunDataset, DamagedImagesAreNamedAndTheRestIsSaved) {
  std::filesystem::resize_file(Image("depth", 4), 500);
  std::filesystem::remove(Image("rgb", 7));
  EXPECT_EQ(RunInto("out"), 1);
  EXPECT_TRUE(LogHas(Image("depth", 4)));
  EXPECT_TRUE(LogHas(Image("rgb", 7)));
  EXPECT_EQ(ReadTrajectory(folder_ / "out/trajectory.txt").size(), kFrames - 2);
  const auto report = nlohmann::json::parse(ReadWholeFile(folder_ / "out/report.json"));
  EXPECT_EQ(report["frames"]["unreadable"], 2);
}

TEST_F(RunDataset, ImageOfAnotherSizeIsNamed) {
  cv::imwrite(Image("rgb", 5), cv::Mat(60, 80, CV_8UC3, cv::Scalar::all(9)));
  EXPECT_EQ(RunInto("out"), 1);
  EXPECT_TRUE(LogHas(Image("rgb", 5)));
  EXPECT_EQ(ReadTrajectory(folder_ / "out/trajectory.txt").size(), kFrames - 1);
}

TEST_F(RunDataset, AllZeroDepthIsLostNotGuessed) {
  for (int n = 5; n < kFrames; ++n) {
    cv::imwrite(Image("depth", n), cv::Mat(120, 160, CV_16UC1, cv::Scalar::all(0)));
  }
  EXPECT_EQ(RunInto("out"), 0);
  EXPECT_EQ(ReadTrajectory(folder_ / "out/trajectory.txt").size(), 5U);
  const auto report = nlohmann::json::parse(ReadWholeFile(folder_ / "out/report.json"));
  EXPECT_EQ(report["frames"]["lost"], kFrames - 5);
}

TEST_F(RunDataset, KeypointsBesideTheImagesAreUsedUnlessNoneAreWanted) {
  WriteKeypoints("data/keypoints");
  const auto arrived = [&](const std::string& options) {
    EXPECT_EQ(RunInto("out", options), 0) << ReadWholeFile(folder_ / "log");
    const auto report = nlohmann::json::parse(ReadWholeFile(folder_ / "out/report.json"));
    return report["keypoints"]["arrived"].get<int>();
  };
  EXPECT_EQ(arrived(""), kFrames);
  EXPECT_EQ(arrived("--keypoints none"), 0);
  EXPECT_EQ(arrived("--keypoint-rate 15"), kFrames / 2);
  EXPECT_EQ(arrived("--keypoint-delay 0.09"), kFrames - 3);
  std::filesystem::rename(folder_ / "data/keypoints", folder_ / "elsewhere");
  EXPECT_EQ(arrived(""), 0);
  EXPECT_EQ(arrived("--keypoints " + (folder_ / "elsewhere")), kFrames);
}

TEST_F(RunDataset, BadKeypointsAreNamedAndTheFramesAreUsed) {
  WriteKeypoints("data/keypoints");
  const std::string bad =
      "data/keypoints/" + FormatStamp(1'000'000'000 + 4 * testing::kRenderedInterval) + ".json";
  std::ofstream(folder_ / bad) << "{\"people\":[{\"pose_keypoints_2d\":[1,2,3]}]}";
  EXPECT_EQ(RunInto("out"), 1);
  EXPECT_TRUE(LogHas(bad + ": pose_keypoints_2d has 3 numbers"));
  EXPECT_EQ(ReadTrajectory(folder_ / "out/trajectory.txt").size(), kFrames);
  const auto report = nlohmann::json::parse(ReadWholeFile(folder_ / "out/report.json"));
  EXPECT_EQ(report["frames"]["unreadable"], 0);
  EXPECT_EQ(report["keypoints"]["arrived"], kFrames - 1);
}

TEST_F(RunDataset, MissingKeypointFolderIsNamedBeforeTheRun) {
  EXPECT_EQ(RunInto("out", "--keypoints /nonexistent/keypoints"), 1);
  EXPECT_TRUE(LogHas("/nonexistent/keypoints"));
}

TEST_F(RunDataset, TopicsAndTfOfAFolderAreRefused) {
  EXPECT_EQ(RunInto("out", "--keypoints topic:/skeletons_in"), 1);
  EXPECT_TRUE(LogHas("topic:/skeletons_in: " + (folder_ / "data") + " is no bag"));
  EXPECT_EQ(RunInto("out", "--odometry tf:odom"), 1);
  EXPECT_TRUE(LogHas("tf:odom: " + (folder_ / "data") + " is no bag"));
}

TEST_F(RunDataset, CtrlCSavesWhatThereIs) {
  // The same few images again and again make a run of minutes.
  std::ofstream rgb_list(folder_ / "data/rgb.txt");
  std::ofstream depth_list(folder_ / "data/depth.txt");
  for (int i = 0; i < 50'000; ++i) {
    const int n = i % (2 * kFrames) < kFrames ? i % kFrames : kFrames - 1 - i % kFrames;
    const std::string stamp = FormatStamp(1'000'000'000 + i * testing::kRenderedInterval);
    rgb_list << stamp << " " << Image("rgb", n).substr((folder_ / "data/").size()) << "\n";
    depth_list << stamp << " " << Image("depth", n).substr((folder_ / "data/").size()) << "\n";
  }
  rgb_list.close();
  depth_list.close();
  const std::string command = "timeout -s INT 5 " + std::string(POSEFUSION_RUN_DATASET) + " " +
                              (folder_ / "data") + " --out " + (folder_ / "out") + " > " +
                              (folder_ / "log") + " 2>&1";
  constexpr int kTimedOut = 124;
  ASSERT_EQ(WEXITSTATUS(std::system(command.c_str())), kTimedOut);
  EXPECT_TRUE(LogHas("interrupted"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/report.json"));
  EXPECT_GT(ReadTrajectory(folder_ / "out/trajectory.txt").size(), 0U);
}

}  // namespace
}  // namespace posefusion
