// Compares an estimated camera trajectory with the ground truth: ATE, RPE over 1 s, coverage.

#include <cstdio>
#include <string>

#include "posefusion/evaluation/evaluation_report.h"
#include "posefusion/evaluation/plot_runner.h"
#include "posefusion/evaluation/trajectory_evaluation.h"
#include "tools/tool_main.h"

namespace {

void Evaluate(const posefusion::EvaluationFiles& files, const std::string& out) {
  const auto evaluation = posefusion::EvaluateFiles(files);
  std::fputs(posefusion::FormatTable(evaluation).c_str(), stdout);
  std::fflush(stdout);
  if (out.empty()) return;
  posefusion::WriteEvaluation(evaluation, out);
  const std::string problem = posefusion::PlotEvaluation(out);
  if (!problem.empty()) {
    std::fprintf(stderr, "evaluate_trajectory: warning: no plots: %s\n", problem.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares an estimated camera trajectory with the ground truth.");
  posefusion::EvaluationFiles files;
  std::string out;
  app.add_option("--groundtruth", files.groundtruth, "true poses, TUM format")->required();
  app.add_option("--estimate", files.estimate, "estimated poses, TUM format")->required();
  app.add_option("--exclude", files.exclude,
                 "intervals that do not count: lines 'start_stamp end_stamp name'");
  app.add_option("--frames", files.frames,
                 "frames that should have a pose: lines 'stamp [state]' (default: frames.txt or "
                 "report.json beside the estimate)");
  app.add_option("--out", out, "folder for evaluation.json, tables and plots");
  return posefusion::RunTool(app, argc, argv, "evaluate_trajectory", [&] {
    Evaluate(files, out);
    return 0;
  });
}
