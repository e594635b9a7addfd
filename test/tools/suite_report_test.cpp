#include "tools/suite_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

JobOutcome Outcome(const std::string& preset, int seed, const Figures& figures) {
  JobOutcome outcome;
  outcome.job.name = "run";
  outcome.job.source_template = "sim:x?seed={seed}";
  outcome.job.source = "sim:x?seed=" + std::to_string(seed);
  outcome.job.preset = preset;
  outcome.job.seed = seed;
  outcome.result.state = JobState::kDone;
  outcome.figures = figures;
  return outcome;
}

TEST(SuiteReport, FiguresOfAllFilesHaveFlatKeys) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "live");
  WriteFileAtomically(folder / "report.json", R"({"frames": {"total": 9}, "version": "1"})");
  WriteFileAtomically(folder / "evaluation.json", R"({"a": {"b": {"c": 0.5}}, "list": [1, 2]})");
  WriteFileAtomically(folder / "live/evaluation.json", R"({"a": true})");
  WriteFileAtomically(folder / "map_evaluation.json", R"({"none": null})");
  const Figures expected = {{"report.frames.total", 9},
                            {"report.version", "1"},
                            {"trajectory.a.b.c", 0.5},
                            {"trajectory.list.count", 2},
                            {"live.a", true}};
  EXPECT_EQ(ReadFigures(folder.path()), expected);
  WriteFileAtomically(folder / "report.json", "{");
  EXPECT_THAT([&] { ReadFigures(folder.path()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("report.json: is no JSON object")));
}

TEST(SuiteReport, AggregatesAreMedianAndMaximumOverTheSeeds) {
  std::vector<JobOutcome> outcomes = {
      Outcome("ef", 1, {{"ate", 3}, {"text", "a"}}), Outcome("default", 1, {{"ate", 7}}),
      Outcome("ef", 2, {{"ate", 1}}), Outcome("ef", 3, {{"ate", 5.5}, {"loops", 2}})};
  outcomes.push_back(Outcome("ef", 4, {{"ate", 100}}));
  outcomes.back().result.state = JobState::kFailed;
  const auto aggregates = Aggregate(outcomes);
  ASSERT_EQ(aggregates.size(), 2U);
  EXPECT_EQ(aggregates[0].preset, "ef");
  EXPECT_EQ(aggregates[0].num_jobs, 4);
  EXPECT_EQ(aggregates[0].num_done, 3);
  const FigureSummary& ate = aggregates[0].figures.at("ate");
  EXPECT_EQ(ate.count, 3);
  EXPECT_EQ(ate.median, 3);
  EXPECT_EQ(ate.max, 5.5);
  EXPECT_EQ(aggregates[0].figures.at("loops").count, 1);
  EXPECT_EQ(aggregates[0].figures.count("text"), 0U);
  EXPECT_EQ(aggregates[1].figures.at("ate").median, 7);
  EXPECT_THAT(SummaryCsv(aggregates), HasSubstr("run,sim:x?seed={seed},ef,ate,3,3.0,5.5\n"));
}

TEST(SuiteReport, CsvHasAColumnForEveryFigureOfAnyJob) {
  std::vector<JobOutcome> outcomes = {Outcome("ef", 1, {{"b", 0.25}, {"text", "say \"a, b\""}}),
                                      Outcome("ef", 2, {{"a", true}})};
  outcomes[1].result.state = JobState::kStopped;
  EXPECT_EQ(SuiteCsv(outcomes),
            "name,source,preset,seed,state,a,b,text\n"
            "run,sim:x?seed=1,ef,1,done,,0.25,\"say \"\"a, b\"\"\"\n"
            "run,sim:x?seed=2,ef,2,stopped,true,,\n");
}

TEST(SuiteReport, TableShowsWhatThereIs) {
  const std::string table =
      SuiteTable(Aggregate({Outcome("ef", 1, {{"trajectory.ate.translation.rmse_m", 0.0123}})}));
  EXPECT_THAT(table, HasSubstr("1.23 (1.23)"));
  EXPECT_THAT(table, HasSubstr(" - "));
}

}  // namespace
}  // namespace posefusion
