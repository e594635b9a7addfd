#include "posefusion/dataset/people_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(PeopleFile, RoundTripKeepsTenthsOfMillimetres) {
  const TemporaryFolder folder;
  const std::vector<PeopleAtStamp> people = {
      {1'000'000'000, {{1, 2, {0.5F, -1, 2}, {3, 4, 5}, 0.25F}, {2, 0, {1, 1, 1}, {2, 2, 2}, 1}}},
      {1'033'333'333, {{1, 2, {0.5F, -1, 2.125F}, {3, 4, 5}, 0.25F}}}};
  WritePeople(people, folder / "people.txt");
  const auto read = ReadPeople(folder / "people.txt");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[1].stamp_ns, 1'033'333'333);
  ASSERT_EQ(read[0].capsules.size(), 2U);
  EXPECT_EQ(read[0].capsules[0].person, 1);
  EXPECT_EQ(read[0].capsules[0].part, 2);
  EXPECT_EQ(read[0].capsules[0].begin_m, Eigen::Vector3f(0.5F, -1, 2));
  EXPECT_EQ(read[0].capsules[0].end_m, Eigen::Vector3f(3, 4, 5));
  EXPECT_EQ(read[1].capsules[0].begin_m.z(), 2.125F);
  EXPECT_EQ(read[0].capsules[1].radius_m, 1);
}

TEST(PeopleFile, RunWithoutPeopleIsEmpty) {
  const TemporaryFolder folder;
  WritePeople({}, folder / "people.txt");
  EXPECT_TRUE(ReadPeople(folder / "people.txt").empty());
}

TEST(PeopleFile, NamesFileAndLineOfAnythingElse) {
  const TemporaryFolder folder;
  const std::string path = folder / "people.txt";
  for (const char* line : {"1.0 1 1 0 0 0 1 1 1", "1.0 1 1 0 0 0 1 1 1 0.5 7",
                           "x 1 1 0 0 0 1 1 1 1", "1.0 1 1 0 0 0 1 1 nan 1", "1.0 head"}) {
    WriteFileAtomically(path, std::string("# comment\n\n") + line + "\n");
    EXPECT_THAT([&] { ReadPeople(path); },
                ThrowsMessage<std::runtime_error>(HasSubstr(path + ":3: expected")))
        << line;
  }
}

}  // namespace
}  // namespace posefusion
