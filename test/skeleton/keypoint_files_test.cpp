#include "posefusion/skeleton/keypoint_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "test/skeleton/sample_skeletons.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using testing::WriteText;

class KeypointFilesTest : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
};

TEST_F(KeypointFilesTest, ReadsStampsOfAnyNumberOfDigits) {
  for (const char* name :
       {"1305031102.175304.json", "1305031102.2.json", "1305031103_keypoints.json"}) {
    WriteText(folder_ / name, "");
  }
  WriteText(folder_ / "README.md", "");
  WriteText(folder_ / "settings.json", "");
  const KeypointFiles files = ListKeypointFiles(folder_.path());
  EXPECT_FALSE(files.numbered);
  EXPECT_EQ(files.num_unknown, 1);
  EXPECT_EQ(files.paths.size(), 3U);
  EXPECT_EQ(files.paths.count(1'305'031'102'175'304'000), 1U);
  EXPECT_EQ(files.paths.count(1'305'031'102'200'000'000), 1U);
  EXPECT_EQ(files.paths.count(1'305'031'103'000'000'000), 1U);
}

TEST_F(KeypointFilesTest, ReadsOpenPosesNumbering) {
  WriteText(folder_ / "walk_2_000000000012_keypoints.json", "");
  WriteText(folder_ / "000000000013_keypoints.json", "");
  const KeypointFiles files = ListKeypointFiles(folder_.path());
  EXPECT_TRUE(files.numbered);
  EXPECT_EQ(files.paths.at(12), folder_ / "walk_2_000000000012_keypoints.json");
  EXPECT_EQ(files.paths.count(13), 1U);
}

TEST_F(KeypointFilesTest, RefusesBothKindsTogether) {
  WriteText(folder_ / "1305031102.2.json", "");
  WriteText(folder_ / "walk_000000000012_keypoints.json", "");
  EXPECT_THAT([&] { ListKeypointFiles(folder_.path()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("000000000012_keypoints.json")));
}

TEST_F(KeypointFilesTest, NamesTheFolderThatIsMissing) {
  EXPECT_THAT([&] { ListKeypointFiles("/nonexistent/keypoints"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("/nonexistent/keypoints")));
}

TEST_F(KeypointFilesTest, NamesTheLineOfABadArrival) {
  for (const char* bad : {"1.5", "1.5 x", "1.5 1.6 1.7", "1.5 1.4"}) {
    WriteText(folder_ / "arrival.txt", std::string("# stamp arrival_stamp\n1.0 1.3\n") + bad);
    EXPECT_THAT([&] { ListKeypointFiles(folder_.path()); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("arrival.txt:3")))
        << bad;
  }
}

}  // namespace
}  // namespace posefusion
