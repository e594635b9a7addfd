#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "posefusion/common/atomic_file.h"
#include "posefusion/skeleton/openpose_json.h"
#include "test/support/rendered_folder.h"
#include "test/support/temporary_folder.h"
#include "test/support/test_data.h"

namespace posefusion {
namespace {

/// Exit code of dataset_to_bag; what it prints goes into `log`.
int Execute(const std::string& arguments, const std::string& log) {
  const std::string command =
      std::string(POSEFUSION_DATASET_TO_BAG) + " " + arguments + " > " + log + " 2>&1";
  return WEXITSTATUS(std::system(command.c_str()));
}

TEST(DatasetToBag, WrongUsageExitsWithTwo) {
  const TemporaryFolder folder;
  EXPECT_EQ(Execute("", folder / "log"), 2);
  EXPECT_EQ(Execute("a b c", folder / "log"), 2);
  EXPECT_EQ(Execute("--help", folder / "log"), 0);
}

TEST(DatasetToBag, MissingFolderIsNamedAndExitsWithOne) {
  const TemporaryFolder folder;
  EXPECT_EQ(Execute("/nonexistent/run " + (folder / "a.bag"), folder / "log"), 1);
  EXPECT_NE(ReadWholeFile(folder / "log").find("/nonexistent/run"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.bag"));
}

TEST(DatasetToBag, KeypointsComeInAtTheirArrival) {
  const TemporaryFolder folder;
  testing::WriteRenderedFolder(folder / "data", 3);
  std::filesystem::create_directories(folder / "keypoints");
  std::ofstream(folder / "keypoints/1.0.json") << ToOpenPoseJson({Skeleton{}});
  std::ofstream(folder / "keypoints/arrival.txt") << "1.0 1.5\n";
  const std::string arguments =
      (folder / "data ") + (folder / "a.bag") + " --keypoints " + (folder / "keypoints");
  ASSERT_EQ(Execute(arguments, folder / "log"), 0) << ReadWholeFile(folder / "log");
  const rosbag::Bag bag(folder / "a.bag");
  rosbag::View view(bag, rosbag::TopicQuery("/skeletons_in"));
  ASSERT_EQ(view.size(), 1U);
  EXPECT_EQ(view.begin()->getTime(), ros::Time(1, 500'000'000));

  EXPECT_EQ(Execute((folder / "data ") + (folder / "b.bag") + " --keypoints /nonexistent/keypoints",
                    folder / "log"),
            1);
  EXPECT_NE(ReadWholeFile(folder / "log").find("/nonexistent/keypoints"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "b.bag"));
}

TEST(DatasetToBag, BagThatCannotBeWrittenIsNamedAndExitsWithOne) {
  SKIP_WITHOUT_DATA("fr1_xyz");
  const TemporaryFolder folder;
  EXPECT_EQ(Execute(DataPath("fr1_xyz") + " /nonexistent/a.bag", folder / "log"), 1);
  EXPECT_NE(ReadWholeFile(folder / "log").find("/nonexistent/a.bag"), std::string::npos);
}

}  // namespace
}  // namespace posefusion
