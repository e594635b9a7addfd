// Runs many sources with many presets and seeds, evaluates each run and gathers all figures.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "interrupt.h"
#include "presets.h"
#include "suite_list.h"
#include "suite_report.h"
#include "suite_runner.h"
#include "tools/tool_main.h"

namespace {

namespace pf = posefusion;

struct Arguments {
  std::string list;
  std::string programs;  ///< folder
  pf::SuiteOptions options;
};

void Say(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

/// Names what did not succeed. @return the exit code.
int ReportProblems(const std::vector<pf::JobOutcome>& outcomes) {
  int num_failed = 0;
  int num_stopped = 0;
  for (const pf::JobOutcome& outcome : outcomes) {
    if (outcome.result.state == pf::JobState::kStopped) ++num_stopped;
    if (outcome.result.state != pf::JobState::kFailed) continue;
    ++num_failed;
    std::fprintf(stderr, "evaluate_suite: %s failed: %s\n", outcome.job.id.c_str(),
                 outcome.result.problem.c_str());
  }
  if (num_stopped > 0) {
    std::fprintf(stderr,
                 "evaluate_suite: interrupted; %d jobs are left, the same command goes on\n",
                 num_stopped);
  }
  return num_failed + num_stopped > 0 ? pf::kExitFailure : 0;
}

int Run(Arguments arguments) {
  const auto jobs = pf::ReadSuite(arguments.list, pf::PresetNames());
  const pf::SuitePrograms programs(arguments.programs);
  pf::CatchInterrupts();
  arguments.options.should_stop = [] { return pf::interrupted.load(); };
  arguments.options.say = Say;
  arguments.options.out = std::filesystem::absolute(arguments.options.out).lexically_normal();
  const auto outcomes = pf::RunSuite(jobs, programs, arguments.options);
  pf::WriteSuite(outcomes, arguments.options.out);
  std::fputs(pf::SuiteTable(pf::Aggregate(outcomes)).c_str(), stdout);
  Say("results in " + arguments.options.out);
  return ReportProblems(outcomes);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs and evaluates a list of sources x presets x seeds.");
  Arguments arguments;
  std::error_code error;
  arguments.programs =
      std::filesystem::read_symlink("/proc/self/exe", error).parent_path().string();
  app.add_option("LIST", arguments.list, "yaml list of runs (config/suites has an example)")
      ->required();
  app.add_option("--out", arguments.options.out,
                 "folder for the runs, suite.csv, suite_summary.csv and suite.json; jobs that are "
                 "already done there are skipped")
      ->required();
  app.add_option("--jobs", arguments.options.num_parallel,
                 "jobs at a time; each uses two threads unless its options say otherwise")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--ms-per-frame", arguments.options.ms_per_frame,
                 "first guess for the estimate of time")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--programs", arguments.programs,
                 "folder of run_dataset, evaluate_trajectory, evaluate_map, evaluate_blur and "
                 "evaluate_masks")
      ->capture_default_str();
  return posefusion::RunTool(app, argc, argv, "evaluate_suite", [&] { return Run(arguments); });
}
