// Compares the map of a simulated run with the true surfaces: errors, completeness, ghosts.

#include <cstdio>
#include <string>

#include "posefusion/evaluation/map_report.h"
#include "tools/tool_main.h"

namespace {

void Evaluate(const posefusion::MapEvaluationFiles& files,
              const posefusion::MapEvaluationConfig& config, const std::string& out) {
  const auto evaluation = posefusion::EvaluateMapFiles(files, config);
  std::fputs(posefusion::FormatTable(evaluation, config).c_str(), stdout);
  if (!out.empty()) posefusion::WriteMapEvaluation(evaluation, config, out);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Compares the surfel map of a simulated run with the true surfaces.");
  posefusion::MapEvaluationFiles files;
  posefusion::MapEvaluationConfig config;
  std::string out;
  app.add_option("--map", files.map, "map.ply of run_dataset")->required();
  app.add_option("--truth", files.truth,
                 "folder with world.ply, groundtruth.txt, camera.yaml, rgb.txt, and "
                 "moved_objects.txt, people_capsules.txt and events.txt where there are any")
      ->required();
  app.add_option("--estimate", files.estimate,
                 "camera poses of the map, TUM format (default: trajectory.txt beside the map)");
  app.add_option("--min-confidence", config.min_confidence, "surfels below are left out")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--threads", config.num_threads, "threads to use")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--out", out, "folder for map_evaluation.json");
  return posefusion::RunTool(app, argc, argv, "evaluate_map", [&] {
    Evaluate(files, config, out);
    return 0;
  });
}
