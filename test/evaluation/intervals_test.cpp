#include "posefusion/evaluation/intervals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Intervals, ReadsEventsWithNames) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder / "events.txt", "# events\n1.5 2.5 fall forward\n10 11\n");
  const auto intervals = ReadIntervals(folder / "events.txt");
  ASSERT_EQ(intervals.size(), 2U);
  EXPECT_EQ(intervals[0].begin_ns, 1'500'000'000);
  EXPECT_EQ(intervals[0].end_ns, 2'500'000'000);
  EXPECT_EQ(intervals[0].name, "fall forward");
  EXPECT_EQ(intervals[1].name, "");
}

TEST(Intervals, NamesFileAndLineOfWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string path = folder / "events.txt";
  for (const char* line : {"1.5", "2.5 1.5 backwards", "a b c"}) {
    WriteFileAtomically(path, std::string("1 2 good\n") + line + "\n");
    EXPECT_THAT([&] { ReadIntervals(path); },
                ThrowsMessage<std::runtime_error>(HasSubstr(path + ":2: expected")));
  }
}

TEST(Intervals, EndsBelongToThem) {
  const std::vector<StampInterval> intervals = {{10, 20, "a"}, {40, 50, "b"}};
  EXPECT_TRUE(IsInside(10, intervals));
  EXPECT_TRUE(IsInside(50, intervals));
  EXPECT_FALSE(IsInside(21, intervals));
  EXPECT_TRUE(Overlaps(0, 100, intervals));
  EXPECT_TRUE(Overlaps(15, 16, intervals));
  EXPECT_FALSE(Overlaps(21, 39, intervals));
  EXPECT_FALSE(Overlaps(0, 100, {}));
}

}  // namespace
}  // namespace posefusion
