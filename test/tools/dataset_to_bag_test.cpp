#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "posefusion/common/atomic_file.h"
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

TEST(DatasetToBag, BagThatCannotBeWrittenIsNamedAndExitsWithOne) {
  SKIP_WITHOUT_DATA("fr1_xyz");
  const TemporaryFolder folder;
  EXPECT_EQ(Execute(DataPath("fr1_xyz") + " /nonexistent/a.bag", folder / "log"), 1);
  EXPECT_NE(ReadWholeFile(folder / "log").find("/nonexistent/a.bag"), std::string::npos);
}

}  // namespace
}  // namespace posefusion
