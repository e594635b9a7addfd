// Runs the whole system over recorded frames: trajectory, map and report out.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "interrupt.h"
#include "posefusion/common/stage_clock.h"
#include "posefusion/dataset/prefetched_source.h"
#include "posefusion/dataset/trajectory_file.h"
#include "posefusion/dataset/tum_folder_source.h"
#include "posefusion/pipeline/offline_run.h"
#include "posefusion/simulation/robot_record.h"
#include "posefusion/simulation/sim_source.h"
#include "posefusion/skeleton/skeleton_folder.h"
#include "posefusion/skeleton/timed_skeletons.h"
#include "posefusion_ros/bag_source.h"
#include "presets.h"
#include "progress.h"
#include "run_output.h"
#include "tools/tool_main.h"

namespace {

namespace pf = posefusion;

constexpr char kNone[] = "none";

struct Arguments {
  std::string source;
  std::string out;
  std::string preset;
  std::vector<std::string> config_files;
  std::string keypoints;  ///< folder or "none"; empty = what the source has
  std::string odometry;   ///< file or "none"; empty = what the source has
  pf::KeypointDelivery delivery;
  bool save_masks = false;
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

/// Where the robot believes its camera is.
struct Odometry {
  std::unique_ptr<pf::OdometrySource> source;  ///< null = none
  std::string name = kNone;                    ///< for the report
};

struct Source {
  std::unique_ptr<pf::FrameSource> frames;
  std::unique_ptr<pf::SkeletonSource> own_keypoints;   ///< that come with the frames, or null
  std::shared_ptr<const pf::SimulatedRun> simulation;  ///< null for recorded frames
};

Odometry ReadOdometry(const std::string& path) {
  return {std::make_unique<pf::RecordedOdometry>(pf::ReadTrajectory(path)), path};
}

/// What comes with the frames.
Odometry OwnOdometry(const Arguments& arguments, const pf::SimulatedRun* simulation) {
  if (simulation != nullptr) {
    const pf::Simulator& simulator = simulation->simulator;
    pf::Trajectory trajectory = CameraOdometry(RecordRobot(simulator.config(), simulator.mover()));
    if (trajectory.empty()) return {};
    return {std::make_unique<pf::RecordedOdometry>(std::move(trajectory)), "simulator"};
  }
  const std::string path = arguments.source + "/odometry_camera.txt";
  return std::filesystem::exists(path) ? ReadOdometry(path) : Odometry();
}

/// @throws std::invalid_argument when a file is given that would not be used.
Odometry OpenOdometry(const Arguments& arguments, const pf::SystemConfig& config,
                      const pf::SimulatedRun* simulation) {
  const bool enabled = config.mapping.tracking.prior.enabled;
  if (arguments.odometry == kNone) return {};
  if (arguments.odometry.empty()) return enabled ? OwnOdometry(arguments, simulation) : Odometry();
  if (!enabled) {
    throw std::invalid_argument("--odometry " + arguments.odometry +
                                ": mapping.tracking.prior.enabled is false");
  }
  return ReadOdometry(arguments.odometry);
}

Source OpenBag(const Arguments& arguments, const pf::CameraInfoConfig& camera_info) {
  pf::BagSourceOptions options;
  options.images_are_rectified = camera_info.images_are_rectified;
  return {
      std::make_unique<TrimmedSource>(std::make_unique<pf::BagSource>(arguments.source, options),
                                      arguments.start_s, arguments.max_frames),
      nullptr, nullptr};
}

Source OpenSource(const Arguments& arguments, const pf::SystemConfig& config) {
  if (EndsWith(arguments.source, ".bag")) return OpenBag(arguments, config.camera_info);
  if (const auto simulation = pf::ParseSimulationName(arguments.source)) {
    auto frames = std::make_unique<pf::SimSource>(*simulation, arguments.num_threads);
    auto run = frames->run();
    auto keypoints = arguments.keypoints.empty() ? frames->MakeKeypoints() : nullptr;
    return {
        std::make_unique<TrimmedSource>(std::move(frames), arguments.start_s, arguments.max_frames),
        std::move(keypoints), std::move(run)};
  }
  pf::TumFolderOptions options;
  options.start_s = arguments.start_s;
  options.max_frames = arguments.max_frames;
  auto frames = std::make_unique<pf::TumFolderSource>(arguments.source, options);
  const std::string folder = arguments.source + "/keypoints";
  const bool own = arguments.keypoints.empty() && std::filesystem::is_directory(folder);
  return {std::move(frames), own ? std::make_unique<pf::SkeletonFolder>(folder) : nullptr, nullptr};
}

/// The keypoints that are asked for, as fast and as late as they are asked for; null for none.
std::unique_ptr<pf::SkeletonSource> OpenKeypoints(const Arguments& arguments,
                                                  std::unique_ptr<pf::SkeletonSource> own) {
  if (arguments.keypoints == kNone) return nullptr;
  std::unique_ptr<pf::SkeletonSource> keypoints = std::move(own);
  if (!arguments.keypoints.empty()) {
    keypoints = std::make_unique<pf::SkeletonFolder>(arguments.keypoints);
  }
  if (!keypoints) return nullptr;
  return std::make_unique<pf::TimedSkeletons>(std::move(keypoints), arguments.delivery);
}

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
  Source source = OpenSource(arguments, config);
  const Odometry odometry = OpenOdometry(arguments, config, source.simulation.get());
  const auto keypoints = OpenKeypoints(arguments, std::move(source.own_keypoints));
  auto frames = std::make_unique<pf::PrefetchedSource>(std::move(source.frames));
  pf::CatchInterrupts();
  pf::Progress progress("run_dataset", frames->NumFrames());
  pf::OfflineRunHooks hooks;
  hooks.should_stop = [] { return pf::interrupted.load(); };
  hooks.on_frame = [&](int done) { progress.Update(done); };
  hooks.on_error = [&](const std::string& text) { progress.Print("run_dataset: " + text); };
  hooks.on_note = hooks.on_error;
  if (arguments.save_masks) hooks.on_mask = pf::MaskWriter(arguments.out + "/masks");
  const pf::OfflineRun run = pf::RunOffline(*frames, config, arguments.num_threads, hooks,
                                            keypoints.get(), odometry.source.get());
  progress.Finish();
  frames.reset();  // ends its thread
  if (pf::interrupted) std::fprintf(stderr, "run_dataset: interrupted, saving what there is\n");
  pf::WriteRunOutput(run, config, odometry.name, arguments.out);
  if (source.simulation) source.simulation->WriteTruth(arguments.out + "/truth");
  PrintSummary(run, arguments.out);
  if (keypoints) PrintKeypoints(run, keypoints->counts());
  if (run.frames.empty()) throw std::runtime_error(arguments.source + ": no frame could be used");
  return run.errors.empty() ? 0 : pf::kExitFailure;
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
  app.add_option(
         "--config", arguments.config_files,
         "yaml files with groups blur_filter, human_removal, mapping and camera_info, later "
         "ones win")
      ->allow_extra_args(false);
  app.add_option(
      "--keypoints", arguments.keypoints,
      "folder of OpenPose's JSON files, or 'none' (default: SOURCE/keypoints if there is "
      "one, the simulator's own for sim:)");
  app.add_option("--keypoint-rate", arguments.delivery.rate_hz,
                 "uses keypoints of so many images per second (default: of all that have some)")
      ->check(CLI::Range(0.01, 1000.0));
  app.add_option("--keypoint-delay", arguments.delivery.delay_s,
                 "lets keypoints arrive so many seconds later, in the time of the images")
      ->check(CLI::Range(0.0, 100.0));
  app.add_option("--odometry", arguments.odometry,
                 "poses of the camera in the odometry frame, TUM format, or 'none' (default: "
                 "SOURCE/odometry_camera.txt if there is one, the simulated robot's own for sim:)");
  app.add_flag("--masks", arguments.save_masks, "writes what was taken for people to OUT/masks");
  app.add_option("--max-frames", arguments.max_frames, "ends after so many frames")
      ->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.num_threads, "threads to use")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  app.add_option("--start", arguments.start_s, "leaves out so many seconds at the beginning")
      ->check(CLI::NonNegativeNumber);
  return posefusion::RunTool(app, argc, argv, "run_dataset", [&] { return Run(arguments); });
}
