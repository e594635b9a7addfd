// Compares what the blur filter dropped of a simulated run with the true blur of its frames.

#include <cstdio>
#include <filesystem>
#include <string>

#include "posefusion/evaluation/blur_evaluation.h"
#include "tools/tool_main.h"

namespace {

void Evaluate(const std::string& truth, const std::string& frames,
              const posefusion::BlurEvaluationConfig& config, const std::string& out) {
  const std::string events = truth + "/events.txt";
  const auto evaluation = posefusion::EvaluateBlur(
      posefusion::ReadJudgedFrames(truth + "/blur.txt", frames),
      std::filesystem::exists(events) ? posefusion::ReadIntervals(events)
                                      : std::vector<posefusion::StampInterval>(),
      config);
  std::fputs(posefusion::FormatTable(evaluation, config).c_str(), stdout);
  if (!out.empty()) posefusion::WriteBlurEvaluation(evaluation, config, out);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares the frames that the blur filter dropped with the true blur.");
  std::string truth;
  std::string frames;
  std::string out;
  posefusion::BlurEvaluationConfig config;
  app.add_option("--truth", truth, "folder with blur.txt, and events.txt where there is one")
      ->required();
  app.add_option("--frames", frames, "frames.txt of run_dataset")->required();
  app.add_option("--blurred-px", config.blurred_px, "longer true blur ought to be dropped")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--still-px", config.still_px, "up to this the image stands still")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--out", out, "folder for blur_evaluation.json");
  return posefusion::RunTool(app, argc, argv, "evaluate_blur", [&] {
    Evaluate(truth, frames, config, out);
    return 0;
  });
}
