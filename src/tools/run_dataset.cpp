// Runs the whole system over recorded frames: trajectory, map and report out.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "interrupt.h"
#include "posefusion/common/stage_clock.h"
#include "posefusion/dataset/prefetched_source.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/pipeline/offline_run.h"
#include "posefusion/simulation/sim_source.h"
#include "posefusion_ros/bag_source.h"
#include "presets.h"
#include "progress.h"
#include "run_output.h"

namespace {

namespace pf = posefusion;

constexpr int kExitFailure = 1;
constexpr int kExitUsage = 2;

struct Arguments {
  std::string source;
  std::string out;
  std::string preset;
  std::vector<std::string> config_files;
  std::string keypoints = "none";
  int max_frames = 0;
  int num_threads = 2;
  double start_s = 0;
};

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Leaves out frames of another source before `start_s` and after `max_frames`.
class TrimmedSource : public pf::FrameSource {
 public:
  TrimmedSource(std::unique_ptr<pf::FrameSource> source, double start_s, int max_frames)
      : source_(std::move(source)), start_s_(start_s), max_frames_(max_frames) {}

  std::optional<pf::RgbdFrame> Next() override {
    if (max_frames_ > 0 && num_given_ >= max_frames_) return std::nullopt;
    while (auto frame = source_->Next()) {
      if (!first_stamp_ns_) first_stamp_ns_ = frame->stamp_ns;
      if (pf::SecondsBetween(*first_stamp_ns_, frame->stamp_ns) < start_s_) continue;
      ++num_given_;
      return frame;
    }
    return std::nullopt;
  }

  std::optional<int> NumFrames() const override {
    const auto all = source_->NumFrames();
    if (max_frames_ == 0 || !all) return all;
    return std::min(*all, max_frames_);
  }

 private:
  std::unique_ptr<pf::FrameSource> source_;
  double start_s_;
  int max_frames_;
  int num_given_ = 0;
  std::optional<pf::StampNs> first_stamp_ns_;
};

struct Source {
  std::unique_ptr<pf::FrameSource> frames;
  std::shared_ptr<const pf::SimulatedRun> simulation;  ///< null for recorded frames
};

Source OpenSource(const Arguments& arguments) {
  if (EndsWith(arguments.source, ".bag")) {
    return {std::make_unique<TrimmedSource>(std::make_unique<pf::BagSource>(arguments.source),
                                            arguments.start_s, arguments.max_frames),
            nullptr};
  }
  if (const auto simulation = pf::ParseSimulationName(arguments.source)) {
    auto frames = std::make_unique<pf::SimSource>(*simulation, arguments.num_threads);
    auto run = frames->run();
    return {
        std::make_unique<TrimmedSource>(std::move(frames), arguments.start_s, arguments.max_frames),
        std::move(run)};
  }
  pf::TumFolderOptions options;
  options.start_s = arguments.start_s;
  options.max_frames = arguments.max_frames;
  return {std::make_unique<pf::TumFolderSource>(arguments.source, options), nullptr};
}

/// What the run came to, in a few lines.
void PrintSummary(const pf::OfflineRun& run, const std::string& out) {
  std::printf("%zu frames: %d tracked, %d lost, %d dropped as blurred; median %.1f ms a frame\n",
              run.frames.size(), run.Count(pf::FrameState::kTracked),
              run.Count(pf::FrameState::kLost), run.Count(pf::FrameState::kDroppedBlur),
              pf::Quantile(run.frame_ms, 0.5));
  std::printf("%zu surfels; results in %s\n", run.num_surfels, out.c_str());
}

int Run(const Arguments& arguments) {
  pf::PrepareOutputFolder(arguments.out);
  std::vector<std::string> files = arguments.config_files;
  if (!arguments.preset.empty()) {
    files.insert(files.begin(), pf::PresetFile(arguments.preset));
  }
  const pf::SystemConfig config = pf::LoadSystemConfig(files);
  Source source = OpenSource(arguments);
  auto frames = std::make_unique<pf::PrefetchedSource>(std::move(source.frames));
  pf::CatchInterrupts();
  pf::Progress progress("run_dataset", frames->NumFrames());
  pf::OfflineRunHooks hooks;
  hooks.should_stop = [] { return pf::interrupted.load(); };
  hooks.on_frame = [&](int done) { progress.Update(done); };
  hooks.on_error = [&](const std::string& text) { progress.Print("run_dataset: " + text); };
  const pf::OfflineRun run = pf::RunOffline(*frames, config, arguments.num_threads, hooks);
  progress.Finish();
  frames.reset();  // ends its thread
  if (pf::interrupted) std::fprintf(stderr, "run_dataset: interrupted, saving what there is\n");
  pf::WriteRunOutput(run, config, arguments.out);
  if (source.simulation) source.simulation->WriteTruth(arguments.out + "/truth");
  PrintSummary(run, arguments.out);
  if (run.frames.empty()) throw std::runtime_error(arguments.source + ": no frame could be used");
  return run.errors.empty() ? 0 : kExitFailure;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs posefusion over recorded frames.");
  Arguments arguments;
  app.add_option("SOURCE", arguments.source,
                 "folder in TUM format, .bag, or sim:PRESET?humans=N&seed=N&seconds=S")
      ->required();
  app.add_option("--out", arguments.out, "folder for trajectory.txt, map.ply, report.json")
      ->required();
  app.add_option("--preset", arguments.preset, "named settings of config/presets")
      ->check(CLI::IsMember(pf::PresetNames()));
  app.add_option("--config", arguments.config_files,
                 "yaml files with groups blur_filter and mapping, later ones win")
      ->allow_extra_args(false);
  app.add_option("--keypoints", arguments.keypoints,
                 "keypoints of people; this version leaves people in, so only 'none'")
      ->check(CLI::IsMember({"none"}))
      ->capture_default_str();
  app.add_option("--max-frames", arguments.max_frames, "ends after so many frames")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.num_threads, "threads to use")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--start", arguments.start_s, "leaves out so many seconds at the beginning")
      ->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitUsage;
  }
  try {
    return Run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "run_dataset: %s\n", error.what());
    return kExitFailure;
  }
}
