#include "posefusion/evaluation/blur_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/program_run.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::HasSubstr;

constexpr StampNs kTenthNs = 100'000'000;

/// One frame every tenth of a second.
std::vector<JudgedFrame> Frames(const std::vector<std::pair<double, bool>>& lengths_and_drops) {
  std::vector<JudgedFrame> frames;
  for (const auto& [length_px, dropped] : lengths_and_drops) {
    frames.push_back({static_cast<StampNs>(frames.size()) * kTenthNs, length_px, dropped});
  }
  return frames;
}

TEST(BlurEvaluation, CountsBlurredAndSharpFramesInAndOutsideEvents) {
  const auto frames = Frames({{0, false}, {4, true}, {5, true}, {9, false}, {8, true}, {1, false}});
  const BlurEvaluation evaluation = EvaluateBlur(frames, {{200'000'000, 350'000'000, "fall"}}, {});
  EXPECT_EQ(evaluation.all.num_blurred, 3);
  EXPECT_EQ(evaluation.all.num_found, 2);
  EXPECT_EQ(evaluation.all.num_sharp, 3);
  EXPECT_EQ(evaluation.all.num_false, 1);
  EXPECT_DOUBLE_EQ(evaluation.all.Recall(), 2.0 / 3);
  EXPECT_DOUBLE_EQ(evaluation.all.FalseShare(), 1.0 / 3);
  EXPECT_EQ(evaluation.in_events.num_blurred, 2);
  EXPECT_EQ(evaluation.in_events.num_found, 1);
  EXPECT_EQ(evaluation.outside_events.num_blurred, 1);
  EXPECT_EQ(evaluation.outside_events.num_sharp, 3);
}

TEST(BlurEvaluation, NothingBlurredMeansNothingMissed) {
  EXPECT_EQ(EvaluateBlur({}, {}, {}).all.Recall(), 1);
  EXPECT_EQ(EvaluateBlur({}, {}, {}).all.FalseShare(), 0);
}

TEST(BlurEvaluation, LongestStillDropLastsUntilTheNextFrame) {
  // Two still frames dropped, then one that moves, then one still frame.
  const auto frames =
      Frames({{0, false}, {0.5, true}, {1, true}, {3, true}, {0, true}, {0, false}});
  EXPECT_DOUBLE_EQ(EvaluateBlur(frames, {}, {}).longest_still_drop_s, 0.2);
  EXPECT_EQ(EvaluateBlur(Frames({{9, true}, {0, false}}), {}, {}).longest_still_drop_s, 0);
}

class EvaluateBlurTest : public ::testing::Test {
 protected:
  EvaluateBlurTest() {
    WriteFileAtomically(folder_ / "blur.txt", "# stamp blur_px\n1.0 0.2\n1.1 7.5\n1.2 6.1\n");
    WriteFileAtomically(folder_ / "frames.txt", "1.0 tracked\n1.1 dropped_blur\n1.2 lost\n");
  }

  std::string Files() const {
    return "--truth " + folder_.path() + " --frames " + (folder_ / "frames.txt");
  }

  TemporaryFolder folder_;
};

TEST_F(EvaluateBlurTest, PrintsTheFiguresAndWritesThem) {
  WriteFileAtomically(folder_ / "events.txt", "1.05 1.15 fall\n");
  const ProgramRun run = RunProgram(EVALUATE_BLUR, Files() + " --out " + (folder_ / "a/b"));
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, HasSubstr("50.0%"));
  const auto json = nlohmann::json::parse(ReadWholeFile(folder_ / "a/b/blur_evaluation.json"));
  EXPECT_EQ(json.at("recall").get<double>(), 0.5);
  EXPECT_EQ(json.at("in_events").at("recall").get<double>(), 1);
  EXPECT_EQ(json.at("outside_events").at("recall").get<double>(), 0);
  EXPECT_EQ(json.at("settings").at("blurred_px").get<double>(), 4);
}

TEST_F(EvaluateBlurTest, FramesThatTheRunDidNotHaveAreLeftOut) {
  WriteFileAtomically(folder_ / "frames.txt", "1.1 dropped_blur\n");
  EXPECT_EQ(ReadJudgedFrames(folder_ / "blur.txt", folder_ / "frames.txt").size(), 1U);
}

TEST_F(EvaluateBlurTest, SaysWhichFileAndLineIsWrong) {
  WriteFileAtomically(folder_ / "frames.txt", "1.0 tracked\n1.5 tracked\n");
  const ProgramRun other_run = RunProgram(EVALUATE_BLUR, Files());
  EXPECT_EQ(other_run.exit_code, 1);
  EXPECT_THAT(other_run.output, HasSubstr("frames.txt:2: "));
  WriteFileAtomically(folder_ / "blur.txt", "1.0 short\n");
  EXPECT_THAT(RunProgram(EVALUATE_BLUR, Files()).output, HasSubstr("blur.txt:1: expected"));
  EXPECT_EQ(RunProgram(EVALUATE_BLUR, "").exit_code, 2);
}

}  // namespace
}  // namespace posefusion
