// Runs the whole system over recorded frames: trajectory, map and report out.

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "interrupt.h"
#include "posefusion/common/stage_clock.h"
#include "posefusion/dataset/prefetched_source.h"
#include "posefusion/pipeline/offline_run.h"
#include "presets.h"
#include "progress.h"
#include "run_inputs.h"
#include "run_output.h"
#include "tools/tool_main.h"

namespace {

namespace pf = posefusion;

struct Arguments {
  pf::RunInputNames input;
  std::string out;
  std::string preset;
  std::vector<std::string> config_files;
  bool save_masks = false;
};

/// What the run came to, in a few lines.
void PrintSummary(const pf::OfflineRun& run, const std::string& out) {
  std::printf("%zu frames: %d tracked, %d lost, %d dropped as blurred; median %.1f ms a frame\n",
              run.frames.size(), run.Count(pf::FrameState::kTracked),
              run.Count(pf::FrameState::kLost), run.Count(pf::FrameState::kDroppedBlur),
              pf::Quantile(run.frame_ms, 0.5));
  std::printf("%zu surfels; results in %s\n", run.num_surfels, out.c_str());
}

void PrintKeypoints(const pf::OfflineRun& run, const pf::SkeletonCounts& counts) {
  std::printf("keypoints of %d frames: %d arrived before the end, %d more belong to no frame\n",
              counts.frames_with_keypoints, run.num_keypoints, counts.without_frame);
}

int Run(const Arguments& arguments) {
  pf::PrepareOutputFolder(arguments.out);
  std::vector<std::string> files = arguments.config_files;
  if (!arguments.preset.empty()) {
    files.insert(files.begin(), pf::PresetFile(arguments.preset));
  }
  const pf::SystemConfig config = pf::LoadSystemConfig(files);
  pf::RunInputs inputs = pf::OpenRunInputs(arguments.input, config);
  auto frames = std::make_unique<pf::PrefetchedSource>(std::move(inputs.frames));
  pf::CatchInterrupts();
  pf::Progress progress("run_dataset", frames->NumFrames());
  pf::OfflineRunHooks hooks;
  hooks.should_stop = [] { return pf::interrupted.load(); };
  hooks.on_frame = [&](int done) { progress.Update(done); };
  hooks.on_error = [&](const std::string& text) { progress.Print("run_dataset: " + text); };
  hooks.on_note = hooks.on_error;
  if (arguments.save_masks) hooks.on_mask = pf::MaskWriter(arguments.out + "/masks");
  const pf::OfflineRun run = pf::RunOffline(*frames, config, arguments.input.num_threads, hooks,
                                            inputs.keypoints.get(), inputs.odometry.get());
  progress.Finish();
  frames.reset();  // ends its thread
  if (pf::interrupted) std::fprintf(stderr, "run_dataset: interrupted, saving what there is\n");
  pf::WriteRunOutput(run, config, inputs.odometry_name, arguments.out);
  if (inputs.simulation) inputs.simulation->WriteTruth(arguments.out + "/truth");
  PrintSummary(run, arguments.out);
  if (inputs.keypoints) PrintKeypoints(run, inputs.keypoints->counts());
  if (run.frames.empty())
    throw std::runtime_error(arguments.input.source + ": no frame could be used");
  return run.errors.empty() ? 0 : pf::kExitFailure;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs posefusion over recorded frames.");
  Arguments arguments;
  app.add_option("SOURCE", arguments.input.source,
                 "folder in TUM format, .bag, or sim:PRESET?humans=N&seed=N&seconds=S")
      ->required();
  app.add_option("--out", arguments.out, "folder for trajectory.txt, map.ply, report.json")
      ->required();
  app.add_option("--preset", arguments.preset, "named settings of config/presets")
      ->check(CLI::IsMember(pf::PresetNames()));
  app.add_option(
         "--config", arguments.config_files,
         "yaml files with groups blur_filter, human_removal, mapping and camera_info, later "
         "ones win")
      ->allow_extra_args(false);
  app.add_option(
      "--keypoints", arguments.input.keypoints,
      "folder of OpenPose's JSON files, topic:NAME of a bag, or 'none' (default: SOURCE/keypoints "
      "or the bag's /skeletons_in if there is one, the simulator's own for sim:)");
  app.add_option("--keypoint-rate", arguments.input.delivery.rate_hz,
                 "uses keypoints of so many images per second (default: of all that have some)")
      ->check(CLI::Range(0.01, 1000.0));
  app.add_option("--keypoint-delay", arguments.input.delivery.delay_s,
                 "lets keypoints arrive so many seconds later, in the time of the images")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option(
      "--odometry", arguments.input.odometry,
      "poses of the camera in the odometry frame, TUM format, tf:FRAME of a bag, or 'none' "
      "(default: SOURCE/odometry_camera.txt if there is one, the simulated robot's own "
      "for sim:)");
  app.add_flag("--masks", arguments.save_masks, "writes what was taken for people to OUT/masks");
  app.add_option("--max-frames", arguments.input.max_frames, "ends after so many frames")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.input.num_threads, "threads to use")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--start", arguments.input.start_s, "leaves out so many seconds at the beginning")
      ->check(CLI::NonNegativeNumber);
  return posefusion::RunTool(app, argc, argv, "run_dataset", [&] { return Run(arguments); });
}
