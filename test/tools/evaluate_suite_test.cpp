// The program evaluate_suite, run as its users run it, with scripts in the place of the programs
// that it starts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "posefusion/common/atomic_file.h"
#include "test/support/program_run.h"
#include "test/support/temporary_folder.h"

namespace posefusion {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Counts its runs, fails for the source "bad", waits for the source "slow", and reports its seed,
/// which is its source's last letter.
constexpr char kFakeRun[] = R"(#!/bin/sh
echo "$@" >> FOLDER/runs.txt
case $1 in
  bad*) echo "cannot do it"; exit 1;;
  slow*) touch FOLDER/waiting; sleep 30;;
esac
seed=${1#"${1%?}"}
echo "{\"frames\": {\"total\": $seed}}" > "$3/report.json"
case "$*" in *--masks*) mkdir "$3/masks"; touch "$3/masks/1.png";; esac
)";

constexpr char kFakeEvaluation[] = R"(#!/bin/sh
echo "$@" >> FOLDER/evaluations.txt
while [ "$1" != --out ]; do shift; done
mkdir -p "$2"
echo '{"FIGURE": 1}' > "$2/NAME"
)";

class EvaluateSuiteTest : public ::testing::Test {
 protected:
  EvaluateSuiteTest() {
    fs::create_directories(folder_ / "programs");
    WriteProgram("run_dataset", kFakeRun);
    std::string evaluation = kFakeEvaluation;
    WriteProgram("evaluate_blur", Replaced(Replaced(evaluation, "NAME", "blur_evaluation.json"),
                                           "FIGURE", "recall"));
    WriteProgram("evaluate_masks", Replaced(Replaced(evaluation, "NAME", "mask_evaluation.json"),
                                            "FIGURE", "recall"));
    WriteProgram("evaluate_map", Replaced(Replaced(evaluation, "NAME", "map_evaluation.json"),
                                          "FIGURE", "surface"));
    WriteProgram("evaluate_trajectory",
                 Replaced(Replaced(evaluation, "NAME", "evaluation.json"), "FIGURE", "ate"));
  }

  static std::string Replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t place = text.find(from); place != std::string::npos; place = text.find(from)) {
      text.replace(place, from.size(), to);
    }
    return text;
  }

  void WriteProgram(const std::string& name, const std::string& text) const {
    const std::string path = folder_ / ("programs/" + name);
    WriteFileAtomically(path, Replaced(text, "FOLDER", folder_.path()));
    fs::permissions(path, fs::perms::owner_all);
  }

  std::string Arguments(const std::string& runs) const {
    WriteFileAtomically(folder_ / "list.yaml", "runs: " + runs);
    return (folder_ / "list.yaml") + " --out " + (folder_ / "out") + " --programs " +
           (folder_ / "programs");
  }

  ProgramRun Run(const std::string& runs, const std::string& more = "") const {
    return RunProgram(EVALUATE_SUITE, Arguments(runs) + " " + more);
  }

  /// How often run_dataset has been started.
  int NumRuns() const {
    const std::string runs = ReadWholeFile(folder_ / "runs.txt");
    return static_cast<int>(std::count(runs.begin(), runs.end(), '\n'));
  }

  nlohmann::json Result() const {
    return nlohmann::json::parse(ReadWholeFile(folder_ / "out/suite.json"));
  }

  TemporaryFolder folder_;
};

constexpr char kSixJobs[] =
    "[{name: a, sources: ['x{seed}'], presets: [default, ef], "
    "seeds: [1, 2, 4], options: [--max-frames, '3']}]";

TEST_F(EvaluateSuiteTest, RunsEveryJobAndGathersTheFigures) {
  const ProgramRun run = Run(kSixJobs, "--jobs 2");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(run.output, AllOf(HasSubstr("6 jobs, 0 already done; about "), HasSubstr("[6/6] a/"),
                                HasSubstr("about 0 s left")));
  EXPECT_EQ(NumRuns(), 6);
  EXPECT_THAT(ReadWholeFile(folder_ / "runs.txt"),
              HasSubstr("x4 --out " + (folder_ / "out/jobs/a/ef/seed_4") +
                        " --preset ef --max-frames 3\n"));
  const auto result = Result();
  ASSERT_EQ(result.at("jobs").size(), 6U);
  EXPECT_EQ(result["jobs"][2]["figures"]["report.frames.total"], 4);
  ASSERT_EQ(result.at("aggregates").size(), 2U);
  EXPECT_EQ(result["aggregates"][1]["figures"]["report.frames.total"]["median"], 2.0);
  EXPECT_TRUE(fs::exists(folder_ / "out/suite.csv"));
  EXPECT_TRUE(fs::exists(folder_ / "out/suite_summary.csv"));
}

TEST_F(EvaluateSuiteTest, SkipsJobsThatAreDoneUntilSomethingChanges) {
  Run(kSixJobs);
  const ProgramRun again = Run(kSixJobs);
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.output, HasSubstr("6 jobs, 6 already done; about 0 s"));
  EXPECT_EQ(NumRuns(), 6);
  EXPECT_EQ(Result()["jobs"][5]["figures"]["report.frames.total"], 4);
  Run(Replaced(kSixJobs, "'3'", "'5'"));  // other options
  EXPECT_EQ(NumRuns(), 12);
  fs::remove(folder_ / "out/jobs/a/ef/seed_2/done.json");
  Run(Replaced(kSixJobs, "'3'", "'5'"));
  EXPECT_EQ(NumRuns(), 13);
  WriteProgram("run_dataset", std::string(kFakeRun) + "# another version\n");
  Run(Replaced(kSixJobs, "'3'", "'5'"));
  EXPECT_EQ(NumRuns(), 19);
}

TEST_F(EvaluateSuiteTest, EvaluatesWhereThereIsATruth) {
  fs::create_directories(folder_ / "data");
  fs::create_directories(folder_ / "truth");
  WriteFileAtomically(folder_ / "data/groundtruth.txt", "");
  WriteFileAtomically(folder_ / "truth/groundtruth.txt", "");
  WriteFileAtomically(folder_ / "truth/world.ply", "");
  WriteFileAtomically(folder_ / "truth/events.txt", "");
  Run("[{name: a, sources: ['" + (folder_ / "data") + "'], exclude: '{truth}/b.txt'}]");
  EXPECT_THAT(ReadWholeFile(folder_ / "evaluations.txt"),
              AllOf(HasSubstr("--groundtruth " + (folder_ / "data/groundtruth.txt")),
                    HasSubstr("/trajectory_live.txt"),
                    HasSubstr("--exclude " + (folder_ / "data/b.txt")), Not(HasSubstr("--map"))));
  const ProgramRun run =
      Run("[{name: b, sources: [x1], truth: '" + Replaced(folder_ / "trut{h}", "{h}", "h") + "'}]");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(ReadWholeFile(folder_ / "evaluations.txt"),
              AllOf(HasSubstr("--map " + (folder_ / "out/jobs/b/default/seed_1/map.ply")),
                    HasSubstr("--exclude " + (folder_ / "truth/events.txt"))));
  const auto figures = Result()["jobs"][0]["figures"];
  for (const char* key : {"trajectory.ate", "live.ate", "map.surface"}) EXPECT_EQ(figures[key], 1);
}

TEST_F(EvaluateSuiteTest, EvaluatesMasksWhereThereAreAnyAndTrueOnes) {
  fs::create_directories(folder_ / "data1/labels");
  fs::create_directories(folder_ / "nobody2");
  for (const char* truth : {"data1", "nobody2"}) {
    WriteFileAtomically(folder_ / (std::string(truth) + "/groundtruth.txt"), "");
  }
  const auto entry = [&](const std::string& name, const std::string& source,
                         const std::string& options) {
    return "{name: " + name + ", sources: ['" + (folder_ / source) + "'], options: [" + options +
           "]}";
  };
  const ProgramRun run =
      Run("[" + entry("with", "data1", "--masks") + "," + entry("without_masks", "data1", "") +
          "," + entry("without_truth", "nobody2", "--masks") + "]");
  EXPECT_EQ(run.exit_code, 0) << run.output;
  EXPECT_THAT(ReadWholeFile(folder_ / "evaluations.txt"),
              HasSubstr("--truth " + (folder_ / "data1") + " --estimate " +
                        (folder_ / "out/jobs/with/default/seed_1/masks") + " --only-estimated"));
  const auto jobs = Result()["jobs"];
  EXPECT_EQ(jobs[0]["figures"].count("masks.recall"), 1U);
  EXPECT_EQ(jobs[1]["figures"].count("masks.recall"), 0U);
  EXPECT_EQ(jobs[2]["figures"].count("masks.recall"), 0U);
}

TEST_F(EvaluateSuiteTest, FailedJobsNameTheirLogAndTheOthersGoOn) {
  const ProgramRun run =
      Run("[{name: a, sources: [bad1, x1]}, {name: c, sources: [x2], truth: /no}]");
  EXPECT_EQ(run.exit_code, 1);
  const std::string log = folder_ / "out/jobs/a/source_1/default/seed_1/log.txt";
  EXPECT_THAT(run.output, HasSubstr("run_dataset failed with exit code 1; see " + log));
  EXPECT_THAT(run.output, HasSubstr("/no: has no groundtruth.txt"));
  EXPECT_THAT(ReadWholeFile(log), HasSubstr("cannot do it"));
  EXPECT_EQ(Result()["jobs"][0]["state"], "failed");
  EXPECT_EQ(Result()["jobs"][1]["state"], "done");
  EXPECT_EQ(Result()["jobs"][2]["state"], "failed");
  EXPECT_EQ(Result()["jobs"][2]["figures"]["report.frames.total"], 2);  // what there was
  EXPECT_EQ(Result()["aggregates"][2]["done"], 0);
}

TEST_F(EvaluateSuiteTest, CtrlCKeepsWhatIsDoneAndGoesOnLater) {
  const std::string runs = "[{name: a, sources: [x1]}, {name: b, sources: [slow1, x3]}]";
  const std::string script =
      "( " + std::string(EVALUATE_SUITE) + " " + Arguments(runs) + " & suite=$!; while [ ! -e " +
      (folder_ / "waiting") +
      " ]; do sleep 0.05; done; kill -INT $suite; wait $suite; echo code $? )";
  const ProgramRun run = RunProgram(script, "");
  EXPECT_THAT(run.output, AllOf(HasSubstr("interrupted; 2 jobs are left"), HasSubstr("code 1")));
  EXPECT_EQ(Result()["jobs"][0]["state"], "done");
  EXPECT_EQ(Result()["jobs"][1]["state"], "stopped");
  EXPECT_EQ(NumRuns(), 2);
  WriteProgram("run_dataset", kFakeRun);  // the same bytes
  const ProgramRun later = Run("[{name: a, sources: [x1]}, {name: b, sources: [x1, x3]}]");
  EXPECT_THAT(later.output, HasSubstr("3 jobs, 1 already done"));
  EXPECT_EQ(later.exit_code, 0);
}

TEST_F(EvaluateSuiteTest, ErrorsHaveTheirExitCodes) {
  EXPECT_EQ(RunProgram(EVALUATE_SUITE, "").exit_code, 2);
  EXPECT_EQ(RunProgram(EVALUATE_SUITE, "--help").exit_code, 0);
  EXPECT_EQ(Run(kSixJobs, "--jobs 0").exit_code, 2);
  const ProgramRun missing = RunProgram(EVALUATE_SUITE, "/no.yaml --out " + (folder_ / "out"));
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_THAT(missing.output, HasSubstr("/no.yaml"));
  fs::remove(folder_ / "programs/evaluate_map");
  const ProgramRun no_program = Run(kSixJobs);
  EXPECT_EQ(no_program.exit_code, 1);
  EXPECT_THAT(no_program.output, HasSubstr("evaluate_map: there is no such program"));
}

}  // namespace
}  // namespace posefusion
