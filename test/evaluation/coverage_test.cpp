#include "posefusion/evaluation/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/evaluation/sample_trajectories.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Coverage, OfFramesCountsThoseWithAPose) {
  const Trajectory all = WavyTrajectory(100);
  const Trajectory estimate(all.begin(), all.begin() + 80);
  const Coverage coverage = CoverageOfFrames(estimate, StampsOf(all), {});
  EXPECT_EQ(coverage.num_expected, 100);
  EXPECT_EQ(coverage.num_covered, 80);
  EXPECT_DOUBLE_EQ(coverage.Ratio(), 0.8);
  EXPECT_EQ(coverage.basis, CoverageBasis::kFrames);
}

TEST(Coverage, ExpectsNothingInsideExcludedIntervals) {
  const Trajectory all = WavyTrajectory(100);
  const Trajectory estimate(all.begin(), all.begin() + 80);
  const StampInterval fall{all[80].stamp_ns, all[89].stamp_ns, "fall"};
  const Coverage coverage = CoverageOfFrames(estimate, StampsOf(all), {fall});
  EXPECT_EQ(coverage.num_expected, 90);
  EXPECT_EQ(coverage.num_covered, 80);
}

TEST(Coverage, OfCountsLeavesOutDroppedFrames) {
  const Coverage coverage = CoverageOfCounts(WavyTrajectory(80), {100, 20});
  EXPECT_DOUBLE_EQ(coverage.Ratio(), 1.0);
}

TEST(Coverage, OfTheTruthSeesGapsLongerThanATenthOfASecond) {
  const Trajectory truth = WavyTrajectory(300);
  Trajectory estimate(truth.begin(), truth.begin() + 200);
  EXPECT_NEAR(CoverageOfTruth(estimate, truth, {}).Ratio(), 203.0 / 300, 0.004);
  estimate.erase(estimate.begin() + 50, estimate.begin() + 54);  // dropped as blurred
  EXPECT_NEAR(CoverageOfTruth(estimate, truth, {}).Ratio(), 203.0 / 300, 0.004);
  EXPECT_EQ(CoverageOfTruth({}, truth, {}).Ratio(), 0);
}

TEST(Coverage, ReadsListsOfFramesWithAndWithoutState) {
  const TemporaryFolder folder;
  WriteFileAtomically(folder / "frames.txt", "# a\n1.0 tracked\n2.0 dropped_blur\n3.0\n4.0 lost\n");
  EXPECT_EQ(ReadExpectedFrames(folder / "frames.txt").size(), 3U);
  WriteFileAtomically(folder / "frames.txt", "1.0 rgb/1.0.png\nx\n");
  EXPECT_THAT([&] { ReadExpectedFrames(folder / "frames.txt"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("frames.txt:2: expected")));
}

TEST(Coverage, ReadsTheCountsOfAReport) {
  const TemporaryFolder folder;
  const std::string path = folder / "report.json";
  EXPECT_FALSE(ReadFrameCounts(path));
  WriteFileAtomically(path, R"({"frames": {"total": 300, "dropped_blur": 7, "lost": 1}})");
  EXPECT_EQ(ReadFrameCounts(path)->total, 300);
  EXPECT_EQ(ReadFrameCounts(path)->dropped_blur, 7);
  for (const char* text : {"{", "{}", R"({"frames": {"total": "many"}})"}) {
    WriteFileAtomically(path, text);
    EXPECT_THAT([&] { ReadFrameCounts(path); },
                ThrowsMessage<std::runtime_error>(HasSubstr(path + ": no frame counts")));
  }
}

}  // namespace
}  // namespace posefusion
