#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "posefusion/common/atomic_file.h"
#include "test/skeleton/tiny_caffe_network.h"
#include "test/support/program_run.h"
#include "test/support/rendered_folder.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::HasSubstr;

namespace fs = std::filesystem;

std::size_t NumFiles(const std::string& folder, const std::string& extension) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == extension) ++count;
  }
  return count;
}

/// A rendered sequence of ten images in a third of a second, and a network that sees nobody.
class DetectKeypoints : public ::testing::Test {
 protected:
  DetectKeypoints() {
    testing::WriteRenderedFolder(sequence_, 10);
    testing::TinyCaffeNetwork(57).Write(folder_ / "tiny.prototxt", folder_ / "tiny.caffemodel");
  }

  ProgramRun Run(const std::string& more) const {
    return RunProgram(DETECT_KEYPOINTS, sequence_ + " --out " + out_ + " --model " +
                                            folder_.path() + "/tiny.caffemodel --model-config " +
                                            folder_.path() + "/tiny.prototxt --input-size 64 64 " +
                                            more);
  }

  const TemporaryFolder folder_;
  const std::string sequence_ = folder_ / "sequence";
  const std::string out_ = folder_ / "sequence/keypoints";
};

TEST_F(DetectKeypoints, WritesAFilePerImageNamedByItsStamp) {
  const ProgramRun run = Run("");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("10 images, people in 0"));
  EXPECT_EQ(NumFiles(out_, ".json"), 10U);
  EXPECT_EQ(ReadWholeFile(out_ + "/1.000000.json"), "{\"version\":1.3,\"people\":[]}\n");
}

TEST_F(DetectKeypoints, RateThinsOutByStamps) {
  EXPECT_EQ(Run("--rate 10").exit_code, 0);
  EXPECT_NEAR(static_cast<double>(NumFiles(out_, ".json")), 3.5, 0.5);
}

TEST_F(DetectKeypoints, PicturesShowEveryImage) {
  EXPECT_EQ(Run("--pictures " + (folder_ / "drawn")).exit_code, 0);
  EXPECT_EQ(NumFiles(folder_ / "drawn", ".png"), 10U);
}

TEST_F(DetectKeypoints, FolderInUseStaysUnlessForced) {
  ASSERT_EQ(Run("").exit_code, 0);
  std::ofstream(out_ + "/notes.txt") << "mine";
  const ProgramRun refused = Run("--rate 10");
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.output, HasSubstr(out_ + " is not empty"));
  EXPECT_EQ(NumFiles(out_, ".json"), 10U);
  EXPECT_EQ(Run("--rate 10 --force").exit_code, 0);
  EXPECT_LT(NumFiles(out_, ".json"), 5U) << "keypoints of the earlier run are left";
  EXPECT_TRUE(fs::exists(out_ + "/notes.txt"));
}

TEST_F(DetectKeypoints, MissingModelIsNamedAndNothingIsWritten) {
  const ProgramRun run =
      RunProgram(DETECT_KEYPOINTS, sequence_ + " --out " + out_ + " --model /nowhere/pose.pb");
  EXPECT_NE(run.exit_code, 0);
  EXPECT_THAT(run.output, HasSubstr("pose_network.model: /nowhere/pose.pb does not exist"));
  EXPECT_FALSE(fs::exists(out_));
}

}  // namespace
}  // namespace posefusion
