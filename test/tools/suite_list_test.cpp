#include "tools/suite_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "posefusion/common/atomic_file.h"
#include "test/support/temporary_folder.h"
#include "tools/presets.h"
#include "tools/suite_time.h"

namespace posefusion {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class SuiteListTest : public ::testing::Test {
 protected:
  std::vector<SuiteJob> Read(const std::string& text) const {
    WriteFileAtomically(path_, text);
    return ReadSuite(path_, {"ef", "pf"});
  }

  void ExpectError(const std::string& text, const std::string& message) const {
    EXPECT_THAT([&] { Read(text); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(path_ + ": " + message)));
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "list.yaml";
};

TEST_F(SuiteListTest, EverySourceRunsWithEveryPresetAndSeed) {
  const auto jobs = Read(
      "runs:\n- {name: a, sources: ['sim:x?seed={seed}', /data/b], presets: [default, ef],\n"
      "   seeds: [7, 8], options: [--config, '{seed}.yaml'], truth: '{source}/t{seed}',\n"
      "   exclude: '{truth}/e.txt', frames: 90}\n"
      "- {name: c, sources: [/data/c]}\n");
  ASSERT_EQ(jobs.size(), 9U);
  EXPECT_EQ(jobs[3].source, "sim:x?seed=8");
  EXPECT_EQ(jobs[3].source_template, "sim:x?seed={seed}");
  EXPECT_EQ(jobs[3].preset, "ef");
  EXPECT_EQ(jobs[3].id, "a/source_1/ef/seed_8");
  EXPECT_THAT(jobs[3].options, ElementsAre("--config", "8.yaml"));
  EXPECT_EQ(jobs[3].truth, "sim:x?seed=8/t8");
  EXPECT_EQ(jobs[3].exclude, "{truth}/e.txt");
  EXPECT_EQ(jobs[8].id, "c/default/seed_1");
  EXPECT_EQ(jobs[8].source, "/data/c");
  EXPECT_TRUE(jobs[8].truth.empty());
}

TEST_F(SuiteListTest, RefusesWithTheNameOfTheKey) {
  ExpectError("[]", "expected one key 'runs'");
  ExpectError("runs: []", "runs: empty");
  ExpectError("runs: [{sources: [a]}]", "runs[0].name: ''");
  ExpectError("runs: [{name: ../a, sources: [a]}]", "runs[0].name: '../a'");
  ExpectError("runs: [{name: .., sources: [a]}]", "runs[0].name: '..'");
  ExpectError("runs: [{name: a}]", "runs[0].sources: missing");
  ExpectError("runs: [{name: a, sources: b}]", "runs[0].sources: expected a list");
  ExpectError("runs: [{name: a, sources: [b], seed: [1]}]", "runs[0].seed: unknown key");
  ExpectError("runs: [{name: a, sources: [b], seeds: [x]}]", "runs[0].seeds: expected a list of");
  ExpectError("runs: [{name: a, sources: [b], seeds: [1, 2]}]", "runs[0].seeds: nothing has a");
  ExpectError("runs: [{name: a, sources: [b], presets: [xx]}]",
              "runs[0].presets: there is no preset 'xx'");
  ExpectError("runs: [{name: a, sources: [b]}, {name: a, sources: [c]}]",
              "a/default/seed_1 is twice");
  ExpectError("runs: [a]", "runs[0]: expected name");
}

TEST_F(SuiteListTest, ShippedListsCanBeRead) {
  for (const char* name : {"simulated", "people"}) {
    const std::string shipped = POSEFUSION_CONFIG_FOLDER "/suites/" + std::string(name) + ".yaml";
    EXPECT_FALSE(ReadSuite(shipped, PresetNames()).empty()) << shipped;
  }
}

TEST_F(SuiteListTest, CountsFramesWhereTheyCanBeTold) {
  SuiteJob job;
  job.source = "sim:x?humans=2&seconds=20";
  EXPECT_EQ(NumFrames(job), 600);
  job.options = {"--max-frames", "100"};
  EXPECT_EQ(NumFrames(job), 100);
  job.source = folder_.path();
  job.options.clear();
  EXPECT_EQ(NumFrames(job), std::nullopt);
  WriteFileAtomically(folder_ / "rgb.txt", "# comment\n1.0 a.png\n2.0 b.png\n");
  EXPECT_EQ(NumFrames(job), 2);
  job.frames = 7;
  EXPECT_EQ(NumFrames(job), 7);
}

TEST_F(SuiteListTest, EstimateOfTimeFollowsTheJobsThatAreDone) {
  SuiteJob job;
  job.source = "/data/a";
  job.frames = 1000;
  SuiteTime time(/*ms_per_frame=*/95, /*num_parallel=*/1);
  for (int i = 0; i < 3; ++i) time.AddPending(job);
  EXPECT_NEAR(time.RemainingS(), 300, 1e-6);  // 95 s and 5 s for the evaluation, each
  time.AddDone(job, 50, /*was_pending=*/true);
  EXPECT_NEAR(time.RemainingS(), 100, 1e-6);
  time.Drop(job);
  EXPECT_NEAR(time.RemainingS(), 50, 1e-6);
}

}  // namespace
}  // namespace posefusion
