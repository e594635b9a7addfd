// Compares masks of people with the true ones: recall, precision, worst frames.

#include <cstdio>
#include <string>

#include "posefusion/evaluation/mask_report.h"
#include "tools/tool_main.h"

namespace {

void Evaluate(const posefusion::MaskEvaluationFiles& files,
              const posefusion::MaskEvaluationConfig& config, const std::string& out) {
  const auto evaluation = posefusion::EvaluateMaskFiles(files, config);
  std::fputs(posefusion::FormatTable(evaluation, config).c_str(), stdout);
  if (!out.empty()) posefusion::WriteMaskEvaluation(evaluation, config, out);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares masks of people with the true ones, where there is depth.");
  posefusion::MaskEvaluationFiles files;
  posefusion::MaskEvaluationConfig config;
  std::string out;
  app.add_option("--truth", files.truth,
                 "folder in TUM format with labels/ (10 and above are people) or masks/")
      ->required();
  app.add_option("--estimate", files.estimate, "folder with masks <stamp>.png, not 0 = person")
      ->required();
  app.add_option("--keypoints", files.keypoints,
                 "OpenPose JSON by stamp: people with too few joints do not count");
  app.add_option("--min-joints", config.min_joints, "joints that a person needs to count")
      ->check(CLI::Range(1, 18))
      ->capture_default_str();
  app.add_flag("--only-estimated", files.only_estimated, "leave out frames without a mask");
  app.add_option("--rim", config.rim_px, "pixels this close to a border do not count")
      ->check(CLI::Range(0, 50))
      ->capture_default_str();
  app.add_option("--worst", config.num_worst, "number of worst frames listed")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--out", out, "folder for mask_evaluation.json");
  return posefusion::RunTool(app, argc, argv, "evaluate_masks", [&] {
    Evaluate(files, config, out);
    return 0;
  });
}
